// MIS weights, delta strategies, mixtures, sets of lights.
#include "cases.hpp"

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

namespace stability {

namespace {

template <class T>
constexpr T infinity = std::numeric_limits<T>::infinity();
template <class T>
constexpr T nan = std::numeric_limits<T>::quiet_NaN();

// Weights against sums of powers in quad, which hold what overflows in T; and their sum.
template <class T>
void check_power_weights(Measured& measured, const std::vector<T>& densities, int beta) {
    const lumis::PowerHeuristic power{static_cast<double>(beta)};
    const auto to_beta = [&](T p) {
        Quad result = 1;
        for (int i = 0; i < beta; ++i) result *= Quad{p};
        return result;
    };
    Quad all = 0, sum = 0;
    for (const T p : densities) all += to_beta(p);
    for (std::size_t i = 0; i < densities.size(); ++i) {
        const std::span<const T> span{densities};
        const T weight =
            beta == 1 ? lumis::mis_weight(lumis::BalanceHeuristic{}, i, span) : lumis::mis_weight(power, i, span);
        measured.density(weight);
        measured.expect(weight <= 1);
        sum += Quad{weight};
        const Quad expected = to_beta(densities[i]) / all;
        if (expected < Quad{std::numeric_limits<T>::min()}) continue;  // T may flush it
        measured.compare(weight, expected);
        if (beta == 2 && densities.size() == 2) {
            const T own = densities[i], other = densities[1 - i];
            measured.usual(own * own / (own * own + other * other), expected);
        }
    }
    measured.error(static_cast<double>(abs(sum - 1)));
}

}  // namespace

template <class T>
Measured mis_weights(Effort) {
    Measured measured;
    const int steps = 38;
    sweep(1e-38, 1e38, steps, [&](double first) {
        sweep(1e-38, 1e38, steps, [&](double second) {
            for (const double count : {1.0, 1e6}) {
                const T p = static_cast<T>(first), q = static_cast<T>(second) * static_cast<T>(count);
                if (second * count > double{std::numeric_limits<T>::max()}) continue;  // in float: see the policy
                // 1e-38 is subnormal in float.
                if (measured.leaves_out<T>(first) || measured.leaves_out<T>(second * count)) continue;
                for (const int beta : {1, 2, 3}) check_power_weights<T>(measured, {p, q}, beta);
                const T with_factors = lumis::mis_weight(lumis::BalanceWithFactors{0.25, 3.0}, p, q);
                const Quad expected = Quad{p} / (Quad{p} + 12 * Quad{q});
                if (expected >= Quad{std::numeric_limits<T>::min()}) measured.compare(with_factors, expected);
                const T largest = lumis::mis_weight(lumis::MaximumHeuristic{}, p, q);
                measured.expect(largest == (p > q ? T(1) : p < q ? T(0) : T(0.5)));
                const T kept = lumis::mis_weight(lumis::CutoffHeuristic{0.1}, p, q);
                const T other = lumis::mis_weight(lumis::CutoffHeuristic{0.1}, q, p);
                measured.expect(kept >= 0 && kept <= 1 && std::abs(double{kept} + double{other} - 1) < 1e-6);
            }
        });
    });
    return measured;
}

template <class T>
Measured mis_weights_of_many(Effort effort) {
    Measured measured;
    for (const int n : {3, 30, 300, 1000}) {
        std::vector<T> equal(static_cast<std::size_t>(n), T(1e-30)), spread, steep;
        sweep(0.01, 100, n - 1, [&](double p) { spread.push_back(static_cast<T>(p)); });
        sweep(1e-37, 1e37, n - 1, [&](double p) { steep.push_back(static_cast<T>(p)); });
        if (effort.quick && n > 30) continue;
        for (const int beta : {1, 2}) {
            for (const auto& densities : {equal, spread, steep}) check_power_weights<T>(measured, densities, beta);
        }
    }
    return measured;
}

template <class T>
Measured mis_weights_policy(Effort) {
    Measured measured;
    const auto check = [&](const auto& heuristic) {
        const auto weight = [&](auto... densities) { return lumis::mis_weight(heuristic, T(densities)...); };
        measured.expect(weight(0, 0) == 0 && weight(0, 0, 0) == 0);
        for (const double p : {1e-38, 1.0, 1e38}) {
            if (measured.leaves_out<T>(p)) continue;
            measured.expect(weight(p, 0) == 1 && weight(0, p) == 0);
            if (!measured.leaves_out<T>(infinity<T>)) {
                measured.expect(weight(infinity<T>, p) == 1 && weight(p, infinity<T>) == 0);
                measured.expect(weight(nan<T>, p) == 0 && weight(p, nan<T>) == 0 && weight(p, p, nan<T>) == 0);
            }
        }
        if (!measured.leaves_out<T>(infinity<T>)) {
            measured.expect(weight(0, nan<T>) == 0 && weight(nan<T>, 0) == 0);
            measured.expect(weight(infinity<T>, 0) == 1 && weight(0, infinity<T>) == 0);
            measured.expect(weight(infinity<T>, infinity<T>) == T(0.5));
            measured.expect(weight(infinity<T>, infinity<T>, 1) == T(0.5));
        }
        // Scaling all densities changes nothing.
        for (const double ratio : {1e-6, 0.3, 1.0, 50.0}) {
            const T plain = weight(1, ratio);
            for (const double scale : {0x1p-100, 0x1p100}) {
                const T scaled = weight(scale, scale * double{static_cast<T>(ratio)});
                if (plain > 0) measured.compare(scaled, Quad{plain});
                measured.expect(plain > 0 || scaled == 0);
            }
        }
    };
    check(lumis::BalanceHeuristic{});
    check(lumis::PowerHeuristic{});
    check(lumis::PowerHeuristic{4});
    check(lumis::MaximumHeuristic{});
    check(lumis::CutoffHeuristic{});
    return measured;
}

// A mirror below a lamp and a patch of sky: every estimate of the deltas is the analytic value itself.
template <class T>
Measured delta_strategies(Effort effort) {
    Measured measured;
    using lumis::choose, lumis::take;
    const lumis::Direction<T> wo{T(0.6), T(0), T(0.8)};
    sweep(1e-6, 1e6, 6, [&](double distance) {
        const lumis::PerfectReflection<T> mirror{wo};
        const lumis::PointLight<T> lamp{{T(0), T(0), static_cast<T>(distance)}, {T(0), T(0), T(0)}};
        const lumis::CosineHemisphere<T> smooth;
        const T square = static_cast<T>(distance) * static_cast<T>(distance);
        struct Radiance {
            T square;
            T operator()(const lumis::Direction<T>& w) const { return w.z * std::numbers::inv_pi_v<T> / square; }
            T operator()(const lumis::Direction<T>& w, lumis::delta_t) const { return w.z / square; }
        } const f{square};
        const Quad analytic_mirror = Quad{wo.z} / Quad{square}, analytic_lamp = 1 / Quad{square};
        auto source = uniforms<T>(1);
        const auto single = [&](const auto& strategy, const Quad& answer) {
            measured.compare(lumis::multi_sample(lumis::PowerHeuristic{}, take(1, strategy)).estimate(f, source),
                             answer);
            measured.compare(lumis::multi_sample(lumis::PowerHeuristic{}, take(3, strategy)).estimate(f, source),
                             answer);
            // Beside a smooth technique of weight 1: its integral is 1 / square in every sample.
            const auto both = lumis::multi_sample(lumis::PowerHeuristic{}, take(1, strategy), take(1, smooth));
            measured.compare(both.estimate(f, source), Quad{answer + 1 / Quad{square}});
        };
        single(mirror, analytic_mirror);
        single(lamp, analytic_lamp);
        const auto both = lumis::multi_sample(lumis::BalanceHeuristic{}, take(1, mirror), take(2, lamp));
        measured.compare(both.estimate(f, source), Quad{analytic_mirror + analytic_lamp});
        // The selection probability divides, and is no density.
        for (const double c : {1e-3, 0.3, 0.5}) {
            const auto selected =
                lumis::one_sample(lumis::BalanceHeuristic{}, choose(c, mirror), choose(1 - c, smooth));
            const auto moments =
                moments_of<T>(effort.of(c < 0.01 ? 400'000 : 20'000), [&](auto& u) { return selected.estimate(f, u); });
            measured.bias(moments, static_cast<double>(Quad{analytic_mirror + 1 / Quad{square}}), 1e-5);
        }
    });
    const lumis::PointLight<T> at_the_point{{T(1), T(2), T(3)}, {T(1), T(2), T(3)}};
    for_each_uniform<T>(5, [&](const auto& u) {
        const auto sample = at_the_point.sample(u);
        measured.sample<T>(sample, at_the_point.pdf(sample.value));
        measured.expect(sample.pdf == 0);
        measured.expect(lumis::PerfectReflection<T>{{T(0.6), T(0), T(-0.8)}}.sample(u).pdf == 0);
    });
    return measured;
}

template <class T>
Measured mixtures(Effort effort) {
    Measured measured;
    const lumis::Direction<T> wo{T(0.6), T(0), T(0.8)};
    const lumis::CosineHemisphere<T> diffuse;
    sweep(1e-6, 0.999999, 6, [&](double c) {
        for (const double alpha : {1e-3, 0.1, 1.0}) {
            const lumis::GgxReflection<T> specular{wo, glm::vec<2, T>{glm::dvec2{alpha}}};
            const T p = static_cast<T>(c), rest = static_cast<T>(1 - c);
            const lumis::Mixture mixture{lumis::choose(p, specular), lumis::choose(rest, diffuse)};
            auto source = uniforms<T>(1);
            for (std::int64_t i = 0; i < effort.of(2000); ++i) {
                const auto sample = mixture.sample(source.template next<3>());
                measured.sample<T>(sample, mixture.pdf(sample.value));
                if (!(sample.pdf > 0)) continue;
                measured.expect_same(sample.pdf, mixture.pdf(sample.value));
                measured.compare(sample.pdf, Quad{p} * Quad{specular.pdf(sample.value)} +
                                                 Quad{rest} * Quad{diffuse.pdf(sample.value)});
            }
            // A white surface sends back all that the mixture draws: the integral of cos / pi is 1.
            const auto estimator = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, mixture));
            if (c < 0.005 || c > 0.995) continue;  // what is this rare, so few samples cannot tell
            const auto f = [](const auto& w) { return std::max(w.z, T(0)) * std::numbers::inv_pi_v<T>; };
            measured.bias(moments_of<T>(effort.of(20'000), [&](auto& u) { return estimator.estimate(f, u); }), 1, 1e-5);
        }
    });
    const lumis::Mixture nothing{lumis::choose(0, diffuse), lumis::choose(0, diffuse)};
    for (const T u : corner_values<T>) {
        const auto sample = nothing.sample({u, T(0.5), u});
        measured.sample<T>(sample, nothing.pdf(sample.value));
        measured.expect(sample.pdf == 0 && nothing.pdf({T(0), T(0), T(1)}) == 0);
    }
    return measured;
}

template <class T>
Measured light_sets(Effort effort) {
    Measured measured;
    const glm::vec<3, T> p{T(0), T(0), T(0)};
    const auto light = [&](std::size_t i) {
        const T x = static_cast<T>(i % 100) - T(50), y = static_cast<T>(i / 100 % 100) - T(50);
        return lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{
            {{x, y, T(20) + static_cast<T>(i / 10'000)}, T(0.1)}, p};
    };
    const auto irradiance = [&](std::size_t i) {
        const glm::dvec3 c{double(i % 100) - 50, double(i / 100 % 100) - 50, 20 + double(i / 10'000)};
        const double radius = double{T(0.1)};
        return std::numbers::pi * radius * radius / glm::dot(c, c) * c.z / glm::length(c);
    };
    for (const std::size_t n : {1u, 2u, 10u, 100'000u}) {
        std::vector<T> weights(n);
        double answer = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const bool dark = n > 1 && i % 2 == 1;  // a light of power 0
            weights[i] = dark ? T(0) : static_cast<T>(irradiance(i) * (1 + static_cast<double>(i % 3)));
            answer += dark ? 0 : irradiance(i);
        }
        const lumis::AliasTable<T> table{weights};
        const lumis::LightSet set{light, table};
        const auto moments = moments_of<T>(effort.of(200'000), [&](auto& source) {
            const auto selected = set.sample_one(source.template next<3>());
            measured.expect(selected.index < n && weights[selected.index] > 0);
            measured.sample<T>(selected.sample, set.pdf_of(selected.index, selected.sample.value));
            return selected.sample.pdf > 0 ? std::max(selected.sample.value.z, T(0)) / selected.sample.pdf : T(0);
        });
        measured.bias(moments, answer, rounding_of_mean<T>);
        // The density of the whole set, which asks every light.
        auto source = uniforms<T>(2);
        for (int i = 0; i < (n > 100 ? 3 : 200); ++i) {
            const auto sample = set.sample(source.template next<3>());
            measured.sample<T>(sample, set.pdf(sample.value));
            Quad sum = 0;
            for (std::size_t k = 0; k < n; ++k) sum += Quad{table.pdf(k)} * Quad{light(k).pdf(sample.value)};
            measured.compare(sample.pdf, sum);
        }
    }
    // No power at all: nothing is drawn.
    const lumis::LightSet dark{light, lumis::AliasTable<T>{std::vector<T>(10, T(0))}};
    for (const T u : corner_values<T>) {
        const auto sample = dark.sample({u, u, u});
        measured.sample<T>(sample, dark.pdf(sample.value));
        measured.expect(dark.empty() && sample.pdf == 0);
    }
    return measured;
}

template Measured mis_weights<float>(Effort);
template Measured mis_weights<double>(Effort);
template Measured mis_weights_of_many<float>(Effort);
template Measured mis_weights_of_many<double>(Effort);
template Measured mis_weights_policy<float>(Effort);
template Measured mis_weights_policy<double>(Effort);
template Measured delta_strategies<float>(Effort);
template Measured delta_strategies<double>(Effort);
template Measured mixtures<float>(Effort);
template Measured mixtures<double>(Effort);
template Measured light_sets<float>(Effort);
template Measured light_sets<double>(Effort);

}  // namespace stability
