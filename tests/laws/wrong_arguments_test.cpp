// What a caller gets wrong and only values can tell. It fails an assertion; and where assertions are compiled out, as good as
// here where they are counted, what is drawn stays what the density says.
#include "assertions.hpp"
#include "catch.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/agreement.hpp>
#include <lumis/testing/integration.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace laws = lumis::testing;

namespace {

template <class T>
constexpr T not_a_number = std::numeric_limits<T>::quiet_NaN();

// How many assertions fail.
int failures(const auto& make) {
    const CaughtAssertions caught;
    make();
    return caught.count();
}

// The density is that of the samples, and integrates to how often something is drawn. The laws' own false-alarm rate is 1e-6.
template <class S>
void check_consistent(const std::string& name, const S& strategy) {
    for (const auto& law : {laws::agreement(strategy), laws::integrates(strategy)}) {
        INFO(name << ": " << law.message);
        CHECK(law.passed);
    }
}

template <class T>
lumis::Direction<T> unit(double x, double y, double z) {
    return lumis::Direction<T>(glm::normalize(glm::dvec3{x, y, z}));
}

}  // namespace

TEMPLATE_TEST_CASE("frames of vectors that are not orthonormal", "[wrong_arguments]", float, double) {
    using T = TestType;
    using lumis::Frame;
    const auto n = unit<T>(1, -2, 0.5);
    const Frame<T> right{n};
    const auto t = right.tangent(), b = right.bitangent();
    const T s = T(0.01);
    // As fast reciprocal roots, half precision and products of floats leave vectors.
    for (const auto& tolerated : {n * T(1 + 3.6e-4), n * T(1 - 4.8e-4)}) {
        CHECK(failures([&] { (void)Frame<T>{tolerated}; }) == 0);
        CHECK(Frame<T>{tolerated}.normal() == tolerated);
    }
    CHECK(failures([&] { (void)Frame<T>{t + T(2e-5) * n, b, n}; }) == 0);
    CHECK(failures([&] { (void)Frame<T>{b, t, n}; }) == 0);  // left-handed, as mirrored texture coordinates make it

    const lumis::GgxReflection<T> ggx{unit<T>(0.3, 0.2, 0.9), glm::vec<2, T>{T(0.3)}};
    const auto wrong = [&](const std::string& name, const auto&... vectors) {
        CHECK(failures([&] { (void)Frame<T>{vectors...}; }) == 1);
        const CaughtAssertions caught;
        const Frame<T> frame{vectors...};
        check_consistent(name + ", cosine", lumis::in_frame(frame, lumis::CosineHemisphere<T>{}));
        check_consistent(name + ", ggx", lumis::in_frame(frame, ggx));
        CHECK(glm::length(frame.normal() - n) <= T(1e-6));
    };
    for (const T length : {T(0.95), T(1.002), T(5), T(1e-15), T(1e15)}) wrong("length", length * n);
    wrong("sheared tangent", t + s * n, b, n);
    wrong("sheared bitangent", t, b - s * n, n);
    wrong("tangents not at right angles", t, b + s * t, n);
    wrong("long tangent", t * T(1.01), b, n);
    wrong("short normal, left-handed", b, t, n * T(0.95));

    // Without a direction there is no frame, and nothing is drawn.
    for (const auto& none : {lumis::Direction<T>{T(0)}, lumis::Direction<T>{not_a_number<T>, T(0), T(1)}}) {
        CHECK(failures([&] { (void)Frame<T>{none}; }) == 1);
        CHECK(failures([&] { (void)Frame<T>{t, b, none}; }) == 1);
        const CaughtAssertions caught;
        for (const auto& frame : {Frame<T>{none}, Frame<T>{t, b, none}, Frame<T>{none, b, n}, Frame<T>{n, b, n}}) {
            const auto world = lumis::in_frame(frame, lumis::CosineHemisphere<T>{});
            CHECK(world.sample({T(0.3), T(0.4)}).pdf == 0);
            CHECK(world.pdf(n) == 0);
        }
    }
}

TEMPLATE_TEST_CASE("directions that are not unit vectors", "[wrong_arguments]", float, double) {
    using T = TestType;
    const auto wo = unit<T>(0.3, 0.2, 0.9);
    const glm::vec<2, T> alpha{T(0.3), T(0.5)};
    CHECK(failures([&] { (void)lumis::GgxReflection<T>{wo, alpha}; }) == 0);
    CHECK(failures([&] { (void)lumis::PerfectReflection<T>{wo * T(1 - 4e-4)}; }) == 0);
    for (const T length : {T(0.95), T(1.05), T(5), T(1e-3)}) {
        const auto off = length * wo;
        const std::string name = "length " + laws::detail::text(length);
        CHECK(failures([&] { (void)lumis::GgxVndf<T>{off, alpha}; }) > 0);
        CHECK(failures([&] { (void)lumis::GgxReflection<T>{off, alpha}; }) > 0);
        CHECK(failures([&] { (void)lumis::GgxBoundedReflection<T>{off, alpha}; }) > 0);
        CHECK(failures([&] { (void)lumis::Reflected{off, lumis::CosineHemisphere<T>{}}; }) > 0);
        CHECK(failures([&] { (void)lumis::PerfectReflection<T>{off}; }) > 0);
        CHECK(failures([&] { (void)lumis::DirectionalLight<T>{off}; }) > 0);
        const CaughtAssertions caught;
        check_consistent(name + ", normals", lumis::GgxVndf<T>{off, alpha});
        check_consistent(name + ", reflection", lumis::GgxReflection<T>{off, alpha});
        check_consistent(name + ", bounded", lumis::GgxBoundedReflection<T>{off, alpha});
        check_consistent(name + ", rough glass", lumis::GgxDielectric<T>{off, alpha, T(1.5)});
        check_consistent(name + ", mirrored", lumis::Reflected{off, lumis::CosineHemisphere<T>{}});
        const T tolerance = 4 * std::numeric_limits<T>::epsilon();
        CHECK(std::abs(glm::length(lumis::PerfectReflection<T>{off}.sample({}).value) - 1) <= tolerance);
        CHECK(glm::length(lumis::DirectionalLight<T>{off}.sample({}).value - wo) <= tolerance);
    }
}

TEMPLATE_TEST_CASE("NaN parameters of every strategy", "[wrong_arguments]", float, double) {
    using namespace lumis;
    using T = TestType;
    using V = glm::vec<3, T>;
    const T nan = not_a_number<T>;
    const V up{T(0), T(0), T(1)}, bad{T(0), nan, T(1)}, origin{T(0)}, x{T(1), T(0), T(0)}, y{T(0), T(1), T(0)};
    const glm::vec<2, T> alpha{T(0.3)}, bad_alpha{T(0.3), nan};
    const auto asserts = [](const std::string& name, const auto& make) {
        INFO(name);
        CHECK(failures([&] { (void)make(); }) > 0);
        const CaughtAssertions caught;
        const auto strategy = make();
        using S = std::remove_cvref_t<decltype(strategy)>;
        CHECK(strategy.sample(UniformsOf<S>(T(0.3))).pdf == 0);
        CHECK(strategy.pdf(V{T(0), T(0), T(1)}) == 0);
    };
    asserts("normals", [&] { return GgxNdf<T>{bad_alpha}; });
    asserts("visible normals", [&] { return GgxVndf<T>{up, bad_alpha}; });
    asserts("visible normals of a direction", [&] { return GgxVndf<T>{bad, alpha}; });
    asserts("reflection", [&] { return GgxReflection<T>{bad, alpha}; });
    asserts("reflection of a roughness", [&] { return GgxReflection<T>{up, bad_alpha}; });
    asserts("bounded reflection", [&] { return GgxBoundedReflection<T>{bad, alpha}; });
    asserts("bounded reflection of a roughness", [&] { return GgxBoundedReflection<T>{up, bad_alpha}; });
    asserts("reflected normals", [&] { return Reflected{bad, CosineHemisphere<T>{}}; });
    asserts("mirror", [&] { return PerfectReflection<T>{bad}; });
    asserts("rough glass", [&] { return GgxDielectric<T>{bad, alpha, T(1.5)}; });
    asserts("rough glass of a roughness", [&] { return GgxDielectric<T>{up, bad_alpha, T(1.5)}; });
    asserts("rough glass of an index", [&] { return GgxDielectric<T>{up, alpha, nan}; });
    asserts("smooth glass", [&] { return SmoothDielectric<T>{bad, 1.5}; });
    asserts("smooth glass of an index", [&] { return SmoothDielectric<T>{up, nan}; });
    asserts("sun", [&] { return DirectionalLight<T>{bad}; });
    asserts("lamp", [&] { return PointLight<T>{bad, origin}; });
    asserts("lamp from a point", [&] { return PointLight<T>{up, bad}; });
    asserts("frame", [&] { return in_frame(Frame<T>{bad}, CosineHemisphere<T>{}); });
    const auto light = [&](const std::string& name, const auto& shape, const auto& right) {
        using Shape = std::remove_cvref_t<decltype(shape)>;
        asserts(name, [&] { return AreaLight{shape, origin}; });
        asserts(name + " from a point", [&] { return AreaLight{right, bad}; });
        if constexpr (!std::is_same_v<Shape, Disk<T>>) {
            asserts(name + " by solid angle", [&] { return AreaLight<Shape, BySolidAngle>{shape, origin}; });
            asserts(name + " by solid angle from a point", [&] { return AreaLight<Shape, BySolidAngle>{right, bad}; });
        }
        CHECK(failures([&] { (void)AreaLight{right, origin}; }) == 0);
    };
    const Triangle<T> triangle{up, up + x, up + y};
    const Parallelogram<T> square{up, x, y};
    const Disk<T> disk{up, up, T(1)};
    const Sphere<T> sphere{up, T(0.5)};
    for (const auto& shape :
         {Triangle<T>{bad, up + x, up + y}, Triangle<T>{up, bad, up + y}, Triangle<T>{up, up + x, bad}})
        light("triangle", shape, triangle);
    for (const auto& shape : {Parallelogram<T>{bad, x, y}, Parallelogram<T>{up, bad, y}, Parallelogram<T>{up, x, bad}})
        light("parallelogram", shape, square);
    for (const auto& shape : {Disk<T>{bad, up, T(1)}, Disk<T>{up, bad, T(1)}, Disk<T>{up, up, nan}})
        light("disk", shape, disk);
    for (const auto& shape : {Sphere<T>{bad, T(0.5)}, Sphere<T>{up, nan}}) light("sphere", shape, sphere);
}

TEMPLATE_TEST_CASE("arguments that are right raise no floating-point exception in assertions", "[wrong_arguments]",
                   float, double) {
    using T = TestType;
    volatile T one = 1;
    const lumis::Direction<T> n{T(0), T(0), one};
    std::feclearexcept(FE_ALL_EXCEPT);
    const bool unit = lumis::detail::is_unit(n);
    const bool frame = lumis::detail::are_orthonormal(lumis::Direction<T>{one, T(0), T(0)}, {T(0), one, T(0)}, n);
    const bool nan = lumis::detail::is_nan(n) || lumis::detail::is_nan(lumis::Direction<T>{not_a_number<T>});
    CHECK(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0);
    CHECK((unit && frame && nan));
}

// Found by a fuzzer: the sum over a fan of triangles was finite, the weight between two of its corners was not.
TEST_CASE("a light by cosine with an edge and a normal beyond all numbers has densities", "[wrong_arguments]") {
    using V = glm::vec3;
    const CaughtAssertions caught;
    const lumis::AreaLight<lumis::Parallelogram<float>, lumis::ByCosine> light{
        {V(-4.65661287e-10f, -4.65661287e-10f, 0.831372559f), V(-3.01594846e-05f, 0.00781249953f, 3.40282347e+38f),
         V(-4.65661287e-10f)},
        V(-4.65661287e-10f, -4.65661287e-10f, 0.8359375f),
        V(-0.00656127976f, 8.94023106e-06f, 2.16172782e+19f)};
    for (int k = 0; k <= 1000; ++k) {
        const auto drawn = light.sample({0, static_cast<float>(k) / 1000});
        CHECK((drawn.pdf >= 0 && drawn.pdf <= std::numeric_limits<float>::max()));
        CHECK(light.pdf(drawn.value) >= 0);
    }
}
