// The law of coverage refuses strategies that leave a part of their integrand out, which agree with themselves on that.
#include "broken.hpp"
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace {

// Draws the half of the hemisphere on which x > 0, by twice the cosine.
struct HalfCosine {
    using Scalar = double;
    using Point = V;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    lumis::Sample<V, double> sample(glm::dvec2 u) const noexcept {
        auto w = Cosine{}.sample(u).value;
        w.x = std::abs(w.x);
        return {w, pdf(w)};
    }
    double pdf(const V& w) const noexcept { return w.x > 0 ? 2 * Cosine{}.pdf(w) : 0.0; }
};

constexpr auto lambert = [](const V& w) { return std::fmax(w.z, 0) * std::numbers::inv_pi; };

}  // namespace

TEST_CASE("only coverage refuses half a lobe", "[laws]") {
    const HalfCosine half;
    CHECK(laws::agreement(half).passed);
    CHECK(laws::integrates(half, laws::sphere_chart(), {.tolerance = 1e-4}).passed);
    CHECK(laws::chi_square(half).passed);
    CHECK(laws::stays_finite(half).passed);
    const auto law = laws::covers(half, lambert);
    INFO(law);
    CHECK_FALSE(law.passed);
    CHECK(law.decided);
    CHECK(std::abs(law.number - 0.5) <= 0.01);
    CHECK(law.message.find("density 0 at (-0.") == 0);
    CHECK(law.message.find("% of the integrand") != std::string::npos);
    CHECK(laws::covers(Cosine{}, lambert).passed);
    CHECK(laws::covers(half, [](const V& w) { return w.x > 0 ? lambert(w) : 0; }).passed);
}

TEST_CASE("coverage refuses", "[laws]") {
    // A cone that leaves out what is below 3 degrees: a thousandth of the cosine.
    const auto narrowed = consistently_broken(Cosine{}, [](const V& w, double pdf) { return w.z < 0.05 ? 0 : pdf; });
    CHECK_FALSE(laws::covers(narrowed, lambert).passed);
    CHECK(laws::covers(narrowed, [](const V& w) { return w.z > 0.05; }).passed);
    CHECK_FALSE(laws::covers(Cosine{}, laws::everywhere).passed);
    CHECK(laws::covers(lumis::UniformSphere<float>{}, laws::everywhere).passed);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(
        laws::covers(consistently_broken(Cosine{}, [nan](const V& w, double pdf) { return w.x > 0.9 ? nan : pdf; }),
                     lambert)
            .passed);
    // One component of a colour is enough.
    CHECK_FALSE(laws::covers(HalfCosine{}, [](const V& w) { return glm::vec3{0, 0, w.z > 0 && w.x < -0.1}; }).passed);

    // One texel and one light of many.
    std::vector<double> texels(64 * 32, 1.0);
    const auto chart = laws::latlong_chart(64, 32);
    CHECK(laws::covers(lumis::EnvironmentMap{64, 32, texels}, laws::everywhere, chart).passed);
    texels[700] = 0;
    CHECK_FALSE(laws::covers(lumis::EnvironmentMap{64, 32, texels}, laws::everywhere, chart).passed);
    std::vector<double> powers(1000, 1e-9);
    powers[5] = 1;
    CHECK(laws::covers(lumis::AliasTable{powers}, laws::everywhere, laws::index_chart(1000)).passed);
    powers[6] = 0;
    const auto law = laws::covers(lumis::AliasTable{powers}, laws::everywhere, laws::index_chart(1000));
    CHECK_FALSE(law.passed);
    CHECK(law.message.find("density 0 at 6") == 0);
    CHECK(std::abs(law.number - 0.001) <= 1e-12);
}

TEST_CASE("coverage of an integrand that is 0 all over the chart is undecided", "[laws]") {
    const auto law = laws::covers(Cosine{}, [](const V&) { return 0.0; });
    CHECK_FALSE(law.passed);
    CHECK_FALSE(law.decided);
}
