// Carries a strategy over local directions to world space. The density is unchanged: a rotation preserves solid angle.
#pragma once

#include "lumis/core/detail/held.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/frame.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"

#include <utility>

namespace lumis::LUMIS_ISA {

// Held is the local strategy or, for one that owns memory, a reference to it.
template <class HeldStrategy>
class InFrame {
    using Local = std::remove_cvref_t<HeldStrategy>;

  public:
    using Scalar = typename Local::Scalar;
    using Point = Direction<Scalar>;
    using Measure = typename Local::Measure;
    static constexpr int dimensions = Local::dimensions;
    static constexpr bool is_delta = DeltaStrategy<Local>;

    static_assert(std::same_as<typename Local::Point, Point>, "only strategies over directions have a frame");

    LUMIS_HD constexpr InFrame(const Frame<Scalar>& frame, HeldStrategy local)
        : frame_{frame}, local_{std::forward<HeldStrategy>(local)} {}

    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD auto sample(glm::vec<dimensions, R> u) const noexcept {
        auto drawn = detail::sample_in<R>(local_, u);
        const Direction<R> w = frame_.to_world(drawn.value);
        const auto finite = all_finite(w);
        drawn.value.x = real::select(finite, w.x, 0);
        drawn.value.y = real::select(finite, w.y, 0);
        drawn.value.z = real::select(finite, w.z, 0);
        drawn.pdf = real::select(finite, drawn.pdf, 0);
        return drawn;
    }

    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return detail::pdf_in<R>(local_, frame_.to_local(w));
    }

    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& w) const noexcept requires LightStrategy<Local> {
        return detail::distance_in<R>(local_, frame_.to_local(w));
    }

    [[nodiscard]] LUMIS_HD UniformsOf<Local> invert(const Point& w) const noexcept requires InvertibleStrategy<Local> {
        return local_.invert(frame_.to_local(w));
    }

  private:
    Frame<Scalar> frame_;
    HeldStrategy local_;
};

template <class S>
    requires Strategy<std::remove_cvref_t<S>>
[[nodiscard]] LUMIS_HD constexpr auto in_frame(const Frame<typename std::remove_cvref_t<S>::Scalar>& frame, S&& local) {
    return InFrame<detail::Held<S>>{frame, std::forward<S>(local)};
}
template <class S>
    requires Strategy<S> && detail::HeldByReference<S&>
[[nodiscard]] LUMIS_HD constexpr auto in_frame(const Frame<typename S::Scalar>& frame, S& local LUMIS_LIFETIME_BOUND) {
    return InFrame<detail::Held<S&>>{frame, local};
}

}  // namespace lumis::LUMIS_ISA
