// Smooth glass: Snell's directions, Fresnel's probabilities, and what a path through a boundary carries.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/delta.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

namespace {

namespace laws = lumis::testing;
using lumis::TransportMode;

template <class T>
glm::vec<3, T> direction(double cosine, double azimuth = 0.4) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    return glm::vec<3, T>{glm::dvec3{sine * std::cos(azimuth), sine * std::sin(azimuth), cosine}};
}

template <class T>
constexpr glm::vec<3, T> least{T(0.3), T(0.4), T(0)};
template <class T>
constexpr glm::vec<3, T> greatest{T(0.3), T(0.4), T(1)};

}  // namespace

TEMPLATE_TEST_CASE("smooth glass mirrors and refracts", "[smooth_dielectric]", float, double) {
    using T = TestType;
    const double tolerance = 4 * double{std::numeric_limits<T>::epsilon()};
    for (const double eta : {1.5, 1 / 1.5, 1.01, 2.4, 100.0}) {
        for (const double cosine : {1.0, 0.8, 0.3, 1e-3, -1.0, -0.9, -0.5, -1e-3}) {
            INFO("eta " << eta << ", cosine " << cosine);
            const auto wo = direction<T>(cosine);
            const lumis::SmoothDielectric<T> glass{wo, eta};
            const double relative = cosine > 0 ? static_cast<T>(eta) : 1 / double{static_cast<T>(eta)};
            CHECK(laws::draws_deltas(glass, 100).passed);
            // cos^2 - (1 - eta^2) cancels where eta is small.
            CHECK(std::abs(glass.reflectance() + glass.transmittance() - 1) <=
                  tolerance * (1 + 1 / (relative * relative)));
            CHECK(glass.reflectance() == Approx(lumis::fresnel_dielectric(wo.z, T(eta))).epsilon(1e-5));

            const auto mirrored = glass.sample(least<T>);
            CHECK(mirrored.value == glm::vec<3, T>{-wo.x, -wo.y, wo.z});
            CHECK(mirrored.pdf == glass.reflectance());
            CHECK(glass.coefficient(mirrored.value) == mirrored.pdf);

            const double sine = std::hypot(double{wo.x}, double{wo.y}) / relative;
            const auto other = glass.sample(greatest<T>);
            if (sine >= 1) {  // all is reflected
                CHECK(other.value == mirrored.value);
                CHECK((glass.reflectance() == 1 && glass.transmittance() == 0));
                continue;
            }
            CHECK(std::abs(other.value.x + wo.x / relative) <= tolerance);
            CHECK(std::abs(other.value.y + wo.y / relative) <= tolerance);
            CHECK(other.value.z * wo.z < 0);
            CHECK(std::abs(std::abs(other.value.z) - std::sqrt((1 - sine) * (1 + sine))) <= 4 * tolerance);
            CHECK(other.pdf == glass.transmittance());
            CHECK(glass.coefficient(other.value, TransportMode::Importance) == other.pdf);
            CHECK(glass.coefficient(other.value) == Approx(other.pdf / (relative * relative)).epsilon(1e-5));
            // The way back meets the same boundary, as far as the refracted direction has digits left for the angle.
            if (eta > 3 || std::abs(cosine) < 0.1) continue;
            const lumis::SmoothDielectric<T> back{other.value, eta};
            CHECK(back.transmittance() == Approx(glass.transmittance()).epsilon(1e-3));
        }
    }
}

// Under a sky of radiance 1 the power that arrives is 1, whichever lobe it leaves by; radiance that has entered and left a
// pane is what it was, less what was reflected.
TEMPLATE_TEST_CASE("estimates through smooth glass", "[smooth_dielectric]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const auto wo = direction<T>(0.6);
    const lumis::SmoothDielectric<T> pane{wo, 1.5};
    const auto one = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, pane));
    lumis::Uniforms<std::mt19937, T> uniforms{std::mt19937{1}};
    int refracted = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto power = [&](const V& wi, lumis::delta_t) {
            refracted += wi.z < 0;
            return pane.coefficient(wi, TransportMode::Importance);
        };
        REQUIRE(one.estimate(power, uniforms) == Approx(1));
    }
    CHECK(std::abs(refracted / 1000.0 - double{pane.transmittance()}) <= 0.05);

    const auto inside = pane.sample(greatest<T>);
    const lumis::SmoothDielectric<T> exit{-inside.value, 1 / 1.5};  // its own normal points inwards
    const auto outside = exit.sample(greatest<T>);
    CHECK(pane.coefficient(inside.value) * exit.coefficient(outside.value) ==
          Approx(pane.transmittance() * exit.transmittance()));
    CHECK(glm::length(outside.value + wo) <= T(1e-6));
}

TEMPLATE_TEST_CASE("a boundary between equal media lets all pass straight", "[smooth_dielectric]", float, double) {
    using T = TestType;
    for (const double cosine : {1.0, 0.3, -0.01}) {
        const auto wo = direction<T>(cosine);
        const lumis::SmoothDielectric<T> none{wo, 1};
        CHECK(none.reflectance() == 0);
        CHECK(none.sample(least<T>).pdf == Approx(1));
        CHECK(glm::length(none.sample(least<T>).value + wo) <= 1e-5);
    }
}

TEMPLATE_TEST_CASE("smooth glass of nothing to draw", "[smooth_dielectric]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const auto draws_nothing = [](const lumis::SmoothDielectric<T>& glass) {
        for (const auto& u : {least<T>, greatest<T>}) {
            const auto drawn = glass.sample(u);
            CHECK(drawn.pdf == 0);
            CHECK(std::isfinite(drawn.value.x + drawn.value.y + drawn.value.z));
            CHECK(glass.coefficient(drawn.value) == 0);
        }
    };
    draws_nothing({V{1, 0, 0}, 1.5});
    for (const T eta : {T(0), T(-1), T(1e-5), T(1e5), std::numeric_limits<T>::infinity()})
        draws_nothing({direction<T>(0.5), eta});
    const CaughtAssertions caught;
    const T nan = std::numeric_limits<T>::quiet_NaN();
    draws_nothing({direction<T>(0.5), nan});
    draws_nothing({V{nan, 0, 1}, 1.5});
    CHECK(caught.count() > 0);
}
