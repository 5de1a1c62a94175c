// Directions from versines and turns, and latitude-longitude coordinates: relative accuracy down to the poles, and the ends
// of their ranges.
#include "catch.hpp"
#include <lumis/core/latlong.hpp>
#include <lumis/core/spherical.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

using Wide = long double;

template <class T>
constexpr Wide epsilon = std::numeric_limits<T>::epsilon();

Wide relative_error(Wide value, Wide exact) {
    return value == exact ? 0 : std::abs(value - exact) / std::abs(exact);
}

// Polar angles from near the pole to near the other one, evenly in their logarithms from both sides.
template <class Visit>
void for_each_angle(Visit visit) {
    for (int i = 0; i <= 200; ++i) {
        const Wide angle = std::numbers::pi_v<Wide> / 2 * std::pow(Wide{10}, -Wide(i) / 10);
        visit(angle);
        if (i < 60) visit(std::numbers::pi_v<Wide> - angle);
    }
}

}  // namespace

TEMPLATE_TEST_CASE("versines keep their digits at the pole", "[spherical]", float, double) {
    using T = TestType;
    Wide worst_sine = 0, worst_versine = 0, worst_direction = 0;
    for_each_angle([&](Wide angle) {
        const auto versine = static_cast<T>(2 * std::sin(angle / 2) * std::sin(angle / 2));
        if (versine < std::numeric_limits<T>::min() || versine > 2) return;
        const Wide sine = std::sqrt(Wide{versine} * (2 - Wide{versine}));
        // Beyond the equator 2 - versine has lost what the versine's rounding took.
        worst_sine = std::max(worst_sine, relative_error(lumis::sine_of_versine(versine), sine));
        for (const T turn : {T(0), T(0.1), T(0.25), T(0.4), T(0.7), T(0.999)}) {
            const Wide phi = 2 * std::numbers::pi_v<Wide> * turn;
            const auto w = lumis::direction_at(versine, turn);
            worst_direction = std::max({worst_direction, std::abs(w.x - sine * std::cos(phi)) / sine,
                                        std::abs(w.y - sine * std::sin(phi)) / sine});
            CHECK(std::abs(w.z - (1 - Wide{versine})) <= epsilon<T> / 2);
            CHECK(std::abs(std::hypot(Wide{w.x}, Wide{w.y}, Wide{w.z}) - 1) <= 3 * epsilon<T>);
            // From the pole to just beyond the equator, of x and y as they are rounded.
            if (versine <= 1) {
                const Wide x = w.x, y = w.y,
                           own = (x * x + y * y) / (1 + std::sqrt(1 - std::min(x * x + y * y, Wide{1})));
                if (angle < 1) worst_versine = std::max(worst_versine, relative_error(lumis::versine_of(w), own));
                CHECK(relative_error(lumis::versine_of(w), versine) <= 8 * epsilon<T>);
            } else {
                CHECK(std::abs(lumis::versine_of(w) - Wide{versine}) <= 2 * epsilon<T>);
            }
        }
    });
    INFO(worst_sine / epsilon<T> << ", " << worst_direction / epsilon<T> << ", " << worst_versine / epsilon<T>);
    CHECK(worst_sine <= 2 * epsilon<T>);
    CHECK(worst_direction <= 4 * epsilon<T>);
    CHECK(worst_versine <= 4 * epsilon<T>);
    CHECK(lumis::versine_of(lumis::Direction<T>{T(0), T(0), T(1)}) == 0);
    CHECK(lumis::versine_of(lumis::Direction<T>{T(0), T(0), T(-1)}) == 2);
    CHECK(lumis::versine_of(lumis::Direction<T>{T(1), T(0), T(0)}) == 1);
    CHECK(lumis::sine_of_versine(T(0)) == 0);
    CHECK(lumis::sine_of_versine(T(2)) == 0);
    CHECK(lumis::sine_of_versine(T(1)) == 1);
}

TEMPLATE_TEST_CASE("coordinates of a direction, from pole to pole", "[spherical]", float, double) {
    using T = TestType;
    constexpr Wide pi = std::numbers::pi_v<Wide>;
    Wide worst_u = 0, worst_v = 0;
    for_each_angle([&](Wide angle) {
        for (int i = 0; i < 64; ++i) {
            const Wide phi = 2 * pi * (Wide(i) + Wide(0.3)) / 64 - pi;
            const lumis::Direction<T> w{static_cast<T>(std::sin(angle) * std::cos(phi)),
                                        static_cast<T>(std::cos(angle)),
                                        static_cast<T>(std::sin(angle) * std::sin(phi))};
            const Wide ring = std::hypot(Wide{w.x}, Wide{w.z});
            const auto uv = lumis::latlong_from_direction(w);
            worst_u = std::max(worst_u, std::abs(uv.x - (Wide(0.5) + std::atan2(Wide{w.z}, Wide{w.x}) / (2 * pi))));
            // Squares of the components must be in range.
            if (ring * ring / 64 > std::numeric_limits<T>::min()) {
                worst_v = std::max(worst_v, relative_error(uv.y, std::atan2(ring, Wide{w.y}) / pi));
            }
            CHECK((uv.x >= 0 && uv.x < 1 && uv.y >= 0 && uv.y <= 1));

            const T versine = lumis::versine_of(lumis::Direction<T>{w.x, w.z, std::abs(w.y)});
            const auto back = lumis::direction_from_latlong(uv.x, versine, w.y < 0 ? T(-1) : T(1));
            for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(Wide{back[axis]} - Wide{w[axis]}) <= 8 * epsilon<T>);
        }
    });
    INFO(worst_u / epsilon<T> << ", " << worst_v / epsilon<T>);
    CHECK(worst_u <= epsilon<T>);
    CHECK(worst_v <= 4 * epsilon<T>);
}

TEMPLATE_TEST_CASE("coordinates at the seam, at the poles and of NaN", "[spherical]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const auto at = [](T x, T y, T z) { return lumis::latlong_from_direction(lumis::Direction<T>{x, y, z}); };
    // The seam is at -x: u counts from it, over -z, +x and +z.
    CHECK(at(T(-1), T(0), T(0)).x == 0);
    CHECK(at(T(-1), T(0), T(-0.0)).x == 0);
    CHECK(at(T(0), T(0), T(-1)).x == T(0.25));
    CHECK(at(T(1), T(0), T(0)).x == T(0.5));
    CHECK(at(T(0), T(0), T(1)).x == T(0.75));
    for (int halvings = 1; halvings < 140; ++halvings) {
        const T z = std::ldexp(T(1), -halvings);
        CHECK((at(T(-1), T(0), z).x < 1 && at(T(-1), T(0), z).x >= 0));
        CHECK(at(T(-1), T(0), -z).x <= T(0.25));
    }
    CHECK(at(T(1), T(0), T(0)).y == T(0.5));
    CHECK(at(T(0), T(1), T(0)).y == 0);
    CHECK(at(T(0), T(-1), T(0)).y == 1);
    for (const auto& uv : {at(nan, T(0), T(1)), at(T(1), T(0), nan)}) CHECK((std::isnan(uv.x) && std::isnan(uv.y)));
    CHECK(std::isnan(at(T(1), nan, T(0)).y));
    const auto pole = lumis::direction_from_latlong(T(0.3), T(0), T(-1));
    CHECK((pole.x == 0 && pole.y == -1 && pole.z == 0));
}
