// Points of surfaces, and rays that leave them: laws, the power that is emitted, form factors, and light tracing against
// lights that are sampled from the receiver.
#include "catch.hpp"
#include "irradiance.hpp"
#include "light_shapes.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/laws.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <tuple>
#include <type_traits>

namespace {

namespace laws = lumis::testing;
using V = glm::dvec3;

void check(const laws::LawResult& law) {
    INFO(law.message);
    CHECK(law.passed);
}

template <class Visit>
void for_each_shape(Visit visit) {
    std::apply([&](const auto&... shape) { (visit(shape), ...); }, shapes::each<float>({0.5, -1, 2}, 1));
    std::apply([&](const auto&... shape) { (visit(shape), ...); }, shapes::each<double>({0.5, -1, 2}, 1));
}

// Whether a ray meets the square of side 1 at z = 1 with the corner (x, y).
bool meets_square(const V& start, const V& w, double x, double y) {
    const double t = (1 - start.z) / w.z;
    const double a = start.x + t * w.x - x, b = start.y + t * w.y - y;
    return t > 0 && a > 0 && a < 1 && b > 0 && b < 1;
}

}  // namespace

TEST_CASE("points drawn of surfaces", "[surface_area]") {
    for_each_shape([](const auto& shape) {
        using T = typename std::remove_cvref_t<decltype(shape)>::Scalar;
        const lumis::SurfaceArea area{shape};
        using Area = std::remove_const_t<decltype(area)>;
        STATIC_REQUIRE(lumis::InvertibleStrategy<Area>);
        STATIC_REQUIRE(std::same_as<typename Area::Measure, lumis::measure::Area>);
        CHECK(area.area() == Approx(lumis::AreaLight{shape, glm::vec<3, T>{T(3), T(4), T(9)}}.area()));
        check(laws::agreement(area));
        auto uniforms = irradiance::uniforms<T>(1);
        constexpr int samples = 20'000, cells = 4;
        int counts[cells][cells] = {};
        double worst = 0;
        for (int i = 0; i < samples; ++i) {
            const auto u = uniforms.template next<2>();
            const auto s = area.sample(u);
            const auto back = area.invert(s.value);
            const double turn = std::abs(double{back.y} - double{u.y});  // in parts of a turn, on disks and spheres
            worst = std::fmax(worst, std::fmax(std::abs(double{back.x} - double{u.x}),
                                               u.x > T(0.01) && u.x < T(0.99) ? std::fmin(turn, 1 - turn) : 0));
            REQUIRE(s.value == s.surface.position);
            const glm::dvec2 uv{s.surface.uv};
            REQUIRE(glm::length(V{s.value} - shapes::position(shape, uv)) <= 1e-5);
            REQUIRE(glm::length(V{area.normal_at(s.value)} - shapes::normal(shape, uv)) <= 1e-2);
            ++counts[std::min(int(back.x * cells), cells - 1)][std::min(int(back.y * cells), cells - 1)];
            // Off the surface there is nothing.
            const auto off = shapes::point<T>(V{s.value} + 1e-3 * shapes::normal(shape, uv));
            REQUIRE(area.pdf(off) == 0);
        }
        CHECK(worst <= 4000 * double{std::numeric_limits<T>::epsilon()});
        for (const auto& row : counts) {
            for (const int count : row) CHECK(std::abs(count - samples / 16.0) <= 5 * std::sqrt(samples / 16.0));
        }
    });
}

// Where coordinates are large, a rounded position is still found on the surface, and one well off it is not.
TEMPLATE_TEST_CASE("positions far from the origin lie on their surface", "[surface_area]", float, double) {
    using T = TestType;
    for (const double far : {1e3, 1e6}) {
        std::apply(
            [&](const auto&... shape) {
                const auto one = [&](const auto& s) {
                    const lumis::SurfaceArea area{s};
                    auto uniforms = irradiance::uniforms<T>(2);
                    for (int i = 0; i < 300; ++i) {
                        const auto drawn = area.sample(uniforms.template next<2>());
                        REQUIRE(drawn.pdf > 0);
                        REQUIRE(area.pdf(drawn.value) == drawn.pdf);
                    }
                    CHECK(area.pdf(shapes::point<T>(far * V{1, -1, 1.1})) == 0);
                };
                (one(shape), ...);
            },
            shapes::each<T>(far * V{1, -1, 1}, 1));
    }
}

TEMPLATE_TEST_CASE("surfaces in lanes, and none", "[surface_area]", float, double) {
    using T = TestType;
    using L = lumis::Lanes<T, 4>;
    const auto all = shapes::each<T>({0.5, -1, 2}, 1);
    const lumis::SurfaceArea area{std::get<2>(all)};
    const auto drawn = area.sample(glm::vec<2, L>{L(T(0.25)), L(T(0.75))});
    const auto expected = area.sample({T(0.25), T(0.75)});
    CHECK(glm::length(V{lumis::detail::lane_of(drawn.value, 2)} - V{expected.value}) <= 1e-6);
    CHECK(drawn.pdf[1] == expected.pdf);
    CHECK(area.pdf(drawn.value)[3] == expected.pdf);
    const lumis::SurfaceEmission emission{std::get<4>(all)};
    const auto rays = lumis::detail::sample_in<L>(emission, glm::vec<4, L>{L(T(0.2)), L(T(0.3)), L(T(0.4)), L(T(0.6))});
    CHECK(rays.pdf[2] == emission.sample({T(0.2), T(0.3), T(0.4), T(0.6)}).pdf);

    const glm::vec<3, T> a{T(1), T(2), T(3)};
    CHECK(lumis::SurfaceArea{lumis::Triangle<T>{a, a, a}}.sample({T(0.5), T(0.5)}).pdf == 0);
    CHECK(lumis::SurfaceArea{lumis::Sphere<T>{a, T(0)}}.sample({T(0.5), T(0.5)}).pdf == 0);
    CHECK(lumis::SurfaceArea{lumis::Disk<T>{a, a, T(-1)}}.sample({T(0.5), T(0.5)}).pdf == 0);
    CHECK(lumis::SurfaceEmission{lumis::Triangle<T>{a, a, a}}.sample({T(0.5), T(0.5), T(0.5), T(0.5)}).pdf == 0);
}

// The integral of radiance times cosine over all rays is pi A L, and every estimate of it is exact; a uniform density of
// directions has the same integral.
TEST_CASE("emitted power", "[surface_area]") {
    for_each_shape([](const auto& shape) {
        using T = typename std::remove_cvref_t<decltype(shape)>::Scalar;
        for (const auto sides : {lumis::Sides::One, lumis::Sides::Both}) {
            const lumis::SurfaceEmission emission{shape, sides};
            STATIC_REQUIRE(lumis::Strategy<std::remove_const_t<decltype(emission)>>);
            const double area = emission.area().area();
            const double power = std::numbers::pi * area * (sides == lumis::Sides::One ? 1 : 2);
            CHECK(double{emission.power()} == Approx(power));
            auto uniforms = irradiance::uniforms<T>(3);
            int front = 0;
            double integral = 0;
            for (int i = 0; i < 4000; ++i) {
                const auto s = emission.sample(uniforms.template next<4>());
                const double cosine = glm::dot(V{s.surface.normal}, V{s.value.direction});
                REQUIRE((s.pdf > 0 && emission.pdf(s.value) == Approx(s.pdf).epsilon(1e-3).margin(1e-5)));
                REQUIRE(std::abs(cosine) / double{s.pdf} == Approx(power).epsilon(1e-3));
                front += cosine > 0;
                // Uniform directions about the point.
                const auto w = lumis::UniformSphere<T>{}.sample(uniforms.template next<2>());
                integral += double{emission.pdf({s.value.position, w.value})} * area / double{w.pdf};
            }
            CHECK(integral / 4000 == Approx(1).epsilon(0.08));
            if (sides == lumis::Sides::One) CHECK(front == 4000);
            if (sides == lumis::Sides::Both) CHECK(std::abs(front - 2000) <= 5 * std::sqrt(1000));
        }
    });
}

// Two parallel squares of side 1, 1 apart: 0.19982 (Hottel). And the mean irradiance of one from the other, by light that
// leaves it and by light that is looked for.
TEMPLATE_TEST_CASE("form factor of two squares, by light tracing and by area lights", "[surface_area]", float, double) {
    using T = TestType;
    const double form_factor = 0.199824895698;
    const glm::vec<3, T> o{T(0), T(0), T(0)}, x{T(1), T(0), T(0)}, y{T(0), T(1), T(0)}, z{T(0), T(0), T(1)};
    const lumis::Parallelogram<T> lamp{o, x, y}, floor{z, x, y};
    const lumis::SurfaceEmission emission{lamp, lumis::Sides::One};
    const lumis::SurfaceArea receiver{floor};
    auto uniforms = irradiance::uniforms<T>(4);
    const auto traced = [&] {
        const auto s = emission.sample(uniforms.template next<4>());
        const double cosine = glm::dot(V{s.surface.normal}, V{s.value.direction});
        return meets_square(V{s.value.position}, V{s.value.direction}, 0, 0) ? cosine / double{s.pdf} : 0.0;
    };
    const auto lit = [&] {
        const auto at = receiver.sample(uniforms.template next<2>());
        const lumis::AreaLight light{lamp, at.value, lumis::Sides::One};
        const auto s = light.sample(uniforms.template next<2>());
        return s.pdf > 0 ? std::abs(double{s.value.z}) / double{s.pdf} / double{at.pdf} : 0.0;
    };
    laws::UnbiasedOptions options;
    options.samples = 100'000;
    options.significance = irradiance::significance;
    options.answer_error = 1e-6;
    const double answer = std::numbers::pi * form_factor;
    check(laws::unbiased(traced, answer, options));
    check(laws::unbiased(lit, answer, options));
}
