// A convex combination of densities, sum of c_k p_k, itself a strategy: the lobes of a layered material, several lights,
// or a safe density mixed into a risky one (defensive sampling, Hesterberg 1995).
#pragma once

#include "lumis/combine/detail/nearest.hpp"
#include "lumis/combine/detail/parts.hpp"
#include "lumis/combine/technique.hpp"
#include "lumis/core/detail/for_each_index.hpp"
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

namespace lumis::LUMIS_ISA {

template <class First, class... Rest>
    requires Composable<First, Rest...>
class Mixture {
    using S0 = std::remove_cvref_t<First>;
    static constexpr bool knows_nearest = detail::KnowNearest<S0, std::remove_cvref_t<Rest>...>;
    static constexpr bool knows_surface = detail::KnowSurface<S0, std::remove_cvref_t<Rest>...>;

    template <class X, Real R, bool with_distance>
    using SampleOf = detail::SampleOfSeveral<X, R, with_distance, knows_surface>;

    static constexpr std::size_t size = 1 + sizeof...(Rest);
    static constexpr int part_dimensions = real::largest_of(
        std::array<int, size>{std::remove_cvref_t<First>::dimensions, std::remove_cvref_t<Rest>::dimensions...});

  public:
    using Scalar = typename S0::Scalar;
    using Point = typename S0::Point;
    using Measure = typename S0::Measure;
    static constexpr int dimensions = part_dimensions + 1;

    // A mixture with a light is a light. Its samples have the distance to the nearest one, and its surface if lights tell it,
    // whichever part drew them.
    using SampleType = SampleOf<Point, Scalar, knows_nearest>;

    static_assert(dimensions <= 4, "a mixture of mixtures of mixtures needs more uniforms than a glm::vec holds");
    static_assert(!(DeltaStrategy<S0> || ... || DeltaStrategy<std::remove_cvref_t<Rest>>),
                  "a delta strategy has no density to mix: select it by one_sample");

    // Parts of probability 0 are left out. Where the probabilities sum to less than 1, the rest draws nothing; they may not
    // sum to more.
    LUMIS_HD explicit constexpr Mixture(Choose<First> first LUMIS_LIFETIME_BOUND,
                                        Choose<Rest>... rest LUMIS_LIFETIME_BOUND)
        : probabilities_{detail::selectable(std::array<Scalar, size>{first.probability, rest.probability...})},
          parts_{{std::forward<First>(first.strategy)}, {std::forward<Rest>(rest.strategy)}...} {}

    // u.x selects the part, which gets the other numbers: stretching u.x for it would leave a rare part few bits.
    // In lanes each selects its own; a part that some lane selected is drawn for all.
    [[nodiscard]] LUMIS_HD SampleType sample(glm::vec<dimensions, Scalar> u) const noexcept {
        return draw<SampleType>(u);
    }
    template <RealOf<Scalar> R>
        requires(!std::same_as<R, Scalar>)
    [[nodiscard]] LUMIS_HD auto sample(const glm::vec<dimensions, R>& u) const noexcept {
        return draw_lanes<SampleIn<R, knows_nearest>>(u);
    }

    // The same but for the distance, which asks every light for its own.
    [[nodiscard]] LUMIS_HD Sample<Point, Scalar> sample_point(glm::vec<dimensions, Scalar> u) const noexcept {
        return draw<Sample<Point, Scalar>>(u);
    }
    template <RealOf<Scalar> R>
        requires(!std::same_as<R, Scalar>)
    [[nodiscard]] LUMIS_HD auto sample_point(const glm::vec<dimensions, R>& u) const noexcept {
        return draw_lanes<SampleIn<R, false>>(u);
    }

    [[nodiscard]] LUMIS_HD Scalar pdf(const Point& x) const noexcept { return density<Scalar>(x); }
    template <detail::PointInLanes<Mixture> X>
    [[nodiscard]] LUMIS_HD auto pdf(const X& x) const noexcept {
        return density<typename detail::RealAt<Mixture, X>::type>(x);
    }

    // To the nearest light, parts of probability 0 included; infinity where there is none.
    [[nodiscard]] LUMIS_HD Scalar distance_along(const Point& w) const noexcept requires knows_nearest {
        return nearest<Scalar>(w);
    }
    template <detail::PointInLanes<Mixture> X>
    requires knows_nearest [[nodiscard]] LUMIS_HD auto distance_along(const X& w) const noexcept {
        return nearest<typename detail::RealAt<Mixture, X>::type>(w);
    }

    // The same, and what stands there.
    [[nodiscard]] LUMIS_HD LightHit<Scalar> hit_along(const Point& w) const noexcept requires knows_surface {
        return detail::nearest_hit(parts_, w, LightHit<Scalar>{});
    }
    template <detail::PointInLanes<Mixture> X>
    requires knows_surface [[nodiscard]] LUMIS_HD auto hit_along(const X& w) const noexcept {
        return detail::nearest_hit(parts_, w, LightHit<typename detail::RealAt<Mixture, X>::type>{});
    }

    // Part I, and the probability with which it is drawn: for hosts that share work between a density and a reflectance.
    template <std::size_t I>
    [[nodiscard]] LUMIS_HD constexpr const auto& strategy() const noexcept LUMIS_LIFETIME_BOUND {
        return detail::part<I>(parts_);
    }
    template <std::size_t I>
    [[nodiscard]] LUMIS_HD constexpr const Scalar& probability() const noexcept LUMIS_LIFETIME_BOUND {
        return probabilities_[I];
    }

  private:
    template <Real R>
    using PointAt = typename detail::PointIn<Point, Scalar, R>::type;
    template <Real R, bool with_distance>
    using SampleIn = SampleOf<PointAt<R>, R, with_distance>;
    template <std::size_t I>
    using Nth = typename detail::NthStrategy<I, First, Rest...>::type;

    template <Real R>
    [[nodiscard]] LUMIS_HD R density(const PointAt<R>& x) const noexcept {
        return density_or_zero(sum_of_parts<R>(x, std::make_index_sequence<size>{}));
    }
    // Forced inline: clang++ would pass the mixture to for_each_index through memory, where a path tracer asks twice.
    template <Real R, std::size_t... I>
    [[nodiscard]] LUMIS_INLINE R sum_of_parts(const PointAt<R>& x, std::index_sequence<I...>) const noexcept {
        R sum = scalar_of<R>(0);
        const auto add = [&](const Scalar& probability, const auto& part) {
            if (real::any(probability > 0)) sum += probability * detail::pdf_in<R>(part, x);
        };
        (add(probabilities_[I], detail::part<I>(parts_)), ...);
        return sum;
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD R nearest(const PointAt<R>& w) const noexcept {
        return detail::nearest_along(parts_, w, R(std::numeric_limits<scalar_of<R>>::infinity()));
    }

    template <int N, Real R>
    LUMIS_HD static glm::vec<N, R> without_first(const glm::vec<dimensions, R>& u) noexcept {
        glm::vec<N, R> rest;
        for (int i = 0; i < N; ++i) rest[i] = u[i + 1];
        return rest;
    }

    // Result: with a distance, or without.
    template <class Result>
    [[nodiscard]] LUMIS_HD Result draw(const glm::vec<dimensions, Scalar>& u) const noexcept {
        if constexpr (!std::floating_point<Scalar>) {
            return draw_lanes<Result>(u);
        } else {
            Result result{};
            Scalar remaining = u.x;
            bool selected = false;
            detail::for_each_index<size>([&](auto i) {
                if (!selected && remaining < probabilities_[i]) {
                    selected = true;
                    const auto drawn = draw_part<i, Result>(u);
                    if (!(drawn.pdf > 0)) return;
                    result.value = Point(drawn.value);
                    result.pdf = pdf(result.value);
                    if constexpr (detail::HasSurface<Result>) {
                        result = detail::with_hit(
                            result, detail::nearest_hit<i>(parts_, result.value, detail::own_hit<Scalar>(drawn)));
                    } else if constexpr (detail::HasDistance<Result>) {
                        result.distance =
                            detail::nearest_along<i>(parts_, result.value, detail::own_distance<Scalar>(drawn));
                    }
                }
                remaining -= probabilities_[i];
            });
            return result;
        }
    }

    template <class Result, Real R>
    [[nodiscard]] LUMIS_HD Result draw_lanes(const glm::vec<dimensions, R>& u) const noexcept {
        Result result{};
        std::array<MaskOf<R>, size> drawn_by;
        R remaining = u.x;
        LightHit<R> hit;
        MaskOf<R> open = true, any_drawn = false;
        detail::for_each_index<size>([&](auto i) {
            const MaskOf<R> selected = open && remaining < probabilities_[i];
            drawn_by[i] = false;
            if (real::any(selected)) {
                const auto drawn = draw_part<i, Result>(u);
                drawn_by[i] = selected && drawn.pdf > 0;
                any_drawn = any_drawn || drawn_by[i];
                open = open && !selected;
                result.value = detail::select_point(drawn_by[i], drawn.value, result.value);
                hit.distance = real::select(drawn_by[i], detail::own_distance<R>(drawn), hit.distance);
                if constexpr (detail::HasSurface<Result>)
                    hit.surface = detail::select(drawn_by[i], detail::own_hit<R>(drawn).surface, hit.surface);
            }
            remaining -= probabilities_[i];
        });
        result.pdf = real::select(any_drawn, density<R>(result.value), scalar_of<R>(0));
        if constexpr (detail::HasDistance<Result>) {
            result.distance = hit.distance;
            if constexpr (detail::HasSurface<Result>) result.surface = hit.surface;
            detail::for_each_index<size>([&](auto k) {
                if constexpr (LightStrategy<Nth<k>> && detail::HasSurface<Result>) {
                    detail::keep_nearer(result, detail::hit_in<R>(detail::part<k>(parts_), result.value), !drawn_by[k]);
                } else if constexpr (LightStrategy<Nth<k>>) {
                    const R other = detail::distance_in<R>(detail::part<k>(parts_), result.value);
                    result.distance = real::select(drawn_by[k], result.distance, real::lesser(result.distance, other));
                }
            });
        }
        return result;
    }

    template <std::size_t I, class Result, Real R>
    [[nodiscard]] LUMIS_HD auto draw_part(const glm::vec<dimensions, R>& u) const noexcept {
        using Part = Nth<I>;
        const auto rest = without_first<Part::dimensions>(u);
        if constexpr (!detail::HasDistance<Result> && detail::SamplesPoints<Part>) {
            return detail::sample_point_in<R>(detail::part<I>(parts_), rest);
        } else if constexpr (std::same_as<R, Scalar>) {
            return detail::part<I>(parts_).sample(rest);
        } else {
            return detail::sample_in<R>(detail::part<I>(parts_), rest);
        }
    }

    std::array<Scalar, size> probabilities_;
    detail::Parts<First, Rest...> parts_;
};

}  // namespace lumis::LUMIS_ISA
