// Rough glass: how much it reflects and transmits, against quadrature over its normals; its density against Walter's
// formula; its laws as a material; and where there is nothing to draw.
#include "assertions.hpp"
#include "catch.hpp"
#include "dielectric_subjects.hpp"
#include "white_furnace.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/jacobian.hpp>
#include <lumis/testing/materials.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <random>
#include <string>

namespace {

namespace laws = lumis::testing;
using lumis::TransportMode;
using subjects::direction;
using subjects::Refracting;

// The amplitudes of Fresnel, squared and averaged, from the cosines on both sides.
template <class T>
T reflectance(T n_o, T cos_o, T n_i, T cos_i) {
    const T s = (n_o * cos_o - n_i * cos_i) / (n_o * cos_o + n_i * cos_i);
    const T p = (n_i * cos_o - n_o * cos_i) / (n_i * cos_o + n_o * cos_i);
    return (s * s + p * p) / 2;
}

// Shares of the power from wo by the textbook's formulas and quadrature over the normals. With wi scattered at wm, the
// integrand f |wi.z| dwi is G2 F (wo.wm) / (wo.z wm.z) times D wm.z dwm, and that last product is dr^2 dphi / (2 pi) in the
// disk that GGX stretches by alpha; z^2 = 1 - r^2.
struct Shares {
    double reflected, transmitted;
};
Shares albedo(const glm::dvec3& wo, const glm::dvec2& alpha, double eta) {
    using boost::math::quadrature::gauss_kronrod;
    using white_furnace::lambda;
    constexpr double pi = std::numbers::pi;
    const Refracting boundary{wo, eta};
    const double side = wo.z > 0 ? 1 : -1;
    const auto integrand = [&](double z, double phi, bool mirrors) {
        const double r = std::sqrt((1 - z) * (1 + z));
        const glm::dvec3 along{alpha.x * r * std::cos(phi), alpha.y * r * std::sin(phi), z};
        const glm::dvec3 wm = side * glm::normalize(along);
        const double cosine = glm::dot(wo, wm);
        if (!(cosine > 0)) return 0.0;
        const glm::dvec3 refracted = boundary.refracted(wm);
        const bool total = refracted == glm::dvec3{0};
        const double share = total ? 1 : reflectance(boundary.n_o, cosine, boundary.n_i, -glm::dot(refracted, wm));
        const glm::dvec3 wi = mirrors ? 2 * cosine * wm - wo : refracted;
        if (!((mirrors ? side : -side) * wi.z > 0)) return 0.0;
        const double lo = lambda(wo, alpha), li = lambda(wi, alpha);
        const double visible = mirrors ? share / (1 + lo + li) : (1 - share) / ((1 + lo) * (1 + li));
        return visible * cosine / std::abs(wo.z) * glm::length(along) * 2;
    };
    const auto integral = [&](bool mirrors) {
        const auto over_z = [&](double phi) {
            const auto at = [&](double z) { return integrand(z, phi, mirrors); };
            return gauss_kronrod<double, 31>::integrate(at, 0, 1, 6, 1e-6);
        };
        double sum = 0;  // in pieces, so that no symmetry can hide from the nodes
        for (int i = 0; i < 4; ++i)
            sum += gauss_kronrod<double, 31>::integrate(over_z, i * pi / 2, (i + 1) * pi / 2, 2, 1e-5);
        return sum / (2 * pi);
    };
    return {integral(true), integral(false)};
}

// The BSDF as the laws take it. rescaled: over the squared index of wo's side, which makes radiance reciprocal.
template <class T>
auto bsdf(const glm::dvec2& alpha, double eta, TransportMode mode, bool rescaled = false) {
    return [=](const glm::vec<3, T>& wo, const glm::vec<3, T>& wi) {
        const lumis::GgxDielectric<T> glass{wo, glm::vec<2, T>(alpha), static_cast<T>(eta)};
        const double index = rescaled && wo.z < 0 ? eta : 1;
        return glass.bsdf(wi, mode) / static_cast<T>(index * index);
    };
}

// Asked for the weight of the other kind of path.
template <class T>
struct CarriesPower : lumis::GgxDielectric<T> {
    T weight(const glm::vec<3, T>& wi) const { return lumis::GgxDielectric<T>::weight(wi, TransportMode::Importance); }
};

// The lobe that is drawn for one value of the third uniform, a strategy of two. The density of just this lobe is the whole
// one, over the probability of choosing it at that normal.
struct OneLobe {
    using Scalar = double;
    using Point = glm::dvec3;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    lumis::GgxDielectric<double> glass;
    Refracting boundary;
    bool mirrors;

    [[nodiscard]] lumis::Sample<glm::dvec3, double> sample(glm::dvec2 u) const {
        auto drawn = glass.sample({u.x, u.y, mirrors ? 0 : 1});
        if ((drawn.value.z * boundary.wo.z > 0) != mirrors) return {};  // for want of the other one
        return {drawn.value, pdf(drawn.value)};
    }
    [[nodiscard]] double pdf(const glm::dvec3& wi) const {
        const auto& b = boundary;
        const glm::dvec3 wm = mirrors ? glm::normalize(b.wo + wi) : b.normal(wi);
        const glm::dvec3 refracted = b.refracted(wm);
        if (refracted == glm::dvec3{0}) return mirrors ? glass.pdf(wi) : 0;
        const double share = reflectance(b.n_o, glm::dot(b.wo, wm), b.n_i, -glm::dot(refracted, wm));
        return glass.pdf(wi) / (mirrors ? share : 1 - share);
    }
};

}  // namespace

TEST_CASE("what rough glass reflects and transmits", "[ggx_dielectric]") {
    struct Row {
        double alpha, reflected, transmitted;
    };
    for (const auto& [alpha, reflected, transmitted] :
         {Row{0.1, 0.044267, 0.953458}, Row{0.3, 0.039561, 0.939081}, Row{0.5, 0.031173, 0.913867}}) {
        const auto shares = albedo(direction(0.8, 0.3), glm::dvec2{alpha}, 1.5);
        CHECK(std::abs(shares.reflected - reflected) <= 2e-6);
        CHECK(std::abs(shares.transmitted - transmitted) <= 2e-6);
    }
    for (const auto& [cosine, azimuth, alpha, eta] : subjects::GgxDielectric::cases) {
        const glm::dvec3 wo = direction(cosine, azimuth);
        INFO(subjects::label("wo ", wo, ", alpha ", alpha, ", eta ", eta));
        const auto chart = subjects::scattered_chart(wo, eta, subjects::normals_chart(alpha));
        const auto f = bsdf<double>(alpha, eta, TransportMode::Importance);
        const auto share = [&](double side) {
            const auto there = [&](const glm::dvec3& o, const glm::dvec3& i) {
                return side * o.z * i.z > 0 ? f(o, i) : 0.0;
            };
            return laws::conserves_energy(there, wo, chart, {.tolerance = 1e-5}).number;
        };
        const auto expected = albedo(wo, alpha, eta);
        CHECK(std::abs(share(1) - expected.reflected) <= 2e-5);
        CHECK(std::abs(share(-1) - expected.transmitted) <= 2e-5);
    }
}

TEMPLATE_TEST_CASE("rough glass is a material", "[ggx_dielectric]", float, double) {
    using T = TestType;
    for (const auto& [cosine, azimuth, alpha, eta] : subjects::GgxDielectric::cases) {
        const glm::dvec3 wo = direction(cosine, azimuth);
        INFO(subjects::label("wo ", wo, ", alpha ", alpha, ", eta ", eta));
        const auto chart = subjects::scattered_chart(wo, eta, subjects::normals_chart(alpha));
        const auto energy =
            laws::conserves_energy(bsdf<T>(alpha, eta, TransportMode::Importance), wo, chart, {.tolerance = 1e-5});
        INFO(energy.message);
        CHECK(energy.passed);
        // The direction's last place moves a narrow lobe; near the critical angle the transmittance as well.
        const double narrow = std::min({alpha.x, alpha.y, 1.0}) * std::min(1.0, std::abs(eta - 1));
        const double tolerance = 64 * double{std::numeric_limits<T>::epsilon()} / narrow;
        laws::ReciprocityOptions both{
            .tolerance = std::max(tolerance, laws::bsdf_tolerance<T>), .both_sides = true, .pairs = 3000};
        const auto reciprocal = laws::is_reciprocal(bsdf<T>(alpha, eta, TransportMode::Radiance, true), both);
        INFO(reciprocal.message);
        CHECK(reciprocal.passed);
    }
}

TEMPLATE_TEST_CASE("weights of rough glass are f cos / pdf, and bounded", "[ggx_dielectric]", float, double) {
    using T = TestType;
    for (const auto& [cosine, azimuth, alpha, eta] : subjects::GgxDielectric::cases) {
        const glm::dvec3 wo = direction(cosine, azimuth);
        INFO(subjects::label("wo ", wo, ", alpha ", alpha, ", eta ", eta));
        const lumis::GgxDielectric<T> glass{glm::vec<3, T>(wo), glm::vec<2, T>(alpha), static_cast<T>(eta)};
        const CarriesPower<T> power{glass};
        laws::WeightOptions options;
        options.samples = 2000;
        const auto f_cos = [&](TransportMode mode) {
            return [&glass, mode](const glm::vec<3, T>& wi) { return glass.bsdf(wi, mode) * std::abs(wi.z); };
        };
        const auto radiance = laws::weighs(glass, f_cos(TransportMode::Radiance), options);
        const auto importance = laws::weighs(power, f_cos(TransportMode::Importance), options);
        INFO(radiance.message << "; " << importance.message);
        CHECK(radiance.passed);
        CHECK(importance.passed);
        lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{3}};
        const double squeeze = cosine > 0 ? 1 / (eta * eta) : eta * eta,
                     slack = 1 + 4 * std::numeric_limits<T>::epsilon();
        for (int i = 0; i < 2000; ++i) {
            // Any direction, drawn or not.
            const auto drawn = glass.sample(uniforms.template next<3>()).value;
            const auto any = lumis::UniformSphere<T>{}.sample(uniforms.template next<2>()).value;
            for (const auto& wi : {drawn, any}) {
                const double weight = power.weight(wi), bound = cosine * double{wi.z} > 0 ? 1 : squeeze;
                REQUIRE((weight >= 0 && weight <= slack));
                REQUIRE(double{glass.weight(wi)} <= bound * slack);
                if (glass.pdf(wi) == 0) REQUIRE(weight == 0);
            }
        }
    }
}

TEST_CASE("the densities of both lobes are their maps' Jacobians", "[ggx_dielectric]") {
    for (const auto& [cosine, azimuth, alpha, eta] : subjects::GgxDielectric::cases) {
        const glm::dvec3 wo = direction(cosine, azimuth);
        for (const bool mirrors : {true, false}) {
            const OneLobe lobe{{wo, alpha, eta}, {wo, eta}, mirrors};
            // Half of the chart's points may lie beyond the critical angle's kink.
            const auto law = laws::jacobian(lobe, {.least_share = 0.5});
            INFO(subjects::label("wo ", wo, ", alpha ", alpha, ", eta ", eta, mirrors ? ", mirrored" : ", refracted"));
            INFO(law.message);
            CHECK(law.passed);
        }
    }
}

// Walter et al. 2007 as printed, eqs. 13 to 17 with 33 and Heitz's visible normals, in long double, at pairs of directions of which
// most are no refraction of each other.
TEMPLATE_TEST_CASE("the density of rough glass is Walter's", "[ggx_dielectric]", float, double) {
    using T = TestType;
    using V = glm::vec<3, long double>;
    using Long = long double;
    const auto walter = [](const V& o, const V& i, const glm::vec<2, Long>& alpha, Long eta) -> Long {
        const Long n_o = o.z > 0 ? 1 : eta, n_i = o.z > 0 ? eta : 1, side = o.z > 0 ? 1 : -1;
        const bool mirrors = o.z * i.z > 0;
        V m = mirrors ? V{glm::normalize(o + i)} : V{-glm::normalize(n_o * o + n_i * i)};
        if (m.z * side < 0) m = -m;
        const Long om = glm::dot(o, m), im = glm::dot(i, m);
        if (om <= 0 || (mirrors ? im <= 0 : im >= 0)) return 0;
        const Long x = m.x / alpha.x, y = m.y / alpha.y, s = x * x + y * y + m.z * m.z;
        const Long D = 1 / (std::numbers::pi_v<Long> * alpha.x * alpha.y * s * s);
        const Long ox = alpha.x * o.x / o.z, oy = alpha.y * o.y / o.z;
        const Long visible = 2 / (1 + std::sqrt(1 + ox * ox + oy * oy)) * om * D / std::abs(o.z);
        const Long square = 1 - (n_o / n_i) * (n_o / n_i) * (1 - om * om);
        const Long share = square > 0 ? reflectance<Long>(n_o, om, n_i, std::sqrt(square)) : 1;
        if (mirrors) return share * visible / (4 * om);
        const Long divisor = n_i * im + n_o * om;
        return (1 - share) * visible * n_i * n_i * -im / (divisor * divisor);
    };
    lumis::Uniforms<std::mt19937_64, double> uniforms{std::mt19937_64{5}};
    const T epsilon = std::numeric_limits<T>::epsilon();
    int refracted = 0;
    for (const double eta : {1.5, 1 / 1.5, 1.1, 2.4}) {
        for (int k = 0; k < 4000; ++k) {
            const auto u = uniforms.next<4>();
            const glm::vec<2, T> alpha{T(0.3), T(0.7)};
            const glm::vec<3, T> wo(lumis::direction_at(2 * u.x, u.y)), wi(lumis::direction_at(2 * u.z, u.w));
            const T pdf = lumis::GgxDielectric<T>{wo, alpha, static_cast<T>(eta)}.pdf(wi);
            // Near the critical angle, and where a normal is seen edge-on, rounding of the directions moves the density.
            Long low = std::numeric_limits<Long>::infinity(), high = 0;
            laws::detail::for_each_neighbour(wi, 8 * epsilon, [&](const auto& neighbour) {
                const Long expected = walter(V{wo}, V{neighbour}, glm::vec<2, Long>{alpha}, static_cast<T>(eta));
                low = std::min(low, expected), high = std::max(high, expected);
            });
            refracted += high > 0 && wo.z * wi.z < 0;
            INFO(subjects::label("wo ", wo, ", wi ", wi, ", eta ", eta, ": ", pdf, ", expected ",
                                 static_cast<double>(low), " to ", static_cast<double>(high)));
            REQUIRE((pdf >= low * (1 - 64 * epsilon) && pdf <= high * (1 + 64 * epsilon)));
        }
    }
    CHECK(refracted >= 500);
}

TEMPLATE_TEST_CASE("where a boundary is none, or wo lies in it, nothing is drawn", "[ggx_dielectric]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const auto draws_nothing = [](const lumis::GgxDielectric<T>& glass) {
        lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{4}};
        for (int i = 0; i < 200; ++i) {
            const auto drawn = glass.sample(uniforms.template next<3>());
            const auto any = lumis::UniformSphere<T>{}.sample(uniforms.template next<2>()).value;
            REQUIRE(drawn.pdf == 0);
            REQUIRE((glass.pdf(any) == 0 && glass.bsdf(any) == 0 && glass.weight(any) == 0));
        }
    };
    const V wo{T(0.6), 0, T(0.8)};
    for (const T eta : {T(0), T(-1.5), T(1e5), T(1e-5), std::numeric_limits<T>::infinity()})
        draws_nothing({wo, T(0.3), eta});
    draws_nothing({wo, T(-0.3), T(1.5)});
    draws_nothing({V{1, 0, 0}, T(0.3), T(1.5)});
    // The indices are the same: all passes straight, into one direction.
    const lumis::GgxDielectric<T> none{wo, T(0.3), T(1)};
    CHECK(none.sample({T(0.3), T(0.4), T(0.5)}).pdf == 0);
    CHECK((none.pdf(-wo) == 0 && none.bsdf(-wo) == 0 && none.weight(-wo) == 0));
    const CaughtAssertions caught;
    const T nan = std::numeric_limits<T>::quiet_NaN();
    draws_nothing({wo, T(0.3), nan});
    draws_nothing({V{nan, 0, 1}, T(0.3), T(1.5)});
    CHECK(caught.count() > 0);
}

// The direction decides on the scalar.
static_assert(std::same_as<decltype(lumis::GgxDielectric{lumis::Direction<float>{}, glm::vec2{0.1f, 0.2f}, 1.5}),
                           lumis::GgxDielectric<float>>);

TEMPLATE_TEST_CASE("rough glass in a frame and in a mixture", "[ggx_dielectric]", float, double) {
    using T = TestType;
    const lumis::GgxDielectric<T> glass{glm::vec<3, T>(direction(-0.8, 1)), 0.3, 1.5};
    const lumis::Frame<T> frame{glm::vec<3, T>(glm::normalize(glm::dvec3{1, -2, 0.5}))};
    const auto framed = lumis::in_frame(frame, glass);
    const lumis::Mixture mixture{lumis::choose(0.5, glass), lumis::choose(0.5, lumis::UniformSphere<T>{})};
    laws::AgreementOptions options;
    options.samples = 1000;
    options.rounding = 16;
    options.length = 6;
    for (const auto& law : {laws::agreement(framed, options), laws::agreement(mixture, options)}) {
        INFO(law.message);
        CHECK(law.passed);
    }
}

TEMPLATE_TEST_CASE("nearly smooth glass scatters as smooth glass does", "[ggx_dielectric]", float, double) {
    using T = TestType;
    for (const double cosine : {0.8, -0.9, -0.5}) {
        const glm::vec<3, T> wo(direction(cosine, 1));
        const lumis::GgxDielectric rough{wo, 1e-4, 1.5};
        const lumis::SmoothDielectric smooth{wo, 1.5};
        for (const T choice : {T(0), T(0.5), T(0.99)}) {
            const glm::vec<3, T> u{T(0.2), T(0.3), choice};
            const auto a = rough.sample(u), b = smooth.sample(u);
            REQUIRE(glm::length(a.value - b.value) <= T(1e-3));
            CHECK(rough.weight(a.value) * b.pdf == Approx(smooth.coefficient(b.value)).epsilon(1e-3));
            CHECK(rough.weight(a.value, TransportMode::Importance) == Approx(1).epsilon(1e-6));
        }
    }
}
