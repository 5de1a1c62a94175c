// The cone about +z over all half-angles: its solid angle keeps its digits, what is drawn lies in it, and cones that are none
// draw nothing.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/directions/uniform_cone.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace {

namespace laws = lumis::testing;

constexpr double pi = std::numbers::pi;

}  // namespace

TEMPLATE_TEST_CASE("a cone's density is one over its solid angle at any half-angle", "[uniform_cone]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    for (const double half_angle : {1e-9, 1e-6, 1e-4, 0.00465, 0.1, 1.0, pi / 2, 2.0, 3.1, pi}) {
        const lumis::UniformCone<T> cone{static_cast<T>(half_angle)};
        const double sine = std::sin(double{static_cast<T>(half_angle)} / 2), solid_angle = 4 * pi * sine * sine;
        INFO("half-angle " << half_angle);
        CHECK(std::abs(double{cone.solid_angle()} / solid_angle - 1) <= 8 * epsilon);
        CHECK(std::abs(double{cone.sample({T(0.3), T(0.7)}).pdf} * solid_angle - 1) <= 8 * epsilon);
    }
}

// The mean of the versine is half of the largest, and that of the cosine of irradiance sin^2(half_angle) pi over the cone's.
TEMPLATE_TEST_CASE("directions fill a cone evenly, and no more than it", "[uniform_cone]", float, double) {
    using T = TestType;
    for (const double half_angle : {1e-5, 0.00465, 0.7, 2.5}) {
        const lumis::UniformCone<T> cone{static_cast<T>(half_angle)};
        INFO("half-angle " << half_angle);
        const double sine = std::sin(half_angle / 2), largest = 2 * sine * sine;
        double sum = 0, beyond = 0;
        constexpr int n = 64;
        for (int i = 0; i < n * n; ++i) {
            const glm::vec<2, T> u{(static_cast<T>(i % n) + T(0.5)) / T(n), (static_cast<T>(i / n) + T(0.5)) / T(n)};
            const auto drawn = cone.sample(u);
            const double versine = double{lumis::versine_of(drawn.value)} / largest;
            sum += versine;
            beyond = std::fmax(beyond, versine);
            CHECK(cone.pdf(drawn.value) == drawn.pdf);
        }
        CHECK(std::abs(sum / n / n - 0.5) <= 1e-5);
        CHECK(beyond <= 1);
        const auto at = [](double angle) {
            return lumis::Direction<T>(glm::dvec3{std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle)});
        };
        CHECK(cone.pdf(at(half_angle * 0.9)) > 0);
        CHECK(cone.pdf(at(half_angle * 1.1)) == 0);
    }
}

TEMPLATE_TEST_CASE("cones that are none, and one of all directions", "[uniform_cone]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const CaughtAssertions caught;  // of NaN
    for (const T half_angle : {T(0), T(-0.1), nan, (std::numeric_limits<T>::min)()}) {
        const auto law = laws::draws_nothing(lumis::UniformCone<T>{half_angle});
        INFO(half_angle << ": " << law.message);
        CHECK(law.passed);
    }
    for (const T half_angle : {T(4), inf}) {
        const lumis::UniformCone<T> all{half_angle};
        CHECK(all.pdf({T(0), T(0), T(-1)}) == Approx(1 / (4 * pi)));
        const auto law = laws::stays_finite(all);
        INFO(half_angle << ": " << law.message);
        CHECK(law.passed);
    }
}
