// A sample that a host goes on with, as a path does: with its density, and with its MIS weight once the host asks for it.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <array>
#include <concepts>
#include <cstddef>

namespace lumis::LUMIS_ISA {

// A sample of technique I of an estimator, which has to live as long. Made by the estimator's weighted_sample<I>(uniforms),
// or by weighted<I>(sample) of a sample that the host has drawn. In lanes, R is lanes.
template <class Estimator, std::size_t I, class Drawn, Real R>
class WeightedSample {
  public:
    static constexpr std::size_t technique = I;
    static constexpr bool is_delta = Estimator::template is_delta<I>;

    // As its strategy drew it, a light's with the distance to this light.
    Drawn sample;

    // n_I p_I or c_I p_I; 0: nothing was drawn. The divisor of a path's throughput where only this technique's samples go on,
    // as those of a BSDF do.
    R density;

    LUMIS_INLINE constexpr WeightedSample(const Estimator& estimator LUMIS_LIFETIME_BOUND, const Drawn& drawn,
                                          R effective_density)
        : sample{drawn}, density{effective_density}, estimator_{&estimator} {}

    // The MIS weight among all techniques; asks each of the others for its density. 1 for a delta strategy's sample. 0 where
    // nothing was drawn, except by PartitionWeights, which ask the point alone.
    [[nodiscard]] LUMIS_INLINE R weight() const noexcept { return weight_given<>(); }

    // The same where the host knows the densities of the strategies K..., from what the sample's ray has hit:
    // weight_given<1>(pdf) takes pdf for what strategy 1 would have answered (without its count n_1 or probability c_1) and
    // asks the rest. A light's pdf_from_hit, times the probability of choosing this light, is such a density.
    template <std::size_t... K>
    [[nodiscard]] LUMIS_INLINE R weight_given(std::convertible_to<R> auto... pdfs) const noexcept {
        static_assert(sizeof...(K) == sizeof...(pdfs), "weight_given<K...> takes a density for each technique K");
        static_assert(((K != I) && ...), "a sample knows the density of the technique that drew it");
        static_assert(!(Estimator::template is_delta<K> || ...), "a delta strategy has no density");
        if constexpr (is_delta) {
            return real::select(density > 0, R(scalar_of<R>(1)), scalar_of<R>(0));
        } else {
            const std::array<R, sizeof...(K)> known{static_cast<R>(pdfs)...};
            return estimator_->template weight_from<I, R>(
                sample.value, [&] { return density; },
                [&](auto k) {
                    constexpr std::array<std::size_t, sizeof...(K)> given{K...};
                    constexpr std::size_t at = position(given, k);
                    if constexpr (at < sizeof...(K)) {
                        return estimator_->template effective<k, R>(known[at]);
                    } else {
                        return estimator_->template density<k, R>(sample.value);
                    }
                });
        }
    }

    // What the integrand is multiplied by in an estimate, weight / density; 0 where nothing was drawn. A path that goes on from
    // whichever technique was selected takes its throughput times this.
    [[nodiscard]] LUMIS_INLINE R factor() const noexcept {
        if constexpr (std::floating_point<R>) {
            return density > 0 ? weight() / density : R(0);
        } else {
            return real::quotient_where(density > 0, weight(), density);
        }
    }

  private:
    // Where k stands among those given; their number if it does not.
    [[nodiscard]] LUMIS_HD static constexpr std::size_t position(const auto& given, std::size_t k) {
        std::size_t at = 0;
        for (const std::size_t one : given) {
            if (one == k) break;
            ++at;
        }
        return at;
    }

    const Estimator* estimator_;
};

}  // namespace lumis::LUMIS_ISA
