// Spheres as lights.
#include "cases.hpp"
#include "light_checks.hpp"

#include <numbers>

namespace stability {

namespace {

const glm::dvec3 slanted{0.48, -0.6, 0.64};  // a unit vector along no axis

// A sphere seen under a half-angle, from the origin.
template <class T>
lumis::Sphere<T> sphere_at(const glm::dvec3& direction, double distance, double half_angle) {
    return {Vector<T>{distance * direction}, static_cast<T>(distance * std::sin(half_angle))};
}

template <class T>
Quad sphere_solid_angle(const lumis::Sphere<T>& sphere, const Vector<T>& reference_point) {
    const Quad d = length(quad(sphere.center) - quad(reference_point)), r{sphere.radius};
    return d > r ? Quad{2 * quad_pi * (1 - sqrt(1 - r * r / (d * d)))} : Quad{4 * quad_pi};
}

// Evenly over the solid angle, what is drawn lies on the sphere, at the distance reported.
template <class T>
void check_sphere(Measured& measured, const lumis::Sphere<T>& sphere, const Vector<T>& reference_point, int random) {
    const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> light{sphere, reference_point};
    const Quad solid_angle = sphere_solid_angle(sphere, reference_point);
    measured.compare(light.solid_angle(), solid_angle);
    const T d = glm::length(sphere.center - reference_point), sine = sphere.radius / d;
    if (sine < 1) measured.usual(2 * std::numbers::pi_v<T> * (1 - std::sqrt(1 - sine * sine)), solid_angle);
    for_each_uniform<T>(random, [&](const auto& u) {
        const auto sample = light.sample(u);
        const T pdf = light.pdf(sample.value);
        measured.sample<T>(sample, pdf);
        measured.density(sample.distance);
        measured.compare(sample.pdf, Quad{1 / solid_angle});
        measured.expect(pdf == sample.pdf);
        const QuadVector center = quad(sphere.center) - quad(reference_point);
        const QuadVector point = Quad{sample.distance} * quad(sample.value);
        const Quad off_surface = abs(length(point - center) - Quad{sphere.radius});
        measured.expect(off_surface <= 32 * Quad{std::numeric_limits<T>::epsilon()} * length(center) ||
                        length(center) < Quad{sphere.radius});
    });
}

}  // namespace

template <class T>
Measured sphere_cone(Effort effort) {
    Measured measured;
    for (const double degrees : {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 60.0, 85.0, 89.0}) {
        for (const double distance : {1e-6, 1.0, 1e6}) {
            for (const glm::dvec3& direction : {glm::dvec3{0, 0, 1}, glm::dvec3{0, 0, -1}, slanted}) {
                const auto sphere = sphere_at<T>(direction, distance, degrees * std::numbers::pi / 180);
                check_sphere(measured, sphere, Vector<T>{0, 0, 0}, effort.quick ? 1 : 20);
            }
        }
    }
    return measured;
}

template <class T>
Measured sphere_near_surface(Effort effort) {
    Measured measured;
    // Just above the surface of a unit sphere, as near as T can say.
    for (const double degrees : {89.0, 89.9, 89.99}) {
        const double height = 1 / std::sin(degrees * std::numbers::pi / 180) - 1;
        for (const glm::dvec3& direction : {glm::dvec3{0, 0, 1}, glm::dvec3{1, 0, 0}, slanted}) {
            const lumis::Sphere<T> sphere{Vector<T>{(1 + height) * direction}, T(1)};
            if (sphere_solid_angle(sphere, Vector<T>{0, 0, 0}) == 4 * quad_pi) continue;  // rounded onto the surface
            check_sphere(measured, sphere, Vector<T>{0, 0, 0}, effort.quick ? 1 : 50);
        }
    }
    return measured;
}

template <class T>
Measured sphere_far_away(Effort effort) {
    Measured measured;
    for (const double radii : {1e3, 1e4, 1e5, 1e6}) {
        for (const double scale : {1e-3, 1.0, 1e3}) {
            const lumis::Sphere<T> sphere{Vector<T>{radii * scale * slanted}, static_cast<T>(scale)};
            check_sphere(measured, sphere, Vector<T>{0, 0, 0}, effort.quick ? 1 : 20);
            check_sphere(measured, sphere, Vector<T>{scale * glm::dvec3{3, 2, 1}}, effort.quick ? 1 : 20);
        }
    }
    return measured;
}

template <class T>
Measured sphere_inside(Effort effort) {
    Measured measured;
    for (const double from_centre : {0.0, 1e-6, 0.5, 0.999, 0.999999}) {
        const lumis::Sphere<T> sphere{Vector<T>{from_centre * slanted}, T(1)};
        check_sphere(measured, sphere, Vector<T>{0, 0, 0}, effort.quick ? 1 : 20);
        // All that is around: irradiance pi, whichever way points are drawn.
        const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> by_solid_angle{sphere, Vector<T>{0, 0, 0}};
        check_irradiance<T>(measured, by_solid_angle, std::numbers::pi, effort.of(100'000));
        // By area the density has a peak of (1 - from_centre)^2 where the surface is near.
        if (from_centre > 0.9) continue;
        check_irradiance<T>(measured, lumis::AreaLight{sphere, Vector<T>{0, 0, 0}}, std::numbers::pi,
                            effort.of(100'000));
    }
    // From the surface itself nothing is seen of the front.
    const lumis::Sphere<T> touching{{T(0), T(0), T(1)}, T(1)};
    check_draws_nothing<T>(measured, lumis::AreaLight{touching, Vector<T>{0, 0, 0}});
    check_draws_nothing<T>(measured, lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{touching, {}});
    constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    for (const T radius : {T(0), T(-1), std::numeric_limits<T>::infinity(), nan}) {
        if (measured.leaves_out<T>(radius)) continue;
        const lumis::Sphere<T> sphere{{T(0), T(0), T(1)}, radius};
        check_draws_nothing<T>(measured, lumis::AreaLight{sphere, Vector<T>{0, 0, 0}});
        check_draws_nothing<T>(measured, lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{sphere, {}});
    }
    return measured;
}

template <class T>
Measured sphere_irradiance(Effort effort) {
    Measured measured;
    for (const double half_angle : {1e-5, 1e-3, 0.1, 0.5}) {
        for (const double from_zenith : {0.0, 0.9}) {
            const glm::dvec3 direction{std::sin(from_zenith), 0, std::cos(from_zenith)};
            const auto sphere = sphere_at<T>(direction, 10, half_angle);
            const double sine = double{sphere.radius} / glm::length(glm::dvec3{sphere.center});
            const double answer = std::numbers::pi * sine * sine * std::cos(from_zenith);
            check_irradiance<T>(measured, lumis::AreaLight{sphere, Vector<T>{0, 0, 0}}, answer, effort.of(60'000));
            check_irradiance<T>(measured, lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{sphere, {}}, answer,
                                effort.of(60'000));
        }
    }
    return measured;
}

template Measured sphere_cone<float>(Effort);
template Measured sphere_cone<double>(Effort);
template Measured sphere_near_surface<float>(Effort);
template Measured sphere_near_surface<double>(Effort);
template Measured sphere_far_away<float>(Effort);
template Measured sphere_far_away<double>(Effort);
template Measured sphere_inside<float>(Effort);
template Measured sphere_inside<double>(Effort);
template Measured sphere_irradiance<float>(Effort);
template Measured sphere_irradiance<double>(Effort);

}  // namespace stability
