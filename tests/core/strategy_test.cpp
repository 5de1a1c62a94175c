#include "assertions.hpp"
#include "catch.hpp"
#include "one_dimensional.hpp"
#include <lumis/core/measure.hpp>
#include <lumis/core/sample.hpp>
#include <lumis/core/strategy.hpp>
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace {

template <template <class> class S>
constexpr bool is_strategy = lumis::Strategy<S<float>>&& lumis::Strategy<S<double>>;

// A loaded coin, the smallest strategy over indices.
struct Coin {
    using Scalar = float;
    using Point = std::size_t;
    using Measure = lumis::measure::Counting;
    static constexpr int dimensions = 1;

    lumis::Sample<std::size_t, float> sample(glm::vec1 u) const noexcept {
        return u.x < 0.25f ? lumis::Sample<std::size_t, float>{0, 0.25f} : lumis::Sample<std::size_t, float>{1, 0.75f};
    }
    float pdf(std::size_t i) const noexcept { return i == 0 ? 0.25f : i == 1 ? 0.75f : 0.0f; }
};

struct WithoutMeasure : Coin {
  private:
    using Measure = void;
};
struct WithoutPdf : Coin {
    void pdf() const;
};
struct SamplesByGenerator : Coin {
    lumis::Sample<std::size_t, float> sample(int generator) const = delete;
};
struct OfWholeNumbers : Coin {
    using Scalar = int;
};
struct NeverDelta : Coin {
    static constexpr bool is_delta = false;
};
struct DeltaCoin : Coin {
    static constexpr bool is_delta = true;
};

}  // namespace

TEST_CASE("strategies of the library and of a host model the concept", "[strategy]") {
    STATIC_REQUIRE(is_strategy<lumis::CosineHemisphere>);
    STATIC_REQUIRE(is_strategy<lumis::UniformHemisphere>);
    STATIC_REQUIRE(is_strategy<lumis::GgxVndf>);
    STATIC_REQUIRE(is_strategy<lumis::GgxReflection>);
    STATIC_REQUIRE(is_strategy<lumis::PerfectReflection>);
    STATIC_REQUIRE(is_strategy<lumis::EnvironmentMap>);
    STATIC_REQUIRE(is_strategy<lumis::AliasEnvironmentMap>);
    STATIC_REQUIRE(lumis::Strategy<lumis::AreaLight<lumis::Triangle<double>>>);
    STATIC_REQUIRE(lumis::Strategy<lumis::AreaLight<lumis::Parallelogram<float>, lumis::ByArea>>);
    STATIC_REQUIRE(lumis::Strategy<lumis::AreaLight<lumis::Sphere<float>, lumis::ByArea>>);
    STATIC_REQUIRE(lumis::Strategy<lumis::AreaLight<lumis::Sphere<double>, lumis::BySolidAngle>>);
    STATIC_REQUIRE(lumis::Strategy<Interval<float>>);
    STATIC_REQUIRE(lumis::Strategy<Gaussian<double>>);
    STATIC_REQUIRE(lumis::Strategy<Coin>);
}

TEST_CASE("what lacks a part of a strategy is none", "[strategy]") {
    STATIC_REQUIRE_FALSE(lumis::Strategy<int>);
    STATIC_REQUIRE_FALSE(lumis::Strategy<lumis::Ggx<float>>);
    STATIC_REQUIRE_FALSE(lumis::Strategy<lumis::Triangle<float>>);
    STATIC_REQUIRE_FALSE(lumis::Strategy<WithoutMeasure>);
    STATIC_REQUIRE_FALSE(lumis::Strategy<WithoutPdf>);
    STATIC_REQUIRE_FALSE(lumis::Strategy<SamplesByGenerator>);
    STATIC_REQUIRE_FALSE(lumis::Strategy<OfWholeNumbers>);
}

TEST_CASE("deltas and inverses are refinements", "[strategy]") {
    STATIC_REQUIRE(lumis::DeltaStrategy<lumis::PerfectReflection<float>>);
    STATIC_REQUIRE(lumis::DeltaStrategy<DeltaCoin>);
    STATIC_REQUIRE_FALSE(lumis::DeltaStrategy<NeverDelta>);
    STATIC_REQUIRE_FALSE(lumis::DeltaStrategy<Coin>);
    STATIC_REQUIRE_FALSE(lumis::DeltaStrategy<int>);
    STATIC_REQUIRE(lumis::InvertibleStrategy<lumis::CosineHemisphere<float>>);
    STATIC_REQUIRE_FALSE(lumis::InvertibleStrategy<Coin>);
}

TEST_CASE("samples tell points from whole samples", "[strategy]") {
    STATIC_REQUIRE(lumis::AnySample<lumis::Sample<float, float>>);
    STATIC_REQUIRE(lumis::AnySample<lumis::LightSample<glm::vec3, float>>);
    STATIC_REQUIRE_FALSE(lumis::AnySample<glm::vec3>);
    STATIC_REQUIRE_FALSE(lumis::AnySample<double>);
    STATIC_REQUIRE(lumis::Sample<float, float>{}.pdf == 0);
    STATIC_REQUIRE(std::is_empty_v<lumis::delta_t>);
}

TEMPLATE_TEST_CASE("a density is positive and finite, or 0", "[strategy]", float, double) {
    using T = TestType;
    constexpr T infinity = std::numeric_limits<T>::infinity();
    CHECK(lumis::density_or_zero(T(2)) == 2);
    CHECK(lumis::density_or_zero(std::numeric_limits<T>::max()) == std::numeric_limits<T>::max());
    CHECK(lumis::density_or_zero(std::numeric_limits<T>::denorm_min()) > 0);
    for (const T none : {T(0), T(-0.0), T(-1), infinity, -infinity, std::numeric_limits<T>::quiet_NaN()}) {
        const T density = lumis::density_or_zero(none);
        CHECK(density == 0);
    }
}

TEMPLATE_TEST_CASE("a density per area becomes one per solid angle", "[strategy]", float, double) {
    using T = TestType;
    // A unit square 2 away, facing the reference point, subtends nearly 1/4 sr; tilted to cos 1/2, half of that.
    CHECK(lumis::area_to_solid_angle(T(1), T(2), T(1)) == 4);
    CHECK(lumis::area_to_solid_angle(T(1), T(2), T(-0.5)) == 8);
    CHECK(lumis::area_to_solid_angle(T(1), T(2), T(0)) == 0);
    CHECK(lumis::area_to_solid_angle(T(1), T(0), T(1)) == 0);
    CHECK(lumis::area_to_solid_angle(std::numeric_limits<T>::infinity(), T(1), T(1)) == 0);
    CHECK(lumis::area_to_solid_angle(T(0), T(0), T(0)) == 0);
}
