// What is deduced of what one writes: the scalar is that of the vectors, and numbers are converted to it.
#include "catch.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>

#include <concepts>

namespace {

using namespace lumis;

template <class Strategy, class T>
void same_alpha(const Strategy& one, T x, T y) {
    CHECK(one.ggx().alpha() == glm::vec<2, T>{x, y});
}

}  // namespace

TEST_CASE("roughness is a number or a vector, of the direction's scalar", "[deduction]") {
    const glm::vec3 wo{0, 0.6f, 0.8f};
    const glm::dvec3 wide{0, 0.6, 0.8};

    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wo, 0.3f}), GgxReflection<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wo, 0.3}), GgxReflection<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wo, 1}), GgxReflection<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wo, {0.3, 0.5}}), GgxReflection<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wo, {0.3f, 0.5f}}), GgxReflection<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wo, glm::vec2{0.3f}}), GgxReflection<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wide, 0.3f}), GgxReflection<double>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxVndf{wo, 0.3}), GgxVndf<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxVndf{wo, {0.3f, 0.5f}}), GgxVndf<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxBoundedReflection{wo, 0.3}), GgxBoundedReflection<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxBoundedReflection{wide, {0.3, 0.5}}), GgxBoundedReflection<double>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxNdf{0.3f}), GgxNdf<float>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxNdf{glm::vec2{0.3f, 0.5f}}), GgxNdf<float>>);
    STATIC_REQUIRE(std::same_as<decltype(Ggx{0.3f}), Ggx<float>>);
    STATIC_REQUIRE(std::same_as<decltype(Ggx{0.3}), Ggx<double>>);
    STATIC_REQUIRE(std::same_as<decltype(Ggx{glm::dvec2{0.3, 0.5}}), Ggx<double>>);

    using L = NativeLanes<float>;
    const glm::vec<3, L> wos{wo};
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wos, L{0.3f}}), GgxReflection<L>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wos, 0.3f}), GgxReflection<L>>);
    STATIC_REQUIRE(std::same_as<decltype(GgxReflection{wos, glm::vec<2, L>{L{0.3f}}}), GgxReflection<L>>);

    same_alpha(GgxReflection{wo, 0.3f}, 0.3f, 0.3f);
    same_alpha(GgxReflection{wo, 0.3}, 0.3f, 0.3f);
    same_alpha(GgxReflection{wo, {0.3f, 0.5f}}, 0.3f, 0.5f);
    same_alpha(GgxVndf{wo, 0.3}, 0.3f, 0.3f);
    same_alpha(GgxBoundedReflection{wide, 0.3}, 0.3, 0.3);
    same_alpha(GgxNdf{0.3f}, 0.3f, 0.3f);
}

TEST_CASE("a radius is of the vectors' scalar", "[deduction]") {
    const glm::vec3 p{0, 0, 2}, n{0, 0, 1};
    STATIC_REQUIRE(std::same_as<decltype(Sphere{p, 1}), Sphere<float>>);
    STATIC_REQUIRE(std::same_as<decltype(Sphere{p, 0.5}), Sphere<float>>);
    STATIC_REQUIRE(std::same_as<decltype(Sphere{p, 0.5f}), Sphere<float>>);
    STATIC_REQUIRE(std::same_as<decltype(Sphere{glm::dvec3{p}, 0.5f}), Sphere<double>>);
    STATIC_REQUIRE(std::same_as<decltype(Disk{p, n, 1}), Disk<float>>);
    STATIC_REQUIRE(std::same_as<decltype(Disk{p, n, 0.5}), Disk<float>>);
    const double radius = 0.3;
    const int two = 2;
    CHECK(Sphere{p, radius}.radius == 0.3f);
    CHECK(Disk{p, n, two}.radius == 2);
    CHECK(Disk{p, n, 1}.radius == 1);
}

TEST_CASE("a reference point may be a list", "[deduction]") {
    const Sphere sphere{glm::vec3{0, 0, 2}, 1};
    STATIC_REQUIRE(std::same_as<decltype(AreaLight{sphere, {0, 0, 0}}), AreaLight<Sphere<float>, ByArea>>);
    STATIC_REQUIRE(std::same_as<decltype(AreaLight{sphere, glm::vec3{}}), AreaLight<Sphere<float>, ByArea>>);
    CHECK(AreaLight{sphere, {0, 0, 0}}.area() == Approx(4 * 3.14159265));
    CHECK(AreaLight{Disk{glm::dvec3{0, 0, 2}, {0, 0, 1}, 1}, {0, 0, 0}}.area() == Approx(3.14159265));
}
