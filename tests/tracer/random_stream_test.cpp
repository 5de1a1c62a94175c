// Streams of random numbers are independent: between pixels, passes and seeds.
#include "paths/random_stream.hpp"

#include "catch.hpp"
#include <lumis/core/uniforms.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

namespace {

using Engines = std::function<pcg32(std::uint64_t seed, std::uint64_t pixel, std::uint64_t pass)>;

const Engines mixed_seeds = [](std::uint64_t seed, std::uint64_t pixel, std::uint64_t pass) {
    return tracer::random_stream(seed, pixel, pass);
};

// What must not pass: the seed is spread out, but the passes count up.
const Engines counted_seeds = [](std::uint64_t seed, std::uint64_t pixel, std::uint64_t pass) {
    return pcg32{seed * 0x9e3779b97f4a7c15u + pass, pixel};
};

constexpr std::uint64_t pixels = 40'000;

// The mean of `samples` estimates of the integral of x + y over the unit square, less the integral.
double error_of_pass(const Engines& engines, std::uint64_t seed, std::uint64_t pixel, std::uint64_t pass, int samples) {
    lumis::Uniforms uniforms{engines(seed, pixel, pass)};
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
        const glm::vec2 u = uniforms.next<2>();
        sum += double{u.x} + double{u.y} - 1;
    }
    return sum / samples;
}

// The variance over pixels of the mean over 1, 4, 16, 64 and 256 passes, times passes and samples, over that of x + y.
std::vector<double> variances(const Engines& engines, int samples) {
    constexpr double variance_of_one = 1 / 6.0;
    std::vector<double> sums(5);
    for (std::uint64_t pixel = 0; pixel < pixels; ++pixel) {
        double sum = 0;
        std::uint64_t pass = 0;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const std::uint64_t passes = std::uint64_t{1} << 2 * i;
            for (; pass < passes; ++pass) sum += error_of_pass(engines, 5, pixel, pass, samples);
            sums[i] += sum * sum / static_cast<double>(passes) * samples;
        }
    }
    for (double& sum : sums) sum /= variance_of_one * static_cast<double>(pixels);
    return sums;
}

struct Place {
    std::uint64_t seed, pixel, pass;
};

// The largest correlation of two out of 64 series, each of 10,000 errors. The series are those of 0, 4, 8, ... 252.
double worst_correlation(const std::function<double(std::uint64_t series, std::uint64_t i)>& error) {
    constexpr std::size_t many = 64;
    std::vector<std::vector<double>> rows(many);
    for (std::size_t row = 0; row < many; ++row) {
        for (std::uint64_t i = 0; i < 10'000; ++i) rows[row].push_back(error(4 * row, i));
    }
    const auto product = [&](std::size_t a, std::size_t b) {
        return std::inner_product(rows[a].begin(), rows[a].end(), rows[b].begin(), 0.0);
    };
    double worst = 0;
    for (std::size_t a = 0; a < many; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            worst = std::max(worst, std::abs(product(a, b)) / std::sqrt(product(a, a) * product(b, b)));
        }
    }
    return worst;
}

struct Correlations {
    double pixels, passes, seeds;
    double diagonals;  // where one of the three rises by as much as another falls
};

Correlations correlations(const Engines& engines, int samples) {
    using Index = std::uint64_t;
    const auto error = [&](Index seed, Index pixel, Index pass) {
        return error_of_pass(engines, seed, pixel, pass, samples);
    };
    return {worst_correlation([&](Index pixel, Index pass) { return error(1, pixel, pass); }),
            worst_correlation([&](Index pass, Index pixel) { return error(1, pixel, pass); }),
            worst_correlation([&](Index seed, Index pixel) { return error(seed, pixel, 0); }),
            std::max({worst_correlation([&](Index up, Index i) { return error(1, up, 252 + i - up); }),
                      worst_correlation([&](Index up, Index i) { return error(up, 252 + i - up, 0); }),
                      worst_correlation([&](Index up, Index i) { return error(up, 0, 252 + i - up); })})};
}

double worst_of(const std::vector<double>& ratios) {
    double worst = 0;
    for (const double ratio : ratios) worst = std::max(worst, std::abs(ratio - 1));
    return worst;
}

}  // namespace

// A ratio has a standard error of sqrt(2 / 40000) = 0.7 %: streams that are independent fail 10 tests at 3 % once in 5000.
TEST_CASE("the variance of a pixel falls as 1 / passes") {
    for (const int samples : {1, 4}) {
        const auto ratios = variances(mixed_seeds, samples);
        for (const double ratio : ratios) {
            INFO(samples << " samples a pass: " << ratio << " of what it should be");
            CHECK(std::abs(ratio - 1) <= 0.03);
        }
    }
    CHECK(worst_of(variances(counted_seeds, 1)) > 0.03);
}

// A correlation has a standard error of 0.01; 0.057 is exceeded by one of 2016 pairs of 12 kinds once in 3400.
TEST_CASE("streams are not correlated") {
    constexpr double limit = 0.057;
    for (const int samples : {1, 4}) {
        const Correlations mixed = correlations(mixed_seeds, samples);
        CHECK(mixed.pixels <= limit);
        CHECK(mixed.passes <= limit);
        CHECK(mixed.seeds <= limit);
        CHECK(mixed.diagonals <= limit);
    }
    const auto counted = correlations(counted_seeds, 1);
    CHECK(counted.pixels > limit);
    CHECK(counted.passes > limit);
}

// Two that did would do so by chance once in 10^9 runs.
TEST_CASE("no two of 262,144 streams begin alike") {
    std::vector<std::uint64_t> beginnings;
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
        for (std::uint64_t pixel = 0; pixel < 64; ++pixel) {
            for (std::uint64_t pass = 0; pass < 64; ++pass) {
                pcg32 engine = tracer::random_stream(seed, pixel, pass);
                const std::uint64_t first = engine();
                beginnings.push_back(first << 32 | engine());
            }
        }
    }
    std::ranges::sort(beginnings);
    CHECK(std::ranges::adjacent_find(beginnings) == beginnings.end());
}
