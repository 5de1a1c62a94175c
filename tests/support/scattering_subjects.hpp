// Subjects of the laws: strategies over the directions into which a surface scatters.
#pragma once

#include "subject.hpp"
#include "visibility.hpp"
#include <lumis/lumis.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace subjects {

inline glm::dvec3 direction(double cos_theta, double phi) {
    const double sin_theta = std::sqrt((1 - cos_theta) * (1 + cos_theta));
    return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

inline lumis::testing::DirectionChart normals_chart(glm::dvec2 alpha) {
    const lumis::Frame<double> local{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return lumis::testing::lobe_chart(local, glm::max(alpha, glm::dvec2{lumis::ggx_min_alpha}));
}

inline const std::vector<glm::dvec2> alphas{{1e-4, 1e-4}, {0.01, 0.01}, {0.1, 0.1}, {0.5, 0.5},  {1, 1},
                                            {0.001, 0.5}, {0.4, 0.05},  {1, 0},     {0.05, 1e-4}};
inline const std::vector<glm::dvec3> views{direction(1, 0), direction(0.7, 0.4), direction(0.1, 2.5),
                                           direction(0.01, -2)};

// make(wo, alpha) for every view and roughness; the integrand, given wo, is a BSDF's unless stated.
template <class T, class Make>
auto over_roughness(
    Make make, WhereDirections (*integrand)(const glm::dvec3&) = [](const glm::dvec3&) -> WhereDirections {
        return above_horizon;
    }) {
    std::vector<decltype(make(glm::dvec3{}, glm::dvec2{}))> result;
    for (const auto& wo : views) {
        for (const auto& alpha : alphas) {
            result.push_back(make(wo, alpha));
            result.back().label = label("wo ", wo, ", alpha ", alpha);
            result.back().integrand = integrand(wo);
        }
    }
    return result;
}

struct CosineHemisphere {
    template <class T>
    static std::vector<Subject<lumis::CosineHemisphere<T>>> make() {
        return {{.label = "", .strategy = {}, .chart = lumis::testing::sphere_chart(), .integrand = above_horizon}};
    }
};

struct UniformHemisphere {
    template <class T>
    static std::vector<Subject<lumis::UniformHemisphere<T>>> make() {
        return {{.label = "", .strategy = {}, .chart = lumis::testing::sphere_chart(), .integrand = above_horizon}};
    }
};

struct UniformSphere {
    template <class T>
    static std::vector<Subject<lumis::UniformSphere<T>>> make() {
        return {{.label = "",
                 .strategy = {},
                 .chart = lumis::testing::sphere_chart(),
                 .integrand = lumis::testing::everywhere}};
    }
};

struct UniformCone {
    template <class T>
    static auto make() {
        std::vector<Subject<lumis::UniformCone<T>>> result;
        for (const double half_angle : {1e-4, 0.00465, 0.3, 1.5, 3.0, 3.2}) {
            const double sine = std::sin(std::fmin(half_angle / 2, std::numbers::pi / 2));
            result.push_back({label("half-angle ", half_angle), lumis::UniformCone<T>{static_cast<T>(half_angle)},
                              lumis::testing::lobe_chart(glm::dvec3{0, 0, 1}, 1.4 * sine), 1.0,
                              20 * std::numeric_limits<T>::epsilon() / half_angle});
            result.back().integrand = [half_angle](const glm::dvec3& w) {
                return std::atan2(std::hypot(w.x, w.y), w.z) < half_angle;
            };
        }
        return result;
    }
};

struct HenyeyGreenstein {
    template <class T>
    static auto make() {
        std::vector<Subject<lumis::HenyeyGreenstein<T>>> result;
        for (const double g : {-0.9, -0.3, 0.0, 1e-5, 0.6, 0.99, 0.9999}) {
            const glm::dvec3 wo = direction(-0.4, 1), peak = g < 0 ? wo : -wo;
            result.push_back({label("g ", g),
                              {glm::vec<3, T>(wo), static_cast<T>(g)},
                              lumis::testing::lobe_chart(peak, 2 * (1 - std::abs(g)))});
            result.back().integrand = lumis::testing::everywhere;
        }
        return result;
    }
};

struct GgxNdf {
    template <class T>
    static auto make() {
        std::vector<Subject<lumis::GgxNdf<T>>> result;
        for (const auto& alpha : alphas) {
            const lumis::GgxNdf<T> normals{glm::vec<2, T>(alpha)};
            result.push_back({label("alpha ", alpha), normals, normals_chart(alpha)});
            result.back().integrand = above_horizon;
        }
        return result;
    }
};

struct GgxVndf {
    template <class T>
    static auto make() {
        const auto visible_normals = [](const glm::dvec3& wo) -> WhereDirections {
            return [wo](const glm::dvec3& wm) { return wm.z > 0 && glm::dot(wo, wm) > 0; };
        };
        return over_roughness<T>(
            [](const glm::dvec3& wo, const glm::dvec2& alpha) {
                return Subject<lumis::GgxVndf<T>>{
                    "", {glm::vec<3, T>(wo), glm::vec<2, T>(alpha)}, normals_chart(alpha)};
            },
            visible_normals);
    }
};

struct GgxReflection {
    template <class T>
    static auto make() {
        return over_roughness<T>([](const glm::dvec3& wo, const glm::dvec2& alpha) {
            return Subject<lumis::GgxReflection<T>>{"",
                                                    {glm::vec<3, T>(wo), glm::vec<2, T>(alpha)},
                                                    lumis::testing::reflected_chart(wo, normals_chart(alpha)),
                                                    std::nullopt};
        });
    }
};

struct GgxBoundedReflection {
    template <class T>
    static auto make() {
        return over_roughness<T>([](const glm::dvec3& wo, const glm::dvec2& alpha) {
            return Subject<lumis::GgxBoundedReflection<T>>{"",
                                                           {glm::vec<3, T>(wo), glm::vec<2, T>(alpha)},
                                                           lumis::testing::reflected_chart(wo, normals_chart(alpha)),
                                                           std::nullopt};
        });
    }
};

// Classical half-vector sampling, which draws normals that wo does not see.
struct ReflectedGgxNdf {
    template <class T>
    static auto make() {
        return over_roughness<T>([](const glm::dvec3& wo, const glm::dvec2& alpha) {
            const lumis::GgxNdf<T> normals{glm::vec<2, T>(alpha)};
            return Subject<lumis::Reflected<lumis::GgxNdf<T>>>{
                "",
                {glm::vec<3, T>(wo), normals},
                lumis::testing::reflected_chart(wo, normals_chart(alpha)),
                std::nullopt};
        });
    }
};

// Reflection about normals that are not GGX's.
struct ReflectedCosine {
    template <class T>
    static auto make() {
        using Normals = lumis::CosineHemisphere<T>;
        std::vector<Subject<lumis::Reflected<Normals>>> result;
        for (const auto& wo : {direction(1, 0), direction(0.4, 1), direction(0.05, -1)}) {
            const auto chart = lumis::testing::reflected_chart(wo, lumis::testing::sphere_chart());
            result.push_back({label("wo ", wo), {glm::vec<3, T>(wo), Normals{}}, chart, std::nullopt});
            result.back().integrand = above_horizon;
        }
        return result;
    }
};

struct GgxReflectionInFrame {
    template <class T>
    static auto make() {
        const glm::dvec3 normal = glm::normalize(glm::dvec3{1, -2, 0.5});
        const lumis::Frame<double> frame{normal};
        const lumis::Frame<T> own_frame{glm::vec<3, T>(normal)};
        using S = decltype(lumis::in_frame(own_frame, std::declval<lumis::GgxReflection<T>>()));
        std::vector<Subject<S>> result;
        for (const auto& wo : views) {
            for (const auto& alpha : alphas) {
                // The lobe is alpha wo.z radians wide across its plane: in world space a float has no digits for less.
                if (std::min(alpha.x, alpha.y) * wo.z < 1e-5) continue;
                const lumis::GgxReflection<T> local{glm::vec<3, T>(wo), glm::vec<2, T>(alpha)};
                const auto chart = lumis::testing::reflected_chart(wo, normals_chart(alpha));
                result.push_back({label("wo ", wo, ", alpha ", alpha),
                                  lumis::in_frame(own_frame, lumis::GgxReflection<T>{local}),
                                  lumis::testing::framed_chart(frame, chart),
                                  std::nullopt,
                                  0,
                                  {.rounding = 8, .length = 6}});
                result.back().integrand = [normal](const glm::dvec3& w) { return glm::dot(w, normal) > 0; };
            }
        }
        return result;
    }
};

// A diffuse base under a GGX coat.
struct CoatedDiffuse {
    template <class T>
    static auto make() {
        const glm::dvec3 wo = direction(0.6, 1);
        using S = decltype(lumis::Mixture{lumis::choose(0.25, lumis::CosineHemisphere<T>{}),
                                          lumis::choose(0.75, std::declval<lumis::GgxReflection<T>>())});
        std::vector<Subject<S>> result;
        for (const double alpha : {0.02, 0.2}) {
            const lumis::GgxReflection<T> coat{glm::vec<3, T>(wo), glm::vec<2, T>(T(alpha))};
            result.push_back({label("alpha ", alpha),
                              lumis::Mixture{lumis::choose(0.25, lumis::CosineHemisphere<T>{}),
                                             lumis::choose(0.75, lumis::GgxReflection<T>{coat})},
                              lumis::testing::reflected_chart(wo, normals_chart(glm::dvec2{2 * alpha})), std::nullopt});
            result.back().integrand = above_horizon;
        }
        return result;
    }
};

}  // namespace subjects
