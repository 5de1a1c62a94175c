// Triangles, parallelograms and disks as lights.
#include "cases.hpp"
#include "light_checks.hpp"

#include <array>

namespace stability {

namespace {

// The four corners, or the three and the first again.
template <class T>
std::array<QuadVector, 4> corners_of(const lumis::Triangle<T>& t, const Vector<T>& p) {
    return {quad(t.a) - quad(p), quad(t.b) - quad(p), quad(t.c) - quad(p), quad(t.a) - quad(p)};
}
template <class T>
std::array<QuadVector, 4> corners_of(const lumis::Parallelogram<T>& s, const Vector<T>& p) {
    const QuadVector a = quad(s.corner) - quad(p), u = quad(s.edge_u), v = quad(s.edge_v);
    return {a, a + u, a + u + v, a + v};
}

// The point that u draws, and the shape's normal of the length of its area, in quad.
struct QuadPoint {
    QuadVector position, area_normal;
};
template <class T>
QuadPoint point_of(const lumis::Triangle<T>& t, const Vector<T>& p, const glm::vec<2, T>& u) {
    const QuadVector ab = quad(t.b) - quad(t.a), ac = quad(t.c) - quad(t.a);
    const Quad root = sqrt(Quad{u.x});
    return {quad(t.a) - quad(p) + root * (1 - Quad{u.y}) * ab + root * Quad{u.y} * ac, Quad{0.5} * cross(ab, ac)};
}
template <class T>
QuadPoint point_of(const lumis::Parallelogram<T>& s, const Vector<T>& p, const glm::vec<2, T>& u) {
    const QuadVector eu = quad(s.edge_u), ev = quad(s.edge_v);
    return {quad(s.corner) - quad(p) + Quad{u.x} * eu + Quad{u.y} * ev, cross(eu, ev)};
}
// About the disk's centre the frame is the library's business: the point is the one drawn.
template <class T>
QuadPoint point_of(const lumis::Disk<T>& disk, const Vector<T>& p, const lumis::LightSample<Vector<T>, T>& sample) {
    const QuadVector normal = unit(quad(disk.normal)), center = quad(disk.center) - quad(p), w = quad(sample.value);
    const Quad r{disk.radius};
    return {dot(center, normal) / dot(w, normal) * w, quad_pi * r * r * normal};
}

// By area: the density of the drawn point, distance^2 / (area cos), against quad at the same uniforms. sine: of the angle
// under which the plane is seen, by which errors are divided as they are multiplied by nature.
template <class T, class Shape>
void check_by_area(Measured& measured, const Shape& shape, const Vector<T>& p, int random, double sine = 1) {
    const lumis::AreaLight light{shape, p};
    for_each_uniform<T>(random, [&](const auto& u) {
        const auto sample = light.sample(u);
        measured.sample<T>(sample, light.pdf(sample.value));
        measured.density(sample.distance);
        if (!(sample.pdf > 0)) return;
        const auto [position, area_normal] = [&] {
            if constexpr (requires { point_of(shape, p, u); }) {
                return point_of(shape, p, u);
            } else {
                return point_of(shape, p, sample);
            }
        }();
        const Quad d = length(position);
        const Quad pdf = d * d * d / abs(dot(position, area_normal));
        measured.error(sine * static_cast<double>(abs(Quad{sample.pdf} - pdf) / pdf));
    });
}

template <class T>
lumis::Triangle<T> triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return {Vector<T>{a}, Vector<T>{b}, Vector<T>{c}};
}
template <class T>
lumis::Parallelogram<T> parallelogram(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    return {Vector<T>{corner}, Vector<T>{u}, Vector<T>{v}};
}
template <class T>
lumis::Disk<T> disk(const glm::dvec3& center, const glm::dvec3& normal, double radius) {
    return {Vector<T>{center}, Vector<T>{normal}, static_cast<T>(radius)};
}

// By solid angle: the density is one over the solid angle, and what is drawn lies inside of the shape. beyond: how far
// beyond its edges that may be for a better reason than a direction's rounding.
template <class T, class Shape>
void check_by_solid_angle(Measured& measured, const Shape& shape, const Vector<T>& p, int random, double beyond = 0) {
    const lumis::AreaLight<Shape, lumis::BySolidAngle> light{shape, p};
    const auto c = corners_of(shape, p);
    const Quad solid_angle = solid_angle_of(c[0], c[1], c[2]) + solid_angle_of(c[0], c[2], c[3]);
    measured.compare(light.solid_angle(), solid_angle);
    // A direction's rounding; beyond 5 sr, where a vertex may lie opposite to the far edge, that of its versine.
    const double ulp = double{std::numeric_limits<T>::epsilon()};
    const Quad slack = solid_angle > 5 ? 8 * std::sqrt(ulp) : std::max(8 * ulp, beyond);
    const QuadVector middle = c[0] + c[2] + (std::same_as<Shape, lumis::Triangle<T>> ? c[1] : QuadVector{0, 0, 0});
    for_each_uniform<T>(random, [&](const auto& u) {
        const auto sample = light.sample(u);
        measured.sample<T>(sample, light.pdf(sample.value));
        measured.density(sample.distance);
        measured.compare(sample.pdf, Quad{1 / solid_angle});
        // On the inner side of every plane through the reference point and an edge, up to the rounding of a direction.
        for (std::size_t i = 0; i < 4; ++i) {
            const QuadVector edge_plane = cross(c[i], c[(i + 1) % 4]);
            const Quad span = length(edge_plane);
            if (!(span > 0)) continue;
            const Quad side = dot(quad(sample.value), edge_plane) / span;
            measured.expect((dot(middle, edge_plane) > 0 ? side : Quad{-side}) >= -slack);
        }
    });
}

// Irradiance on a receiver at p of normal +z, by Lambert's formula.
template <class T, class Shape>
double irradiance_of(const Shape& shape, const Vector<T>& p) {
    const auto c = corners_of(shape, p);
    Quad sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += irradiance_of_edge(c[i], c[(i + 1) % 4], {0, 0, 1});
    return std::abs(static_cast<double>(sum));
}

template <class T, class Shape>
void check_irradiance_of(Measured& measured, const Shape& shape, const Vector<T>& p, std::int64_t samples) {
    const double answer = irradiance_of(shape, p);
    check_irradiance<T>(measured, lumis::AreaLight{shape, p}, answer, samples);
    check_irradiance<T>(measured, lumis::AreaLight<Shape, lumis::BySolidAngle>{shape, p}, answer, samples);
}

}  // namespace

template <class T>
Measured flat_slivers(Effort effort) {
    Measured measured;
    const int random = effort.quick ? 1 : 20;
    const Vector<T> p{0, 0, 0};
    sweep(1e-6, 1, 6, [&](double width) {
        check_by_area<T>(measured, triangle<T>({-1, -1, 2}, {1, -1, 2}, {0.3, -1 + width, 2.5}), p, random);
        check_by_area<T>(measured, parallelogram<T>({-1, 1, 2}, {2, 1, 1}, {0, 0.7 * width, -width}), p, random);
        check_by_area<T>(measured, disk<T>({1, 2, 3}, {1, -1, 2}, width), p, random);
    });
    return measured;
}

template <class T>
Measured flat_scales(Effort effort) {
    Measured measured;
    const int random = effort.quick ? 1 : 20;
    const Vector<T> p{0, 0, 0};
    sweep(1e-12, 1e12, 12, [&](double s) {
        check_by_area<T>(measured, triangle<T>({-s, -s, 2 * s}, {s, -s, 2 * s}, {0, s, 3 * s}), p, random);
        check_by_area<T>(measured, parallelogram<T>({-s, s, 2 * s}, {2 * s, 0, s}, {0, s, -s}), p, random);
        check_by_area<T>(measured, disk<T>({s, 2 * s, 3 * s}, {1, -1, 2}, s), p, random);
        const auto gold = triangle<T>({0, 0, s}, {s, 0, s}, {0, s, s});
        check_irradiance<T>(measured, lumis::AreaLight{gold, p}, 0.302299894039, effort.of(30'000));
        check_irradiance<T>(measured, lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>{gold, p},
                            0.302299894039, effort.of(30'000));
    });
    return measured;
}

template <class T>
Measured flat_edge_on(Effort effort) {
    Measured measured;
    const int random = effort.quick ? 1 : 20;
    const Vector<T> p{0, 0, 0};
    sweep(1e-6, 1, 6, [&](double h) {
        check_by_area<T>(measured, triangle<T>({1, -1, h}, {2, 1, 2 * h}, {3, 0, -h}), p, random, h / 9);
        check_by_area<T>(measured, parallelogram<T>({1, -1, h}, {1, 0, h}, {0, 2, -h}), p, random, h / 9);
        check_by_area<T>(measured, disk<T>({3, 1, h}, {h, 0, 1}, 1), p, random, h / 9);
    });
    return measured;
}

template <class T>
Measured flat_nothing_to_draw(Effort) {
    Measured measured;
    const auto check_all = [&](const auto& shape, const Vector<T>& p) {
        check_draws_nothing<T>(measured, lumis::AreaLight{shape, p});
        using Shape = std::remove_cvref_t<decltype(shape)>;
        if constexpr (!std::same_as<Shape, lumis::Disk<T>>) {
            check_draws_nothing<T>(measured, lumis::AreaLight<Shape, lumis::BySolidAngle>{shape, p});
        }
    };
    sweep(1e-12, 1e12, 8, [&](double s) {
        const auto t = triangle<T>({-s, -s, 0}, {s, -s, 0}, {0, s, 0});
        const auto q = parallelogram<T>({-s, -s, 0}, {2 * s, 0, 0}, {0, 2 * s, 0});
        for (const glm::dvec3 in_plane : {glm::dvec3{0, 0, 0}, {-s, -s, 0}, {s, -s, 0}, {0, s, 0}, {5 * s, s, 0}}) {
            check_all(t, Vector<T>{in_plane});
            check_all(q, Vector<T>{in_plane});
            check_all(disk<T>({0, 0, 0}, {0, 0, 1}, s), Vector<T>{in_plane});
        }
        const Vector<T> above{glm::dvec3{0, 0, s}};
        check_all(triangle<T>({-s, -s, 0}, {s, s, 0}, {0, 0, 0}), above);  // a line
        check_all(triangle<T>({s, s, 0}, {s, s, 0}, {s, s, 0}), above);    // a point
        check_all(parallelogram<T>({-s, -s, 0}, {s, s, 0}, {s, s, 0}), above);
        check_all(parallelogram<T>({-s, -s, 0}, {0, 0, 0}, {0, 0, 0}), above);
        check_all(disk<T>({0, 0, 0}, {0, 0, 1}, 0), above);
        check_all(disk<T>({0, 0, 0}, {0, 0, 0}, s), above);
    });
    return measured;
}

template <class T>
Measured flat_far_from_origin(Effort effort) {
    Measured measured;
    const int random = effort.quick ? 1 : 50;
    sweep(1, 1e6, 6, [&](double far) {
        const glm::dvec3 o = far * glm::dvec3{1, -0.7, 0.4};
        const auto p = Vector<T>{o};
        const auto t = triangle<T>(o + glm::dvec3{-1, -1, 2}, o + glm::dvec3{1, -1, 2}, o + glm::dvec3{0, 1, 3});
        const auto q = parallelogram<T>(o + glm::dvec3{-1, 1, 2}, {2, 0, 1}, {0, 1, -1});
        check_by_area<T>(measured, t, p, random);
        check_by_area<T>(measured, q, p, random);
        check_by_solid_angle<T>(measured, t, p, random);
        check_by_solid_angle<T>(measured, q, p, random);
        check_irradiance_of<T>(measured, t, p, effort.of(30'000));
    });
    return measured;
}

template <class T>
Measured spherical_triangle(Effort effort) {
    Measured measured;
    const Vector<T> p{0, 0, 0};
    const int random = effort.quick ? 1 : 20;
    // From 1e-8 sr to almost half of all directions.
    sweep(2e-4, 1, 8, [&](double s) {
        check_by_solid_angle<T>(measured, triangle<T>({0.3, 0, 1}, {0.3 + s, 0, 1}, {0.3, s, 1}), p, random);
        check_by_solid_angle<T>(measured, triangle<T>({-s, 1, 2}, {s, 1, 2}, {0, 1 + s, 2 + s}), p, random);
        check_irradiance_of<T>(measured, triangle<T>({0.3, 0, 1}, {0.3 + s, 0, 1}, {0.3, s, 1}), p, effort.of(30'000));
    });
    sweep(1, 1e-4, 8, [&](double h) {
        check_by_solid_angle<T>(measured, triangle<T>({-1, -1, h}, {1, -1, h}, {0, 1, h}), p, random);
    });
    return measured;
}

template <class T>
Measured spherical_rectangle(Effort effort) {
    Measured measured;
    const Vector<T> p{0, 0, 0};
    const int random = effort.quick ? 1 : 20;
    sweep(1e-4, 1, 8, [&](double s) {
        check_by_solid_angle<T>(measured, parallelogram<T>({0.3, 0.2, 1}, {s, 0, 0}, {0, s, 0}), p, random);
        check_by_solid_angle<T>(measured, parallelogram<T>({0.3, 0.2, 1}, {s, s / 2, 0}, {0, s, s / 3}), p, random);
        check_irradiance_of<T>(measured, parallelogram<T>({0.3, 0.2, 1}, {s, 0, 0}, {0, s, 0}), p, effort.of(30'000));
    });
    sweep(1, 1e-4, 8, [&](double h) {
        check_by_solid_angle<T>(measured, parallelogram<T>({-1, -1, h}, {2, 0, 0}, {0, 2, 0}), p, random);
    });
    return measured;
}

// A long edge that starts at a, in a plane at the given height, and a polygon of the given width at its side: as it is, and
// turned so that no coordinate is 0.
template <class T>
Measured polygon_edges_close_by(Effort effort) {
    Measured measured;
    const Vector<T> p{0, 0, 0};
    const int random = effort.quick ? 0 : 1;
    // double has no wider type to form the cross products of vertices nearly opposite to each other.
    constexpr double beyond = 1e-7;
    const auto from = [&](const glm::dvec3& a, const glm::dvec3& along, const glm::dvec3& across) {
        const glm::dvec3 b = a + along, c = a + 0.35 * along + across;
        for (const auto& t : {triangle<T>(a, b, c), triangle<T>(b, c, a), triangle<T>(c, a, b), triangle<T>(a, c, b),
                              triangle<T>(c, b, a), triangle<T>(b, a, c)}) {
            check_by_solid_angle<T>(measured, t, p, random, beyond);
        }
        check_by_solid_angle<T>(measured, parallelogram<T>(a, along, across), p, random, beyond);
        check_by_solid_angle<T>(measured, parallelogram<T>(a, across, along), p, random, beyond);
        check_by_solid_angle<T>(measured, parallelogram<T>(a, along, across + 0.3 * along), p, random, beyond);
        check_by_solid_angle<T>(measured, parallelogram<T>(a, 0.4 * along - across, 0.6 * along + across), p, random,
                                beyond);
    };
    sweep(1e-6, 1, 6, [&](double height) {
        for (const double width : {1.0, 0.1, 0.01, 0.001}) {
            for (const double start : {-0.2, -1.0, 0.0, 0.1}) {
                for (const double aside : {0.0, height, -height, 1e-3, -1e-3}) {
                    from({start, aside, height}, {2, 0, 0}, {0, width, 0});
                    const glm::dvec3 x{0.6, 0.64, -0.48}, y{-0.8, 0.48, -0.36}, z{0, 0.6, 0.8};
                    from(start * x + aside * y + height * z, 2.0 * x, width * y);
                }
            }
        }
        // By area its estimates vary without bound.
        const auto t = triangle<T>({-0.2, 0, height}, {1.8, 0, height}, {0.3, 0.02, height});
        check_irradiance<T>(measured, lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>{t, p},
                            irradiance_of(t, p), effort.of(30'000));
    });
    return measured;
}

template Measured flat_slivers<float>(Effort);
template Measured flat_slivers<double>(Effort);
template Measured flat_scales<float>(Effort);
template Measured flat_scales<double>(Effort);
template Measured flat_edge_on<float>(Effort);
template Measured flat_edge_on<double>(Effort);
template Measured flat_nothing_to_draw<float>(Effort);
template Measured flat_nothing_to_draw<double>(Effort);
template Measured flat_far_from_origin<float>(Effort);
template Measured flat_far_from_origin<double>(Effort);
template Measured spherical_triangle<float>(Effort);
template Measured spherical_triangle<double>(Effort);
template Measured spherical_rectangle<float>(Effort);
template Measured spherical_rectangle<double>(Effort);
template Measured polygon_edges_close_by<float>(Effort);
template Measured polygon_edges_close_by<double>(Effort);

}  // namespace stability
