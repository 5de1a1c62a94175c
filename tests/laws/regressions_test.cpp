// What the fuzzers of tests/fuzz found: each case once failed as its comment says.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace {

template <class T>
constexpr T infinity = std::numeric_limits<T>::infinity();
template <class T>
constexpr T not_a_number = std::numeric_limits<T>::quiet_NaN();

template <class T>
bool is_finite(const glm::vec<3, T>& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Draws nothing or a unit vector, and reports a density that is a number.
template <class S>
void check_draws(const S& strategy) {
    using T = typename S::Scalar;
    for (const T u : {T(0), T(0.3), T(1)}) {
        const auto sample = strategy.sample(lumis::UniformsOf<S>(u));
        CHECK(is_finite(sample.value));
        CHECK((sample.pdf >= 0 && sample.pdf <= std::numeric_limits<T>::max()));
        if (sample.pdf > 0) CHECK(std::abs(glm::length(sample.value) - 1) <= T(1e-5));
        if constexpr (requires { sample.distance; }) CHECK((sample.pdf == 0 || sample.distance >= 0));
    }
}

}  // namespace

TEMPLATE_TEST_CASE("a direction that is none is mirrored to nothing", "", float, double) {
    using T = TestType;
    // The value was NaN or infinite, for PerfectReflection and DirectionalLight with probability 1.
    for (const T bad : {not_a_number<T>, infinity<T>}) {
        const CaughtAssertions caught;
        const glm::vec<3, T> wo{bad, T(0), T(1)};
        CHECK(lumis::PerfectReflection<T>{wo}.sample({}).pdf == 0);
        CHECK(lumis::DirectionalLight<T>{wo}.sample({}).pdf == 0);
        check_draws(lumis::Reflected{wo, lumis::CosineHemisphere<T>{}});
        check_draws(lumis::GgxReflection<T>{wo, glm::vec<2, T>{T(0.5)}});
        CHECK(lumis::DirectionalLight<T>{wo}.sample({}).value == glm::vec<3, T>{T(0)});
    }
}

TEMPLATE_TEST_CASE("a frame that is none carries nothing to world space", "", float, double) {
    using T = TestType;
    const CaughtAssertions caught;
    const lumis::Frame<T> frame{
        glm::vec<3, T>{not_a_number<T>, T(0), T(1)}};  // the value was NaN, its density that of the part
    check_draws(lumis::in_frame(frame, lumis::CosineHemisphere<T>{}));
}

TEMPLATE_TEST_CASE("a density that overflows in a mixture is 0", "", float, double) {
    using T = TestType;
    // Two lights whose densities are just below the largest number: their sum was infinite.
    const T distance = 4, radius = distance / std::sqrt(std::numeric_limits<T>::max() * T(0.1));
    const lumis::AreaLight<lumis::Disk<T>> light{{{T(0), T(0), distance}, {T(0), T(0), T(1)}, radius}, {}};
    const glm::vec<3, T> up{T(0), T(0), T(1)};
    const T pdf = light.pdf(up);
    const CaughtAssertions caught;
    const lumis::Mixture mixture{lumis::choose(1, light), lumis::choose(infinity<T>, light)};
    CHECK(std::isfinite(pdf));
    CHECK(std::isfinite(mixture.pdf(up)));
}

TEMPLATE_TEST_CASE("a point light nearer or farther than can be squared draws nothing", "", float, double) {
    using T = TestType;
    // The length had lost its digits in the square, and the direction was not of unit length.
    const T tiny = std::sqrt(std::numeric_limits<T>::min()) / 10, huge = std::sqrt(std::numeric_limits<T>::max()) * 2;
    for (const T distance : {tiny, huge}) {
        CHECK(lumis::PointLight<T>{{T(0), distance, distance}, glm::vec<3, T>{T(0)}}.sample({}).pdf == 0);
    }
    check_draws(lumis::PointLight<T>{{T(0), T(0), tiny * 20}, glm::vec<3, T>{T(0)}});
}

TEMPLATE_TEST_CASE("a light seen from all but its vertex draws nothing or a direction", "", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    // In units of the longest edge the squares of the corner underflowed: directions of length 0.94 to 1.08, or NaN, and
    // distances that were not positive.
    const T edge = std::sqrt(std::numeric_limits<T>::max()) * T(1e-2);
    const V corner{T(1e-5), T(2e-6), T(3e-6)}, edge_u{T(0), T(0.02), T(0.1)}, edge_v{T(1e-3), edge, T(0)};
    const V nowhere{T(0)};
    check_draws(lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>{{corner, edge_u, edge_v}, nowhere});
    check_draws(lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle>{{corner, edge_u, edge_v}, nowhere});
    // A strip from far ahead to far behind: the direction was off by 2e-5 in length.
    const lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle> strip{
        {{T(-0.83594), T(-2.47929e10), T(-2.47929e10)},
         {T(-2.46971e10), T(-1), T(-0.00778281)},
         {T(3.26082e10), T(0.948043), T(0.0073961)}},
        {T(0.00741421), T(0.941207), T(-0.00741399)}};
    check_draws(strip);
    const auto drawn = strip.sample({T(0.474518), T(0.472656)});
    CHECK((drawn.pdf == 0 || std::abs(glm::length(drawn.value) - 1) <= T(1e-5)));
    const V along{T(0), T(0), edge}, across{edge, T(0), T(0)};  // a rectangle, whose height over the point underflows
    check_draws(lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle>{{-corner, along, across}, nowhere});
}

TEMPLATE_TEST_CASE("a sphere around a point next to its centre is seen everywhere", "", float, double) {
    using T = TestType;
    // The axis of the frame, centre over distance, was not of unit length.
    const T tiny = std::sqrt(std::numeric_limits<T>::min()) / 10;
    const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> light{{{tiny, tiny, tiny}, T(1)}, {}};
    check_draws(light);
    CHECK(std::abs(light.solid_angle() - 4 * std::numbers::pi_v<T>) <= T(1e-5));
    check_draws(lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{{{tiny, tiny, tiny}, tiny / 2}, {}});
}

TEMPLATE_TEST_CASE("GGX draws nothing for a vector too long or short to be a direction", "", float, double) {
    using T = TestType;
    // The value was infinite or NaN: mirroring overflows, the length of the stretched vector underflows.
    const CaughtAssertions caught;
    const T huge = std::numeric_limits<T>::max(), tiny = 2 * std::sqrt(std::numeric_limits<T>::min());
    check_draws(lumis::GgxVndf<T>{{tiny, 0, tiny * tiny}, {T(1e-4), T(1e-4)}});
    for (const glm::vec<3, T>& wo : {glm::vec<3, T>{0, 0, huge}, {huge, 0, huge}, {huge, huge, T(1)}}) {
        for (const T alpha : {T(1e-4), T(0.3), T(1), T(1e4)}) {
            check_draws(lumis::GgxVndf<T>{wo, {alpha, alpha}});
            check_draws(lumis::GgxReflection<T>{wo, {alpha, alpha}});
            check_draws(lumis::GgxBoundedReflection<T>{wo, {alpha, alpha}});
            check_draws(lumis::Reflected<lumis::GgxNdf<T>>{wo, lumis::GgxNdf<T>{{alpha, alpha}}});
        }
    }
}

TEST_CASE("a sliver as wide as its rounding is drawn by unit vectors or not at all", "") {
    // Its length was 0.985, its density 2e16.
    const double far = -88305875091456;
    const lumis::Parallelogram<double> sliver{{0.64773284271359444, 0.64313844684511423, 0.64313725475221872},
                                              {0.64313725475221872, -0.62745102401822805, far},
                                              {far, far, far}};
    check_draws(lumis::AreaLight<lumis::Parallelogram<double>, lumis::BySolidAngle>{sliver, {far, far, far}});
}

TEMPLATE_TEST_CASE("a power that vanishes gives a technique without density no share", "", float, double) {
    using T = TestType;
    const CaughtAssertions caught;  // of an exponent below 1
    const std::vector<T> densities{T(2), T(0), T(3)};
    T sum = 0;  // was 2/3: pow(0, 0) is 1
    for (std::size_t i = 0; i < 3; ++i) {
        sum += lumis::mis_weight(lumis::PowerHeuristic{1e-320}, i, std::span<const T>{densities});
    }
    CHECK(std::abs(sum - 1) <= T(1e-5));
}

TEMPLATE_TEST_CASE("tables find a cell for any number", "", float, double) {
    using T = TestType;
    // The cast of such a number to an index was undefined behaviour.
    for (const T x : {not_a_number<T>, infinity<T>, -infinity<T>, T(-1), std::numeric_limits<T>::max()}) {
        CHECK(lumis::detail::index_of(x, 5) == (x > 0 ? 4 : 0));
        const lumis::PiecewiseConstant1D table{std::vector<T>{1, 2}};
        (void)table.invert(x);
    }
}

// The row's sum of weights, times its extent of 2, was infinite, and the map was refused for too many dim texels.
TEMPLATE_TEST_CASE("a map of one row is as bright as numbers go", "", float, double) {
    using T = TestType;
    using Limits = std::numeric_limits<T>;
    const std::array texels{Limits::denorm_min(), Limits::min(), Limits::max()};
    const lumis::EnvironmentMap<T> map{3, 1, texels};
    const auto sample = map.sample({T(0.9), T(0.5)});
    CHECK(sample.pdf > 0);
    CHECK(sample.pdf == map.pdf(sample.value));
}
