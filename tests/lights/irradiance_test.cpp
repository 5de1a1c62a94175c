// The irradiance at the origin, normal +z, from Lambertian emitters of radiance 1 against closed forms (Lambert 1760
// for polygons; pi (r/d)^2 cos(omega) for spheres above the horizon), by each light strategy alone and by MIS.
#include "irradiance.hpp"

#include "catch.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

using irradiance::check_unbiased;

namespace {

using V = glm::dvec3;

// visible(w): whether the emitter lies in a direction, told without the library.
template <class Visible>
auto cosine_where(Visible visible) {
    return [=]<class T>(const glm::vec<3, T>& w) { return w.z > 0 && visible(V{w}) ? w.z : T(0); };
}

// By the light alone, and by two samples of it and one of the BSDF.
template <class Light, class Visible>
void check_briefly(const std::string& name, const Light& light, Visible visible, double answer) {
    using T = typename Light::Scalar;
    const auto f = cosine_where(visible);
    const auto alone = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, light));
    check_unbiased<T>(
        name, [&](auto& uniforms) { return alone.estimate(f, uniforms); }, answer);
    const auto both = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, lumis::CosineHemisphere<T>{}),
                                          lumis::take(2, light));
    check_unbiased<T>(
        name + ", MIS", [&](auto& uniforms) { return both.estimate(f, uniforms); }, answer);
}

// In many ways.
template <class Light, class Visible>
void check(const std::string& name, const Light& light, Visible visible, double answer) {
    using T = typename Light::Scalar;
    const lumis::CosineHemisphere<T> cosine;
    const auto f = cosine_where(visible);
    const auto run = [&](const char* how, const auto& combination) {
        check_unbiased<T>(
            name + ", " + how, [&](auto& uniforms) { return combination.estimate(f, uniforms); }, answer);
    };
    using lumis::choose, lumis::take;
    const lumis::BalanceHeuristic balance;
    const lumis::PowerHeuristic power;
    run("light alone", lumis::multi_sample(balance, take(1, light)));
    run("multi-sample, balance", lumis::multi_sample(balance, take(1, cosine), take(1, light)));
    run("multi-sample, power", lumis::multi_sample(power, take(1, cosine), take(2, light)));
    run("one-sample, balance", lumis::one_sample(balance, choose(0.3, cosine), choose(0.7, light)));
    run("one-sample, power", lumis::one_sample(power, choose(0.5, cosine), choose(0.5, light)));
}

template <class T>
glm::vec<3, T> point(double x, double y, double z) {
    return {static_cast<T>(x), static_cast<T>(y), static_cast<T>(z)};
}

template <class T, class Sampling = lumis::ByArea, class Shape>
auto light(const Shape& shape) {
    return lumis::AreaLight<Shape, Sampling>{shape, glm::vec<3, T>(T(0))};
}

}  // namespace

TEMPLATE_TEST_CASE("irradiance from polygons", "[irradiance]", float, double) {
    using T = TestType;
    const auto both = [](const std::string& name, const auto& shape, auto visible, double answer) {
        check_briefly(name + " by area", light<T>(shape), visible, answer);
        check(name + " by solid angle", light<T, lumis::BySolidAngle>(shape), visible, answer);
    };
    const lumis::Triangle<T> triangle{point<T>(0, 0, 1), point<T>(1, 0, 1), point<T>(0, 1, 1)};
    both(
        "triangle", triangle, [](const V& w) { return w.x >= 0 && w.y >= 0 && w.x + w.y <= w.z; }, 0.302299894039);

    const lumis::Triangle<T> octant{point<T>(1, 0, 0), point<T>(0, 1, 0), point<T>(0, 0, 1)};
    both(
        "octant", octant, [](const V& w) { return w.x >= 0 && w.y >= 0; }, std::numbers::pi / 4);

    const lumis::Parallelogram<T> square{point<T>(-1, -1, 1), point<T>(2, 0, 0), point<T>(0, 2, 0)};
    both(
        "square", square, [](const V& w) { return std::abs(w.x) <= w.z && std::abs(w.y) <= w.z; }, 1.740839502734);
}

// Straight above in closed form; aslant and dipping below the horizon by quadrature over its area.
TEMPLATE_TEST_CASE("irradiance from disks", "[irradiance]", float, double) {
    using T = TestType;
    const auto check_disk = [](const std::string& name, const V& center, const V& normal, double radius,
                               double answer) {
        const auto visible = [=](const V& w) {
            const double distance = glm::dot(center, normal) / glm::dot(w, normal);
            return distance > 0 && glm::length(distance * w - center) <= radius;
        };
        const lumis::Disk<T> disk{glm::vec<3, T>(center), glm::vec<3, T>(normal), static_cast<T>(radius)};
        check_briefly(name, light<T>(disk), visible, answer);
    };
    check_disk("disk above", {0, 0, 1}, {0, 0, -1}, 1, std::numbers::pi / 2);
    const auto by_quadrature = [](const V& center, const V& normal, double radius) {
        using boost::math::quadrature::gauss_kronrod;
        const V n = glm::normalize(normal), t = glm::normalize(glm::cross(n, V{0.3, 0.5, 0.7})), b = glm::cross(n, t);
        const auto at = [&](double r, double phi) {
            const V p = center + r * (std::cos(phi) * t + std::sin(phi) * b);
            const double d2 = glm::dot(p, p);
            return std::max(p.z, 0.0) * std::abs(glm::dot(p, n)) / (d2 * d2) * r;
        };
        const auto ring = [&](double r) {
            return gauss_kronrod<double, 31>::integrate([&](double phi) { return at(r, phi); }, 0, 2 * std::numbers::pi,
                                                        10, 1e-9);
        };
        return gauss_kronrod<double, 31>::integrate(ring, 0, radius, 10, 1e-8);
    };
    CHECK(by_quadrature({0, 0, 1}, {0, 0, 1}, 1) == Approx(std::numbers::pi / 2).epsilon(1e-7));
    const V center{1.2, -0.5, 1.5}, low{1.5, 0.5, 0.4};
    check_disk("disk aslant", center, {0.3, 0.4, -2}, 0.7, by_quadrature(center, {0.3, 0.4, -2}, 0.7));
    check_disk("disk below the horizon", low, {-1, 0, 0.2}, 0.8, by_quadrature(low, {-1, 0, 0.2}, 0.8));
}

// By Lambert's formula; an asymmetric shape, so that its edges cannot be mistaken for one another.
TEMPLATE_TEST_CASE("irradiance from a skew parallelogram", "[irradiance]", float, double) {
    using T = TestType;
    const V a{0.2, -0.3, 0.8}, u{1.5, 0.2, 0.3}, v{-0.4, 0.7, 0.1};
    const V corners[] = {a, a + u, a + u + v, a + v};
    double answer = 0;
    for (int i = 0; i < 4; ++i) {
        const V p = glm::normalize(corners[i]), q = glm::normalize(corners[(i + 1) % 4]), normal = glm::cross(p, q);
        answer += 0.5 * std::acos(glm::dot(p, q)) * glm::normalize(normal).z;
    }
    const auto visible = [=](const V& w) {
        const double det = glm::dot(w, glm::cross(u, v)), distance = glm::dot(a, glm::cross(u, v)) / det;
        const V hit = distance * w - a, n = glm::cross(u, v);
        const double s = glm::dot(glm::cross(hit, v), n) / glm::dot(n, n);
        const double t = glm::dot(glm::cross(u, hit), n) / glm::dot(n, n);
        return distance > 0 && s >= 0 && s <= 1 && t >= 0 && t <= 1;
    };
    const lumis::Parallelogram<T> shape{glm::vec<3, T>(a), glm::vec<3, T>(u), glm::vec<3, T>(v)};
    check("skew by area", light<T>(shape), visible, std::abs(answer));
    check_briefly("skew by solid angle", light<T, lumis::BySolidAngle>(shape), visible, std::abs(answer));
}

TEMPLATE_TEST_CASE("irradiance from spheres", "[irradiance]", float, double) {
    using T = TestType;
    const auto both = [](const std::string& name, const V& center, double radius, double answer) {
        const auto visible = [=](const V& w) {
            const V across = center - glm::dot(center, w) / glm::dot(w, w) * w;
            return glm::dot(center, w) > 0 && glm::dot(across, across) <= radius * radius;
        };
        const lumis::Sphere<T> sphere{glm::vec<3, T>(center), static_cast<T>(radius)};
        check(name + " by area", light<T>(sphere), visible, answer);
        check(name + " by solid angle", light<T, lumis::BySolidAngle>(sphere), visible, answer);
    };
    both("sphere straight up", {0, 0, 2}, 1, std::numbers::pi / 4);
    both("sphere on the horizon", {2, 0, 0}, 1, 0.0905860737);
    both("sphere aslant", {1.2, -0.5, 1.5}, 0.5, std::numbers::pi * 0.25 * 1.5 / std::pow(1.44 + 0.25 + 2.25, 1.5));
}

// The same light in another unit of length, or far from the origin, is the same light.
TEMPLATE_TEST_CASE("irradiance does not depend on the scale of the scene", "[irradiance]", float, double) {
    using T = TestType;
    const auto mean = [](const auto& strategy) {
        auto uniforms = irradiance::uniforms<T>(4);
        double sum = 0;
        constexpr int n = 20'000;
        for (int i = 0; i < n; ++i) {
            const auto sample = strategy.sample(uniforms.template next<2>());
            if (sample.pdf > 0) sum += double{std::max(sample.value.z, T(0)) / sample.pdf};
        }
        return sum / n;
    };
    const auto means = [&](double scale, const V& origin) {
        const auto at = [&](double x, double y, double z) { return glm::vec<3, T>(origin + scale * V{x, y, z}); };
        const auto along = [&](double x, double y, double z) { return glm::vec<3, T>(scale * V{x, y, z}); };
        const glm::vec<3, T> reference(origin);
        const lumis::Triangle<T> triangle{at(0.3, 0, 1), at(1, 0.2, 1.3), at(0, 1, 1)};
        const lumis::Parallelogram<T> square{at(-1, -1, 1), along(2, 0, 0), along(0, 2, 0)};
        const lumis::Sphere<T> sphere{at(0.5, 0.25, 2), static_cast<T>(scale)};
        using S = lumis::Sphere<T>;
        return std::array{mean(lumis::AreaLight{triangle, reference}), mean(lumis::AreaLight{square, reference}),
                          mean(lumis::AreaLight{sphere, reference}),
                          mean(lumis::AreaLight<S, lumis::BySolidAngle>{sphere, reference})};
    };
    const auto expected = means(1, V{0});
    const auto compare = [&](double scale, const V& origin, double tolerance) {
        const auto actual = means(scale, origin);
        for (std::size_t i = 0; i < actual.size(); ++i) {
            INFO("light " << i << ", scale " << scale << ", origin " << origin.x);
            CHECK(actual[i] == Approx(expected[i]).epsilon(tolerance));
        }
    };
    // Another unit moves every coordinate by rounding: sample by sample, and at a sphere's rim by much.
    for (double scale = 1e-3; scale <= 1001; scale *= 10) compare(scale, V{0}, std::is_same_v<T, float> ? 2e-5 : 1e-12);
    for (const double scale : {1e-9, 1e9}) compare(scale, V{0}, std::is_same_v<T, float> ? 2e-5 : 1e-12);
    if (std::is_same_v<T, double>) compare(1, V{1e6, -1e6, 1e6}, 1e-8);
}

TEMPLATE_TEST_CASE("irradiance from a white environment is pi for every normal", "[irradiance]", float, double) {
    using T = TestType;
    const std::pair<int, int> sizes[] = {{1, 1}, {4, 2}, {64, 32}};
    const V normals[] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, glm::normalize(V{-0.3, 0.2, -0.9})};
    for (const auto& [width, height] : sizes) {
        const std::vector<T> white(static_cast<std::size_t>(width * height), T(1));
        const lumis::EnvironmentMap environment{width, height, white};
        for (const V& normal : normals) {
            const lumis::Frame<T> frame{glm::vec<3, T>(normal)};
            const auto f = [&](const glm::vec<3, T>& w) { return std::max(frame.to_local(w).z, T(0)); };
            const auto cosine = lumis::in_frame(frame, lumis::CosineHemisphere<T>{});
            const auto alone = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, environment));
            const auto both =
                lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, environment), lumis::take(1, cosine));
            const std::string label = "normal " + std::to_string(normal.x) + ", " + std::to_string(normal.y);
            const double pi = std::numbers::pi;
            check_unbiased<T>(
                label, [&](auto& uniforms) { return alone.estimate(f, uniforms); }, pi);
            check_unbiased<T>(
                label + ", MIS", [&](auto& uniforms) { return both.estimate(f, uniforms); }, pi);
        }
    }
}
