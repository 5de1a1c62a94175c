// Lights of shapes that are not the library's: a ring, which has seen_from as a member and kernels for lanes, and the same
// for numbers alone, with a function beside it.
#include "catch.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/batch.hpp>
#include <lumis/testing/laws.hpp>

#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <type_traits>

namespace mine {

using lumis::Direction, lumis::Real, lumis::RealOf, lumis::SurfaceHit, lumis::SurfaceSample;
namespace real = lumis::real;

// The points between two radii in the plane at a height over the reference point.
template <class T>
class RingView {
  public:
    RingView(const glm::vec<3, T>& center, T inner, T outer) : center_{center}, inner_{inner}, outer_{outer} {}

    [[nodiscard]] T area() const noexcept { return std::numbers::pi_v<T> * (outer_ - inner_) * (outer_ + inner_); }

    template <RealOf<T> R = T>
    [[nodiscard]] SurfaceSample<R> sample(glm::vec<2, R> u) const noexcept {
        const R radius = real::sqrt(R(inner_ * inner_ + u.x * (outer_ * outer_ - inner_ * inner_)));
        const auto circle = lumis::unit_circle(u.y);
        return {{center_.x + radius * circle.x, center_.y + radius * circle.y, R(center_.z)}, R(center_.z)};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] SurfaceHit<R> intersect(const Direction<R>& w) const noexcept {
        const R distance = real::quotient_where(real::abs(w.z) > 0, R(center_.z), w.z);
        const R x = distance * w.x - center_.x, y = distance * w.y - center_.y, square = x * x + y * y;
        constexpr T rounding = 16 * std::numeric_limits<T>::epsilon();
        const auto met =
            distance > 0 && square >= inner_ * inner_ * (1 - rounding) && square <= outer_ * outer_ * (1 + rounding);
        return {real::select(met, distance, 0), real::select(met, w.z, 0)};
    }

  private:
    glm::vec<3, T> center_;
    T inner_, outer_;
};

template <class T>
struct Ring {
    using Scalar = T;
    glm::vec<3, T> center;
    T inner, outer;

    [[nodiscard]] RingView<T> seen_from(const glm::vec<3, T>& point) const noexcept {
        return {center - point, inner, outer};
    }
};

// The same, without lanes, invertible.
struct PlainRing {
    using Scalar = double;
    Ring<double> ring;
};

struct PlainView {
    RingView<double> view;

    [[nodiscard]] double area() const noexcept { return view.area(); }
    [[nodiscard]] SurfaceSample<double> sample(glm::dvec2 u) const noexcept { return view.sample(u); }
    [[nodiscard]] SurfaceHit<double> intersect(const glm::dvec3& w) const noexcept { return view.intersect(w); }
};

PlainView seen_from(const PlainRing& shape, const glm::dvec3& point) {
    return {shape.ring.seen_from(point)};
}

struct WithoutArea : PlainRing {};
struct ViewWithoutArea {
    [[nodiscard]] SurfaceSample<double> sample(glm::dvec2) const noexcept { return {}; }
    [[nodiscard]] SurfaceHit<double> intersect(const glm::dvec3&) const noexcept { return {}; }
};
ViewWithoutArea seen_from(const WithoutArea&, const glm::dvec3&) {
    return {};
}

struct Unseen {
    using Scalar = float;
};

}  // namespace mine

namespace {

namespace laws = lumis::testing;

void check(const laws::LawResult& law) {
    INFO(law.message);
    CHECK(law.passed);
}

}  // namespace

TEMPLATE_TEST_CASE("a light of one's own shape obeys the laws", "[own_shape]", float, double) {
    using T = TestType;
    STATIC_REQUIRE(lumis::Shape<mine::Ring<T>>);
    const lumis::AreaLight light{mine::Ring<T>{{T(0.3), T(-0.2), T(2)}, T(0.5), T(1)}, {0, 0, 0}};
    STATIC_REQUIRE(lumis::LightStrategy<std::remove_const_t<decltype(light)>>);
    STATIC_REQUIRE(!lumis::InvertibleStrategy<std::remove_const_t<decltype(light)>>);
    CHECK(light.area() == Approx(0.75 * std::numbers::pi));
    check(laws::agreement(light));
    check(laws::integrates(light));
    check(laws::batch_agrees(light));
    check(laws::chi_square(light));
    STATIC_REQUIRE(lumis::detail::SamplesLanes<std::remove_const_t<decltype(light)>, lumis::NativeLanes<T>>);
    const mine::Ring<T> ring{{T(0.3), T(-0.2), T(2)}, T(0.5), T(1)};
    CHECK(lumis::pdf_from_hit(ring, {0, 0, 0}, T(2.5), T(-0.8)) == light.pdf_from_hit(T(2.5), T(-0.8)));
}

TEST_CASE("a shape for numbers alone, in a batch too", "[own_shape]") {
    const lumis::AreaLight light{mine::PlainRing{{{0.3, -0.2, 2}, 0.5, 1}}, {0, 0, 0}};
    using Light = std::remove_const_t<decltype(light)>;
    STATIC_REQUIRE(lumis::LightStrategy<Light>);
    STATIC_REQUIRE(!lumis::detail::SamplesLanes<Light, lumis::NativeLanes<double>>);
    check(laws::agreement(light));
    check(laws::integrates(light));
    check(laws::batch_agrees(light));
}

TEST_CASE("what is no shape", "[own_shape]") {
    STATIC_REQUIRE(lumis::Shape<mine::PlainRing>);
    STATIC_REQUIRE(lumis::Shape<lumis::Triangle<float>>);
    STATIC_REQUIRE(lumis::Shape<lumis::Sphere<lumis::NativeLanes<float>>>);
    STATIC_REQUIRE(!lumis::Shape<mine::WithoutArea>);
    STATIC_REQUIRE(!lumis::Shape<mine::Unseen>);
    STATIC_REQUIRE(!lumis::Shape<float>);
}
