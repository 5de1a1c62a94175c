// Glass, sample, density and once as in kernels.cpp. A sample comes with its density and its weight, bsdf times cosine over
// density; it spends a third uniform on the choice between mirroring and refracting.
#include "forms.hpp"
#include "subjects.hpp"
#include "textbook/dielectric.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>

namespace {

template <class T>
struct Chosen {
    Uniforms<T> u{few}, choice{few, 2};

    [[nodiscard]] glm::vec<3, T> operator[](std::size_t i) const { return {u.x[i], u.y[i], choice.x[i]}; }
};

template <class T, class Drawn>
void write(Results<T>& out, std::size_t i, const Drawn& drawn) {
    out.x[i] = drawn.value.x;
    out.y[i] = drawn.value.y;
    out.z[i] = drawn.value.z;
    out.pdf[i] = drawn.pdf;
}

// Half of what is drawn, half anywhere.
template <class T>
Directions<T> directions(const lumis::GgxDielectric<T>& glass) {
    const Chosen<T> chosen;
    const Uniforms<T> any{few, 3};
    Directions<T> result;
    for (std::size_t i = 0; i < batch; ++i) {
        const auto drawn = glass.sample(chosen[i]);
        result.add(i % 2 == 0 && drawn.pdf > 0 ? drawn.value : lumis::direction_at(2 * any.x[i], any.y[i]));
    }
    return result;
}

template <class T>
void add_rough_glass() {
    const Scene<T> scene;
    const T eta = T(1.5);
    const auto glass = ready(lumis::GgxDielectric<T>{scene.wo, scene.alpha, eta});
    const auto book = ready(textbook::GgxDielectric<T>{scene.wo, scene.alpha, eta});
    const auto uniforms = lazily([] { return Chosen<T>{}; });
    const auto some = lazily([=] { return directions(*glass()); });

    const auto weighed = [](const auto& made, const Chosen<T>& u, std::size_t, Results<T>& out) {
        const auto surface = made;
        for (std::size_t i = 0; i < batch; ++i) {
            one_at_a_time(i);
            const auto drawn = surface.sample(u[i]);
            write(out, i, drawn);
            out.weight[i] = drawn.pdf > 0 ? surface.bsdf(drawn.value) * std::abs(drawn.value.z) / drawn.pdf : T(0);
        }
    };
    add_form<T>("sample/ggx_dielectric/single", glass, uniforms, weighed);
    add_form<T>("sample/ggx_dielectric/textbook", book, uniforms, weighed);
    add_form<T>("sample/ggx_dielectric/batch", glass, uniforms,
                [](const auto& surface, const Chosen<T>& u, std::size_t, Results<T>& out) {
                    const std::array<std::span<const T>, 3> columns{u.u.x, u.u.y, u.choice.x};
                    lumis::sample_n(surface, columns, lumis::DirectionSpans<T>{out.x, out.y, out.z, out.pdf});
                    const auto f_cos = [surface](const auto& wi) { return surface.bsdf(wi) * lumis::real::abs(wi.z); };
                    lumis::evaluate_n<T>(f_cos, out.x, out.y, out.z, out.weight);
                    for (std::size_t i = 0; i < batch; ++i) {
                        out.weight[i] = out.pdf[i] > 0 ? out.weight[i] / out.pdf[i] : T(0);
                    }
                });

    const auto pdf_single = [](const auto& s, const auto& w, auto pass, auto& out) { pdf_each(s, w, pass, out); };
    add_form<T>("pdf/ggx_dielectric/single", glass, some, pdf_single);
    add_form<T>("pdf/ggx_dielectric/textbook", book, some, pdf_single);
    add_form<T>("pdf/ggx_dielectric/batch", glass, some, [](const auto& s, const auto& w, auto pass, auto& out) {
        lumis::pdf_n(s, part(w.x, pass), part(w.y, pass), part(w.z, pass), out.pdf);
    });

    // A wo of each sample's own.
    const auto once = [scene, eta]<class S>(std::type_identity<S>) {
        return [=](const glm::vec<3, T>& wo, const Chosen<T>& u, std::size_t, Results<T>& out) {
            const glm::vec<3, T> start = wo;
            for (std::size_t i = 0; i < batch; ++i) {
                one_at_a_time(i);
                const auto aside = T(0.5) * glm::vec<3, T>{u.u.y[i], u.u.x[i], 0};
                write(out, i, S{glm::normalize(start + aside), scene.alpha, eta}.sample(u[i]));
            }
        };
    };
    add_form<T>("once/ggx_dielectric/single", ready(scene.wo), uniforms,
                once(std::type_identity<lumis::GgxDielectric<T>>{}));
    add_form<T>("once/ggx_dielectric/textbook", ready(scene.wo), uniforms,
                once(std::type_identity<textbook::GgxDielectric<T>>{}));
    add_form<T>("once/smooth_dielectric/single", ready(scene.wo), uniforms,
                [eta](const glm::vec<3, T>& wo, const Chosen<T>& u, std::size_t, Results<T>& out) {
                    const glm::vec<3, T> start = wo;
                    for (std::size_t i = 0; i < batch; ++i) {
                        one_at_a_time(i);
                        const auto aside = T(0.5) * glm::vec<3, T>{u.u.y[i], u.u.x[i], 0};
                        write(out, i, lumis::SmoothDielectric<T>{glm::normalize(start + aside), eta}.sample(u[i]));
                    }
                });
}

const bool added = (add_rough_glass<float>(), add_rough_glass<double>(), true);

}  // namespace
