// The law that a batch is the single call, many times: what is drawn, densities and estimates agree up to rounding.
#pragma once

#include "lumis/batch/batch.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/agreement.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"
#include "lumis/testing/unbiased.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

namespace detail {

// Uniforms in columns: all combinations of corner values of N numbers, then random ones.
template <int N, std::floating_point T>
[[nodiscard]] std::array<std::vector<T>, N> uniform_columns(int samples, std::uint64_t seed) {
    std::array<std::vector<T>, N> columns;
    const auto add = [&](const glm::vec<N, T>& u) {
        for (int k = 0; k < N; ++k) columns[static_cast<std::size_t>(k)].push_back(u[k]);
    };
    for_each_corner<N, T>(add);
    Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{seed}};
    for (int i = 0; i < samples; ++i) add(uniforms.template next<N>());
    return columns;
}

}  // namespace detail

// For all corner uniforms and many random ones: sample_n draws the points that sample draws, to within `distance_allowed`
// units in the last place of 1, with the density that pdf gives them, and pdf_n gives the same, both up to the rounding of the
// point. A batch may have any size: the last lanes may be empty. number: the largest distance between points, in units in
// the last place.
template <Strategy S>
    requires FloatOrDouble<typename S::Scalar>
[[nodiscard]] LawResult batch_agrees(const S& strategy, const AgreementOptions& options, double distance_allowed) {
    using Scalar = typename S::Scalar;
    using Point = typename S::Point;
    constexpr double ulp = std::numeric_limits<Scalar>::epsilon();
    constexpr std::size_t dimensions = S::dimensions;
    const auto u = detail::uniform_columns<S::dimensions, Scalar>(options.samples, options.seed);
    const auto first = [&](std::size_t size) {
        std::array<std::span<const Scalar>, dimensions> columns;
        for (std::size_t k = 0; k < dimensions; ++k) columns[k] = std::span{u[k]}.first(size);
        return columns;
    };

    const std::size_t count = u[0].size();
    std::vector<Point> value(count);
    std::vector<Scalar> pdf(count), again(count);
    sample_n(strategy, first(count), PointSpans<Point, Scalar>{value, pdf});
    pdf_n(strategy, value, again);

    LawResult result{true, 0, {}};
    const auto fail = [&](const auto&... what) {
        if (result.passed) result.message = detail::text(what...);
        result.passed = false;
    };
    // A density belongs to a point if those of the point and its neighbours bracket it.
    const auto belongs = [&](Scalar density, const Point& x) {
        const auto [low, high] = detail::density_range(strategy, x, static_cast<Scalar>(options.rounding * ulp));
        const double peak = double{high} + (double{high} - double{low}) / 32, slack = options.tolerance * ulp;
        return (1 - slack) * double{low} <= double{density} && double{density} <= (1 + slack) * peak;
    };
    for (std::size_t i = 0; i < count; ++i) {
        UniformsOf<S> alone;
        for (int k = 0; k < S::dimensions; ++k) alone[k] = u[static_cast<std::size_t>(k)][i];
        const auto single = strategy.sample(alone);
        const Point& x = value[i];
        if (!(belongs(pdf[i], x) || (options.unbounded_at_edge && pdf[i] >= 0)) || !belongs(again[i], x)) {
            fail("densities ", pdf[i], " and ", again[i], " at ", x, ", where pdf is ", strategy.pdf(x),
                 "; u = ", alone);
        }
        if (!(single.pdf > 0 && pdf[i] > 0)) {
            // At the edge of the support rounding may decide.
            if (single.pdf > 0 && !belongs(Scalar(0), single.value)) fail("nothing drawn at u = ", alone);
            if (pdf[i] > 0 && !belongs(Scalar(0), x)) fail("drawn only in a batch: u = ", alone);
            continue;
        }
        const double distance = detail::distance(x, Point(single.value)) / ulp;
        if (distance > result.number) result.number = distance;
        if (!(distance <= distance_allowed)) fail("drawn ", x, " in a batch, else ", single.value);
    }
    // Shorter batches, of which the last lanes are empty, are the same to the last bit; so are directions by component.
    for (std::size_t size = 0; size < 2 * NativeLanes<Scalar>::size; ++size) {
        std::vector<Point> short_value(size);
        std::vector<Scalar> short_pdf(size), x(size), y(size), z(size);
        sample_n(strategy, first(size), PointSpans<Point, Scalar>{short_value, short_pdf});
        for (std::size_t i = 0; i < size; ++i) {
            if (!(short_value[i] == value[i] && short_pdf[i] == pdf[i])) fail("a batch of ", size, " differs");
        }
        if constexpr (std::same_as<Point, Direction<Scalar>>) {
            sample_n(strategy, first(size), DirectionSpans<Scalar>{x, y, z, short_pdf});
            for (std::size_t i = 0; i < size; ++i) {
                if (!(Point{x[i], y[i], z[i]} == value[i] && short_pdf[i] == pdf[i]))
                    fail("a batch of ", size, " directions differs");
            }
        }
    }
    if (result.passed) result.message = detail::text("batch and single call agree to ", result.number);
    return result;
}

template <Strategy S>
    requires FloatOrDouble<typename S::Scalar>
[[nodiscard]] LawResult batch_agrees(const S& strategy, const AgreementOptions& options = {}) {
    return batch_agrees(strategy, options, options.rounding);
}

namespace detail {

// The uniforms of one estimate as a source.
template <int N, std::floating_point T>
struct RowOfUniforms {
    const std::array<std::vector<T>, N>& columns;
    std::size_t row;
    std::size_t next_column = 0;

    template <int M>
    [[nodiscard]] glm::vec<M, T> next() {
        glm::vec<M, T> result;
        for (int k = 0; k < M; ++k) result[k] = columns[next_column++][row];
        return result;
    }
};

}  // namespace detail

struct EstimatesOptions {
    // How far an estimate may be off, relative, in units in the last place: rounding moves the drawn point, and with it
    // the density and the integrand.
    double tolerance = 256;
    // The share of estimates that may be off by more: at the edges of supports and of the integrand, rounding decides.
    double share_at_edges = 2e-3;
    int samples = 10'000;
    std::uint64_t seed = 1;
};

// estimate_n makes the estimates that estimate makes of the same uniforms, and is finite where that is: N is the number that
// an estimate spends. f returns a number or a glm::vec. number: the share of estimates that are off.
template <int N, class Estimator, class F>
[[nodiscard]] LawResult batch_agrees(const Estimator& estimator, const F& f, const EstimatesOptions& options = {}) {
    using T = typename Estimator::Scalar;
    using Row = detail::RowOfUniforms<N, T>;
    using Value = decltype(estimator.estimate(f, std::declval<Row&>()));

    std::array<std::vector<T>, N> u;
    const std::array<T, 7> corners = detail::corner_uniforms<T>;
    std::mt19937_64 engine{options.seed};
    Uniforms<std::mt19937_64&, T> uniforms{engine};
    constexpr int at_corners = 500;
    for (int i = 0; i < at_corners + options.samples; ++i) {
        for (auto& column : u) {
            const T random = uniforms.template next<1>().x;
            column.push_back(i < at_corners ? corners[engine() % corners.size()] : random);
        }
    }
    const std::size_t count = u[0].size();
    std::array<std::span<const T>, N> columns;
    for (std::size_t k = 0; k < N; ++k) columns[k] = u[k];
    std::vector<Value> batch(count);
    estimate_n(estimator, f, columns, batch);

    using Channels = detail::Channels<Value>;
    LawResult result{true, 0, {}};
    const auto fail = [&](const auto&... what) {
        if (result.passed) result.message = detail::text(what...);
        result.passed = false;
    };
    if (estimator.uniforms_per_estimate() != N) fail("spends ", estimator.uniforms_per_estimate(), " uniforms");
    std::size_t off = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Value single = estimator.estimate(f, Row{u, i});
        for (int channel = 0; channel < Channels::number; ++channel) {
            const double a = Channels::get(batch[i], channel), b = Channels::get(single, channel);
            if (std::isfinite(a) != std::isfinite(b)) fail("estimate ", i, " is ", a, " in a batch, else ", b);
            const double allowed = options.tolerance * double{std::numeric_limits<T>::epsilon()} * std::abs(b);
            if (i >= at_corners && std::isfinite(b)) off += !(std::abs(a - b) <= allowed);
        }
    }
    result.number = static_cast<double>(off) / static_cast<double>(options.samples);
    if (!(result.number <= options.share_at_edges)) fail(result.number, " of the estimates are off");
    if (result.passed) result.message = detail::text(result.number, " of the estimates are off");
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
