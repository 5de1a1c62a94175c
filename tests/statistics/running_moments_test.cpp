#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/statistics/running_moments.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using lumis::RunningMoments;

namespace {

template <class T>
RunningMoments<T> moments_of(const std::vector<T>& values, std::size_t begin, std::size_t end) {
    RunningMoments<T> moments;
    for (std::size_t i = begin; i < end; ++i) moments.add(values[i]);
    return moments;
}

bool agree(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance * std::abs(b);
}

}  // namespace

TEST_CASE("moments of a few numbers", "[running_moments]") {
    RunningMoments<float> moments;
    CHECK(moments.count() == 0);
    CHECK(moments.mean() == 0);
    CHECK(std::isnan(moments.variance()));
    moments.add(2);
    CHECK(moments.mean() == 2);
    CHECK(std::isnan(moments.variance()));
    CHECK(std::isnan(moments.standard_error()));
    for (const float value : {4.0f, 4.0f, 4.0f, 5.0f, 5.0f, 7.0f, 9.0f}) moments.add(value);
    CHECK(moments.count() == 8);
    CHECK(moments.rejected() == 0);
    CHECK(moments.mean() == 5);
    CHECK(agree(moments.variance(), 32 / 7.0, 1e-15));
    CHECK(agree(moments.standard_error(), std::sqrt(32 / 7.0 / 8), 1e-15));
}

TEST_CASE("the mean of a hundred million floats keeps its digits", "[running_moments]") {
    // A running sum in float would stall at 2^21, and its mean here be 0.021.
    RunningMoments<float> moments;
    for (int i = 0; i < 100'000'000; ++i) moments.add(0.1f);
    CHECK(moments.count() == 100'000'000);
    CHECK(agree(moments.mean(), double{0.1f}, 1e-6));
    CHECK(moments.variance() <= 1e-14);
}

TEST_CASE("a small variance survives a huge offset", "[running_moments]") {
    // Deviations -1, 0 and 1 in turn: textbook sums of squares lose them all.
    RunningMoments<double> moments;
    constexpr int triples = 100'000;
    for (int i = 0; i < triples; ++i) {
        for (const double deviation : {-1.0, 0.0, 1.0}) moments.add(1e9 + deviation);
    }
    CHECK(agree(moments.mean(), 1e9, 1e-13));
    CHECK(agree(moments.variance(), 2.0 * triples / (3 * triples - 1), 1e-6));

    RunningMoments<double> outlier;
    for (int i = 0; i < 1000; ++i) outlier.add(1);
    outlier.add(1e30);
    CHECK(agree(outlier.mean(), 1e30 / 1001, 1e-12));
    CHECK(agree(outlier.variance(), 1e60 / 1001, 1e-12));
}

TEMPLATE_TEST_CASE("merged parts equal the whole, however it is split", "[running_moments]", float, double) {
    using T = TestType;
    std::mt19937 engine{1};
    std::lognormal_distribution<T> distribution{0, 1};
    std::vector<T> values(1000);
    for (T& value : values) value = distribution(engine);
    values[10] = std::numeric_limits<T>::infinity();
    values[990] = std::numeric_limits<T>::quiet_NaN();
    const auto whole = moments_of(values, 0, values.size());
    for (const std::size_t split : {0u, 1u, 2u, 500u, 998u, 999u, 1000u}) {
        auto left = moments_of(values, 0, split);
        left.merge(moments_of(values, split, values.size()));
        CHECK(left.count() == 998);
        CHECK(left.rejected() == 2);
        CHECK(agree(left.mean(), whole.mean(), 1e-14));
        CHECK(agree(left.variance(), whole.variance(), 1e-13));
    }
    RunningMoments<T> by_hundreds;
    for (std::size_t begin = 0; begin < values.size(); begin += 100) {
        by_hundreds.merge(moments_of(values, begin, begin + 100));
    }
    CHECK(agree(by_hundreds.mean(), whole.mean(), 1e-14));
    CHECK(agree(by_hundreds.variance(), whole.variance(), 1e-13));

    RunningMoments<T> empty;
    empty.merge(RunningMoments<T>{});
    CHECK(empty.count() == 0);
    CHECK(empty.mean() == 0);
}

TEST_CASE("merging into nothing changes no digit", "[running_moments]") {
    RunningMoments<double> huge, empty;
    huge.add(1e200);
    huge.add(1e200);
    empty.merge(huge);
    CHECK(empty.mean() == 1e200);
    CHECK(empty.variance() == 0);
    huge.merge(RunningMoments<double>{});
    CHECK(huge.mean() == 1e200);
    CHECK(huge.variance() == 0);
}

TEMPLATE_TEST_CASE("numbers that are not finite are counted and enter nothing", "[running_moments]", float, double) {
    using T = TestType;
    RunningMoments<T> moments;
    constexpr T infinity = std::numeric_limits<T>::infinity();
    for (const T value : {T(1), infinity, T(3), -infinity, std::numeric_limits<T>::quiet_NaN()}) moments.add(value);
    CHECK(moments.count() == 2);
    CHECK(moments.rejected() == 3);
    CHECK(moments.mean() == 2);
    CHECK(moments.variance() == 2);

    RunningMoments<T> only_rejected;
    only_rejected.add(infinity);
    CHECK(only_rejected.count() == 0);
    CHECK(only_rejected.rejected() == 1);
    moments.merge(only_rejected);
    CHECK(moments.count() == 2);
    CHECK(moments.rejected() == 4);
    only_rejected.merge(moments);
    CHECK(only_rejected.rejected() == 5);
    CHECK(only_rejected.mean() == 2);
}

// Differences of such numbers overflow, and their squares do. The mean exists, and no NaN is made on the way to it.
TEST_CASE("numbers near the end of double's range have a mean", "[running_moments]") {
    const double huge = GENERATE(1e154, 1e200, 1e308, std::numeric_limits<double>::max());
    const double infinity = std::numeric_limits<double>::infinity();
    RunningMoments<double> moments, upper, lower;
    for (int i = 0; i < 1000; ++i) {
        for (const double sign : {1.0, -1.0, -1.0, 1.0}) {
            moments.add(sign * huge);
            (sign > 0 ? upper : lower).add(sign * huge);
        }
    }
    CHECK(moments.rejected() == 0);
    CHECK(std::abs(moments.mean()) <= 1e-12 * huge);
    CHECK(moments.variance() == infinity);
    CHECK(moments.standard_error() == infinity);
    CHECK(upper.mean() == huge);
    CHECK(upper.variance() == 0);

    upper.merge(lower);
    CHECK(upper.count() == 4000);
    CHECK(std::abs(upper.mean()) <= 1e-12 * huge);
    CHECK(upper.variance() == infinity);
    // What comes after an overflow leaves the mean right.
    RunningMoments<double> later = upper;
    later.merge(moments);
    for (int i = 0; i < 12'000; ++i) later.add(huge);
    CHECK(agree(later.mean(), 0.6 * huge, 1e-12));
    CHECK(later.variance() == infinity);

    RunningMoments<double> unequal;
    unequal.add(-huge);
    unequal.add(-huge);
    unequal.add(huge);
    CHECK(agree(unequal.mean(), -huge / 3, 1e-15));
    RunningMoments<double> single;
    single.add(huge);
    unequal.merge(single);
    CHECK(std::abs(unequal.mean()) <= 1e-15 * huge);
}

TEST_CASE("the largest floats have a mean and a variance", "[running_moments]") {
    constexpr float largest = std::numeric_limits<float>::max();
    RunningMoments<float> moments;
    for (int i = 0; i < 1000; ++i) moments.add(i % 2 == 0 ? largest : -largest);
    CHECK(std::abs(moments.mean()) <= 1e-12 * double{largest});
    CHECK(agree(moments.variance(), 1000.0 / 999 * double{largest} * double{largest}, 1e-12));
}
