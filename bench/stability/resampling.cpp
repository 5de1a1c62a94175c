// Reservoirs of long streams and of unlike weights, and weights of pairs of techniques.
#include "cases.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace stability {

template <class T>
Measured reservoir_of_many(Effort effort) {
    Measured measured;
    const std::int64_t n = effort.of(100'000'000);
    const T low = T(0.1), high = T(0.3);
    lumis::Reservoir<std::int64_t, T> kept;
    T sum = 0;
    for (std::int64_t i = 0; i < n; ++i) {
        const T weight = 2 * i < n ? low : high;
        kept.add(i, weight, 0.5);
        sum += weight;
    }
    const std::int64_t lows = (n + 1) / 2;
    const Quad all = Quad{low} * lows + Quad{high} * (n - lows);
    measured.compare(kept.total_weight(), all);
    measured.usual(sum, all);
    measured.expect(kept.count() == static_cast<std::uint64_t>(n));
    return measured;
}

// Two of unlike weights by every kind of u, in both orders, and a third of weight 0.
template <class T>
Measured reservoir_of_unlike(Effort) {
    Measured measured;
    const std::array uniforms{T(0), T(1e-7f), T(0.5), 1 - std::numeric_limits<T>::epsilon() / 2, T(1)};
    sweep(1e-30, 1e30, 60, [&](double first) {
        sweep(1e-30, 1e30, 60, [&](double second) {
            const std::array weights{static_cast<T>(first), static_cast<T>(second)};
            const Quad all = Quad{weights[0]} + Quad{weights[1]};
            for (const T u : uniforms) {
                lumis::Reservoir<std::size_t, T> kept, other;
                measured.expect(kept.add(0, weights[0], u));
                other.add(1, weights[1], u);
                kept.merge(other, u);
                measured.expect(!kept.add(2, T(0), T(0)));
                measured.expect(kept.item() < 2 && kept.weight() == weights[kept.item()]);
                measured.compare(kept.total_weight(), all);
                const Quad inverse = all / Quad{kept.weight()};
                if (inverse < Quad{std::numeric_limits<T>::max()})
                    measured.compare(kept.inverse_probability(), inverse);
            }
        });
    });
    return measured;
}

// A density that is what it is told to be.
template <class T>
struct Told {
    using Scalar = T;
    using Point = T;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    T density;

    [[nodiscard]] lumis::Sample<T, T> sample(glm::vec<1, T> u) const noexcept { return {u.x, density}; }
    [[nodiscard]] T pdf(T /*x*/) const noexcept { return density; }
};

template <class T>
Measured pairwise_weights(Effort) {
    Measured measured;
    sweep(1e-30, 1e30, 20, [&](double a) {
        sweep(1e-30, 1e30, 20, [&](double b) {
            sweep(1e-30, 1e30, 20, [&](double c) {
                const std::array p{static_cast<T>(a), static_cast<T>(b), static_cast<T>(c)};
                const auto all = multi_sample(lumis::PairwiseWeights{}, lumis::take(1, Told<T>{p[0]}),
                                              lumis::take(2, Told<T>{p[1]}), lumis::take(6, Told<T>{p[2]}));
                const Quad q0{p[0]}, pair1 = 8 * Quad{p[1]} + q0, pair2 = 8 * Quad{p[2]} + q0;
                const std::array<Quad, 3> expected{q0 / pair1 / 4 + 3 * q0 / pair2 / 4, 2 * Quad{p[1]} / pair1,
                                                   6 * Quad{p[2]} / pair2};
                const std::array weights{all.template weight<0>(0), all.template weight<1>(0),
                                         all.template weight<2>(0)};
                // Terms below T's least number are 0.
                const Quad least = Quad{std::numeric_limits<T>::min()} / Quad{std::numeric_limits<T>::epsilon()};
                Quad sum = 0;
                for (std::size_t i = 0; i < 3; ++i) {
                    measured.density(weights[i]);
                    if (expected[i] >= least) measured.compare(weights[i], expected[i]);
                    sum += Quad{weights[i]};
                }
                measured.error(static_cast<double>(abs(sum - 1)));
            });
        });
    });
    return measured;
}

template Measured reservoir_of_many<float>(Effort);
template Measured reservoir_of_many<double>(Effort);
template Measured reservoir_of_unlike<float>(Effort);
template Measured reservoir_of_unlike<double>(Effort);
template Measured pairwise_weights<float>(Effort);
template Measured pairwise_weights<double>(Effort);

}  // namespace stability
