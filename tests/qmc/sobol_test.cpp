// Points of Sobol's sequence, scrambled: where they lie, and that nothing but their stratification ties them together.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/combine/multi_sample.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/qmc/sobol.hpp>
#include <lumis/statistics/running_moments.hpp>

#include <boost/random/sobol.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using Set = std::array<double, 4>;

// The coordinates of a point of the set with this number.
Set set_of(lumis::Sobol<double>& points, std::uint32_t index, int set) {
    points.start(index);
    for (int i = 0; i < set; ++i) (void)points.next<4>();
    const glm::dvec4 u = points.next<4>();
    return {u.x, u.y, u.z, u.w};
}

}  // namespace

TEST_CASE("directions of Sobol's sequence are those of Boost", "[sobol]") {
    boost::random::sobol_engine<std::uint32_t, 32> engine{lumis::detail::sobol_dimensions};
    constexpr auto directions = lumis::detail::sobol_directions();
    for (std::size_t k = 0; k < 32; ++k) {
        engine.seed((k < 31 ? (2u << k) - 1 : 0xffffffffu) - 1);  // Boost counts in Gray code and leaves out 0
        for (const std::uint32_t direction : directions[k]) CHECK(direction == engine());
    }
    for (const bool is_run : {false, true}) {
        const std::uint32_t places[] = {lumis::detail::reversed_bits(0b1010), lumis::detail::reversed_bits(0b1011)};
        std::uint32_t digits[lumis::detail::sobol_dimensions][2] = {};
        lumis::detail::reversed_sobol_points(places, is_run, digits);
        for (std::size_t d = 0; d < lumis::detail::sobol_dimensions; ++d) {
            const std::uint32_t even = directions[1][d] ^ directions[3][d];
            CHECK(lumis::detail::reversed_bits(digits[d][0]) == even);
            CHECK(lumis::detail::reversed_bits(digits[d][1]) == (even ^ directions[0][d]));
        }
    }
}

TEST_CASE("a digit is flipped by the digits before it, each with probability 1/2", "[sobol]") {
    std::mt19937_64 random{1};
    constexpr int draws = 4000;
    double worst = 0;
    for (unsigned flipped = 0; flipped < 32; ++flipped) {
        std::array<int, 32> changes{};
        for (int i = 0; i < draws; ++i) {
            const std::uint64_t key = random();
            const auto x = static_cast<std::uint32_t>(random());
            const std::uint32_t change =
                lumis::detail::owen_scrambled(x, key) ^ lumis::detail::owen_scrambled(x ^ 0x80000000u >> flipped, key);
            for (unsigned digit = 0; digit < 32; ++digit) changes[digit] += (change >> (31 - digit) & 1) != 0;
        }
        for (unsigned digit = 0; digit < 32; ++digit) {
            if (digit < flipped) CHECK(changes[digit] == 0);
            if (digit == flipped) CHECK(changes[digit] == draws);
            if (digit > flipped) worst = std::max(worst, std::abs(changes[digit] - draws / 2) / std::sqrt(draws / 4.0));
        }
    }
    CHECK(worst <= 5.5);  // of 496 counts; a fair one is beyond once in 50,000 tests
}

TEST_CASE("each aligned run of points is stratified, in every set", "[sobol]") {
    constexpr std::uint32_t count = 64;
    lumis::Sobol<double> points{7};
    for (const int set : {0, 1, 5}) {
        for (const std::uint32_t first : {0u, 64u, 0x12345640u}) {
            // Each coordinate has one point in each 64th; the first two have one in each box of that area.
            std::array<std::vector<int>, 4> strips;
            std::array<std::vector<int>, 7> boxes;
            for (auto& strip : strips) strip.assign(count, 0);
            for (auto& box : boxes) box.assign(count, 0);
            for (std::uint32_t i = 0; i < count; ++i) {
                const Set u = set_of(points, first + i, set);
                for (std::size_t d = 0; d < 4; ++d) ++strips[d][static_cast<std::size_t>(u[d] * count)];
                for (std::size_t k = 0; k < boxes.size(); ++k) {
                    const double wide = std::ldexp(u[0], static_cast<int>(k)),
                                 high = std::ldexp(u[1], 6 - static_cast<int>(k));
                    ++boxes[k]
                           [static_cast<std::size_t>(std::floor(wide) * std::ldexp(1, 6 - static_cast<int>(k)) + high)];
                }
            }
            const auto has_one_each = [](const std::vector<int>& cells) {
                return std::ranges::count(cells, 1) == count;
            };
            CHECK(std::ranges::all_of(strips, has_one_each));
            CHECK(std::ranges::all_of(boxes, has_one_each));
        }
    }
}

TEMPLATE_TEST_CASE("a point is uniform over the lattice below 1", "[sobol]", float, double) {
    using T = TestType;
    constexpr int draws = 20'000, bins = 32, digits = lumis::uniform_bits<T>;
    static_assert(lumis::UniformSource<lumis::Sobol<T>, T>);
    for (const std::uint32_t index : {0u, 1u, 1000u, 0xffffffffu}) {
        std::array<int, bins> high{}, low{};
        bool on_lattice = true;
        for (int i = 0; i < draws; ++i) {
            lumis::Sobol<T> points{static_cast<std::uint64_t>(i), index};
            const T u = points.template next<3>().z, place = std::ldexp(u, digits);
            on_lattice = on_lattice && u >= 0 && u < 1 && place == std::floor(place);
            ++high[lumis::lattice_index(u) >> (digits - 5)];
            ++low[lumis::lattice_index(u) % bins];
        }
        CHECK(on_lattice);
        for (const auto& counts : {high, low}) {
            double chi_square = 0;
            for (const int n : counts) chi_square += (n - draws / bins) * (n - draws / bins) / (draws / double{bins});
            CHECK(chi_square <= 86);  // of 31 degrees of freedom: exceeded once in two million tests
        }
    }
}

TEST_CASE("coordinates are scrambled independently, in a set and across sets", "[sobol]") {
    constexpr int draws = 4000;
    constexpr std::size_t coordinates = 12;
    using Signs = std::array<double, coordinates>;
    // Whether a coordinate's second digit is 1. It differs between a point and the next one as the scrambling says.
    const auto second_digits = [](std::uint64_t randomisation, std::uint32_t index) {
        lumis::Sobol<double> points{randomisation, index};
        Signs signs;
        for (double& sign : signs) sign = lumis::lattice_index(points.next<1>().x) >> 51 & 1 ? 1 : -1;
        return signs;
    };
    std::array<Signs, coordinates> of_a_point{}, of_two{};
    for (std::uint64_t i = 0; i < draws; ++i) {
        const Signs first = second_digits(i, 2), second = second_digits(i, 3);
        for (std::size_t a = 0; a < coordinates; ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                of_a_point[a][b] += first[a] * first[b];
                of_two[a][b] += first[a] * second[a] * first[b] * second[b];
            }
        }
    }
    for (std::size_t a = 0; a < coordinates; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            CHECK(std::abs(of_a_point[a][b]) <= 5 * std::sqrt(double{draws}));
            CHECK(std::abs(of_two[a][b]) <= 5 * std::sqrt(double{draws}));
        }
    }
}

TEST_CASE("sets are shuffled against each other", "[sobol]") {
    // Two sets in one order: their first digits would agree at all points or at none. For the estimate to fall by stratification
    // alone, there is none: of 64 points as of 32 random pairs.
    lumis::RunningMoments<double> squares;
    for (std::uint64_t i = 0; i < 500; ++i) {
        lumis::Sobol<double> points{i};
        double sum = 0;
        for (std::uint32_t n = 0; n < 64; ++n) {
            points.start(n);
            const double a = points.next<4>().x, b = points.next<4>().x;
            sum += (a < 0.5) == (b < 0.5) ? 1 : -1;
        }
        squares.add(sum * sum / 64);
    }
    CHECK(squares.mean() <= 3);
    CHECK(squares.mean() >= 1);
}

TEST_CASE("coordinates come in order, and no block lies in two sets", "[sobol]") {
    lumis::Sobol<float> points{3, 5}, again{3, 5};
    const glm::vec4 set = points.next<4>(), next_set = points.next<4>();
    CHECK(again.next<1>().x == set.x);
    CHECK(again.next<2>() == glm::vec2{set.y, set.z});
    CHECK(again.next<2>() == glm::vec2{next_set.x, next_set.y});  // set.w is left out
    points.start(6);
    CHECK(points.next<4>() != set);
    points.start(5);
    CHECK(points.next<4>() == set);
    points.start(4, 5);
    CHECK(points.next<4>() != set);
}

TEST_CASE("lanes hold points in a row", "[sobol]") {
    using Lanes = lumis::Lanes<float, 8>;
    static_assert(lumis::UniformSource<lumis::Sobol<Lanes>, Lanes>);
    const lumis::CosineHemisphere<float> bsdf;
    const lumis::UniformHemisphere<float> light;
    const auto direct = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, bsdf), lumis::take(2, light));
    const auto height = [](const auto& w) { return w.z; };
    for (const std::uint32_t first : {16u, 13u}) {
        lumis::Sobol<Lanes> in_lanes{9, first};
        const Lanes estimates = direct.estimate(height, in_lanes);
        for (std::uint32_t i = 0; i < 8; ++i) {
            lumis::Sobol<float> alone{9, first + i};
            const float expected = direct.estimate(height, alone);
            CHECK(std::abs(estimates[i] - expected) <= 1e-5f * expected);
        }
    }
}
