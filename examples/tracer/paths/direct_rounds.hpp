// Direct light with optimal weights (Kondapaneni et al. 2019): what a pixel's samples of lights and of the BSDF tell of each
// other. A sample is a round; a round's techniques are the BSDF, and each group of lights.
#pragma once

#include "paths/packet.hpp"
#include <lumis/combine/cross_fitted.hpp>
#include <lumis/combine/round.hpp>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace tracer {

// The rounds of a packet. The BSDF's ray has drawn a point of the light that it meets, or else nothing. A light's sample that is
// hidden has drawn nothing either. So a point is drawn by the BSDF and by one group of lights, and by no others.
template <lumis::Real R, std::size_t Groups>
class DirectRounds {
  public:
    using Sums = lumis::CrossFitted<glm::vec3, 1 + Groups>;

    // What was drawn of a group, in the lanes asked for. count: the group's samples in a round. contribution: the integrand over
    // the sum of all effective densities.
    struct Drawn {
        std::size_t group;
        float count;
        Vector<R> contribution;
        R bsdf_pdf, light_pdf;
    };

    void add_light_sample(const Mask<R>& asked, const Mask<R>& is_seen, const Drawn& drawn) {
        for (std::size_t i = 0; i < lanes<R>; ++i) {
            if (!lane(asked, i)) continue;
            if (lane(is_seen, i)) {
                add(drawn, i);
            } else {
                rounds_[i].add_alone(1 + drawn.group, double{drawn.count}, glm::dvec3{0});
            }
        }
    }

    void add_bsdf_sample(const Mask<R>& asked, const Drawn& drawn) {
        for (std::size_t i = 0; i < lanes<R>; ++i) {
            if (!lane(asked, i)) continue;
            add(drawn, i);
            has_bsdf_sample_[i] = true;
        }
    }

    // Adds the rounds of the lanes asked for to a pixel's sums, and starts anew. asks: where both techniques were sampled; the
    // other lanes have drawn nothing by either. counts: the samples of each group.
    void move_to(Sums& sums, const Mask<R>& asked, const Mask<R>& asks, const std::array<std::size_t, Groups>& counts) {
        for (std::size_t i = 0; i < lanes<R>; ++i) {
            if (!lane(asked, i)) continue;
            if (!has_bsdf_sample_[i]) rounds_[i].add_alone(0, 1, glm::dvec3{0});
            for (std::size_t g = 0; g < Groups && !lane(asks, i); ++g) {
                for (std::size_t k = 0; k < counts[g]; ++k) {
                    rounds_[i].add_alone(1 + g, static_cast<double>(counts[g]), glm::dvec3{0});
                }
            }
            auto& factors = rounds_[i].equations.factors;
            factors[0] = 1;
            for (std::size_t g = 0; g < Groups; ++g) factors[1 + g] = static_cast<double>(counts[g]);
            sums.add(rounds_[i]);
        }
        rounds_ = {};
        has_bsdf_sample_ = {};
    }

  private:
    void add(const Drawn& drawn, std::size_t i) {
        const double of_bsdf = lane(drawn.bsdf_pdf, i), of_light = lane(drawn.light_pdf, i);
        const double sum = of_bsdf + double{drawn.count} * of_light;
        std::array<double, 1 + Groups> shares{};
        shares[0] = of_bsdf / sum;
        shares[1 + drawn.group] = of_light / sum;
        rounds_[i].add_sample(glm::dvec3{lane_of(drawn.contribution, i)}, shares);
    }

    std::array<lumis::Round<glm::dvec3, 1 + Groups>, lanes<R>> rounds_{};
    std::array<bool, lanes<R>> has_bsdf_sample_{};
};

}  // namespace tracer
