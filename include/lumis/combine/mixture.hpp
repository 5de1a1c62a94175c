// A convex combination of densities, sum of c_k p_k, itself a strategy: the lobes of a layered material, several lights,
// or a safe density mixed into a risky one (defensive sampling, Hesterberg 1995).
#pragma once

#include "lumis/combine/for_each_index.hpp"
#include "lumis/combine/technique.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/strategy.hpp"

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace lumis {

template <class First, class... Rest>
    requires Composable<First, Rest...>
class Mixture {
    using S0 = std::remove_cvref_t<First>;
    template <class S>
    static constexpr bool has_distance = requires(const S part, UniformsOf<S> u) {
        part.sample(u).distance;
    };
    static constexpr bool all_have_distance = has_distance<S0> && (has_distance<std::remove_cvref_t<Rest>> && ...);

    static constexpr int part_dimensions =
        real::largest_of(std::array{std::remove_cvref_t<First>::dimensions, std::remove_cvref_t<Rest>::dimensions...});

  public:
    using Scalar = typename S0::Scalar;
    using Point = typename S0::Point;
    using Measure = typename S0::Measure;
    static constexpr int dimensions = part_dimensions + 1;

    // A mixture of lights is a light.
    using SampleType = std::conditional_t<all_have_distance, LightSample<Point, Scalar>, Sample<Point, Scalar>>;

    static_assert(dimensions <= 4, "a mixture of mixtures of mixtures needs more uniforms than a glm::vec holds");
    static_assert(!(DeltaStrategy<S0> || ... || DeltaStrategy<std::remove_cvref_t<Rest>>),
                  "a delta strategy has no density to mix: select it by one_sample");

    // Parts of probability 0 are left out. Where the probabilities sum to less than 1, the rest draws nothing.
    explicit constexpr Mixture(Choose<First> first, Choose<Rest>... rest)
        : probabilities_{first.probability, rest.probability...},
          parts_{std::forward<First>(first.strategy), std::forward<Rest>(rest.strategy)...} {}

    // u.x selects the part, which gets the other numbers: stretching u.x for it would leave a rare part few bits.
    [[nodiscard]] SampleType sample(glm::vec<dimensions, Scalar> u) const noexcept {
        SampleType result{};
        Scalar remaining = u.x;
        bool selected = false;
        for_each_part([&](auto probability, const auto& part) {
            if (!selected && remaining < probability) {
                selected = true;
                const auto drawn = part.sample(without_first<std::remove_cvref_t<decltype(part)>::dimensions>(u));
                if (!(drawn.pdf > 0)) return;
                if constexpr (all_have_distance) result.distance = drawn.distance;
                result.value = drawn.value;
                result.pdf = pdf(drawn.value);
            }
            remaining -= probability;
        });
        return result;
    }

    [[nodiscard]] Scalar pdf(const Point& x) const noexcept {
        Scalar sum = 0;
        for_each_part([&](auto probability, const auto& part) {
            if (probability > 0) sum += probability * part.pdf(x);
        });
        return density_or_zero(sum);
    }

  private:
    template <int N>
    static glm::vec<N, Scalar> without_first(glm::vec<dimensions, Scalar> u) noexcept {
        glm::vec<N, Scalar> rest;
        for (int i = 0; i < N; ++i) rest[i] = u[i + 1];
        return rest;
    }

    // Calls visit(probability, part) for each part.
    template <class Visit>
    constexpr void for_each_part(Visit visit) const {
        detail::for_each_index<1 + sizeof...(Rest)>([&](auto i) { visit(probabilities_[i], std::get<i>(parts_)); });
    }

    std::array<Scalar, 1 + sizeof...(Rest)> probabilities_;
    std::tuple<First, Rest...> parts_;
};

}  // namespace lumis
