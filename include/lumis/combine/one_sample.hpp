// The one-sample MIS estimator (Veach and Guibas 1995, section 4.3): one technique is selected at random and drawn once.
#pragma once

#include "lumis/combine/combination.hpp"
#include "lumis/core/platform.hpp"

namespace lumis {

template <class H, class... S>
class OneSample : public Combination<H, S...> {
    using Base = Combination<H, S...>;

  public:
    using typename Base::Scalar;

    LUMIS_HD explicit constexpr OneSample(const H& heuristic, Choose<S>&&... techniques)
        : Base{heuristic, detail::selectable(std::array<Scalar, sizeof...(S)>{techniques.probability...}),
               std::move(techniques)...} {}

    // An unbiased estimate of the integral of f, which is called as by MultiSample::estimate. Spends one uniform on the
    // selection, none if the only technique is certain.
    template <class F, UniformSource<Scalar> U>
    [[nodiscard]] LUMIS_HD auto estimate(F&& f, U&& uniforms) const {
        using Value = decltype(this->template draw<0>(f, uniforms));
        Value result{};
        const bool certain = Base::size == 1 && this->factor(0) >= 1;
        Scalar remaining = certain ? Scalar(0) : glm::vec<1, Scalar>(uniforms.template next<1>()).x;
        bool selected = false;
        detail::for_each_index<Base::size>([&](auto i) {
            if (!selected && remaining < this->factor(i)) {
                selected = true;
                result = this->template draw_as<Value, i>(f, uniforms);
            }
            remaining -= this->factor(i);
        });
        return result;
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

}  // namespace lumis
