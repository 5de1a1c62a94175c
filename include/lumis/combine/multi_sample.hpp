// The multi-sample MIS estimator (Veach and Guibas 1995, eq. 15): n_i samples of every technique, each weighted.
#pragma once

#include "lumis/combine/combination.hpp"
#include "lumis/core/platform.hpp"

namespace lumis::LUMIS_ISA {

template <class H, class... S>
class MultiSample : public Combination<H, S...> {
    using Base = Combination<H, S...>;

  public:
    using typename Base::Scalar;

    LUMIS_HD explicit constexpr MultiSample(const H& heuristic, Take<S>&&... techniques)
        : Base{heuristic, {Scalar(static_cast<scalar_of<Scalar>>(techniques.count))...}, std::move(techniques)...},
          counts_{techniques.count...} {}

    // An unbiased estimate of the integral of f, of the type that f returns; integers count as Scalar. f(x) returns a number,
    // a glm::vec, or any type that adds to itself, scales by a float or a double, and has a lumis::zero. It may take the
    // whole sample instead, f(sample), if it cannot be called with the point alone; a delta strategy calls
    // f(x, lumis::delta), with weight 1. What takes technique<I> as well is told which technique drew, see Takes.
    //
    // A source that yields Lanes of Scalar makes an estimate in each lane. f then gets points in lanes; one that is written
    // for numbers is called for each lane. A type of one's own offers select(condition, a, b).
    template <class F, class U>
        requires UniformSource<U, RealFrom<U, Scalar>>
    [[nodiscard]] LUMIS_HD auto estimate(F&& f, U&& uniforms) const {
        using R = RealFrom<U, Scalar>;
        using First = typename Base::template Nth<0>;
        using Value = decltype(this->template draw<0, R>(f, detail::next_for<First, R>(uniforms)));
        Value sum = zero<Value>::value();
        detail::for_each_index<Base::size>([&](auto i) {
            using Part = typename Base::template Nth<i>;
            for (int k = 0; k < counts_[i]; ++k) {
                const Value value =
                    Base::template as_value<Value>(this->template draw<i, R>(f, detail::next_for<Part, R>(uniforms)));
                sum = i == 0 && k == 0 ? value : Value(sum + value);
            }
        });
        return sum;
    }

    // What an estimate spends.
    [[nodiscard]] LUMIS_HD constexpr std::size_t uniforms_per_estimate() const noexcept {
        std::size_t sum = 0;
        detail::for_each_index<Base::size>([&](auto i) {
            sum += static_cast<std::size_t>(counts_[i]) * std::size_t{Base::template Nth<i>::dimensions};
        });
        return sum;
    }

  protected:
    [[nodiscard]] LUMIS_HD constexpr int count(std::size_t i) const noexcept { return counts_[i]; }

  private:
    std::array<int, sizeof...(S)> counts_;
};

// heuristic: BalanceHeuristic{}, PowerHeuristic{}, or another Heuristic.
template <class H, class First, class... Rest>
    requires HeuristicFor<H, First, Rest...> && Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto multi_sample(const H& heuristic, Take<First> first LUMIS_LIFETIME_BOUND,
                                                   Take<Rest>... rest LUMIS_LIFETIME_BOUND) {
    return MultiSample<H, First, Rest...>{heuristic, std::move(first), std::move(rest)...};
}

template <class... S>
void multi_sample(Take<S>... the_first_argument_must_be_a_heuristic) = delete;

}  // namespace lumis::LUMIS_ISA
