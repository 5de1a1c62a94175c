// A convex combination of densities, sum of c_k p_k, itself a strategy: the lobes of a layered material, several lights,
// or a safe density mixed into a risky one (defensive sampling, Hesterberg 1995).
#pragma once

#include "lumis/combine/detail/nearest.hpp"
#include "lumis/combine/detail/parts.hpp"
#include "lumis/combine/technique.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/strategy.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace lumis {

template <class First, class... Rest>
    requires Composable<First, Rest...>
class Mixture {
    using S0 = std::remove_cvref_t<First>;
    static constexpr bool knows_nearest = detail::KnowNearest<S0, std::remove_cvref_t<Rest>...>;

    static constexpr std::size_t size = 1 + sizeof...(Rest);
    static constexpr int part_dimensions =
        real::largest_of(std::array{std::remove_cvref_t<First>::dimensions, std::remove_cvref_t<Rest>::dimensions...});

  public:
    using Scalar = typename S0::Scalar;
    using Point = typename S0::Point;
    using Measure = typename S0::Measure;
    static constexpr int dimensions = part_dimensions + 1;

    // A mixture with a light is a light. Its samples have the distance to the nearest one, whichever part drew them.
    using SampleType = std::conditional_t<knows_nearest, LightSample<Point, Scalar>, Sample<Point, Scalar>>;

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
    [[nodiscard]] LUMIS_HD SampleType sample(glm::vec<dimensions, Scalar> u) const noexcept {
        return draw<SampleType>(u);
    }

    // The same but for the distance, which asks every light for its own.
    [[nodiscard]] LUMIS_HD Sample<Point, Scalar> sample_point(glm::vec<dimensions, Scalar> u) const noexcept {
        return draw<Sample<Point, Scalar>>(u);
    }

    [[nodiscard]] LUMIS_HD Scalar pdf(const Point& x) const noexcept {
        Scalar sum = 0;
        detail::for_each_index<size>([&](auto i) {
            if (probabilities_[i] > 0) sum += probabilities_[i] * static_cast<Scalar>(detail::part<i>(parts_).pdf(x));
        });
        return density_or_zero(sum);
    }

    // To the nearest light, parts of probability 0 included; infinity where there is none.
    [[nodiscard]] LUMIS_HD Scalar distance_along(const Point& w) const noexcept requires knows_nearest {
        return detail::nearest_along(parts_, w, std::numeric_limits<Scalar>::infinity());
    }

  private:
    template <int N>
    LUMIS_HD static glm::vec<N, Scalar> without_first(glm::vec<dimensions, Scalar> u) noexcept {
        glm::vec<N, Scalar> rest;
        for (int i = 0; i < N; ++i) rest[i] = u[i + 1];
        return rest;
    }

    // Result: with a distance, or without.
    template <class Result>
    [[nodiscard]] LUMIS_HD Result draw(glm::vec<dimensions, Scalar> u) const noexcept {
        Result result{};
        Scalar remaining = u.x;
        bool selected = false;
        detail::for_each_index<size>([&](auto i) {
            if (!selected && remaining < probabilities_[i]) {
                selected = true;
                result = draw_part<i, Result>(u);
            }
            remaining -= probabilities_[i];
        });
        return result;
    }

    template <std::size_t I, class Result>
    [[nodiscard]] LUMIS_HD Result draw_part(glm::vec<dimensions, Scalar> u) const noexcept {
        constexpr bool with_distance = std::same_as<Result, LightSample<Point, Scalar>>;
        using Part = typename detail::NthStrategy<I, First, Rest...>::type;
        const Part& part = detail::part<I>(parts_);
        const auto drawn = [&] {
            const auto rest = without_first<Part::dimensions>(u);
            if constexpr (!with_distance && detail::SamplesPoints<Part>) {
                return part.sample_point(rest);
            } else {
                return part.sample(rest);
            }
        }();
        if (!(drawn.pdf > 0)) return {};
        Result result{Point(drawn.value), pdf(drawn.value)};
        if constexpr (with_distance) {
            result.distance = detail::nearest_along<I>(parts_, drawn.value, detail::own_distance<Scalar>(drawn));
        }
        return result;
    }

    std::array<Scalar, size> probabilities_;
    detail::Parts<First, Rest...> parts_;
};

}  // namespace lumis
