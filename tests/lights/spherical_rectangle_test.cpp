// Rectangles by solid angle against the closed form in long double, and parallelograms, which are split.
#include "catch.hpp"
#include "polygons.hpp"
#include <lumis/lumis.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace {

using polygons::V;

template <class T>
using Light = lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle>;

template <class T>
constexpr glm::vec<3, T> origin{T(0), T(0), T(0)};

struct Rectangle {
    double x0, x1, y0, y1, z;

    template <class T>
    [[nodiscard]] lumis::Parallelogram<T> shape() const {
        return {{static_cast<T>(x0), static_cast<T>(y0), static_cast<T>(z)},
                {static_cast<T>(x1 - x0), T(0), T(0)},
                {T(0), static_cast<T>(y1 - y0), T(0)}};
    }
    [[nodiscard]] long double solid_angle() const { return polygons::rectangle_solid_angle(x0, x1, y0, y1, z); }
};

// All numbers are exact in float.
constexpr Rectangle rectangles[] = {{-1, 1, -1, 1, 1},
                                    {0, 1, 0, 1, 1},
                                    {-0.5, 2, 0.25, 3, 1},
                                    {1, 4, 2, 3, 0.125},
                                    {-64, 128, -32, 256, 0.125},
                                    {-8, 8, 0.5, 0.53125, 1},
                                    {0.5, 0.53125, -8, 8, 1},
                                    {2, 2.5, -3, -2.5, 8},
                                    {-4096, 4096, -8192, 8192, 1},
                                    {-1, 1, 1, 2, 0.0625},
                                    {0.25, 0.25 + 0x1p-13, -0.5, -0.5 + 0x1p-13, 1},
                                    {-0x1p-14, 0x1p-14, -0x1p-14, 0x1p-14, 1},
                                    {0, 0.125, 0, 0.125, 1},
                                    {3, 3 + 0x1p-10, 1, 1 + 0x1p-8, 4}};

// A parallelogram's two halves as seen from the origin.
template <class T>
glm::vec<2, long double> halves(const lumis::Parallelogram<T>& shape) {
    const V a{shape.corner}, u{shape.edge_u}, v{shape.edge_v};
    return {polygons::solid_angle(a, a + u, a + u + v), polygons::solid_angle(a, a + u + v, a + v)};
}

template <class T>
std::vector<V> corners(const lumis::Parallelogram<T>& shape) {
    const V a{shape.corner}, u{shape.edge_u}, v{shape.edge_v};
    return {a, a + u, a + u + v, a + v};
}

}  // namespace

TEMPLATE_TEST_CASE("the solid angle of rectangles is the closed form's", "[spherical_rectangle]", float, double) {
    using T = TestType;
    const double tolerance = std::is_same_v<T, float> ? 1e-5 : 1e-13;
    for (const auto& rectangle : rectangles) {
        // Long double itself keeps 11 digits of the smallest.
        const long double exact = rectangle.solid_angle();
        const Light<T> light{rectangle.shape<T>(), origin<T>};
        const auto pair = halves(rectangle.shape<T>());
        INFO(static_cast<double>(exact) << " sr");
        CHECK(static_cast<double>(std::abs((pair.x + pair.y) / exact - 1)) <= 1e-10);
        CHECK(static_cast<double>(std::abs(light.solid_angle() / (pair.x + pair.y) - 1)) <= tolerance);
        CHECK(static_cast<double>(std::abs(light.sample({T(0.3), T(0.6)}).pdf * exact - 1)) <= 1e-5);
    }
    const Light<T> gold{Rectangle{-1, 1, -1, 1, 1}.shape<T>(), origin<T>};
    CHECK(std::abs(double{gold.solid_angle()} / (4 * std::acos(0.5) / 2) - 1) <= tolerance);  // 2 pi / 3
    CHECK(Rectangle{-4096, 4096, -8192, 8192, 1}.solid_angle() > 6.28L);
}

// Their sides span nearly half a turn, as do those of the triangles that they are made of.
TEMPLATE_TEST_CASE("the solid angle of long rectangles that pass close by", "[spherical_rectangle]", float, double) {
    using T = TestType;
    std::mt19937_64 engine{1};
    std::uniform_real_distribution<double> uniform{0, 1};
    const auto power = [&](double low, double high) { return std::pow(10, low + (high - low) * uniform(engine)); };
    double worst = 0;
    for (int i = 0; i < 20'000; ++i) {
        const T width = static_cast<T>(power(0, 2)), height = static_cast<T>(power(-2, 2));
        const T x = width * static_cast<T>(uniform(engine) - 1), y = height * static_cast<T>(2 * uniform(engine) - 1.5);
        const T z = static_cast<T>(power(-3, 0));
        using Wide = long double;
        const Wide exact = polygons::rectangle_solid_angle(x, Wide{x} + width, y, Wide{y} + height, z);
        const Light<T> light{lumis::Parallelogram<T>{{x, y, z}, {width, T(0), T(0)}, {T(0), height, T(0)}}, origin<T>};
        if (!(exact > 0.02)) continue;
        worst = std::fmax(worst, std::abs(static_cast<double>(light.solid_angle() - exact)));
    }
    INFO(worst / std::numeric_limits<T>::epsilon() << " epsilon");
    CHECK(worst <= 16 * std::numeric_limits<T>::epsilon());
}

// u.x is the share of the solid angle on this side of x, u.y the share of the height's sine along the line at x; where
// the shape is split, see below.
TEMPLATE_TEST_CASE("a uniform cuts its share off a rectangle", "[spherical_rectangle]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    for (const auto& rectangle : rectangles) {
        const auto& [x0, x1, y0, y1, z] = rectangle;
        const double all = static_cast<double>(rectangle.solid_angle());
        if (all <= 2e5 * epsilon) continue;
        const Light<T> light{rectangle.shape<T>(), origin<T>};
        lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{3}};
        double worst_share = 0, worst_height = 0, worst_inside = 0, worst_return = 0;
        int unmet = 0;
        for (int i = 0; i < 1000; ++i) {
            const auto u = uniforms.template next<2>();
            const auto sample = light.sample(u);
            unmet += !(light.pdf(sample.value) > 0 && sample.distance > 0);
            const V w{sample.value};
            const long double x = w.x / w.z * z, y = w.y / w.z * z, d = std::sqrt(x * x + z * z);
            // By how much the point moves when w is rounded.
            const double blur = static_cast<double>(epsilon / (w.z * w.z) * z);
            worst_inside =
                std::fmax(worst_inside, static_cast<double>(std::max({x0 - x, x - x1, y0 - y, y - y1})) / blur);
            const double share = static_cast<double>(polygons::rectangle_solid_angle(x0, x, y0, y1, z)) / all;
            const auto sine = [d](long double at) { return at / std::sqrt(d * d + at * at); };
            const double height = static_cast<double>((sine(y) - sine(y0)) / (sine(y1) - sine(y0)));
            // The angles of small and thin rectangles keep few digits, and those of all but a hemisphere at its rim.
            const double width = std::min(
                {all, 2 * std::numbers::pi - all, 1.0, (x1 - x0) / z, static_cast<double>(sine(y1) - sine(y0))});
            worst_share = std::fmax(worst_share, std::abs(share - double{u.x}) * width / epsilon);
            worst_height = std::fmax(worst_height, std::abs(height - double{u.y}) * width / epsilon);
            const auto again = light.invert(sample.value);
            worst_return = std::fmax(worst_return, std::abs(double{again.x} - double{u.x}) * width / epsilon);
            worst_return = std::fmax(worst_return, std::abs(double{again.y} - double{u.y}) * width / epsilon);
        }
        INFO("x " << x0 << " to " << x1 << ", y " << y0 << " to " << y1 << ", z " << z << ", " << all << " sr: share "
                  << worst_share << ", height " << worst_height << ", inside " << worst_inside << ", return "
                  << worst_return << " epsilon");
        CHECK(worst_share <= 50);
        CHECK(worst_height <= 50);
        CHECK(worst_return <= 50);
        CHECK(worst_inside <= 8);
        CHECK(unmet == 0);
    }
}

// The samples of a rectangle that is turned in space lie on it, and their density is that of its solid angle.
TEMPLATE_TEST_CASE("rectangles that face anywhere", "[spherical_rectangle]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    polygons::Random random{4};
    for (int i = 0; i < 40; ++i) {
        // Edges at right angles up to rounding, from both sides.
        const lumis::Frame<double> frame{random.direction()};
        const auto shape = lumis::Parallelogram<T>{glm::vec<3, T>(frame.to_world({-1.5 + random(), random(), 1.0})),
                                                   glm::vec<3, T>(frame.tangent() * (1.5 + random())),
                                                   glm::vec<3, T>(frame.bitangent() * (i % 2 == 0 ? 1.0 : -1.0))};
        const Light<T> light{shape, origin<T>};
        const auto pair = halves(shape);
        CHECK(static_cast<double>(std::abs(light.solid_angle() / (pair.x + pair.y) - 1)) <= 100 * epsilon);
        CHECK(polygons::estimated_irradiance(light, 128) ==
              Approx(polygons::irradiance(corners(shape))).epsilon(2e-4).margin(1e-5));
        int unmet = 0;
        lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{5}};
        for (int k = 0; k < 200; ++k) unmet += !(light.pdf(light.sample(uniforms.template next<2>()).value) > 0);
        CHECK(unmet == 0);
    }
}

TEMPLATE_TEST_CASE("a parallelogram gives each of its halves its share", "[spherical_rectangle]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    polygons::Random random{6};
    for (const double size : {1e-4, 1e-2, 0.3, 2.0}) {
        for (int i = 0; i < 10; ++i) {
            const glm::dvec3 middle = random.direction();
            const glm::dvec3 u = size * random.vector(), v = size * random.vector();
            const lumis::Parallelogram<T> shape{glm::vec<3, T>(middle - (u + v) / 2.0), glm::vec<3, T>(u),
                                                glm::vec<3, T>(v)};
            const V a{shape.corner}, eu{shape.edge_u}, ev{shape.edge_v}, normal = glm::cross(eu, ev);
            if (glm::length(normal) < 0.2L * size * size) continue;
            if (std::abs(glm::dot(normal, a)) < 0.3L * glm::length(normal)) continue;
            const Light<T> light{shape, origin<T>};
            const auto pair = halves(shape);
            const double share = static_cast<double>(pair.x / (pair.x + pair.y));
            // Where in the parallelogram a uniform falls.
            const auto place = [&](double x, double y) {
                const V w{light.sample({static_cast<T>(x), static_cast<T>(y)}).value};
                const V hit = w * (glm::dot(a, normal) / glm::dot(w, normal)) - a;
                return glm::dvec2(glm::dot(glm::cross(hit, ev), normal) / glm::dot(normal, normal),
                                  glm::dot(glm::cross(eu, hit), normal) / glm::dot(normal, normal));
            };
            const double tolerance = 200 * epsilon / std::min(size, 1.0);
            double unequal = 0, jump = 0, off = 0;
            for (int k = 0; k < 64; ++k) {
                const double y = (k + 0.5) / 64, x = (k * 37 % 64 + 0.5) / 64;
                const glm::dvec2 below = place(share * x, y), above = place(share + (1 - share) * x, y);
                off =
                    std::max({off, below.y - below.x, above.x - above.y, -below.y, -above.x, below.x - 1, above.y - 1});
                // Across the diagonal the map is continuous, and away from the corner it is the diagonal.
                const double step = 4 * epsilon;
                const glm::dvec2 before = place(share * (1 - step), y), after = place(share + (1 - share) * step, y);
                jump = std::fmax(jump, glm::length(before - after));
                unequal = std::fmax(unequal, std::abs(before.x - before.y));
            }
            INFO("size " << size << ", share " << share << ": off " << off / epsilon << ", jump " << jump / epsilon
                         << ", " << unequal / epsilon << " epsilon");
            CHECK(off <= tolerance);
            CHECK(jump <= tolerance);
            CHECK(unequal <= tolerance);
            CHECK(static_cast<double>(std::abs(light.solid_angle() / (pair.x + pair.y) - 1)) <= 1000 * epsilon);
            CHECK(
                polygons::estimated_irradiance(light, 256) ==
                Approx(polygons::irradiance(corners(shape))).epsilon(2e-4).margin(1e-4 * double{light.solid_angle()}));
            double worst_return = 0;
            lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{7}};
            for (int k = 0; k < 100; ++k) {
                const auto given = uniforms.template next<2>();
                const auto again = light.invert(light.sample(given).value);
                worst_return = std::fmax(worst_return, std::abs(double{again.x} - double{given.x}) * double{given.y});
                worst_return = std::fmax(worst_return, std::abs(double{again.y} - double{given.y}));
            }
            CHECK(worst_return <= tolerance);
        }
    }
}

// Below 1e5 epsilon of a steradian, and for edges that are not at right angles, the halves take over: nobody sees it.
TEMPLATE_TEST_CASE("no jump where a rectangle turns into two triangles", "[spherical_rectangle]", float, double) {
    using T = TestType;
    const double threshold = std::sqrt(1e5 * double{std::numeric_limits<T>::epsilon()});
    for (double factor = 0.9; factor <= 1.1; factor += 0.0125) {
        const double side = threshold * factor;
        const Rectangle rectangle{0.25, 0.25 + side, -0.5, -0.5 + side, 1};
        const auto shape = rectangle.shape<T>();
        const Light<T> light{shape, origin<T>};
        INFO("side " << side);
        const auto pair = halves(shape);
        CHECK(static_cast<double>(std::abs(light.sample({T(0.5), T(0.25)}).pdf * (pair.x + pair.y) - 1)) <= 1e-5);
        CHECK(polygons::estimated_irradiance(light, 64) == Approx(polygons::irradiance(corners(shape))).epsilon(1e-5));
    }
    for (double skew = 1; skew > 1e-10; skew /= 8) {
        lumis::Parallelogram<T> shape = Rectangle{-0.5, 1, -1, 0.5, 1}.shape<T>();
        shape.edge_v.x = static_cast<T>(skew);
        const Light<T> light{shape, origin<T>};
        INFO("skew " << skew);
        const auto pair = halves(shape);
        CHECK(static_cast<double>(std::abs(light.sample({T(0.5), T(0.25)}).pdf * (pair.x + pair.y) - 1)) <= 1e-5);
        CHECK(polygons::estimated_irradiance(light, 256) == Approx(polygons::irradiance(corners(shape))).epsilon(2e-5));
    }
}

// One half is all that is seen, up to rounding, if the eye is under it: the other half's share is 0, or 1 that of this.
TEMPLATE_TEST_CASE("a parallelogram whose other half is next to nothing", "[spherical_rectangle]", float, double) {
    using T = TestType;
    constexpr T below_one = 1 - std::numeric_limits<T>::epsilon() / 2;
    const glm::dvec3 u{1, 0, 0}, v{0.5, 1, 0};
    for (const double height : {1e-3, 1e-6, 1e-9, 1e-12, 1e-17}) {
        for (const auto& eye : {glm::dvec2{0.95, 0.05}, {0.05, 0.95}, {0.05, 0.04}, {0.9, 0.95}}) {
            const lumis::Parallelogram<T> shape{glm::vec<3, T>(-eye.x * u - eye.y * v + glm::dvec3{0, 0, height}),
                                                glm::vec<3, T>(u), glm::vec<3, T>(v)};
            const Light<T> light{shape, origin<T>};
            int nothing = 0;
            for (const T x : {T(0), T(0.25), T(0.5), T(0.75), below_one, T(1)}) {
                for (const T y : {T(0), T(0.25), T(0.5), T(0.75), below_one, T(1)}) {
                    const auto sample = light.sample({x, y});
                    INFO("height " << height << ", eye " << eye.x << ", " << eye.y << ", u " << x << ", " << y);
                    REQUIRE((sample.pdf == 0 || sample.pdf == light.sample({T(0.5), T(0.5)}).pdf));
                    if (sample.pdf > 0) {
                        CHECK(std::abs(glm::length(glm::dvec3{sample.value}) - 1) <=
                              8 * double{std::numeric_limits<T>::epsilon()});
                        CHECK((sample.distance > 0 && sample.distance <= std::numeric_limits<T>::max()));
                    }
                    nothing += sample.pdf == 0;
                }
            }
            CHECK(nothing <= 8);  // at the rim, where rounding may turn a direction away
        }
    }
}
