// The multi-sample MIS estimator (Veach and Guibas 1995, eq. 15): n_i samples of every technique, each weighted.
#pragma once

#include "lumis/combine/combination.hpp"

namespace lumis {

template <class Heuristic, class... S>
class MultiSample : public Combination<Heuristic, S...> {
    using Base = Combination<Heuristic, S...>;

  public:
    using typename Base::Scalar;

    explicit constexpr MultiSample(const Heuristic& heuristic, Take<S>&&... techniques)
        : Base{heuristic, {static_cast<Scalar>(techniques.count)...}, std::move(techniques)...},
          counts_{techniques.count...} {}

    // An unbiased estimate of the integral of f. f(x) returns a number, a glm::vec, or any type that adds to itself and
    // scales by Scalar, and whose value-initialised object is zero. It may take the whole sample instead, f(sample),
    // if it cannot be called with the point alone; a delta strategy calls f(x, lumis::delta), with weight 1.
    template <class F, UniformSource<Scalar> U>
    [[nodiscard]] auto estimate(F&& f, U&& uniforms) const {
        decltype(this->template draw<0>(f, uniforms)) sum{};
        detail::for_each_index<Base::size>([&](auto i) {
            for (int k = 0; k < counts_[i]; ++k) {
                const auto value = this->template draw<i>(f, uniforms);
                sum = i == 0 && k == 0 ? value : sum + value;
            }
        });
        return sum;
    }

  private:
    std::array<int, sizeof...(S)> counts_;
};

template <class Heuristic, class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] constexpr auto multi_sample(const Heuristic& heuristic, Take<First> first, Take<Rest>... rest) {
    return MultiSample<Heuristic, First, Rest...>{heuristic, std::move(first), std::move(rest)...};
}

}  // namespace lumis
