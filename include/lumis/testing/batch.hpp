// The law that a batch is the single call, many times: what is drawn and the densities agree up to rounding.
#pragma once

#include "lumis/batch/batch.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/agreement.hpp"
#include "lumis/testing/result.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

namespace lumis::testing {

// What sample_n and pdf_n take.
template <class S>
concept BatchStrategy =
    Strategy<S> && S::dimensions == 2 && std::same_as<typename S::Point, Direction<typename S::Scalar>>;

// For all corner uniforms and many random ones: sample_n draws the directions that sample draws, to within `distance_allowed`
// units in the last place of 1, with the density that pdf gives them, and pdf_n gives the same, both up to the rounding of the
// direction. A batch may have any size: the last lanes may be empty. number: the largest distance between directions, in
// units in the last place.
template <BatchStrategy S>
[[nodiscard]] LawResult batch_agrees(const S& strategy, const AgreementOptions& options, double distance_allowed) {
    using Scalar = typename S::Scalar;
    using Numbers = std::vector<Scalar>;
    constexpr double ulp = std::numeric_limits<Scalar>::epsilon();
    Numbers ux, uy;
    const auto add = [&](const UniformsOf<S>& u) {
        ux.push_back(u.x);
        uy.push_back(u.y);
    };
    detail::for_each_corner<2, Scalar>(add);
    Uniforms<std::mt19937_64, Scalar> uniforms{std::mt19937_64{options.seed}};
    for (int i = 0; i < options.samples; ++i) add(uniforms.template next<2>());

    const std::size_t count = ux.size();
    Numbers x(count), y(count), z(count), pdf(count), again(count);
    sample_n(strategy, {ux, uy}, {x, y, z, pdf});
    pdf_n(strategy, x, y, z, again);

    LawResult result{true, 0, {}};
    const auto fail = [&](const auto&... what) {
        if (result.passed) result.message = detail::text(what...);
        result.passed = false;
    };
    // A density belongs to a direction if those of the direction and its neighbours bracket it.
    const auto belongs = [&](Scalar density, const Direction<Scalar>& w) {
        const auto [low, high] = detail::density_range(strategy, w, static_cast<Scalar>(options.rounding * ulp));
        const double peak = double{high} + (double{high} - double{low}) / 32, slack = options.tolerance * ulp;
        return (1 - slack) * double{low} <= double{density} && double{density} <= (1 + slack) * peak;
    };
    for (std::size_t i = 0; i < count; ++i) {
        const auto single = strategy.sample({ux[i], uy[i]});
        const Direction<Scalar> w{x[i], y[i], z[i]};
        if (!(belongs(pdf[i], w) || (options.unbounded_at_edge && pdf[i] >= 0)) || !belongs(again[i], w)) {
            fail("densities ", pdf[i], " and ", again[i], " at ", w, ", where pdf is ", strategy.pdf(w), "; u = (",
                 ux[i], ", ", uy[i], ")");
        }
        if (!(single.pdf > 0 && pdf[i] > 0)) {
            // At the edge of the support rounding may decide.
            if (single.pdf > 0 && !belongs(Scalar(0), single.value))
                fail("nothing drawn at u = (", ux[i], ", ", uy[i], ")");
            if (pdf[i] > 0 && !belongs(Scalar(0), w)) fail("drawn only in a batch: u = (", ux[i], ", ", uy[i], ")");
            continue;
        }
        const double distance = glm::length(glm::dvec3{w} - glm::dvec3{single.value}) / ulp;
        if (distance > result.number) result.number = distance;
        if (!(distance <= distance_allowed)) fail("drawn ", w, " in a batch, else ", single.value);
    }
    // Shorter batches, of which the last lanes are empty, are the same to the last bit.
    for (std::size_t size = 0; size < 2 * NativeLanes<Scalar>::size; ++size) {
        Numbers sx(size), sy(size), sz(size), sp(size);
        sample_n(strategy, {std::span{ux}.first(size), std::span{uy}.first(size)}, {sx, sy, sz, sp});
        for (std::size_t i = 0; i < size; ++i) {
            if (!(sx[i] == x[i] && sy[i] == y[i] && sz[i] == z[i] && sp[i] == pdf[i]))
                fail("a batch of ", size, " differs");
        }
    }
    if (result.passed) result.message = detail::text("batch and single call agree to ", result.number);
    return result;
}

template <BatchStrategy S>
[[nodiscard]] LawResult batch_agrees(const S& strategy, const AgreementOptions& options = {}) {
    return batch_agrees(strategy, options, options.rounding);
}

}  // namespace lumis::testing
