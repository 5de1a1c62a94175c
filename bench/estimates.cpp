// A whole estimate of direct light at a point, two techniques with the power heuristic and the integrand included:
// estimate/<techniques>/<form>/<scalar>. All forms spend the same four numbers on each.
#include "forms.hpp"
#include "subjects.hpp"
#include "textbook/directions.hpp"
#include "textbook/ggx.hpp"
#include "textbook/lights.hpp"
#include "textbook/tables.hpp"
#include "textbook/weights.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/lumis.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace {

// Number k of every estimate in an array of its own.
template <class T>
struct Columns {
    Uniforms<T> first{few, 1}, second{few, 2};

    [[nodiscard]] std::array<std::span<const T>, 4> spans() const { return {first.x, first.y, second.x, second.y}; }
};

// A host's sampler whose numbers are there already: those of one estimate.
template <class T>
struct Row {
    const std::array<std::span<const T>, 4>& columns;
    std::size_t row;
    std::size_t next_column = 0;

    template <int N>
    glm::vec<N, T> next() {
        glm::vec<N, T> u;
        for (int k = 0; k < N; ++k) u[k] = columns[next_column++][row];
        return u;
    }
};

// As books have it: one sample of either technique, each weighted against the other.
template <class T>
[[nodiscard]] T by_hand(const auto& bsdf, const auto& light, const auto& f, Row<T> uniforms) {
    constexpr textbook::PowerHeuristic weight;
    T sum = 0;
    const auto a = bsdf.sample(uniforms.template next<2>());
    if (a.pdf > 0) sum += f(a.value) * weight(a.pdf, light.pdf(a.value)) / a.pdf;
    const auto b = light.sample(uniforms.template next<2>());
    if (b.pdf > 0) sum += f(b.value) * weight(b.pdf, bsdf.pdf(b.value)) / b.pdf;
    return sum;
}

// Reflected radiance: brdf(w) cos(theta) radiance(w). The cosine is of either sign, brdf and radiance select.
template <class Brdf, class Radiance>
[[nodiscard]] auto integrand(const Brdf& brdf, const Radiance& radiance) {
    return [=](const auto& w) { return brdf(w) * w.z * radiance(w); };
}

// A light of radiance 1, seen where its density is positive.
template <class Light>
[[nodiscard]] auto emission(const Light& light) {
    return [&light](const auto& w) {
        using R = std::remove_cvref_t<decltype(w.x)>;
        using T = typename lumis::scalar_of<R>;
        return lumis::real::select(w.z > 0 && light.pdf(w) > 0, R(T(1)), T(0));
    };
}
template <class T>
[[nodiscard]] auto gradient() {
    return [](const auto& w) { return w.y + T(1.5); };
}

// make_lights() and make_book_lights() yield a light; radiance_of(light) what it emits.
template <class T, class Bsdf, class Book, class MakeLight, class MakeBookLight>
void add(const std::string& name, const Bsdf& bsdf, const auto& brdf, const Book& book, const auto& book_brdf,
         MakeLight make_light, MakeBookLight make_book_light, auto radiance_of) {
    const auto columns = lazily([] { return Columns<T>{}; });
    const std::string full = "estimate/" + name;
    const auto estimator = [=](const auto& light) {
        return lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, bsdf), lumis::take(1, light));
    };
    add_form<T>(full + "/single", make_light, columns,
                [=](const auto& light, const Columns<T>& u, std::size_t, Results<T>& out) {
                    const auto direct = estimator(light);
                    const auto f = integrand(brdf, radiance_of(light));
                    const auto spans = u.spans();
                    for (std::size_t i = 0; i < batch; ++i) {
                        one_at_a_time(i);
                        out.x[i] = direct.estimate(f, Row<T>{spans, i});
                    }
                });
    add_form<T>(full + "/batch", make_light, columns,
                [=](const auto& light, const Columns<T>& u, std::size_t, Results<T>& out) {
                    lumis::estimate_n(estimator(light), integrand(brdf, radiance_of(light)), u.spans(), out.x);
                });
    add_form<T>(full + "/textbook", make_book_light, columns,
                [=](const auto& light, const Columns<T>& u, std::size_t, Results<T>& out) {
                    const auto f = integrand(book_brdf, radiance_of(light));
                    const auto spans = u.spans();
                    for (std::size_t i = 0; i < batch; ++i) {
                        one_at_a_time(i);
                        out.x[i] = by_hand<T>(book, light, f, Row<T>{spans, i});
                    }
                });
}

template <class T>
void add_all() {
    const Scene<T> scene;
    const glm::vec<2, T> alpha(T(0.3));
    const lumis::GgxReflection<T> ggx{scene.wo, alpha};
    const textbook::GgxReflection<T> book_ggx{scene.wo, alpha};
    const auto ggx_brdf = [=](const auto& w) { return ggx.ggx().brdf(scene.wo, w); };
    const auto book_ggx_brdf = [=](const auto& w) { return book_ggx.brdf(w); };
    const auto diffuse = [](const auto&) { return std::numbers::inv_pi_v<T>; };
    const auto emitted = [](const auto& light) { return emission(light); };

    const lumis::Parallelogram<T> square{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}};
    add<T>("ggx_square_light", ggx, ggx_brdf, book_ggx, book_ggx_brdf, ready(lumis::AreaLight{square, scene.origin}),
           ready(textbook::ParallelogramByArea<T>{square, scene.origin}), emitted);
    add<T>("cosine_sphere_light", lumis::CosineHemisphere<T>{}, diffuse, textbook::CosineHemisphere<T>{}, diffuse,
           ready(lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{scene.sphere, scene.origin}),
           ready(textbook::SphereByCone<T>{scene.sphere, scene.origin}), emitted);
    add<T>("ggx_environment_1024x512", ggx, ggx_brdf, book_ggx, book_ggx_brdf, lazily([] {
               return lumis::EnvironmentMap<T>{1024, 512, sky<T>(1024, 512)};
           }),
           lazily([] {
               return textbook::EnvironmentMap<T>{1024, 512, sky<T>(1024, 512)};
           }),
           [](const auto&) { return gradient<T>(); });
}

const bool added = (add_all<float>(), add_all<double>(), true);

}  // namespace
