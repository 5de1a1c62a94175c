#include "catch.hpp"
#include <lumis/core/elementary.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/core/sample.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace {

template <class L>
using Numbers = std::array<typename L::Lane, L::size>;

template <class L>
Numbers<L> numbers_of(L lanes) {
    Numbers<L> numbers;
    lanes.store(numbers.data());
    return numbers;
}

// Numbers that tell operations apart, the ones that misbehave among them.
template <class L>
L mixed(std::size_t shift) {
    using T = typename L::Lane;
    constexpr T inf = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    constexpr T values[] = {T(0.25), T(-3), T(0), T(-0.0), inf, -inf, nan, T(7), T(0.25)};
    Numbers<L> numbers;
    for (std::size_t i = 0; i < L::size; ++i) numbers[i] = values[(i + shift) % std::size(values)];
    return L::load(numbers.data());
}

template <class T>
bool same_bits(T a, T b) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b) || (std::isnan(a) && std::isnan(b));
}

}  // namespace

// Less than a register, a register, and several.
TEMPLATE_TEST_CASE("each lane does as its number would alone", "[lanes]", lumis::NativeLanes<float>,
                   lumis::NativeLanes<double>, (lumis::Lanes<float, 1>), (lumis::Lanes<float, 2>),
                   (lumis::Lanes<float, 8>), (lumis::Lanes<float, 32>), (lumis::Lanes<double, 16>)) {
    using L = TestType;
    using T = typename L::Lane;
    namespace real = lumis::real;
    for (std::size_t shift = 0; shift < 81; ++shift) {
        const L a = mixed<L>(shift), b = mixed<L>(shift / 9), c = T(2);
        const auto same = [&](L lanes, auto alone) {
            for (std::size_t i = 0; i < L::size; ++i) {
                CAPTURE(a[i], b[i], lanes[i], alone(a[i], b[i]));
                CHECK(same_bits(lanes[i], T(alone(a[i], b[i]))));
            }
        };
        same(a + b, [](T x, T y) { return x + y; });
        same(a - b, [](T x, T y) { return x - y; });
        same(a * b, [](T x, T y) { return x * y; });
        same(a / b, [](T x, T y) { return x / y; });
        same(-a, [](T x, T) { return -x; });
        same(c * a, [](T x, T) { return 2 * x; });
        same(1 - a, [](T x, T) { return 1 - x; });
        same(real::sqrt(a), [](T x, T) { return std::sqrt(x); });
        same(real::rounded(a), [](T x, T) { return x; });
        same(L::of_lanes([&](auto i) { return b[i]; }), [](T, T y) { return y; });
        same(real::abs(a), [](T x, T) { return std::abs(x); });
        same(real::copysign(a, b), [](T x, T y) { return std::copysign(x, y); });
        same(real::lesser(a, b), [](T x, T y) { return std::min(x, y); });
        same(real::greater(a, b), [](T x, T y) { return std::max(x, y); });
        same(real::clamp(a, T(-1), T(1)), [](T x, T) { return std::clamp(x, T(-1), T(1)); });
        same(real::select(a < b, a, b), [](T x, T y) { return x < y ? x : y; });
        same(real::select(a <= b, a, b), [](T x, T y) { return x <= y ? x : y; });
        same(real::select(a > b, a, b), [](T x, T y) { return x > y ? x : y; });
        same(real::select(a >= b, a, b), [](T x, T y) { return x >= y ? x : y; });
        same(real::select(a == b, a, b), [](T x, T y) { return x == y ? x : y; });
        same(real::select(!(a < b), a, b), [](T x, T y) { return !(x < y) ? x : y; });
        same(real::select(a < b && a > 0, a, b), [](T x, T y) { return x < y && x > 0 ? x : y; });
        same(real::select(a < b || a > 0, a, b), [](T x, T y) { return x < y || x > 0 ? x : y; });
        same(lumis::density_or_zero(a), [](T x, T) { return lumis::density_or_zero(x); });
    }
}

TEMPLATE_TEST_CASE("a condition on lanes", "[lanes]", lumis::NativeLanes<float>, lumis::NativeLanes<double>,
                   (lumis::Lanes<float, 2>), (lumis::Lanes<float, 32>), (lumis::Lanes<double, 16>)) {
    using L = TestType;
    using Mask = typename L::Mask;
    using T = typename L::Lane;
    CHECK(Mask{true}.all());
    CHECK_FALSE(Mask{false}.all());
    CHECK(Mask{true}.any());
    CHECK_FALSE(Mask{false}.any());
    for (std::size_t i = 0; i < L::size; ++i) {
        L lanes = T(1);
        CHECK(lumis::real::all(lanes > 0));
        lanes.set(i, T(-1));
        CHECK_FALSE(lumis::real::all(lanes > 0));
        lanes.set(i, std::numeric_limits<T>::quiet_NaN());
        CHECK_FALSE(lumis::real::all(lanes > 0));
        CHECK_FALSE(lumis::real::any(lanes < 0));
        lanes.set(i, T(-1));
        CHECK(lumis::real::any(lanes < 0));
        CHECK_FALSE(lumis::real::any(lanes == 0));
    }
}

TEMPLATE_TEST_CASE("lanes are converted as their numbers", "[lanes]", lumis::NativeLanes<float>,
                   lumis::NativeLanes<double>, (lumis::Lanes<float, 1>), (lumis::Lanes<float, 2>),
                   (lumis::Lanes<float, 8>), (lumis::Lanes<float, 32>), (lumis::Lanes<double, 16>)) {
    using T = typename TestType::Lane;
    using U = std::conditional_t<sizeof(T) == 4, double, float>;
    using Other = typename TestType::template Of<U>;
    for (std::size_t shift = 0; shift < 9; ++shift) {
        const auto a = mixed<TestType>(shift) / TestType{T(3)};
        const Other converted{a};
        for (std::size_t i = 0; i < a.size; ++i) CHECK(same_bits(converted[i], static_cast<U>(a[i])));
    }
}

TEMPLATE_TEST_CASE("the sign of zero is kept", "[lanes]", lumis::NativeLanes<float>, lumis::NativeLanes<double>) {
    using L = TestType;
    using T = typename L::Lane;
    for (const T lane : numbers_of(L{T(-0.0)})) CHECK(std::signbit(lane));
}

TEMPLATE_TEST_CASE("lanes are numbers to GLM", "[lanes]", lumis::NativeLanes<float>, lumis::NativeLanes<double>) {
    using L = TestType;
    using T = typename L::Lane;
    const glm::vec<3, L> v{mixed<L>(7), T(2), T(-1)};
    const L length = glm::length(v), first = glm::normalize(v).x;
    for (std::size_t i = 0; i < L::size; ++i) {
        const glm::vec<3, T> lane{v.x[i], T(2), T(-1)};
        CHECK((!(glm::length(lane) >= 0) || length[i] == Approx(glm::length(lane))));
        CHECK((!(glm::normalize(lane).x >= 0) || first[i] == Approx(glm::normalize(lane).x)));
    }
}
