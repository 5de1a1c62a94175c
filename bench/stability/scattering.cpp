// Hemispheres and GGX: densities and what they are made of.
#include "cases.hpp"
#include "directions.hpp"

#include <algorithm>
#include <numbers>

namespace stability {

namespace {

// The textbook's terms, Heitz 2014, with the roughness as the library raises it.
struct QuadGgx {
    Quad ax, ay;

    template <class T>
    explicit QuadGgx(glm::vec<2, T> alpha)
        : ax{std::max(alpha.x, T(lumis::ggx_min_alpha))}, ay{std::max(alpha.y, T(lumis::ggx_min_alpha))} {}

    [[nodiscard]] Quad D(const QuadVector& w) const {
        const Quad cos2 = w.z * w.z;
        const Quad slope = (w.x * w.x / (ax * ax) + w.y * w.y / (ay * ay)) / cos2;
        return 1 / (quad_pi * ax * ay * cos2 * cos2 * (1 + slope) * (1 + slope));
    }
    [[nodiscard]] Quad lambda(const QuadVector& w) const {
        const Quad slope = (w.x * w.x * ax * ax + w.y * w.y * ay * ay) / (w.z * w.z);
        return (sqrt(1 + slope) - 1) / 2;
    }
    [[nodiscard]] Quad G1(const QuadVector& w) const { return 1 / (1 + lambda(w)); }
    [[nodiscard]] Quad G2(const QuadVector& o, const QuadVector& i) const { return 1 / (1 + lambda(o) + lambda(i)); }

    // Per solid angle of the normal.
    [[nodiscard]] Quad visible_normals(const QuadVector& o, const QuadVector& m) const {
        return G1(o) * dot(o, m) * D(m) / o.z;
    }
    // Per solid angle of the reflected direction: D G1 / (4 cos).
    [[nodiscard]] Quad reflection(const QuadVector& o, const QuadVector& i) const {
        return G1(o) * D(unit(o + i)) / (4 * o.z);
    }
    // Eto and Tokuyoshi 2023, listing 2, for wo above the horizon.
    [[nodiscard]] Quad bounded_reflection(const QuadVector& o, const QuadVector& i) const {
        const Quad a = std::min({ax, ay, Quad{1}});
        const Quad s = 1 + sqrt(o.x * o.x + o.y * o.y);
        const Quad k = (1 - a * a) * s * s / (s * s + a * a * o.z * o.z);
        const Quad t = sqrt(ax * ax * o.x * o.x + ay * ay * o.y * o.y + o.z * o.z);
        return D(unit(o + i)) / (2 * (k * o.z + t));
    }
};

// Density of what is drawn, against the reference at the very same value. left(value) is what a sum in it that cancels
// leaves of its terms, by which the error is multiplied.
template <class T, class S>
void check_drawn(Measured& measured, const S& strategy, std::int64_t random, auto reference, auto left) {
    for_each_uniform<T>(random, [&](const auto& u) {
        const auto sample = strategy.sample(u);
        measured.sample<T>(sample, strategy.pdf(sample.value));
        if (!(sample.pdf > 0)) return;
        measured.expect(std::abs(static_cast<double>(length(quad(sample.value)) - 1)) <=
                        4 * double{std::numeric_limits<T>::epsilon()});
        const Quad expected = reference(quad(sample.value));
        // Beyond the range of T there is no number to compare.
        if (expected < Quad{std::numeric_limits<T>::min()}) return;
        for (const T pdf : {sample.pdf, strategy.pdf(sample.value)}) {
            measured.density(pdf);
            measured.error(static_cast<double>(left(quad(sample.value)) * abs(Quad{pdf} - expected) / expected));
        }
    });
}

template <class T, class S>
void check_drawn(Measured& measured, const S& strategy, std::int64_t random, auto reference) {
    check_drawn<T>(measured, strategy, random, reference, [](const QuadVector&) { return Quad{1}; });
}

template <class T, class Visit>
void for_each_surface(Visit visit) {
    for_each_alpha<T>(
        [&](const auto& alpha) { for_each_cosine([&](double cosine) { visit(alpha, at_cosine<T>(cosine)); }); });
}

}  // namespace

template <class T>
Measured hemispheres(Effort effort) {
    Measured measured;
    const std::int64_t random = effort.of(2000);
    check_drawn<T>(measured, lumis::CosineHemisphere<T>{}, random,
                   [](const QuadVector& w) { return Quad{w.z / quad_pi}; });
    check_drawn<T>(measured, lumis::UniformHemisphere<T>{}, random,
                   [](const QuadVector&) { return 1 / (2 * quad_pi); });
    check_drawn<T>(measured, lumis::UniformSphere<T>{}, random, [](const QuadVector&) { return 1 / (4 * quad_pi); });
    const lumis::CosineHemisphere<T> cosine;
    for (const T u : corner_values<T>) measured.expect(cosine.sample({T(1), u}).pdf == 0);
    sweep(1e-9, 1, 9, [&](double depth) {
        const auto below = at_cosine<T>(-depth);
        measured.expect(cosine.pdf(below) == 0 && lumis::UniformHemisphere<T>{}.pdf(below) == 0);
    });
    return measured;
}

// A lobe may be narrower than the last place of a direction. Errors are multiplied by what is left of the terms of
// d = (1 - |g|)^2 + |g| |wi - peak|^2 when they change by such a place.
template <class T>
Measured phase_functions(Effort effort) {
    Measured measured;
    const auto check = [&](T g) {
        for (const auto& wo : {lumis::Direction<T>{T(0), T(0), T(-1)}, at_cosine<T>(0.6)}) {
            const QuadVector peak = Quad{g < 0 ? 1 : -1} * quad(wo);
            const Quad g_abs = abs(Quad{g}), a = 1 - g_abs, b = 1 + g_abs;
            const auto d = [&](const QuadVector& wi) -> Quad { return a * a + g_abs * dot(wi - peak, wi - peak); };
            check_drawn<T>(
                measured, lumis::HenyeyGreenstein<T>{wo, g}, effort.of(60),
                [&](const QuadVector& wi) -> Quad { return a * b / (4 * quad_pi * d(wi) * sqrt(d(wi))); },
                [&](const QuadVector& wi) -> Quad { return d(wi) / (d(wi) + 3 * g_abs * length(wi - peak)); });
        }
    };
    for (const T sign : {T(1), T(-1)}) {
        sweep(1e-6, 1, 6, [&](double rest) { check(sign * static_cast<T>(1 - rest)); });
        sweep(1e-30, 0.5, 6, [&](double g) { check(sign * static_cast<T>(g)); });
    }
    return measured;
}

template <class T>
Measured ggx_terms(Effort effort) {
    Measured measured;
    const int steps = effort.quick ? 6 : 24;
    for_each_surface<T>([&](const auto& alpha, const auto& wo) {
        const lumis::Ggx<T> ggx{alpha};
        const QuadGgx reference{alpha};
        const QuadVector o = quad(wo);
        measured.compare(ggx.G1(wo), reference.G1(o));
        if (const Quad lambda = reference.lambda(o); lambda > Quad{std::numeric_limits<T>::min()}) {
            measured.compare(ggx.lambda(wo), lambda);
            const T z = wo.z, x = ggx.alpha().x * wo.x, y = ggx.alpha().y * wo.y;
            measured.usual((-1 + std::sqrt(1 + (x * x + y * y) / (z * z))) / 2, lambda);
        }
        for (const double other : {1.0, 0.3, 1e-3, 1e-6}) {
            const auto wi = at_cosine<T>(other, 2.0);
            measured.compare(ggx.G2(wo, wi), reference.G2(o, quad(wi)));
        }
    });
    for_each_alpha<T>([&](const auto& alpha) {
        sweep(1e-9, 1.57, steps, [&](double theta) {
            for (const double phi : {0.0, 0.7, std::numbers::pi / 2}) {
                const auto wm = towards<T>(theta, phi);
                const Quad density = QuadGgx{alpha}.D(quad(wm));
                if (density > Quad{std::numeric_limits<T>::min()})
                    measured.compare(lumis::Ggx<T>{alpha}.D(wm), density);
            }
        });
    });
    return measured;
}

template <class T>
Measured ggx_normals(Effort effort) {
    Measured measured;
    for_each_alpha<T>([&](const auto& alpha) {
        check_drawn<T>(measured, lumis::GgxNdf<T>{alpha}, effort.of(60),
                       [&](const QuadVector& m) { return Quad{QuadGgx{alpha}.D(m) * m.z}; });
    });
    return measured;
}

template <class T>
Measured ggx_visible_normals(Effort effort) {
    Measured measured;
    for_each_surface<T>([&](const auto& alpha, const auto& wo) {
        check_drawn<T>(
            measured, lumis::GgxVndf<T>{wo, alpha}, effort.of(30),
            [&](const QuadVector& m) { return QuadGgx{alpha}.visible_normals(quad(wo), m); },
            [o = quad(wo)](const QuadVector& m) -> Quad {
                return abs(dot(o, m)) / (abs(o.x * m.x) + abs(o.y * m.y) + abs(o.z * m.z));
            });
    });
    return measured;
}

template <class T>
Measured ggx_reflection(Effort effort) {
    Measured measured;
    for_each_surface<T>([&](const auto& alpha, const auto& wo) {
        check_drawn<T>(measured, lumis::GgxReflection<T>{wo, alpha}, effort.of(30),
                       [&](const QuadVector& i) { return QuadGgx{alpha}.reflection(quad(wo), i); });
    });
    return measured;
}

template <class T>
Measured ggx_bounded_reflection(Effort effort) {
    Measured measured;
    for_each_surface<T>([&](const auto& alpha, const auto& wo) {
        check_drawn<T>(measured, lumis::GgxBoundedReflection<T>{wo, alpha}, effort.of(30),
                       [&](const QuadVector& i) { return QuadGgx{alpha}.bounded_reflection(quad(wo), i); });
    });
    return measured;
}

template <class T>
Measured ggx_nothing_to_draw(Effort) {
    Measured measured;
    const auto check = [&](const auto& strategy) {
        for_each_uniform<T>(20, [&](const auto& u) {
            const auto sample = strategy.sample(u);
            const T pdf = strategy.pdf(sample.value);
            measured.sample<T>(sample, pdf);
            measured.expect(sample.pdf == 0 && pdf == 0);
        });
    };
    const auto check_all = [&](const lumis::Direction<T>& wo, const glm::vec<2, T>& alpha) {
        check(lumis::GgxVndf<T>{wo, alpha});
        check(lumis::GgxReflection<T>{wo, alpha});
        check(lumis::GgxBoundedReflection<T>{wo, alpha});
        measured.expect(!is_finite(wo.z) || lumis::Ggx<T>{alpha}.G2(wo, wo) == 0);
    };
    constexpr T nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    for_each_alpha<T>([&](const auto& alpha) {
        sweep(1e-6, 1, 4, [&](double depth) { check_all(at_cosine<T>(-depth), alpha); });
        check_all({T(1), T(0), T(0)}, alpha);
        if (!measured.leaves_out<T>(nan)) check_all({nan, nan, nan}, alpha);
    });
    for (const T alpha : {T(-0.1), T(2e4), infinity, nan}) {
        if (measured.leaves_out<T>(alpha)) continue;
        check_all(at_cosine<T>(0.5), {alpha, T(0.5)});
        check_all(at_cosine<T>(0.5), {T(0.5), alpha});
        check(lumis::GgxNdf<T>{{alpha, alpha}});
    }
    return measured;
}

template Measured hemispheres<float>(Effort);
template Measured hemispheres<double>(Effort);
template Measured phase_functions<float>(Effort);
template Measured phase_functions<double>(Effort);
template Measured ggx_terms<float>(Effort);
template Measured ggx_terms<double>(Effort);
template Measured ggx_normals<float>(Effort);
template Measured ggx_normals<double>(Effort);
template Measured ggx_visible_normals<float>(Effort);
template Measured ggx_visible_normals<double>(Effort);
template Measured ggx_reflection<float>(Effort);
template Measured ggx_reflection<double>(Effort);
template Measured ggx_bounded_reflection<float>(Effort);
template Measured ggx_bounded_reflection<double>(Effort);
template Measured ggx_nothing_to_draw<float>(Effort);
template Measured ggx_nothing_to_draw<double>(Effort);

}  // namespace stability
