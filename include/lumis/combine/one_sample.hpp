// The one-sample MIS estimator (Veach and Guibas 1995, section 4.3): one technique is selected at random and drawn once.
#pragma once

#include "lumis/combine/combination.hpp"
#include "lumis/core/platform.hpp"

namespace lumis::LUMIS_ISA {

template <class H, class... S>
class OneSample : public Combination<H, S...> {
    using Base = Combination<H, S...>;

  public:
    using Base::weighted_sample;
    using typename Base::Scalar;

    LUMIS_HD explicit constexpr OneSample(const H& heuristic, Choose<S>&&... techniques)
        : Base{heuristic, detail::selectable(std::array<Scalar, sizeof...(S)>{techniques.probability...}),
               std::move(techniques)...} {}

    // An unbiased estimate of the integral of f, which is called as by MultiSample::estimate. Spends one uniform on the
    // selection, none if the only technique is certain.
    //
    // In lanes each selects its own technique. Every technique that some lane selected is drawn and weighed for all lanes,
    // from the same uniforms: as many as the technique that takes the most.
    template <class F, class U>
        requires UniformSource<U, RealFrom<U, Scalar>>
    [[nodiscard]] LUMIS_HD auto estimate(F&& f, U&& uniforms) const {
        using R = RealFrom<U, Scalar>;
        using First = typename Base::template Nth<0>;
        using Value = decltype(this->template draw<0, R>(f, detail::next_for<First, R>(uniforms)));
        Value result = zero<Value>::value();
        if constexpr (std::floating_point<R>) {
            select(uniforms, [&](auto i) {
                using Part = typename Base::template Nth<i>;
                result =
                    Base::template as_value<Value>(this->template draw<i, R>(f, detail::next_for<Part, R>(uniforms)));
            });
        } else {
            select_in_lanes<R>(uniforms, [&](auto i, const auto& u, const MaskOf<R>& selected) {
                // A lane has one contribution, all others are 0.
                result = Value(result + Base::template as_value<Value>(this->template draw<i, R>(f, u, selected)));
            });
        }
        return result;
    }

    // For hosts that go on with the sample, as a path does: selects a technique, draws from it, and calls visit(s) with a
    // WeightedSample, which knows its technique and whether that is a delta strategy. Returns whether anything was drawn: else
    // visit is not called. Spends what an estimate does. Takes numbers alone: lanes select techniques of their own.
    template <class U, class Visit>
    requires UniformSource<U, Scalar> LUMIS_HD bool weighted_sample(U&& uniforms, Visit&& visit) const {
        static_assert(std::floating_point<RealFrom<U, Scalar>>, "lanes are drawn by weighted_sample<I>(uniforms)");
        bool drawn = false;
        select(uniforms, [&](auto i) {
            const auto sample = this->template weighted_sample<i>(uniforms);
            drawn = sample.density > 0;
            if (drawn) visit(sample);
        });
        return drawn;
    }

    // What an estimate spends at most.
    [[nodiscard]] LUMIS_HD constexpr std::size_t uniforms_per_estimate() const noexcept {
        return std::size_t{!is_certain()} + std::size_t{largest_dimensions};
    }

  protected:
    // Calls visit(i) with the technique that a uniform selects, if any.
    template <class U, class Visit>
    LUMIS_INLINE void select(U& uniforms, Visit visit) const {
        Scalar remaining = first_uniform<Scalar>(uniforms);
        bool selected = false;
        detail::for_each_index<Base::size>([&](auto i) {
            if (!selected && remaining < this->factor(i)) {
                selected = true;
                visit(i);
            }
            remaining -= this->factor(i);
        });
    }

    // Calls visit(i, u, selected) with each technique that some lane selects, its uniforms, and the lanes that do.
    template <Real R, class U, class Visit>
    LUMIS_INLINE void select_in_lanes(U& uniforms, Visit visit) const {
        R remaining = first_uniform<R>(uniforms);
        const auto u = glm::vec<largest_dimensions, R>(uniforms.template next<largest_dimensions>());
        MaskOf<R> open = true;
        detail::for_each_index<Base::size>([&](auto i) {
            const MaskOf<R> selected = open && remaining < this->factor(i);
            if (real::any(selected)) {
                constexpr int dimensions = Base::template Nth<i>::dimensions;
                glm::vec<dimensions, R> own;
                for (int k = 0; k < dimensions; ++k) own[k] = u[k];
                visit(i, own, selected);
                open = open && !selected;
            }
            remaining -= this->factor(i);
        });
    }

  private:
    static constexpr int largest_dimensions =
        real::largest_of(std::array<int, sizeof...(S)>{std::remove_cvref_t<S>::dimensions...});

    template <Real R, class U>
    [[nodiscard]] LUMIS_INLINE R first_uniform(U& uniforms) const {
        return is_certain() ? R(scalar_of<R>(0)) : glm::vec<1, R>(uniforms.template next<1>()).x;
    }

    [[nodiscard]] LUMIS_HD constexpr bool is_certain() const noexcept {
        return Base::size == 1 && real::all(this->factor(0) >= 1);
    }
};

// heuristic: BalanceHeuristic{}, PowerHeuristic{}, or another Heuristic.
template <class H, class First, class... Rest>
    requires HeuristicFor<H, First, Rest...> && Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto one_sample(const H& heuristic, Choose<First> first LUMIS_LIFETIME_BOUND,
                                                 Choose<Rest>... rest LUMIS_LIFETIME_BOUND) {
    return OneSample<H, First, Rest...>{heuristic, std::move(first), std::move(rest)...};
}

template <class... S>
void one_sample(Choose<S>... the_first_argument_must_be_a_heuristic) = delete;

}  // namespace lumis::LUMIS_ISA
