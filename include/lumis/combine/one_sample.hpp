// The one-sample MIS estimator (Veach and Guibas 1995, section 4.3): one technique is selected at random and drawn once.
#pragma once

#include "lumis/combine/combination.hpp"

namespace lumis {

template <class Heuristic, class... S>
class OneSample : public Combination<Heuristic, S...> {
    using Base = Combination<Heuristic, S...>;

  public:
    using typename Base::Scalar;

    explicit constexpr OneSample(const Heuristic& heuristic, Choose<S>&&... techniques)
        : Base{heuristic, {techniques.probability...}, std::move(techniques)...} {}

    // An unbiased estimate of the integral of f, which is called as by MultiSample::estimate. Spends one uniform on the
    // selection, none if the only technique is certain.
    template <class F, UniformSource<Scalar> U>
    [[nodiscard]] auto estimate(F&& f, U&& uniforms) const {
        decltype(this->template draw<0>(f, uniforms)) result{};
        const bool certain = Base::size == 1 && this->factor(0) >= 1;
        Scalar remaining = certain ? Scalar(0) : uniforms.template next<1>().x;
        bool selected = false;
        detail::for_each_index<Base::size>([&](auto i) {
            if (!selected && remaining < this->factor(i)) {
                selected = true;
                result = this->template draw<i>(f, uniforms);
            }
            remaining -= this->factor(i);
        });
        return result;
    }
};

template <class Heuristic, class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] constexpr auto one_sample(const Heuristic& heuristic, Choose<First> first, Choose<Rest>... rest) {
    return OneSample<Heuristic, First, Rest...>{heuristic, std::move(first), std::move(rest)...};
}

}  // namespace lumis
