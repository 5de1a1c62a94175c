#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/statistics/error_metrics.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace {

bool agree(double a, double b) {
    return std::abs(a - b) <= 1e-14 * std::abs(b);
}

}  // namespace

TEMPLATE_TEST_CASE("errors worked out by hand", "[error_metrics]", float, double) {
    using T = TestType;
    const std::array<T, 4> estimate{1, 3, 0, 10}, reference{2, 1, 0, 8};
    const std::span<const T> e{estimate}, r{reference};
    CHECK(agree(lumis::mean_squared_error(e, r), (1 + 4 + 0 + 4) / 4.0));
    CHECK(agree(lumis::root_mean_squared_error(e, r), 1.5));
    CHECK(agree(lumis::relative_mean_squared_error(e, r, 1e-3), (0.25 + 4 + 0 + 0.0625) / 4));
    // Below the floor, errors are fractions of the floor.
    CHECK(agree(lumis::relative_mean_squared_error(e, r, 4.0), (1 / 16.0 + 4 / 16.0 + 0 + 4 / 64.0) / 4));
    CHECK(lumis::mean_squared_error(r, r) == 0);
    CHECK(lumis::relative_mean_squared_error(r, r, 0.1) == 0);
}

TEMPLATE_TEST_CASE("relative errors take the reference's magnitude", "[error_metrics]", float, double) {
    using T = TestType;
    const std::array<T, 2> estimate{-1, 1}, reference{-2, 2};
    const std::span<const T> e{estimate}, r{reference};
    CHECK(agree(lumis::relative_mean_squared_error(e, r, 0.5), 0.25));
    const std::array<T, 1> light{T(0.5)}, black{0};
    CHECK(agree(lumis::relative_mean_squared_error(std::span<const T>{light}, std::span<const T>{black}, 0.25), 4));
}

TEST_CASE("sums of squares of a large image keep their digits", "[error_metrics]") {
    const std::vector<float> estimate(10'000'000, 0.1f), reference(10'000'000, 0.0f);
    const double square = double{0.1f} * double{0.1f};
    const std::span<const float> e{estimate}, r{reference};
    CHECK(std::abs(lumis::mean_squared_error(e, r) / square - 1) <= 1e-9);
    // Squares of floats leave float's range.
    const std::array<float, 1> huge{1e30f}, none{0};
    CHECK(agree(lumis::mean_squared_error(std::span<const float>{huge}, std::span<const float>{none}),
                double{1e30f} * double{1e30f}));
}

TEST_CASE("a value that is not finite shows", "[error_metrics]") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::array<float, 2> reference{1, 2};
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity}) {
        const std::array<float, 2> estimate{1, bad};
        const std::span<const float> e{estimate}, r{reference};
        CHECK_FALSE(std::isfinite(lumis::mean_squared_error(e, r)));
        CHECK_FALSE(std::isfinite(lumis::root_mean_squared_error(e, r)));
        CHECK_FALSE(std::isfinite(lumis::relative_mean_squared_error(e, r, 0.1)));
        CHECK_FALSE(std::isfinite(lumis::relative_mean_squared_error(r, e, 0.1) + lumis::mean_squared_error(r, e)));
    }
    CHECK(std::isnan(lumis::mean_squared_error(std::span<const float>{}, std::span<const float>{})));
}
