// Hemispheres, GGX and dielectrics: densities and what they are made of.
#include "cases.hpp"
#include "directions.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
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
// leaves of its terms, by which the error is multiplied. third: the uniform behind the two that vary, if there is one.
template <class T, class S>
void check_drawn(Measured& measured, const S& strategy, std::int64_t random, auto reference, auto left,
                 std::same_as<T> auto... third) {
    for_each_uniform<T>(random, [&](const auto& u) {
        const auto sample = strategy.sample({u.x, u.y, third...});
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

// Fresnel's amplitudes, from the indices and cosines on both sides.
struct QuadFresnel {
    Quad reflected, transmitted;

    QuadFresnel(const Quad& n_o, const Quad& cos_o, const Quad& n_i, const Quad& cos_i) {
        const Quad s = (n_o * cos_o - n_i * cos_i) / (n_o * cos_o + n_i * cos_i);
        const Quad p = (n_i * cos_o - n_o * cos_i) / (n_i * cos_o + n_o * cos_i);
        reflected = (s * s + p * p) / 2;
        transmitted = 1 - reflected;
    }
};

// Walter et al. 2007, eqs. 13 to 17, of visible normals. eta: the index below the surface over the one above.
template <class T>
struct QuadDielectric {
    QuadGgx ggx;
    QuadVector o;
    Quad side, n_o, n_i;

    QuadDielectric(const lumis::Direction<T>& wo, glm::vec<2, T> alpha, T eta)
        : ggx{alpha}, o{quad(wo)}, side{wo.z > 0 ? 1 : -1}, n_o{wo.z > 0 ? T(1) : eta}, n_i{wo.z > 0 ? eta : T(1)} {}

    [[nodiscard]] QuadVector normal(const QuadVector& i) const {
        const QuadVector along = mirrors(i) ? o + i : n_o * o + n_i * i;
        return ((along.z * side > 0 ? 1 : -1) / length(along)) * along;
    }
    [[nodiscard]] bool mirrors(const QuadVector& i) const { return o.z * i.z > 0; }
    // The squared cosine of the refracted ray, times n_i^2.
    [[nodiscard]] Quad square(const Quad& cos_o) const { return n_i * n_i - n_o * n_o * (1 - cos_o * cos_o); }

    // The cosine of a mirrored pair is half of the length of its sum. A dot product with the normal tells at grazing how far the
    // directions are from unit length.
    [[nodiscard]] Quad density(const QuadVector& i) const {
        if (mirrors(i)) {
            const Quad om = length(o + i) / 2, turned = square(om);
            const Quad share = turned > 0 ? QuadFresnel{n_o, om, n_i, sqrt(turned) / n_i}.reflected : Quad{1};
            return share * ggx.reflection(side * o, side * i);
        }
        const QuadVector m = normal(i);
        const Quad om = dot(o, m), im = dot(i, m), divisor = n_o * om + n_i * im;
        return QuadFresnel{n_o, om, n_i, -im}.transmitted * ggx.visible_normals(side * o, side * m) * n_i * n_i * -im /
               (divisor * divisor);
    }

    // What sums that cancel leave of their terms. Mirrored: the squared cosine of the refracted ray near the critical angle.
    // Refracted: the half vector's own components, over the lobe's width, and the cosines that are formed with it.
    [[nodiscard]] Quad left(const QuadVector& i) const {
        if (mirrors(i)) {
            const Quad om = length(o + i) / 2;
            return abs(square(om)) / (n_o * n_o * om * om + abs(n_i * n_i - n_o * n_o));
        }
        const QuadVector half = n_o * o + n_i * i;
        const auto terms_of = [&](const Quad& x, const Quad& y) -> Quad {
            return abs(x + y) + abs((n_o - 1) * x) + abs((n_i - 1) * y);
        };
        const QuadVector terms{terms_of(o.x, i.x), terms_of(o.y, i.y), terms_of(o.z, i.z)};
        const auto of_sum = [&](const QuadVector& w) -> Quad {
            return abs(dot(w, half)) / (abs(w.x) * terms.x + abs(w.y) * terms.y + abs(w.z) * terms.z);
        };
        const Quad narrowest = std::min({ggx.ax, ggx.ay, Quad{1}});
        return of_sum(o) * of_sum(i) * narrowest * length(half) / (terms.x + terms.y + terms.z);
    }
};

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
Measured fresnel(Effort effort) {
    Measured measured;
    const auto check = [&](T cosine, T eta) {
        const Quad c{cosine}, n{eta}, turned = n * n - 1 + c * c;
        const auto shares = lumis::fresnel_shares(cosine, eta);
        if (!(turned > 0)) return measured.expect(shares.reflected == 1 && shares.transmitted == 0);
        const QuadFresnel expected{1, c, n, sqrt(turned) / n};
        const double left = static_cast<double>(turned / (c * c + abs(n * n - 1)));
        const auto compare = [&](T share, const Quad& reference) {
            measured.density(share);
            measured.error(left * static_cast<double>(abs(Quad{share} - reference) / reference));
        };
        compare(shares.transmitted, expected.transmitted);
        measured.usual(1 - shares.reflected, expected.transmitted);
        if (eta == 1) return measured.expect(shares.reflected == 0);
        compare(shares.reflected, expected.reflected);
        const T cos_t = static_cast<T>(sqrt(turned) / n);
        const T s = (cosine - eta * cos_t) / (cosine + eta * cos_t),
                p = (eta * cosine - cos_t) / (eta * cosine + cos_t);
        measured.usual((s * s + p * p) / 2, expected.reflected);
    };
    sweep(1e-6, 100, effort.quick ? 8 : 32, [&](double excess) {
        for (const double eta : {1 + excess, 1 / (1 + excess), 1.0}) {
            sweep(1e-6, 1, effort.quick ? 8 : 32,
                  [&](double cosine) { check(static_cast<T>(cosine), static_cast<T>(eta)); });
            const double critical = eta < 1 ? std::sqrt((1 - eta) * (1 + eta)) : 0;
            for (const double beside : {-1e-3, -1e-6, 1e-6, 1e-3}) {
                if (critical > 0) check(static_cast<T>(std::min(critical * (1 + beside), 1.0)), static_cast<T>(eta));
            }
        }
    });
    return measured;
}

template <class T>
Measured ggx_dielectric(Effort effort) {
    Measured measured;
    // 1 + 2^-20 hardly bends: float has the lobe on a few of its directions.
    for (const double eta : {1.5, 1 / 2.4, 1.01, 1 + 0x1p-20}) {
        for (const glm::dvec2 alpha : {glm::dvec2{1e-4, 1e-4}, {1e-3, 0.5}, {0.1, 0.1}, {1, 1}}) {
            const glm::vec<2, T> own_alpha{alpha};
            const T own_eta = static_cast<T>(eta);
            for_each_cosine([&](double cosine) {
                for (const double side : {1.0, -1.0}) {
                    const auto wo = at_cosine<T>(side * cosine);
                    const lumis::GgxDielectric<T> glass{wo, own_alpha, own_eta};
                    const QuadDielectric<T> reference{wo, own_alpha, own_eta};
                    // One lobe, where it is drawn at all.
                    for (const T choice : {T(0), T(1)}) {
                        check_drawn<T>(
                            measured, glass, effort.of(10), [&](const QuadVector& i) { return reference.density(i); },
                            [&](const QuadVector& i) { return reference.left(i); }, choice);
                    }
                }
            });
        }
    }
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
    const auto check_glass = [&](const lumis::Direction<T>& wo, const glm::vec<2, T>& alpha, T eta) {
        const lumis::GgxDielectric<T> glass{wo, alpha, eta};
        for_each_uniform<T>(20, [&](const auto& u) {
            for (const T choice : {T(0), T(1)}) {
                const auto sample = glass.sample({u.x, u.y, choice});
                measured.sample<T>(sample, glass.pdf(sample.value));
                measured.expect(sample.pdf == 0 && glass.pdf(sample.value) == 0);
            }
        });
    };
    for (const T bad : {T(-1.5), T(0), T(2e4), infinity, nan}) {
        if (measured.leaves_out<T>(bad)) continue;
        check_glass(at_cosine<T>(-0.5), {T(0.5), T(0.5)}, bad);
    }
    check_glass({T(1), T(0), T(0)}, {T(0.5), T(0.5)}, T(1.5));
    check_glass(at_cosine<T>(0.5), {T(-0.5), T(0.5)}, T(1.5));
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
template Measured fresnel<float>(Effort);
template Measured fresnel<double>(Effort);
template Measured ggx_dielectric<float>(Effort);
template Measured ggx_dielectric<double>(Effort);
template Measured ggx_nothing_to_draw<float>(Effort);
template Measured ggx_nothing_to_draw<double>(Effort);

}  // namespace stability
