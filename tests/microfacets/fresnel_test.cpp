// Fresnel's equations against the textbook's in long double, their averages over the hemisphere, and where they are extreme:
// hardly any boundary, grazing light, the critical angle.
#include "catch.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/microfacets/fresnel.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace {

using Long = long double;
using Complex = std::complex<Long>;

// The amplitudes (n_i cos_i - n_t cos_t) / (n_i cos_i + n_t cos_t) and so on, for any index. eta is that of the other side.
Long textbook(Long cos_i, Complex eta) {
    const Complex cos_t = std::sqrt((eta - 1.0L) * (eta + 1.0L) + cos_i * cos_i) / eta;
    const Complex s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t), p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return (std::norm(s) + std::norm(p)) / 2;
}

// How much a cosine's last place moves the reflectance, which has a vertical tangent at the critical angle, and what the
// differences lose in long double.
template <class T>
Long rounding(Long cos_i, Complex eta) {
    const Long step = cos_i * std::numeric_limits<T>::epsilon(), middle = textbook(cos_i, eta);
    const Long lost = 16 * std::numeric_limits<Long>::epsilon() * std::sqrt(middle);
    return std::abs(textbook(cos_i + step, eta) - textbook(cos_i - step, eta)) + lost;
}

template <class T>
constexpr T ulps(T n) {
    return n * std::numeric_limits<T>::epsilon();
}

}  // namespace

TEMPLATE_TEST_CASE("the reflectance of a dielectric is the textbook's", "[fresnel]", float, double) {
    using T = TestType;
    // 1 + 1e-5 and its like hardly reflect: the textbook's amplitudes, formed in T, have no digit there.
    for (const T eta : {T(1.5), T(1 / 1.5), T(1.33), T(2.4), T(1 / 2.4), T(1.01), T(1 + 1e-5), T(1 - 1e-5), T(0.2),
                        T(0.01), T(1e-3), T(1e3)}) {
        for (const T cosine :
             {T(1), T(0.9999999), T(0.9999), T(0.999), T(0.8), T(0.7453), T(0.5), T(0.1), T(1e-3), T(1e-6)}) {
            INFO("eta " << eta << ", cosine " << cosine);
            const Long expected = textbook(cosine, Complex{eta}), loose = rounding<T>(cosine, Complex{eta});
            const T reflectance = lumis::fresnel_dielectric(cosine, eta);
            CHECK(std::abs(reflectance - expected) <= ulps<T>(8) * expected + 2 * loose);
            const auto shares = lumis::fresnel_shares(cosine, eta);
            CHECK(shares.reflected == reflectance);
            CHECK(std::abs(shares.reflected + shares.transmitted - 1) <= ulps<T>(4) + T(2 * loose));
            CHECK(shares.cos_t >= 0);
            const Long sine_t = std::sqrt((1 - Long{cosine}) * (1 + Long{cosine})) / Long{eta};
            const Long cos_t = sine_t < 1 ? std::sqrt((1 - sine_t) * (1 + sine_t)) : 0.0L;
            CHECK(std::abs(shares.cos_t - cos_t) <= std::sqrt(Long{ulps<T>(8)}) * (1 - cos_t) + ulps<T>(8));
            if (expected >= 1) CHECK((shares.reflected == 1 && shares.transmitted == 0 && shares.cos_t == 0));
        }
    }
}

// 1 - F has an error of one place of 1, which is all of it at grazing.
TEMPLATE_TEST_CASE("what a dielectric lets through at grazing keeps its digits", "[fresnel]", float, double) {
    using T = TestType;
    for (const T eta : {T(1.5), T(2.4), T(1.01)}) {
        for (const T cosine : {T(1e-3), T(1e-6), T(1e-9)}) {
            // 1 - r^2 of amplitudes that are near -1 is (1 - r) (1 + r).
            const Long c = cosine, n = eta, t = std::sqrt(n * n - 1 + c * c) / n;
            const Long s = 4 * c * n * t / ((c + n * t) * (c + n * t)), p = 4 * c * n * t / ((n * c + t) * (n * c + t));
            CHECK(std::abs(lumis::fresnel_shares(cosine, eta).transmitted - (s + p) / 2) <= ulps<T>(16) * (s + p));
        }
    }
}

TEMPLATE_TEST_CASE("light from below meets the reciprocal index", "[fresnel]", float, double) {
    using T = TestType;
    for (const T cosine : {T(1), T(0.8), T(0.3), T(0.01)}) {
        CHECK(lumis::fresnel_dielectric(-cosine, T(2)) == lumis::fresnel_dielectric(cosine, T(0.5)));
        CHECK(lumis::fresnel_shares(-cosine, T(0.5)).cos_t == lumis::fresnel_shares(cosine, T(2)).cos_t);
    }
    CHECK(lumis::fresnel_dielectric(T(1), T(1.5)) == Approx(0.04).epsilon(1e-6));
    CHECK(lumis::fresnel_dielectric(T(-1), T(1.5)) == Approx(0.04).epsilon(1e-6));
    CHECK(lumis::fresnel_dielectric(T(-0.7), T(1.5)) == 1);  // beyond the critical angle, of cosine 0.745
    for (const T cosine : {T(1), T(0.5), T(0), T(-0.5)}) CHECK(lumis::fresnel_dielectric(cosine, T(1)) == 0);
    for (const T eta : {T(1.5), T(0.5), T(1e4)}) CHECK(lumis::fresnel_dielectric(T(0), eta) == Approx(1));
    // Light along the boundary, the square of whose cosine is no normal number.
    const T along = std::sqrt(std::numeric_limits<T>::min()) / 4;
    for (const T eta : {T(1), T(1.5), T(0.5), 1 - std::numeric_limits<T>::epsilon()}) {
        const auto shares = lumis::fresnel_shares(along, eta);
        CHECK((shares.reflected >= 0 && shares.reflected <= 1 && shares.transmitted >= 0 && shares.transmitted <= 1));
        CHECK((lumis::fresnel_conductor(along, eta, along) >= 0 && lumis::fresnel_conductor(along, eta, along) <= 1));
    }
}

TEST_CASE("the average reflectance of glass", "[fresnel]") {
    using boost::math::quadrature::gauss_kronrod;
    const auto average = [](double eta, double side) {
        const auto weighted = [&](double mu) { return 2 * mu * lumis::fresnel_dielectric(side * mu, eta); };
        // The kink of light from below is at the critical angle.
        const double critical = side < 0 ? std::sqrt(1 - 1 / (eta * eta)) : 0;
        const auto substituted = [&](double x) { return weighted(critical + (1 - critical) * x * x) * 2 * x; };
        return critical * critical +
               (1 - critical) * gauss_kronrod<double, 61>::integrate(substituted, 0, 1, 15, 1e-12);
    };
    CHECK(std::abs(average(1.5, 1) - 0.09177796) <= 5e-9);
    CHECK(std::abs(average(1.5, -1) - 0.59634576) <= 5e-9);
}

TEMPLATE_TEST_CASE("the reflectance of a conductor is the textbook's", "[fresnel]", float, double) {
    using T = TestType;
    struct Index {
        double eta, k;
    };
    // Silver, gold and copper at 600 nm or so, iron, hardly a conductor, hardly a boundary, and dielectrics.
    for (const auto& [eta, k] : {Index{0.05, 4.0}, Index{0.25, 3.0}, Index{2.9, 3.0}, Index{1.5, 1e-3}, Index{1, 1e-3},
                                 Index{1, 1e-6}, Index{1.5, 0}, Index{1.01, 0}, Index{1 / 1.5, 0}, Index{1e-3, 20}}) {
        for (const T cosine : {T(1), T(0.8), T(0.5), T(0.1), T(1e-3)}) {
            INFO("eta " << eta << ", k " << k << ", cosine " << cosine);
            const Complex index{static_cast<T>(eta), static_cast<T>(k)};
            const Long expected = textbook(cosine, index), loose = rounding<T>(cosine, index);
            const T reflectance = lumis::fresnel_conductor(cosine, static_cast<T>(eta), static_cast<T>(k));
            CHECK(std::abs(reflectance - expected) <= ulps<T>(16) * expected + 2 * loose);
        }
    }
}

TEMPLATE_TEST_CASE("Fresnel's equations in lanes are those of numbers", "[fresnel]", float, double) {
    using T = TestType;
    using L = lumis::Lanes<T, 4>;
    const T cosines[] = {T(1), T(-0.8), T(0.3), T(-0.5)}, etas[] = {T(1.5), T(1.5), T(0.7), T(1)};
    const auto shares = lumis::fresnel_shares(L::load(cosines), L::load(etas));
    const L conductor = lumis::fresnel_conductor(L::load(cosines), L::load(etas), L{T(3)});
    for (std::size_t i = 0; i < 4; ++i) {
        const auto one = lumis::fresnel_shares(cosines[i], etas[i]);
        CHECK(std::abs(shares.reflected[i] - one.reflected) <= ulps<T>(8));
        CHECK(std::abs(shares.transmitted[i] - one.transmitted) <= ulps<T>(8));
        CHECK(std::abs(shares.cos_t[i] - one.cos_t) <= ulps<T>(8));
        CHECK(std::abs(conductor[i] - lumis::fresnel_conductor(cosines[i], etas[i], T(3))) <= ulps<T>(8));
    }
}
