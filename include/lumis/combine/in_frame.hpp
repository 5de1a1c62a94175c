// Carries a strategy over local directions to world space. The density is unchanged: a rotation preserves solid angle.
#pragma once

#include "lumis/combine/held.hpp"
#include "lumis/core/frame.hpp"
#include "lumis/core/strategy.hpp"

#include <utility>

namespace lumis {

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

    constexpr InFrame(const Frame<Scalar>& frame, HeldStrategy local)
        : frame_{frame}, local_{std::forward<HeldStrategy>(local)} {}

    [[nodiscard]] auto sample(UniformsOf<Local> u) const noexcept {
        auto sample = local_.sample(u);
        sample.value = frame_.to_world(sample.value);
        return all_finite(sample.value) ? sample : decltype(sample){};
    }

    [[nodiscard]] Scalar pdf(const Point& w) const noexcept { return local_.pdf(frame_.to_local(w)); }

    [[nodiscard]] UniformsOf<Local> invert(const Point& w) const noexcept requires InvertibleStrategy<Local> {
        return local_.invert(frame_.to_local(w));
    }

  private:
    Frame<Scalar> frame_;
    HeldStrategy local_;
};

template <class S>
    requires Strategy<std::remove_cvref_t<S>>
[[nodiscard]] constexpr auto in_frame(const Frame<typename std::remove_cvref_t<S>::Scalar>& frame, S&& local) {
    return InFrame<Held<S>>{frame, std::forward<S>(local)};
}

}  // namespace lumis
