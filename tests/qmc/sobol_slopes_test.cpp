// How fast estimates converge with scrambled Sobol points, against random numbers, and what tables leave of it.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/core/uniforms.hpp>
#include <lumis/lights/environment_map.hpp>
#include <lumis/qmc/sobol.hpp>
#include <lumis/statistics/running_moments.hpp>
#include <lumis/tables/alias_table.hpp>
#include <lumis/tables/discrete_table.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace {

// Random numbers behind the same interface: what a test of convergence has to tell apart from points.
class Random {
  public:
    explicit Random(std::uint64_t seed) : numbers_{std::mt19937_64{seed}} {}
    void start(std::uint32_t) {}
    template <int N>
    glm::vec<N, double> next() {
        return numbers_.next<N>();
    }

  private:
    lumis::Uniforms<std::mt19937_64, double> numbers_;
};

struct Convergence {
    double slope, error;  // of log error over log points, and the error with the most of them
};

// The slope of the root mean square error over 64 randomisations, from 64 to 4096 points.
template <class Source>
Convergence convergence(const auto& f, double answer) {
    constexpr std::array counts{64, 256, 1024, 4096};
    std::array<double, counts.size()> errors;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        lumis::RunningMoments<double> squares;
        for (std::uint64_t randomisation = 1; randomisation <= 64; ++randomisation) {
            Source points{randomisation};
            double sum = 0;
            for (int n = 0; n < counts[i]; ++n) {
                points.start(static_cast<std::uint32_t>(n));
                sum += f(points);
            }
            squares.add(std::pow(sum / counts[i] - answer, 2));
        }
        errors[i] = std::sqrt(squares.mean());
    }
    // Least squares over four points in equal steps of log 4.
    const double slope = (3 * std::log(errors[3] / errors[0]) + std::log(errors[2] / errors[1])) / (10 * std::log(4.0));
    return {slope, errors.back()};
}

double smooth(auto& points) {
    const glm::dvec2 u = points.template next<2>();
    return std::exp(u.x + u.y);
}
double step(auto& points) {
    return points.template next<2>().x < 1.0 / 3 ? 1 : 0;
}
double disk(auto& points) {
    const glm::dvec2 u = points.template next<2>();
    return u.x * u.x + u.y * u.y < 1 ? 1 : 0;
}
// Three coordinates of one set, and three of the next.
double sum_of_sets(auto& points) {
    const glm::dvec3 u = points.template next<3>(), v = points.template next<3>();
    return std::exp(u.x + u.y * u.z) + std::exp(v.x * v.y + v.z);
}
constexpr double e = std::numbers::e;

}  // namespace

TEST_CASE("the smoother the integrand the faster points converge, and random numbers do not care", "[sobol]") {
    const auto with_points = [](const auto& f, double answer) {
        return convergence<lumis::Sobol<double>>(f, answer).slope;
    };
    const auto at_random = [](const auto& f, double answer) { return convergence<Random>(f, answer).slope; };
    const auto each = [](auto& points) { return smooth(points); };
    CHECK(std::abs(with_points(each, (e - 1) * (e - 1)) - -1.45) <= 0.1);
    CHECK(std::abs(with_points([](auto& u) { return step(u); }, 1.0 / 3) - -1) <= 0.05);
    CHECK(std::abs(with_points([](auto& u) { return disk(u); }, std::numbers::pi / 4) - -0.77) <= 0.08);
    CHECK(std::abs(at_random(each, (e - 1) * (e - 1)) - -0.5) <= 0.08);
    CHECK(std::abs(at_random([](auto& u) { return disk(u); }, std::numbers::pi / 4) - -0.5) <= 0.08);
}

TEST_CASE("what is a sum over sets converges as fast as in one", "[sobol]") {
    // The integral of e^(xy) over the square is that of (e^x - 1) / x: the sum of 1 / (k k!).
    const double half = (e - 1) * 1.3179021514544038949;
    CHECK(convergence<lumis::Sobol<double>>([](auto& u) { return sum_of_sets(u); }, 2 * half).slope <= -1.2);
}

TEST_CASE("an alias table keeps the slope of a table in order while points outnumber its entries", "[sobol]") {
    // A value that changes slowly from entry to entry, over probabilities that do not.
    const auto compare = [](std::size_t entries) {
        std::mt19937_64 random{3};
        std::vector<double> weights(entries), values(entries);
        double answer = 0;
        for (std::size_t i = 0; i < entries; ++i) {
            weights[i] = 0.5 + std::uniform_real_distribution{}(random);
            values[i] = 1 + std::sin(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(entries));
            answer += values[i];
        }
        const lumis::DiscreteTable<double> in_order{weights};
        const lumis::AliasTable<double> alias{weights};
        const auto by = [&](const auto& table) {
            return [&](auto& points) {
                const auto drawn = table.sample(points.template next<1>());
                return values[drawn.value] / drawn.pdf / answer;
            };
        };
        return std::array{convergence<lumis::Sobol<double>>(by(in_order), 1),
                          convergence<lumis::Sobol<double>>(by(alias), 1)};
    };
    const auto [in_order, alias] = compare(100);
    CHECK(std::abs(in_order.slope - -0.99) <= 0.07);
    CHECK(std::abs(alias.slope - -0.94) <= 0.07);
    CHECK(alias.error <= 2.1 * in_order.error);
    CHECK(alias.error >= 1.2 * in_order.error);
    const auto [many_in_order, many_alias] = compare(10'000);
    CHECK(std::abs(many_in_order.slope - -0.55) <= 0.08);
    CHECK(std::abs(many_alias.slope - -0.53) <= 0.08);
}

TEST_CASE("an alias map loses the slope of a map in order where its texels are as many as the points", "[sobol]") {
    constexpr int width = 64, height = 32;
    std::mt19937_64 random{3};
    std::vector<double> luminance(width * height);
    for (double& texel : luminance) texel = 0.1 + std::uniform_real_distribution{}(random);
    const lumis::EnvironmentMap<double> in_order{width, height, luminance};
    const lumis::AliasEnvironmentMap<double> alias{width, height, luminance};
    // The cosine about a slanted normal, over the map's own distribution.
    const auto by = [](const auto& map) {
        return [&map](auto& points) {
            const glm::dvec3 w = map.sample(points.template next<2>()).value;
            return std::max(0.0, 0.6 * w.x + 0.64 * w.y + 0.48 * w.z);
        };
    };
    lumis::RunningMoments<double> answers;
    for (std::uint64_t randomisation = 100; randomisation < 108; ++randomisation) {
        lumis::Sobol<double> points{randomisation};
        double sum = 0;
        for (std::uint32_t n = 0; n < 1 << 16; ++n) {
            points.start(n);
            sum += by(in_order)(points);
        }
        answers.add(sum / (1 << 16));
    }
    const auto ordered = convergence<lumis::Sobol<double>>(by(in_order), answers.mean()),
               by_alias = convergence<lumis::Sobol<double>>(by(alias), answers.mean());
    CHECK(answers.standard_error() <= 0.1 * ordered.error);
    CHECK(ordered.slope <= -0.9);
    CHECK(std::abs(by_alias.slope - -0.65) <= 0.1);
    CHECK(by_alias.error >= 4 * ordered.error);
}

TEST_CASE("the standard error of independent randomisations is that of their mean", "[sobol]") {
    // 16 of 64 points: covered within one standard error with Student's t, 67 % of the time.
    int within = 0;
    constexpr int repetitions = 300;
    for (std::uint64_t repetition = 0; repetition < repetitions; ++repetition) {
        lumis::RunningMoments<double> means;
        for (std::uint64_t i = 0; i < 16; ++i) {
            lumis::Sobol<double> points{16 * repetition + i};
            double sum = 0;
            for (std::uint32_t n = 0; n < 64; ++n) {
                points.start(n);
                sum += smooth(points);
            }
            means.add(sum / 64);
        }
        within += std::abs(means.mean() - (e - 1) * (e - 1)) <= means.standard_error();
    }
    CHECK(std::abs(within - 0.667 * repetitions) <= 4 * std::sqrt(0.667 * 0.333 * repetitions));
}
