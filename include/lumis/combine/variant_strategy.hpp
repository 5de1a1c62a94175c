// A strategy that is one of several, which of them is known at run time: lights of several kinds in one LightSet, materials
// of several kinds in one scene.
#pragma once

#include "lumis/combine/detail/nearest.hpp"
#include "lumis/combine/technique.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/strategy.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

namespace lumis::LUMIS_ISA {

template <class Variant>
class VariantStrategy;

// All lanes share the alternative. On CUDA devices it works where nvcc takes what is constexpr in the standard library
// (--expt-relaxed-constexpr): std::visit is for hosts alone, std::get_if is not.
template <class First, class... Rest>
    requires Composable<First, Rest...>
class VariantStrategy<std::variant<First, Rest...>> {
    using Variant = std::variant<First, Rest...>;
    static constexpr bool knows_nearest = detail::KnowNearest<First, Rest...>;
    static constexpr bool knows_surface = detail::KnowSurface<First, Rest...>;

  public:
    using Scalar = typename First::Scalar;
    using Point = typename First::Point;
    using Measure = typename First::Measure;

    // Those of the alternative that takes the most; any other leaves the last ones unused.
    static constexpr int dimensions =
        real::largest_of(std::array<int, 1 + sizeof...(Rest)>{First::dimensions, Rest::dimensions...});

    static_assert(!(DeltaStrategy<First> || ... || DeltaStrategy<Rest>),
                  "a delta strategy is no alternative: whether one has a density is known at compile time");

    LUMIS_HD constexpr VariantStrategy(Variant alternatives) : alternatives_{std::move(alternatives)} {}
    template <class S>
        requires(std::same_as<S, First> || ... || std::same_as<S, Rest>)
    LUMIS_HD constexpr VariantStrategy(S strategy) : alternatives_{std::move(strategy)} {}

    [[nodiscard]] LUMIS_HD constexpr const Variant& variant() const noexcept LUMIS_LIFETIME_BOUND {
        return alternatives_;
    }

    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD auto sample(const glm::vec<dimensions, R>& u) const noexcept {
        return draw<SampleIn<R, knows_nearest>>(u);
    }
    // The same but for the distance.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD auto sample_point(const glm::vec<dimensions, R>& u) const noexcept {
        return draw<SampleIn<R, false>>(u);
    }

    [[nodiscard]] LUMIS_HD Scalar pdf(const Point& x) const noexcept { return density<Scalar>(x); }
    template <detail::PointInLanes<First> X>
    [[nodiscard]] LUMIS_HD auto pdf(const X& x) const noexcept {
        return density<typename detail::RealAt<First, X>::type>(x);
    }

    // Infinity for what is no light.
    [[nodiscard]] LUMIS_HD Scalar distance_along(const Point& w) const noexcept requires knows_nearest {
        return distance<Scalar>(w);
    }
    template <detail::PointInLanes<First> X>
    requires knows_nearest [[nodiscard]] LUMIS_HD auto distance_along(const X& w) const noexcept {
        return distance<typename detail::RealAt<First, X>::type>(w);
    }

    // The same, and what stands there.
    [[nodiscard]] LUMIS_HD LightHit<Scalar> hit_along(const Point& w) const noexcept requires knows_surface {
        return hit<Scalar>(w);
    }
    template <detail::PointInLanes<First> X>
    requires knows_surface [[nodiscard]] LUMIS_HD auto hit_along(const X& w) const noexcept {
        return hit<typename detail::RealAt<First, X>::type>(w);
    }

  private:
    template <Real R>
    using PointAt = typename detail::PointIn<Point, Scalar, R>::type;

    // Where one alternative is a light, all samples have a distance: infinity for what has none. Where one tells its surface,
    // all samples have one: zeros for what does not.
    template <Real R, bool with_distance>
    using SampleIn = detail::SampleOfSeveral<PointAt<R>, R, with_distance, knows_surface>;

    // f(the strategy); `none` of a variant that an exception has left without one.
    template <class Result, class F>
    [[nodiscard]] LUMIS_INLINE Result visit(const Result& none, F f) const noexcept {
        Result result = none;
        const auto try_one = [&](const auto* strategy) {
            if (strategy) result = f(*strategy);
            return strategy != nullptr;
        };
        static_cast<void>(
            (try_one(std::get_if<First>(&alternatives_)) || ... || try_one(std::get_if<Rest>(&alternatives_))));
        return result;
    }

    template <class Result, Real R>
    [[nodiscard]] LUMIS_HD Result draw(const glm::vec<dimensions, R>& u) const noexcept {
        return visit(Result{}, [&](const auto& strategy) {
            using S = std::remove_cvref_t<decltype(strategy)>;
            glm::vec<S::dimensions, R> own;
            for (int i = 0; i < S::dimensions; ++i) own[i] = u[i];
            if constexpr (!detail::HasDistance<Result> && detail::SamplesPoints<S>) {
                const auto drawn = detail::sample_point_in<R>(strategy, own);
                return Result{drawn.value, drawn.pdf};
            } else {
                const auto drawn = detail::sample_in<R>(strategy, own);
                if constexpr (detail::HasSurface<Result>) {
                    const auto [distance, surface] = detail::own_hit<R>(drawn);
                    return Result{drawn.value, drawn.pdf, distance, surface};
                } else if constexpr (detail::HasDistance<Result>) {
                    return Result{drawn.value, drawn.pdf, detail::own_distance<R>(drawn)};
                } else {
                    return Result{drawn.value, drawn.pdf};
                }
            }
        });
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD R density(const PointAt<R>& x) const noexcept {
        return visit(R(scalar_of<R>(0)), [&](const auto& strategy) { return detail::pdf_in<R>(strategy, x); });
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD R distance(const PointAt<R>& w) const noexcept {
        const R infinity = std::numeric_limits<scalar_of<R>>::infinity();
        return visit(infinity, [&](const auto& strategy) {
            if constexpr (LightStrategy<std::remove_cvref_t<decltype(strategy)>>) {
                return detail::distance_in<R>(strategy, w);
            } else {
                return infinity;
            }
        });
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD LightHit<R> hit(const PointAt<R>& w) const noexcept {
        return visit(LightHit<R>{}, [&](const auto& strategy) {
            if constexpr (LightStrategy<std::remove_cvref_t<decltype(strategy)>>) {
                return detail::hit_in<R>(strategy, w);
            } else {
                return LightHit<R>{};
            }
        });
    }

    Variant alternatives_;
};

template <class... S>
VariantStrategy(std::variant<S...>) -> VariantStrategy<std::variant<S...>>;

}  // namespace lumis::LUMIS_ISA
