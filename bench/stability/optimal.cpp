// Optimal weights of three densities that are nearly dependent: the matrix of their equations has a condition of 27,000.
#include "cases.hpp"
#include <lumis/combine/optimal.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace stability {

namespace {

// One of three shapes over [3 / 2 pi, pi], times a scale. Points come evenly: it is the sums that are looked at.
template <class T>
struct Shape {
    using Scalar = T;
    using Point = T;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    int which;
    T scale;

    [[nodiscard]] lumis::Sample<T, T> sample(glm::vec<1, T> u) const noexcept {
        constexpr T low = T(1.5) * std::numbers::inv_pi_v<T>, high = T(3.14);
        const T x = low + u.x * (high - low);
        return {x, pdf(x)};
    }
    [[nodiscard]] T pdf(T x) const noexcept {
        const T shape = which == 0 ? x : which == 1 ? x * x - x * std::numbers::inv_pi_v<T> : std::sin(x);
        return scale * shape;
    }
};

template <class T>
struct Evenly {
    int number = 0;

    template <int N>
    [[nodiscard]] glm::vec<N, T> next() {
        glm::vec<N, T> u;
        for (int i = 0; i < N; ++i) u[i] = static_cast<T>(number++ * 619 % 1024) / 1024;
        return u;
    }
};

}  // namespace

// Estimates with the weights found, at all scales of the densities; f is in proportion to them. The usual formula sums in T.
template <class T>
Measured optimal_weights(Effort) {
    Measured measured;
    constexpr int rounds = 256;
    sweep(1e-30, 1e30, 12, [&](double decade) {
        const T scale = static_cast<T>(decade);
        const auto f = [=](T x) { return scale * x * (x * x - x / 3) * std::sin(x); };
        const std::array<Shape<T>, 3> shapes{Shape<T>{0, scale}, Shape<T>{1, scale}, Shape<T>{2, scale}};
        auto best =
            lumis::optimal<double>(lumis::take(1, shapes[0]), lumis::take(1, shapes[1]), lumis::take(1, shapes[2]));
        Evenly<T> uniforms, again;
        for (int i = 0; i < rounds; ++i) best.add(f, uniforms);
        const auto alpha = best.weights();

        Quad sum = 0;
        T usual = 0;
        for (int i = 0; i < 3 * rounds; ++i) {
            const auto drawn = shapes[static_cast<std::size_t>(i % 3)].sample(again.template next<1>());
            Quad s = 0, residual = Quad{f(drawn.value)};
            T usual_s = 0, usual_residual = f(drawn.value);
            for (std::size_t k = 0; k < 3; ++k) {
                const T p = shapes[k].pdf(drawn.value);
                s += Quad{p};
                residual -= Quad{alpha[k]} * Quad{p};
                usual_s += p;
                usual_residual -= static_cast<T>(alpha[k]) * p;
            }
            sum += residual / s;
            usual += usual_residual / usual_s;
        }
        Quad total = 0;
        T usual_total = 0;
        for (const double a : alpha) total += Quad{a}, usual_total += static_cast<T>(a);
        measured.compare(best.estimate(alpha), total + sum / rounds);
        measured.usual(usual_total + usual / T(rounds), total + sum / rounds);
        measured.density(best.estimate());
        measured.expect(best.rejected() == 0 && is_finite(best.standard_error()));
    });
    return measured;
}

template Measured optimal_weights<float>(Effort);
template Measured optimal_weights<double>(Effort);

}  // namespace stability
