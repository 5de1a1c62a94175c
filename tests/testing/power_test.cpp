// The power of each law: the smallest error of a kind that it sees at its usual sample count.
//     lumis_tests "[power]"    prints the table of docs/testing.md
#include "broken.hpp"
#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

namespace {

// The least error in (1e-15, 1) for which the law no longer passes, to 2 %; law(error, seed). The median of some seeds.
template <class Law>
double smallest_seen(const Law& law, int seeds = 1) {
    std::vector<double> errors;
    for (int seed = 1; seed <= seeds; ++seed) {
        double passes = 1e-15, fails = 1;
        while (fails > 1.02 * passes) {
            const double middle = std::sqrt(passes * fails);
            (law(middle, static_cast<std::uint64_t>(seed)).passed ? passes : fails) = middle;
        }
        errors.push_back(fails);
    }
    std::nth_element(errors.begin(), errors.begin() + seeds / 2, errors.end());
    return errors[static_cast<std::size_t>(seeds / 2)];
}

template <class T>
struct Scaled {
    using Scalar = T;
    using Point = lumis::Direction<T>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    struct Drawn {
        Point value;
        T pdf, weight;
    };
    lumis::CosineHemisphere<T> strategy;
    double sample_factor = 1, pdf_factor = 1, weight_factor = 1, hidden = 0;

    T scaled(T pdf, double factor, const Point& w) const noexcept {
        return 1 - double{w.z} < hidden ? T(0) : static_cast<T>(factor * double{pdf});
    }
    Drawn sample(glm::vec<2, T> u) const noexcept {
        const auto [w, pdf] = strategy.sample(u);
        return {w, scaled(pdf, sample_factor, w), static_cast<T>(pdf > 0 ? weight_factor / 2 : 0)};
    }
    T pdf(const Point& w) const noexcept { return scaled(strategy.pdf(w), pdf_factor, w); }
};

template <class T>
void print_laws_of_a_strategy(const char* scalar) {
    const auto print = [&](const char* law, double error) { std::printf("%s, %s: %.2g\n", law, scalar, error); };
    const auto f_cos = [](const lumis::Direction<T>& w) { return (std::max)(w.z, T(0)) / T(2 * std::numbers::pi); };
    print("agreement", smallest_seen([](double e, auto) { return laws::agreement(Scaled<T>{{}, 1 + e}); }));
    print("integrates, probability given", smallest_seen([](double e, auto) {
              return laws::integrates(Scaled<T>{{}, 1 + e, 1 + e}, laws::sphere_chart(), {.probability = 1.0});
          }));
    print("jacobian", smallest_seen([](double e, auto) { return laws::jacobian(Scaled<T>{{}, 1 + e, 1 + e}); }));
    print("weighs", smallest_seen([&](double e, auto) { return laws::weighs(Scaled<T>{{}, 1, 1, 1 + e}, f_cos); }));
    const auto lambert = [](const lumis::Direction<T>& wo, const lumis::Direction<T>& wi) {
        return wo.z > 0 && wi.z > 0 ? std::numbers::inv_pi_v<T> : T(0);
    };
    print("is_reciprocal", smallest_seen([&](double e, auto) {
              return laws::is_reciprocal([&](const lumis::Direction<T>& wo, const lumis::Direction<T>& wi) {
                  return lambert(wo, wi) * static_cast<T>(1 + e * double{wo.z});
              });
          }));
    print("conserves_energy", smallest_seen([&](double e, auto) {
              const auto f = [&](const lumis::Direction<T>& wo, const lumis::Direction<T>& wi) {
                  return static_cast<T>(1 + e) * lambert(wo, wi);
              };
              return laws::conserves_energy(f, V{0, 0, 1});
          }));
}

}  // namespace

TEST_CASE("the power of the laws, measured", "[.][power]") {
    print_laws_of_a_strategy<float>("float");
    print_laws_of_a_strategy<double>("double");
    std::printf("covers, share of the hemisphere: %.2g\n", smallest_seen([](double e, auto) {
                    return laws::covers(Scaled<double>{{}, 1, 1, 1, e}, [](const V& w) { return w.z > 0; });
                }));
    const auto lopsided = [](double e) {
        return laws::expectation(
            laws::Density<V>{[=](const V& w) { return (1 + (w.z > 0.5 ? e : -e)) * Uniform{}.pdf(w); }},
            laws::sphere_chart());
    };
    std::printf("chi_square, half of the hemisphere: %.2g\n", smallest_seen(
                                                                  [&](double e, std::uint64_t seed) {
                                                                      laws::ChiSquareOptions options;
                                                                      options.seed = seed;
                                                                      return laws::chi_square(Uniform{}, lopsided(e),
                                                                                              options);
                                                                  },
                                                                  11));
    std::printf("the same, of at most a million samples: %.2g\n",
                smallest_seen(
                    [&](double e, std::uint64_t seed) {
                        return laws::chi_square(Uniform{}, lopsided(e), laws::Sequential{0.01, 1'000'000, seed});
                    },
                    11));
    const auto doubled = [](std::uint64_t seed) {
        return [uniforms = lumis::Uniforms<std::mt19937_64, double>{std::mt19937_64{seed}}]() mutable {
            return 2 * uniforms.next<1>().x;
        };
    };
    std::printf("unbiased, of numbers evenly spread from 0 to 2: %.2g\n",
                smallest_seen([&](double e, auto seed) { return laws::unbiased(doubled(seed), 1 + e); }, 11));
    std::printf("the same, of at most a million: %.2g\n",
                smallest_seen(
                    [&](double e, auto seed) {
                        return laws::unbiased(laws::Bounded{0, 2, doubled(seed)}, 1 + e, laws::Sequential{});
                    },
                    11));
    std::printf("agreement of two such: %.2g\n",
                smallest_seen(
                    [&](double e, auto seed) {
                        return laws::agreement(doubled(2 * seed),
                                               [=, one = doubled(2 * seed + 1)]() mutable { return (1 + e) * one(); });
                    },
                    11));
}
