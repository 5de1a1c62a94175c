// A strategy of which each lane has its own, and a source that yields the same lanes again and again.
#pragma once

#include <lumis/core/real.hpp>
#include <lumis/core/strategy.hpp>

// Evenly over [0, width], of a width for each lane if R is made of lanes.
template <lumis::Real R>
struct EvenUpTo {
    using Scalar = R;
    using Point = R;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    R width;

    [[nodiscard]] lumis::Sample<R, R> sample(const glm::vec<1, R>& u) const noexcept {
        return {u.x * width, 1 / width};
    }
    [[nodiscard]] R pdf(const R& x) const noexcept {
        return lumis::real::select(x >= 0 && x <= width, R(1 / width), lumis::scalar_of<R>(0));
    }
};

template <class L>
struct Same {
    L u;

    template <int N>
    [[nodiscard]] glm::vec<N, L> next() const {
        return glm::vec<N, L>(u);
    }
};
template <class L>
Same(L) -> Same<L>;
