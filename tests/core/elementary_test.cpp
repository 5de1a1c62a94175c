// The worst errors that core/elementary.hpp states, over all 2^24 float uniforms and dense sweeps.
#include "catch.hpp"
#include <lumis/core/elementary.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

namespace {

// What the references are computed in.
using Wide = long double;
constexpr Wide tau = 2 * std::numbers::pi_v<Wide>;

template <class T>
constexpr Wide epsilon = std::numeric_limits<T>::epsilon();

// The largest error seen, in epsilons; a NaN stays.
class Worst {
  public:
    void absolute(Wide value, Wide exact, Wide unit) { add(std::abs(value - exact) / unit); }
    void relative(Wide value, Wide exact, Wide unit) {
        add(value == exact ? 0 : std::abs(value - exact) / std::abs(exact) / unit);
    }
    [[nodiscard]] bool within(double bound) const { return error_ <= static_cast<Wide>(bound); }
    [[nodiscard]] double value() const { return static_cast<double>(error_); }

  private:
    void add(Wide error) {
        if (!(error <= error_)) error_ = error;
    }
    Wide error_ = 0;
};

// Numbers of all magnitudes from 2^-decades to 1, of both signs.
template <class T>
class Numbers {
  public:
    T operator()(int halvings) {
        const T number = std::ldexp(static_cast<T>((engine_() >> 11) + 1) / T(std::uint64_t{1} << 53),
                                    -static_cast<int>(engine_() % static_cast<unsigned>(halvings)));
        return engine_() % 2 == 0 ? number : -number;
    }

  private:
    std::mt19937_64 engine_{1};
};

constexpr int sweep = 1'000'000;

}  // namespace

TEST_CASE("unit_circle at every float uniform", "[elementary]") {
    Worst error;
    const double two_pi = 2 * std::numbers::pi;
    for (std::uint32_t k = 0; k <= 1u << 24; ++k) {
        const float u = static_cast<float>(k) / static_cast<float>(1 << 24);
        const auto circle = lumis::unit_circle(u);
        error.absolute(circle.x, std::cos(two_pi * u), epsilon<float>);
        error.absolute(circle.y, std::sin(two_pi * u), epsilon<float>);
    }
    INFO(error.value());
    CHECK(error.within(1.75));
}

TEMPLATE_TEST_CASE("unit_circle between the uniforms of a float", "[elementary]", float, double) {
    Worst error;
    Numbers<TestType> numbers;
    for (int i = 0; i < sweep; ++i) {
        const TestType turn = std::abs(numbers(60));
        const auto circle = lumis::unit_circle(turn);
        error.absolute(circle.x, std::cos(tau * turn), epsilon<TestType>);
        error.absolute(circle.y, std::sin(tau * turn), epsilon<TestType>);
    }
    INFO(error.value());
    CHECK(error.within(1.75));
}

TEMPLATE_TEST_CASE("half_circle keeps the relative accuracy of small sines and cosines", "[elementary]", float,
                   double) {
    using T = TestType;
    Worst sine, cosine;
    Numbers<T> numbers;
    for (int i = 0; i < sweep; ++i) {
        const T small = numbers(100) / 4;
        const auto near_x = lumis::half_circle(small);
        sine.relative(near_x.y, std::sin(tau * small), epsilon<T>);
        const T large = std::copysign(T(0.25) - std::abs(small), small);  // as it is when rounded
        const auto near_y = lumis::half_circle(large);
        cosine.relative(near_y.x, std::sin(tau * (Wide(0.25) - std::abs(Wide{large}))), epsilon<T>);
    }
    INFO(sine.value() << " and " << cosine.value());
    CHECK(sine.within(1.75));
    CHECK(cosine.within(1.75));
}

TEMPLATE_TEST_CASE("turns of vectors of any length", "[elementary]", float, double) {
    using T = TestType;
    Worst turn, radians;
    Numbers<T> numbers;
    for (int i = 0; i < sweep; ++i) {
        const T x = numbers(40), y = numbers(40);
        const Wide exact = std::atan2(Wide{y}, Wide{x});
        turn.relative(lumis::signed_turn_of(x, y), exact / tau, epsilon<T>);
        radians.relative(lumis::real::atan2(y, x), exact, epsilon<T>);
    }
    INFO(turn.value() << " and " << radians.value());
    CHECK(turn.within(2.25));
    CHECK(radians.within(2.75));
}

TEMPLATE_TEST_CASE("arc cosines", "[elementary]", float, double) {
    using T = TestType;
    Worst error;
    Numbers<T> numbers;
    for (int i = 0; i < sweep; ++i) {
        const T near_zero = numbers(60);
        error.relative(lumis::real::acos(near_zero), std::acos(Wide{near_zero}), epsilon<T>);
        const T near_one = 1 - std::abs(numbers(60));
        error.relative(lumis::real::acos(near_one), std::acos(Wide{near_one}), epsilon<T>);
        error.relative(lumis::real::acos(-near_one), std::acos(-Wide{near_one}), epsilon<T>);
    }
    INFO(error.value());
    CHECK(error.within(1.75));
    CHECK(lumis::real::acos(T(1)) == 0);
    CHECK(lumis::real::acos(T(-1)) == std::numbers::pi_v<T>);
}

TEMPLATE_TEST_CASE("turns at the axes, at the origin and of NaN", "[elementary]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), least = std::numeric_limits<T>::denorm_min();
    const auto at = [](T turn) { return lumis::unit_circle(turn); };
    CHECK(at(T(0)).x == 1);
    CHECK(at(T(0)).y == 0);
    CHECK(at(T(0.25)).x == 0);
    CHECK(at(T(0.25)).y == 1);
    CHECK(at(T(0.5)).x == -1);
    CHECK(at(T(0.5)).y == 0);
    CHECK(at(T(0.75)).x == 0);
    CHECK(at(T(0.75)).y == -1);
    CHECK(at(T(1)).x == 1);
    CHECK(at(T(1)).y == 0);
    CHECK(lumis::turn_of(T(1), T(0)) == 0);
    CHECK(lumis::turn_of(T(0), T(2)) == T(0.25));
    CHECK(lumis::turn_of(T(-3), T(0)) == T(0.5));
    CHECK(lumis::turn_of(T(0), T(-4)) == T(0.75));
    CHECK(lumis::turn_of(T(0), T(0)) == 0);
    CHECK(lumis::signed_turn_of(T(0), T(0)) == 0);  // not NaN, which turn_of makes 0
    CHECK(lumis::signed_turn_of(T(-0.0), T(0)) == T(0.5));
    CHECK(lumis::turn_of(T(1), -least) == 0);  // not 1
    const T least_normal = std::numeric_limits<T>::min();
    CHECK(std::abs(lumis::turn_of(least_normal, least_normal) - T(0.125)) <= std::numeric_limits<T>::epsilon() / 4);
    CHECK(std::isnan(lumis::signed_turn_of(nan, T(1))));
    CHECK(std::isnan(lumis::signed_turn_of(T(1), nan)));
    CHECK(std::isnan(lumis::signed_turn_of(T(0), nan)));
}

// A small negative turn, added to 1, rounds to 1 from half a unit in the last place below on.
TEMPLATE_TEST_CASE("a turn is below 1, however small a step before the whole turn", "[elementary]", float, double) {
    using T = TestType;
    const T below_one = 1 - std::numeric_limits<T>::epsilon() / 2;
    int wrapped = 0;
    for (int halvings = 1; halvings < 140; ++halvings) {
        for (const T x : {T(1), T(1.25), T(1.75)}) {
            const T y = -std::ldexp(T(1), -halvings), turn = lumis::turn_of(x, y);
            INFO(x << ", " << y);
            CHECK((turn >= 0 && turn <= below_one));
            const Wide exact = 1 + std::atan2(Wide{y}, Wide{x}) / tau;
            CHECK(std::abs(std::remainder(Wide{turn} - exact, Wide{1})) <= epsilon<T>);
            wrapped += turn == 0;
            CHECK(lumis::turn_of(-x, y) > T(0.5) - epsilon<T>);
            CHECK(lumis::turn_of(-x, -y) <= T(0.5));
        }
    }
    CHECK(wrapped > 100);
}

TEMPLATE_TEST_CASE("turn_of inverts unit_circle", "[elementary]", float, double) {
    using T = TestType;
    Worst error;
    for (int i = 0; i < sweep; ++i) {
        const T turn = static_cast<T>(i) / static_cast<T>(sweep);
        const auto circle = lumis::unit_circle(turn);
        error.absolute(lumis::turn_of(circle.x, circle.y), turn, epsilon<T>);
    }
    INFO(error.value());
    CHECK(error.within(1));
}
