// Flat lights by solid angle and cosine, and cones of directions: the sun.
#include "cases.hpp"
#include "light_checks.hpp"

#include <glm/geometric.hpp>

#include <numbers>
#include <vector>

namespace stability {

namespace {

const QuadVector up{0, 0, 1};

// What of a polygon is above a receiver at the origin of normal +z.
std::vector<QuadVector> above_horizon(const std::vector<QuadVector>& polygon) {
    std::vector<QuadVector> above;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const QuadVector &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        if (p.z >= 0) above.push_back(p);
        if ((p.z < 0) != (q.z < 0)) above.push_back(p + Quad{p.z / (p.z - q.z)} * (q - p));
    }
    return above;
}

// Lambert's formula.
double irradiance_of(const std::vector<QuadVector>& polygon) {
    Quad sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += irradiance_of_edge(polygon[i], polygon[(i + 1) % polygon.size()], up);
    return std::abs(static_cast<double>(sum));
}

template <class T>
std::vector<QuadVector> corners_of(const lumis::Triangle<T>& t) {
    return {quad(t.a), quad(t.b), quad(t.c)};
}
template <class T>
std::vector<QuadVector> corners_of(const lumis::Parallelogram<T>& s) {
    const QuadVector a = quad(s.corner), u = quad(s.edge_u), v = quad(s.edge_v);
    return {a, a + u, a + u + v, a + v};
}

// What is drawn lies above the horizon and inside of the shape, and has a density; the irradiance is Lambert's. Its estimates
// hardly vary, so a bias of a thousandth is seen.
template <class T, class Shape>
void check_by_cosine(Measured& measured, const Shape& shape, Effort effort) {
    const Vector<T> origin{0, 0, 0}, normal{0, 0, 1};
    const lumis::AreaLight<Shape, lumis::ByCosine> light{shape, origin, normal};
    const auto seen = above_horizon(corners_of(shape));
    if (seen.size() < 3) return check_draws_nothing<T>(measured, light);
    QuadVector middle{0, 0, 0};
    for (const auto& corner : seen) middle = middle + corner;
    // The slack of a triangle by solid angle: a direction's rounding, or in nearly a hemisphere that of its versine.
    const Quad slack = 8 * std::sqrt(double{std::numeric_limits<T>::epsilon()});
    for_each_uniform<T>(effort.quick ? 1 : 20, [&](const auto& u) {
        const auto sample = light.sample(u);
        const T pdf = light.pdf(sample.value);
        measured.sample<T>(sample, pdf);
        measured.density(sample.distance);
        if (!(sample.pdf > 0)) return;
        measured.expect(sample.value.z > 0 && pdf > 0);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const QuadVector edge_plane = cross(seen[i], seen[(i + 1) % seen.size()]);
            const Quad span = length(edge_plane);
            if (!(span > 0)) continue;
            const Quad side = dot(quad(sample.value), edge_plane) / span;
            measured.expect((dot(middle, edge_plane) > 0 ? side : Quad{-side}) >= -slack);
        }
    });
    // Small rectangles are even up to 1e-4 of their edges, which shows where estimates vary by 1e-10.
    const auto moments = moments_of<T>(effort.of(10'000), [&](auto& source) {
        const auto drawn = light.sample(source.template next<2>());
        return drawn.pdf > 0 ? drawn.value.z / drawn.pdf : T(0);
    });
    measured.bias(moments, irradiance_of(seen), 1e-9 + rounding_of_mean<T>);
}

template <class T>
lumis::Triangle<T> triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return {Vector<T>{a}, Vector<T>{b}, Vector<T>{c}};
}
template <class T>
lumis::Parallelogram<T> parallelogram(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    return {Vector<T>{corner}, Vector<T>{u}, Vector<T>{v}};
}

// Relative error of a density against 1 / solid angle.
template <class T, class Cone>
void check_cone(Measured& measured, const Cone& cone, T half_angle, int random) {
    const Quad sine = sin(Quad{half_angle} / 2), solid_angle = 4 * quad_pi * sine * sine;
    measured.compare(cone.solid_angle(), solid_angle);
    measured.usual(2 * std::numbers::pi_v<T> * (1 - std::cos(half_angle)), solid_angle);
    for_each_uniform<T>(random, [&](const auto& u) {
        const auto sample = cone.sample(u);
        const T pdf = cone.pdf(sample.value);
        measured.sample<T>(sample, pdf);
        measured.compare(sample.pdf, Quad{1 / solid_angle});
        measured.expect(pdf == sample.pdf);
    });
}

}  // namespace

template <class T>
Measured cones(Effort effort) {
    Measured measured;
    const int random = effort.quick ? 1 : 50;
    sweep(1e-9, std::numbers::pi, 30, [&](double angle) {
        const T half_angle = static_cast<T>(angle);
        check_cone(measured, lumis::UniformCone<T>{half_angle}, half_angle, random);
        for (const glm::dvec3& direction : {glm::dvec3{0, 0, 1}, {0, 0, -1}, {0.48, -0.6, 0.64}}) {
            check_cone(measured, lumis::Sun<T>{Vector<T>{direction}, half_angle}, half_angle, random);
        }
    });
    for (const double angle : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        if (measured.template leaves_out<T>(angle)) continue;
        check_draws_nothing<T>(measured, lumis::UniformCone<T>{static_cast<T>(angle)});
        check_draws_nothing<T>(measured, lumis::Sun<T>{Vector<T>{0, 0, 1}, static_cast<T>(angle)});
    }
    check_draws_nothing<T>(measured, lumis::Sun<T>{Vector<T>{0, 0, 0}, T(0.1)});
    return measured;
}

template <class T>
Measured polygons_by_cosine(Effort effort) {
    Measured measured;
    // The horizon cuts a wall, upright and leaning, and a triangle, next to either end.
    sweep(1e-6, 1, 6, [&](double part) {
        for (const double below : {part, 2 - part}) {
            for (const double lean : {0.0, 0.3}) {
                check_by_cosine<T>(measured, parallelogram<T>({1, -1, -below}, {0, 2, lean}, {lean, 0, 2}), effort);
                check_by_cosine<T>(measured, triangle<T>({1, -1, -below}, {1.2, 1, 0.5 - below}, {0.8, 0, 2 - below}),
                                   effort);
            }
        }
    });
    // Close by, its edge near the normal or aside; slivers; and down to 1e-8 sr.
    sweep(1e-6, 1, 6, [&](double size) {
        for (const double start : {-0.9, 0.1}) {
            check_by_cosine<T>(measured, parallelogram<T>({-0.9, start, size}, {2, 0, 0}, {0.3, 2, 0}), effort);
            check_by_cosine<T>(measured, triangle<T>({-0.9, start, size}, {1.1, start, size}, {0.2, 2, size}), effort);
        }
        check_by_cosine<T>(measured, triangle<T>({-1, -1, 2}, {1, -1, 2}, {0.3, -1 + size, 2.5}), effort);
        check_by_cosine<T>(measured, parallelogram<T>({1, -1, -1}, {0, 2, 1}, {0, 0.7 * size, 2 * size}), effort);
    });
    sweep(1e-4, 1, 4, [&](double s) {
        check_by_cosine<T>(measured, parallelogram<T>({2, 0.2, 1}, {s, 0, 0}, {0, s, s / 3}), effort);
        check_by_cosine<T>(measured, triangle<T>({2, 0, -s / 2}, {2, s, 0}, {2, 0, s}), effort);
    });
    return measured;
}

template Measured cones<float>(Effort);
template Measured cones<double>(Effort);
template Measured polygons_by_cosine<float>(Effort);
template Measured polygons_by_cosine<double>(Effort);

}  // namespace stability
