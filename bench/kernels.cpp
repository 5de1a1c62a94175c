// Drawing, sample/<strategy>/<form>/<scalar>, and densities, pdf/<strategy>/<form>/<scalar>, of directions that need no
// table. once/<strategy>/...: a strategy is made for a new point and draws one sample, as at each vertex of a path; the
// form `lanes` makes one strategy of lanes for as many points.
#include "forms.hpp"
#include "subjects.hpp"
#include "textbook/directions.hpp"
#include "textbook/ggx.hpp"
#include "textbook/lights.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>

namespace {

// Lights from points near the origin; GGX from directions around wo.
// Textbook: void if it has no counterpart.
template <class T, class Strategy, class Textbook, class Of>
void add_once(const std::string& name, Of of) {
    const auto uniforms = lazily([] { return Uniforms<T>{few}; });
    const auto make_and_sample = [=]<class S>(std::type_identity<S>) {
        return [=](const glm::vec<3, T>& from, const Uniforms<T>& u, std::size_t pass, Results<T>& out) {
            const auto x = part(u.x, pass), y = part(u.y, pass);
            const glm::vec<3, T> start = from;
            const Of what = of;
            for (std::size_t i = 0; i < batch; ++i) {
                one_at_a_time(i);
                const auto drawn =
                    what.template operator()<S>(start + T(0.5) * glm::vec<3, T>{y[i], x[i], 0}).sample({x[i], y[i]});
                out.x[i] = drawn.value.x;
                out.y[i] = drawn.value.y;
                out.z[i] = drawn.value.z;
                out.pdf[i] = drawn.pdf;
            }
        };
    };
    const auto origin = ready(glm::vec<3, T>{});
    add_form<T>("once/" + name + "/single", origin, uniforms, make_and_sample(std::type_identity<Strategy>{}));
    if constexpr (!std::is_void_v<Textbook>)
        add_form<T>("once/" + name + "/textbook", origin, uniforms, make_and_sample(std::type_identity<Textbook>{}));
}

// The same of points in lanes, each of which draws its sample.
template <class T, class StrategyOfLanes, class Of>
void add_once_in_lanes(const std::string& name, Of of) {
    using L = lumis::NativeLanes<T>;
    const auto uniforms = lazily([] { return Uniforms<T>{few}; });
    const auto origin = ready(glm::vec<3, T>{});
    add_form<T>("once/" + name + "/lanes", origin, uniforms,
                [=](const glm::vec<3, T>& from, const Uniforms<T>& u, std::size_t pass, Results<T>& out) {
                    const auto x = part(u.x, pass), y = part(u.y, pass);
                    const glm::vec<3, L> start{from};
                    const Of what = of;
                    for (std::size_t i = 0; i < batch; i += L::size) {
                        one_at_a_time(i);
                        const L ux = L::load(&x[i]), uy = L::load(&y[i]);
                        const auto drawn = what.template operator()<StrategyOfLanes>(
                                                   start + L{T(0.5)} * glm::vec<3, L>{uy, ux, L{T(0)}})
                                               .sample(glm::vec<2, L>{ux, uy});
                        drawn.value.x.store(&out.x[i]);
                        drawn.value.y.store(&out.y[i]);
                        drawn.value.z.store(&out.z[i]);
                        drawn.pdf.store(&out.pdf[i]);
                    }
                });
}

// One shape in every lane.
template <class L, class T>
auto in_lanes(const lumis::Triangle<T>& shape) {
    using V = glm::vec<3, L>;
    return lumis::Triangle<L>{V{shape.a}, V{shape.b}, V{shape.c}};
}
template <class L, class T>
auto in_lanes(const lumis::Parallelogram<T>& shape) {
    using V = glm::vec<3, L>;
    return lumis::Parallelogram<L>{V{shape.corner}, V{shape.edge_u}, V{shape.edge_v}};
}
template <class L, class T>
auto in_lanes(const lumis::Disk<T>& shape) {
    using V = glm::vec<3, L>;
    return lumis::Disk<L>{V{shape.center}, V{shape.normal}, shape.radius};
}
template <class L, class T>
auto in_lanes(const lumis::Sphere<T>& shape) {
    return lumis::Sphere<L>{glm::vec<3, L>{shape.center}, shape.radius};
}

template <class T, class Sampling, class Shape>
void add_light_in_lanes(const std::string& name, const Shape& shape) {
    using L = lumis::NativeLanes<T>;
    const auto shapes = in_lanes<L>(shape);
    add_once_in_lanes<T, lumis::AreaLight<std::remove_const_t<decltype(shapes)>, Sampling>>(
        name, [shapes]<class S>(const glm::vec<3, L>& from) {
            return S{shapes, from};
        });
}

// A light with its textbook counterpart.
template <class T, class Light, class Textbook, class Shape>
void add_light(const std::string& name, const Shape& shape) {
    const glm::vec<3, T> origin = Scene<T>{}.origin;
    add_strategy<T>(name, lazily([=] {
                        return Light{shape, origin};
                    }),
                    lazily([=] {
                        return Textbook{shape, origin};
                    }));
    add_once<T, Light, Textbook>(name, [shape]<class S>(const glm::vec<3, T>& from) { return S{shape, from}; });
}

// A light that is told more of the receiver than where it is, or of the light than its shape: of(point) makes it.
template <class T, class Of>
void add_light_of(const std::string& name, Of of) {
    const glm::vec<3, T> origin = Scene<T>{}.origin;
    add_strategy<T>(name, lazily([=] { return of(origin); }), nullptr);
    add_once<T, decltype(of(origin)), void>(name, [of]<class S>(const glm::vec<3, T>& from) { return of(from); });
}

template <class T, class Shape>
void add_light_by_cosine(const std::string& name, const Shape& shape) {
    add_light_of<T>(name, [shape](const glm::vec<3, T>& from) {
        return lumis::AreaLight<Shape, lumis::ByCosine>{shape, from, glm::vec<3, T>{T(0.6), T(0), T(0.8)}};
    });
}

template <class T>
void add_image_light() {
    const auto table = std::make_shared<lumis::PiecewiseConstant2D<T>>(256, 128, sky<T>(256, 128));
    add_light_of<T>("image_light", [table, shape = Scene<T>{}.rectangle](const glm::vec<3, T>& from) {
        return lumis::ImageLight{shape, *table, from};
    });
}

// A sample, its density and its weight, reflectance times cosine over density: all that a path needs.
template <class T>
void add_ggx_reflection() {
    const Scene<T> scene;
    const auto strategy = ready(lumis::GgxReflection<T>{scene.wo, scene.alpha});
    const auto textbook = ready(textbook::GgxReflection<T>{scene.wo, scene.alpha});
    const auto uniforms = lazily([] { return Uniforms<T>{few}; });
    const auto directions = lazily([=] { return half_own_half_anywhere(*strategy(), few); });

    const auto weighed = [](auto brdf_of) {
        return [=]<class S>(const S& made, const Uniforms<T>& u, std::size_t pass, Results<T>& out) {
            const S surface = made;
            const auto brdf = brdf_of(surface);
            const auto x = part(u.x, pass), y = part(u.y, pass);
            for (std::size_t i = 0; i < batch; ++i) {
                one_at_a_time(i);
                const auto drawn = surface.sample({x[i], y[i]});
                const auto& wi = drawn.value;
                out.x[i] = wi.x;
                out.y[i] = wi.y;
                out.z[i] = wi.z;
                out.pdf[i] = drawn.pdf;
                out.weight[i] = drawn.pdf > 0 ? brdf(wi) * wi.z / drawn.pdf : T(0);
            }
        };
    };
    const auto of_lumis = [wo = scene.wo](const auto& surface) {
        return [wo, ggx = surface.ggx()](const auto& wi) { return ggx.brdf(wo, wi); };
    };
    const auto of_book = [](const auto& surface) { return [surface](const auto& wi) { return surface.brdf(wi); }; };
    add_form<T>("sample/ggx_reflection/single", strategy, uniforms, weighed(of_lumis));
    add_form<T>("sample/ggx_reflection/textbook", textbook, uniforms, weighed(of_book));
    add_form<T>("sample/ggx_reflection/batch", strategy, uniforms,
                [=](const auto& surface, const auto& u, std::size_t pass, Results<T>& out) {
                    lumis::sample_n(surface, {part(u.x, pass), part(u.y, pass)}, {out.x, out.y, out.z, out.pdf});
                    const auto brdf_cosine = [brdf = of_lumis(surface)](const auto& wi) { return brdf(wi) * wi.z; };
                    lumis::evaluate_n<T>(brdf_cosine, out.x, out.y, out.z, out.weight);
                    for (std::size_t i = 0; i < batch; ++i) {
                        out.weight[i] = out.pdf[i] > 0 ? out.weight[i] / out.pdf[i] : T(0);
                    }
                });

    const auto pdf_single = [](const auto& s, const auto& w, auto pass, auto& out) { pdf_each(s, w, pass, out); };
    add_form<T>("pdf/ggx_reflection/single", strategy, directions, pdf_single);
    add_form<T>("pdf/ggx_reflection/textbook", textbook, directions, pdf_single);
    add_form<T>("pdf/ggx_reflection/batch", strategy, directions,
                [](const auto& s, const auto& w, auto pass, auto& out) {
                    lumis::pdf_n(s, part(w.x, pass), part(w.y, pass), part(w.z, pass), out.pdf);
                });
    add_once<T, lumis::GgxReflection<T>, textbook::GgxReflection<T>>(
        "ggx_reflection", [scene]<class S>(const glm::vec<3, T>& aside) {
            return S{glm::normalize(scene.wo + aside), scene.alpha};
        });
    using L = lumis::NativeLanes<T>;
    add_once_in_lanes<T, lumis::GgxReflection<L>>("ggx_reflection", [scene]<class S>(const glm::vec<3, L>& aside) {
        return S{glm::normalize(glm::vec<3, L>{scene.wo} + aside), glm::vec<2, L>{scene.alpha}};
    });
}

// It spends a third uniform on the choice, so there is no batch of it.
template <class T>
void add_mixture() {
    const Scene<T> scene;
    const lumis::Mixture mixture{lumis::choose(0.5, lumis::CosineHemisphere<T>{}),
                                 lumis::choose(0.5, lumis::GgxReflection<T>{scene.wo, scene.alpha})};
    struct Chosen {
        Uniforms<T> choice{few, 2}, u{few};
    };
    add_form<T>("sample/mixture/single", ready(mixture), lazily([] { return Chosen{}; }),
                [](const auto& made, const Chosen& c, std::size_t, Results<T>& out) {
                    const auto held = made;
                    for (std::size_t i = 0; i < batch; ++i) {
                        one_at_a_time(i);
                        const auto drawn = held.sample({c.choice.x[i], c.u.x[i], c.u.y[i]});
                        out.x[i] = drawn.value.x;
                        out.y[i] = drawn.value.y;
                        out.z[i] = drawn.value.z;
                        out.pdf[i] = drawn.pdf;
                    }
                });
}

// A textured lamp of two triangles, as meshes have them: one is chosen, sampled, and its radiance looked up. The form
// solved_back has only the direction and distance to go by.
template <class T>
struct TexturedLamp {
    using V = glm::vec<3, T>;
    std::array<lumis::Triangle<T>, 2> triangles;
    std::array<T, 64> texels{};

    explicit TexturedLamp(const lumis::Parallelogram<T>& r)
        : triangles{{{r.corner, r.corner + r.edge_u, r.corner + r.edge_u + r.edge_v},
                     {r.corner, r.corner + r.edge_u + r.edge_v, r.corner + r.edge_v}}} {
        for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<T>(i % 7);
    }

    [[nodiscard]] T radiance(const glm::vec<2, T>& uv) const {
        const auto texel = [](T x) { return static_cast<std::size_t>(static_cast<int>(x * T(7.99))); };
        return texels[8 * texel(uv.y) + texel(uv.x)];
    }
};

template <class T>
void add_textured_lamp() {
    using V = glm::vec<3, T>;
    struct Drawn {
        V direction;
        T pdf;
        glm::vec<2, T> uv;
    };
    const auto lamp = ready(TexturedLamp<T>{Scene<T>{}.rectangle});
    const auto uniforms = lazily([] { return Uniforms<T>{few}; });
    const auto add = [&](const char* form, auto draw) {
        add_form<T>(std::string{"once/textured_triangles_by_area/"} + form, lamp, uniforms,
                    [draw](const TexturedLamp<T>& lit, const Uniforms<T>& u, std::size_t pass, Results<T>& out) {
                        const auto x = part(u.x, pass), y = part(u.y, pass);
                        for (std::size_t i = 0; i < batch; ++i) {
                            one_at_a_time(i);
                            const std::size_t chosen = x[i] < T(0.5) ? 0 : 1;
                            const T rest = 2 * x[i] - static_cast<T>(chosen);
                            const Drawn s = draw(lit.triangles[chosen], T(0.5) * V{y[i], x[i], 0}, {rest, y[i]});
                            out.x[i] = s.direction.x;
                            out.y[i] = s.direction.y;
                            out.z[i] = s.direction.z;
                            out.pdf[i] = s.pdf / 2;
                            out.weight[i] = lit.radiance(s.uv);
                        }
                    });
    };
    add("single", [](const lumis::Triangle<T>& triangle, const V& from, const glm::vec<2, T>& u) -> Drawn {
        const auto s = lumis::SurfaceLight{triangle, from}.sample(u);
        return {s.value, s.pdf, s.surface.uv};
    });
    add("solved_back", [](const lumis::Triangle<T>& triangle, const V& from, const glm::vec<2, T>& u) -> Drawn {
        const auto s = lumis::AreaLight{triangle, from}.sample(u);
        const V ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, normal = glm::cross(ab, ac),
                at = (from + s.distance * s.value - triangle.a) / glm::dot(normal, normal);
        return {s.value, s.pdf, {glm::dot(normal, glm::cross(at, ac)), glm::dot(normal, glm::cross(ab, at))}};
    });
    add("textbook", [](const lumis::Triangle<T>& triangle, const V& from, const glm::vec<2, T>& u) -> Drawn {
        const T root = std::sqrt(u.x);
        const glm::vec<2, T> uv{root * (1 - u.y), root * u.y};
        const V ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, normal = glm::cross(ab, ac),
                to = triangle.a + uv.x * ab + uv.y * ac - from;
        const T squared = glm::dot(to, to), distance = std::sqrt(squared);
        return {to / distance, 2 * squared * distance / std::abs(glm::dot(normal, to)), uv};
    });
}

template <class T>
void add_all() {
    using namespace lumis;
    const Scene<T> scene;
    const auto none = nullptr;
    add_strategy<T>("cosine_hemisphere", ready(CosineHemisphere<T>{}), ready(textbook::CosineHemisphere<T>{}));
    add_form<T>("sample/cosine_hemisphere/textbook_concentric", ready(textbook::ConcentricCosineHemisphere<T>{}),
                lazily([] { return ::Uniforms<T>{few}; }),
                [](const auto& s, const auto& u, auto pass, auto& out) { sample_each(s, u, pass, out); });
    add_strategy<T>("uniform_hemisphere", ready(UniformHemisphere<T>{}), ready(textbook::UniformHemisphere<T>{}));
    add_strategy<T>("uniform_cone", ready(UniformCone{T(0.3)}), ready(textbook::UniformCone<T>{std::cos(T(0.3))}));
    add_strategy<T>("henyey_greenstein", ready(HenyeyGreenstein<T>{scene.wo, T(0.7)}),
                    ready(textbook::HenyeyGreenstein<T>{scene.wo, T(0.7)}));
    add_strategy<T>("uniform_sphere", ready(UniformSphere<T>{}), ready(textbook::UniformSphere<T>{}));
    add_ggx_reflection<T>();
    add_strategy<T>("ggx_bounded_reflection", ready(GgxBoundedReflection<T>{scene.wo, scene.alpha}), none);
    add_strategy<T>("ggx_vndf", ready(GgxVndf<T>{scene.wo, scene.alpha}), none);
    add_strategy<T>("perfect_reflection", ready(PerfectReflection<T>{scene.wo}), none);
    add_mixture<T>();

    add_light<T, AreaLight<Triangle<T>>, textbook::TriangleByArea<T>>("triangle_by_area", scene.triangle);
    add_light<T, AreaLight<Parallelogram<T>>, textbook::ParallelogramByArea<T>>("rectangle_by_area", scene.rectangle);
    add_light<T, AreaLight<Disk<T>>, textbook::DiskByArea<T>>("disk_by_area", scene.disk);
    add_light<T, AreaLight<Sphere<T>, BySolidAngle>, textbook::SphereByCone<T>>("sphere_by_solid_angle", scene.sphere);
    add_light<T, AreaLight<Triangle<T>, BySolidAngle>, textbook::TriangleBySolidAngle<T>>("triangle_by_solid_angle",
                                                                                          scene.triangle);
    add_light<T, AreaLight<Parallelogram<T>, BySolidAngle>, textbook::RectangleBySolidAngle<T>>(
        "rectangle_by_solid_angle", scene.rectangle);
    add_light_by_cosine<T>("triangle_by_cosine", scene.triangle);
    add_light_by_cosine<T>("rectangle_by_cosine", scene.rectangle);
    add_light_in_lanes<T, ByArea>("triangle_by_area", scene.triangle);
    add_light_in_lanes<T, ByArea>("rectangle_by_area", scene.rectangle);
    add_light_in_lanes<T, ByArea>("disk_by_area", scene.disk);
    add_light_in_lanes<T, BySolidAngle>("sphere_by_solid_angle", scene.sphere);
    add_textured_lamp<T>();
    add_image_light<T>();
    add_strategy<T>("sun", ready(Sun{glm::vec<3, T>{T(0.6), T(0), T(0.8)}, T(0.00465)}), none);
    add_strategy<T>("sphere_by_area", ready(AreaLight<Sphere<T>>{scene.sphere, scene.origin}), none);
}

const bool added = (add_all<float>(), add_all<double>(), true);

}  // namespace
