// The density of a hit, without a light and of a set: what the light itself says, from near by to far away and from behind.
#include "catch.hpp"
#include "irradiance.hpp"
#include "light_shapes.hpp"
#include <lumis/lumis.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <typeinfo>
#include <vector>

namespace {

template <class T>
inline constexpr double ulp = std::numeric_limits<T>::epsilon();

// Against the light, in units in the last place; both 0 is right, one of them alone is not.
template <class Sampling, class Shape, class T>
double error(const Shape& shape, const glm::vec<3, T>& from, T distance, T cosine, lumis::Sides sides) {
    const double light = lumis::AreaLight<Shape, Sampling>{shape, from, sides}.pdf_from_hit(distance, cosine);
    const double alone = lumis::pdf_from_hit<Sampling>(shape, from, distance, cosine, sides);
    return light == alone ? 0 : std::abs(alone / light - 1) / ulp<T>;
}

}  // namespace

TEMPLATE_TEST_CASE("the density of a hit is that of the light", "[pdf_from_hit]", float, double) {
    using T = TestType;
    for (const double size : {1.0, 1e-3}) {
        shapes::for_each_light<T>({0.5, -1, 2}, size, [&](const auto& shape, auto sampling) {
            using Sampling = decltype(sampling);
            auto uniforms = irradiance::uniforms<double>(1);
            double worst = 0;
            int hidden = 0, drawn = 0;
            for (int i = 0; i < 2000; ++i) {
                const auto u = uniforms.template next<4>();
                // From a millionth of the size to a million of it away from a point of the shape.
                const glm::dvec3 at = shapes::position(shape, {0.5 * u.x, 0.5 * u.y});
                const auto w = lumis::UniformSphere<double>{}.sample({u.z, u.w}).value;
                const auto from = shapes::point<T>(at + size * std::pow(10.0, 12 * u.x - 6) * w);
                const T distance = static_cast<T>(size * std::pow(10.0, 4 * u.y - 2)),
                        cosine = static_cast<T>(u.w - 0.5);
                // In double a grazing view costs the digits of the height: rounded corners alone move it.
                const glm::dvec3 to_shape = glm::dvec3{from} - at;
                const double height = std::abs(glm::dot(to_shape, shapes::normal(shape, {0.5 * u.x, 0.5 * u.y})));
                const double grazing = std::is_same_v<T, double> ? 4 * glm::length(to_shape) / height : 0;
                for (const auto sides : {lumis::Sides::Both, lumis::Sides::One}) {
                    const double off = error<Sampling>(shape, from, distance, cosine, sides);
                    worst = std::fmax(worst, off / (16 + grazing));
                }
                drawn += lumis::pdf_from_hit<Sampling>(shape, from, distance, cosine) > 0;
                hidden += lumis::pdf_from_hit<Sampling>(shape, from, distance, cosine, lumis::Sides::One) == 0;
            }
            INFO("size " << size << ", " << typeid(shape).name() << ", " << typeid(sampling).name());
            CHECK(worst <= 1);
            CHECK(drawn > 1500);
            CHECK(hidden > 300);
        });
    }
}

TEMPLATE_TEST_CASE("no hit on a light that is none", "[pdf_from_hit]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const T one{1};
    const V a{T(0), T(0), T(1)}, b{T(1), T(0), T(1)}, c{T(0), T(1), T(1)}, o{T(0), T(0), T(0)};
    const auto is_none = [&](const auto& shape, const V& from) {
        using S = std::remove_cvref_t<decltype(shape)>;
        CHECK(lumis::pdf_from_hit<lumis::BySolidAngle>(shape, from, one, one) == 0);
        if (lumis::AreaLight<S>{shape, from}.area() == 0) CHECK(lumis::pdf_from_hit(shape, from, one, one) == 0);
    };
    is_none(lumis::Triangle<T>{a, b, b}, o);
    is_none(lumis::Triangle<T>{a, b, b + (b - a)}, o);
    is_none(lumis::Triangle<T>{a, b, c}, a);                         // at a vertex
    is_none(lumis::Triangle<T>{a, b, c}, {T(3), T(4), T(1)});        // edge-on
    is_none(lumis::Triangle<T>{a, b, c}, {T(0.25), T(0.25), T(1)});  // on it
    is_none(lumis::Parallelogram<T>{a, b - a, b - a}, o);
    is_none(lumis::Parallelogram<T>{a, b - a, c - a}, a);
    is_none(lumis::Parallelogram<T>{a, b - a, c - a}, {T(3), T(4), T(1)});
    is_none(lumis::Sphere<T>{a, T(0)}, o);
    is_none(lumis::Sphere<T>{a, T(1)}, o);  // touches
    is_none(lumis::Sphere<T>{o, T(0)}, o);
    CHECK(lumis::pdf_from_hit(lumis::Triangle<T>{a, b, c}, o, one, T(0)) == 0);
    CHECK(lumis::pdf_from_hit(lumis::Triangle<T>{a, b, c}, o, T(0), one) == 0);
    CHECK(lumis::pdf_from_hit<lumis::BySolidAngle>(lumis::Sphere<T>{o, one}, o, one, one, lumis::Sides::One) == 0);
}

// Edges of 1e-150 to 1e150 stay in range in double.
TEST_CASE("the density of a hit at any scale", "[pdf_from_hit]") {
    for (int exponent = -150; exponent <= 150; exponent += 10) {
        const double scale = std::pow(10.0, exponent);
        shapes::for_each_light<double>(scale * glm::dvec3{0.5, -1, 2}, scale, [&](const auto& shape, auto sampling) {
            using Sampling = decltype(sampling);
            const glm::dvec3 from = scale * glm::dvec3{0.1, 0.1, -0.2};
            INFO("1e" << exponent << ", " << typeid(shape).name());
            CHECK(error<Sampling>(shape, from, 2 * scale, 0.5, lumis::Sides::Both) <= 16);
        });
    }
}

TEMPLATE_TEST_CASE("the density of a hit on a light of a set", "[pdf_from_hit]", float, double) {
    using T = TestType;
    const auto [triangle, rectangle, skew, disk, sphere] = shapes::each<T>({0.5, -1, 2}, 1);
    const glm::vec<3, T> origin{T(0), T(0), T(0)};
    const lumis::LightSet set{std::vector{lumis::AreaLight{rectangle, origin}, lumis::AreaLight{skew, origin}},
                              std::vector<T>{T(1), T(3)}};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto& shape = i == 0 ? rectangle : skew;
        const double expected = (i == 0 ? 0.25 : 0.75) * double{lumis::pdf_from_hit(shape, origin, T(2), T(0.5))};
        CHECK(double{set.pdf_of_hit(i, T(2), T(0.5))} == Approx(expected));
    }
}
