// Resampled importance sampling (Talbot, Cline and Egbert 2005): of several candidates, drawn by strategies at hand, one is
// selected in proportion to a target that no strategy draws from. Weights among several sources of candidates are MIS weights
// (Lin et al. 2022, "Generalized Resampled Importance Sampling").
//
// Candidate x of source k, with the effective density n_k p_k(x) and the MIS weight w_k(x), has the resampling weight
// r = w_k(x) target(x) / (n_k p_k(x)). The candidate y that is selected stands for all by its contribution weight
// W = (sum of r) / target(y): the expectation of f(y) W is the integral of f over where the target is positive.
#pragma once

#include "lumis/combine/combination.hpp"
#include "lumis/combine/detail/candidates.hpp"
#include "lumis/combine/reservoir.hpp"
#include "lumis/core/assert.hpp"
#include "lumis/core/platform.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// What resampling yields.
template <class Drawn, Real R>
struct Resampled {
    // The candidate as its strategy drew it. Its pdf is that of drawing this candidate: resampling has a density as well, but
    // nobody can state it.
    Drawn sample;

    // An unbiased estimate of 1 / density, to multiply an integrand by: not a density, so no MIS weight can be made of it.
    // 0: nothing was drawn, or no candidate had a target above 0.
    R contribution_weight;
};

// Made by resample(). Target, H and the strategies are kept as by multi_sample; Candidates says how many candidates are drawn.
template <class Target, class H, class Candidates, class... S>
class Resampling : public Combination<H, S...> {
    using Base = Combination<H, S...>;
    template <std::size_t I>
    using Nth = typename Base::template Nth<I>;

  public:
    using typename Base::Point;
    using typename Base::Scalar;

    static_assert(!(DeltaStrategy<std::remove_cvref_t<S>> || ...),
                  "a delta strategy has no density to resample: add its contribution by multi_sample");

    template <class... Techniques>
    LUMIS_HD explicit constexpr Resampling(const H& heuristic, Target&& target, const Candidates& candidates,
                                           Techniques&&... techniques)
        : Base{heuristic, candidates.factors(), std::forward<Techniques>(techniques)...},
          target_{std::move(target)},
          candidates_{candidates} {}

    // One candidate, and what it weighs; in lanes, one in each. Several techniques have a sample in common: with a distance where
    // one of them is a light, and a surface where one tells it, see multi_sample.
    template <class U>
        requires UniformSource<U, RealFrom<U, Scalar>>
    [[nodiscard]] LUMIS_HD auto sample(U&& uniforms) const {
        using R = RealFrom<U, Scalar>;
        const auto kept = gather<R, false>(uniforms, [](const auto&, const auto&) {});
        using Drawn = std::remove_cvref_t<decltype(kept.item().sample)>;
        const auto [sample, scale] = kept.item();
        const MaskOf<R> drawn = kept.weight() > 0;
        const R factor = divides ? real::quotient_where(drawn, R(scalar_of<R>(1)), scale) : scale;
        return Resampled<Drawn, R>{sample, R(factor * kept.inverse_probability())};
    }

    // An unbiased estimate of the integral of f, which is called as by MultiSample::estimate, but once. With a single candidate it
    // is the estimate of multi_sample, bit for bit. In debug builds f is called at every candidate whose target is 0 as well, and
    // is asserted to be 0 there: else the estimate misses what f has there.
    template <class F, class U>
        requires UniformSource<U, RealFrom<U, Scalar>>
    [[nodiscard]] LUMIS_HD auto estimate(F&& f, U&& uniforms) const {
        using R = RealFrom<U, Scalar>;
        constexpr bool only_points =
            Base::template takes_point<F, R, 0> && Base::template takes_point<const Target, R, 0>;
        using Kept = decltype(nothing_kept<R, only_points>(std::index_sequence_for<S...>{}));
        using Drawn = std::remove_cvref_t<decltype(std::declval<const Kept&>().item().sample)>;
        using Asked = detail::Asked<F, Drawn, R, false, 0>;
        if constexpr (!IntegrandOfSamples<F, typename Asked::Sample, typename Asked::Scalar, false, 0>) {
            detail::require_integrand<F, typename Asked::Sample, typename Asked::Scalar, false, 0>();
            return R{};
        } else {
            const auto at = [&](const Drawn& sample, const MaskOf<R>& where) -> decltype(auto) {
                return detail::evaluate_in<false, 0, R>(f, sample, where);
            };
            using Value = ValueOf<std::remove_cvref_t<decltype(at(std::declval<const Drawn&>(), MaskOf<R>(true)))>, R>;
            const auto kept = gather<R, only_points>(uniforms, [&](const Drawn& sample, const MaskOf<R>& missed) {
                LUMIS_ASSERT(!real::any(missed) ||
                             detail::is_zero(detail::selected(missed, Value(at(sample, missed)))));
                static_cast<void>(sample), static_cast<void>(missed);
            });
            const MaskOf<R> drawn = kept.weight() > 0;
            if (!real::any(drawn)) return zero<Value>::value();
            const auto& [sample, scale] = kept.item();
            decltype(auto) result = at(sample, drawn);
            const R over_probability = kept.inverse_probability();
            if constexpr (divides) {
                const Value one = detail::quotient<Value>(result, detail::positive_divisor(drawn, scale));
                return detail::selected(drawn, detail::scaled<Value>(one, over_probability));
            } else {
                const Value one = detail::scaled<Value>(result, scale);
                return detail::selected(drawn, detail::scaled<Value>(one, over_probability));
            }
        }
    }

    // How many candidates there are.
    [[nodiscard]] LUMIS_HD constexpr std::size_t candidates() const noexcept {
        if constexpr (chooses) {
            return static_cast<std::size_t>(candidates_.count);
        } else {
            std::size_t sum = 0;
            for (const int count : candidates_.counts) sum += static_cast<std::size_t>(count);
            return sum;
        }
    }

    // What an estimate spends, at most: the uniforms of each candidate, that of choosing its technique first, and one on the
    // selection for each after the first.
    [[nodiscard]] LUMIS_HD constexpr std::size_t uniforms_per_estimate() const noexcept {
        const std::size_t number = candidates();
        std::size_t sum = number > 0 ? number - 1 : 0;
        if constexpr (chooses) {
            sum += number * (std::size_t{!is_certain()} + std::size_t{largest_dimensions});
        } else {
            detail::for_each_index<Base::size>([&](auto i) {
                sum += static_cast<std::size_t>(candidates_.counts[i]) * std::size_t{Nth<i>::dimensions};
            });
        }
        return sum;
    }

  private:
    static constexpr bool chooses = std::same_as<Candidates, detail::ChosenCandidates<Scalar, sizeof...(S)>>;
    // A technique that stands alone has weight 1: f is divided by its density.
    static constexpr bool divides = Base::size == 1;
    static constexpr int largest_dimensions =
        real::largest_of(std::array<int, sizeof...(S)>{std::remove_cvref_t<S>::dimensions...});

    // A candidate of technique I, without a distance where points will do.
    template <std::size_t I, Real R, bool only_points>
    [[nodiscard]] LUMIS_INLINE auto draw_candidate(const glm::vec<Nth<I>::dimensions, R>& u) const {
        if constexpr (only_points && detail::SamplesPoints<Nth<I>>) {
            return detail::sample_point_in<R>(this->template strategy<I>(), u);
        } else {
            return detail::sample_in<R>(this->template strategy<I>(), u);
        }
    }
    template <Real R, bool only_points>
    using Several = detail::SampleOfSeveral<typename detail::PointIn<Point, Scalar, R>::type, R,
                                            !only_points && detail::KnowNearest<std::remove_cvref_t<S>...>,
                                            detail::KnowSurface<std::remove_cvref_t<S>...>>;

    // A reservoir for the samples that the techniques have in common.
    template <Real R, bool only_points, std::size_t... I>
    [[nodiscard]] LUMIS_INLINE auto nothing_kept(std::index_sequence<I...>) const {
        using Common =
            detail::CommonSample<Several<R, only_points>,
                                 std::remove_cvref_t<decltype(this->template seen<I, only_points, R>(
                                     draw_candidate<I, R, only_points>(glm::vec<Nth<I>::dimensions, R>{})))>...>;
        return Reservoir<detail::Candidate<typename Common::type, R>, R>{};
    }

    // Draws all candidates and keeps one. missed(sample, where): the target is 0 there, of a candidate that was drawn.
    template <Real R, bool only_points, class U, class Missed>
    [[nodiscard]] LUMIS_INLINE auto gather(U& uniforms, const Missed& missed) const {
        auto kept = nothing_kept<R, only_points>(std::index_sequence_for<S...>{});
        bool first = true;
        // The first candidate of all has nothing to be selected from.
        const auto selection = [&] {
            if (std::exchange(first, false)) return R(scalar_of<R>(0));
            return R(glm::vec<1, R>(uniforms.template next<1>()).x);
        };
        if constexpr (!chooses) {
            detail::for_each_index<Base::size>([&](auto i) {
                for (int k = 0; k < candidates_.counts[i]; ++k) {
                    const auto u = detail::next_for<Nth<i>, R>(uniforms);
                    consider<i, R, only_points>(kept, u, selection(), true, missed);
                }
            });
        } else {
            for (int k = 0; k < candidates_.count; ++k) choose<R, only_points>(kept, uniforms, selection, missed);
        }
        return kept;
    }

    // One candidate of a technique that a uniform selects. Lanes spend what the technique with the largest dimensions does.
    template <Real R, bool only_points, class Kept, class U, class Selection, class Missed>
    LUMIS_INLINE void choose(Kept& kept, U& uniforms, const Selection& selection, const Missed& missed) const {
        R remaining = is_certain() ? R(scalar_of<R>(0)) : R(glm::vec<1, R>(uniforms.template next<1>()).x);
        if constexpr (std::floating_point<R>) {
            bool open = true;
            detail::for_each_index<Base::size>([&](auto i) {
                if (open && remaining < candidates_.probabilities[i]) {
                    open = false;
                    const auto u = detail::next_for<Nth<i>, R>(uniforms);
                    consider<i, R, only_points>(kept, u, selection(), true, missed);
                }
                remaining -= candidates_.probabilities[i];
            });
            if (open) static_cast<void>(selection());
        } else {
            const auto u = glm::vec<largest_dimensions, R>(uniforms.template next<largest_dimensions>());
            const R selecting = selection();
            MaskOf<R> open = true;
            detail::for_each_index<Base::size>([&](auto i) {
                const MaskOf<R> selected = open && remaining < candidates_.probabilities[i];
                if (real::any(selected)) {
                    glm::vec<Nth<i>::dimensions, R> own;
                    for (int k = 0; k < Nth<i>::dimensions; ++k) own[k] = u[k];
                    consider<i, R, only_points>(kept, own, selecting, selected, missed);
                    open = open && !selected;
                }
                remaining -= candidates_.probabilities[i];
            });
        }
    }

    // Draws a candidate from u, weighs it, and keeps it if `selecting` says so. In lanes: where `selected` holds.
    template <std::size_t I, Real R, bool only_points, class Kept, class Missed>
    LUMIS_INLINE void consider(Kept& kept, const glm::vec<Nth<I>::dimensions, R>& u, const R& selecting,
                               [[maybe_unused]] const MaskOf<R>& selected, const Missed& missed) const {
        using T = scalar_of<R>;
        const auto sample = draw_candidate<I, R, only_points>(u);
        const R own = this->factor(I) * sample.pdf;
        MaskOf<R> is_drawn = own > 0;
        if constexpr (!std::floating_point<R>) is_drawn = is_drawn && selected;
        if (!real::any(is_drawn)) return;
        decltype(auto) told = this->template seen<I, only_points, R>(sample);
        decltype(auto) whole = detail::as_common<std::remove_cvref_t<decltype(kept.item().sample)>>(told);
        const R target = real::select(is_drawn, target_at<I, R>(whole, is_drawn), T(0));
        LUMIS_ASSERT(real::all(target >= 0 && target <= (std::numeric_limits<T>::max)()));
        const MaskOf<R> wanted = target > 0;
        missed(whole, is_drawn && !wanted);
        if (!real::any(wanted)) return;
        const R divisor = detail::positive_divisor(is_drawn, own);
        if constexpr (divides) {
            kept.add({whole, own}, real::select(wanted, in_range(R(real::divide(target, divisor))), T(0)), selecting);
        } else {
            const R weight =
                this->template weight_given<I, R>(sample.value, [&] { return real::select(is_drawn, own, T(0)); });
            const R scale = real::divide(weight, divisor);
            kept.add({whole, scale}, real::select(wanted, in_range(R(target * scale)), T(0)), selecting);
        }
    }

    // A resampling weight that reservoirs take. Any positive one selects without bias: that of a target which is very small or
    // large beside the density must neither vanish nor overflow.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE static R in_range(const R& weight) noexcept {
        using Limits = std::numeric_limits<scalar_of<R>>;
        constexpr scalar_of<R> least = (Limits::min)(), most = (Limits::max)() * 0x1p-16f;
        return real::clamp(weight, R(least), R(most));
    }

    template <std::size_t I, Real R, class Drawn>
    [[nodiscard]] LUMIS_INLINE R target_at(const Drawn& sample, const MaskOf<R>& where) const {
        using Asked = typename detail::Asked<const Target, Drawn, R, false, I>::Sample;
        constexpr bool takes = detail::TakesDrawn<const Target, Asked, I>;
        static_assert(takes, "a target takes the point, target(x), or the whole sample, target(sample)");
        if constexpr (takes) {
            const auto target = detail::evaluate_in<false, I, R>(target_, sample, where);
            constexpr bool is_number =
                std::convertible_to<decltype(target), double> || Real<std::remove_cvref_t<decltype(target)>>;
            static_assert(is_number, "a target is a number: of a colour, its luminance");
            if constexpr (is_number) return static_cast<R>(target);
        }
        return R{};
    }

    // Whether no uniform is spent on the choice of a technique.
    [[nodiscard]] LUMIS_HD constexpr bool is_certain() const noexcept {
        return Base::size == 1 && real::all(candidates_.probabilities[0] >= 1);
    }

    [[no_unique_address]] Target target_;
    Candidates candidates_;
};

// target(x), or target(sample), is any number from 0 on, positive wherever the integrand is not 0, and cheap: it is asked for at
// every candidate. The nearer it is in proportion to the integrand, the less variance remains; without shadows it does well where
// few things hide the lights. It is kept by value.
//
// heuristic: BalanceHeuristic{}, which is the default, PairwiseWeights{}, or another Heuristic; it weighs candidates of several
// techniques among each other. With balance a candidate asks all techniques for their densities.
//
// `count` candidates of each technique take(count, strategy):
template <class H, class Target, class First, class... Rest>
    requires HeuristicFor<H, First, Rest...> && Composable<First, Rest...> && detail::MayBeTarget<Target>
[[nodiscard]] LUMIS_HD constexpr auto resample(const H& heuristic, Target target,
                                               Take<First> first LUMIS_LIFETIME_BOUND,
                                               Take<Rest>... rest LUMIS_LIFETIME_BOUND) {
    using Scalar = typename std::remove_cvref_t<First>::Scalar;
    using Candidates = detail::TakenCandidates<Scalar, 1 + sizeof...(Rest)>;
    return Resampling<Target, H, Candidates, First, Rest...>{
        heuristic, std::move(target), Candidates{{first.count, rest.count...}}, std::move(first), std::move(rest)...};
}
template <class Target, class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto resample(Target target, Take<First> first LUMIS_LIFETIME_BOUND,
                                               Take<Rest>... rest LUMIS_LIFETIME_BOUND) {
    return resample(BalanceHeuristic{}, std::move(target), std::move(first), std::move(rest)...);
}

// `candidates` of them, each of a technique that is selected with the probability of choose(probability, strategy):
template <class H, class Target, std::integral Count, class First, class... Rest>
    requires HeuristicFor<H, First, Rest...> && Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto resample(const H& heuristic, Target target, Count candidates,
                                               Choose<First> first LUMIS_LIFETIME_BOUND,
                                               Choose<Rest>... rest LUMIS_LIFETIME_BOUND) {
    using Scalar = typename std::remove_cvref_t<First>::Scalar;
    using Candidates = detail::ChosenCandidates<Scalar, 1 + sizeof...(Rest)>;
    return Resampling<Target, H, Candidates, First, Rest...>{
        heuristic, std::move(target),
        Candidates{detail::checked_count(candidates),
                   detail::selectable(std::array<Scalar, 1 + sizeof...(Rest)>{first.probability, rest.probability...})},
        std::move(first), std::move(rest)...};
}
template <class Target, std::integral Count, class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto resample(Target target, Count candidates,
                                               Choose<First> first LUMIS_LIFETIME_BOUND,
                                               Choose<Rest>... rest LUMIS_LIFETIME_BOUND) {
    return resample(BalanceHeuristic{}, std::move(target), candidates, std::move(first), std::move(rest)...);
}

}  // namespace lumis::LUMIS_ISA
