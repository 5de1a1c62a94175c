// Many samples at once. A strategy's own kernel is run on lanes of numbers (see lanes.hpp); one that is written for single
// numbers only, as a user's own may be, is called for each. Nothing is allocated, and no thread is started.
//
// Spans of a call have one size. They may not overlap, except that an output may be the very span of an input. What is
// written for an element depends on nothing but that element, wherever in a batch it stands, and agrees with the single call
// to a few units in the last place: compilers fuse multiplications and additions differently.
#pragma once

#include "lumis/combine/heuristics.hpp"
#include "lumis/core/assert.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/detail/held.hpp"
#include "lumis/core/lanes.hpp"
#include "lumis/core/strategy.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace lumis {

// Pairs of uniforms in [0, 1), each component in an array of its own.
template <class T>
struct UniformSpans {
    std::span<const T> x, y;
};

// Where directions and their densities go; pdf 0: nothing was drawn.
template <class T>
struct DirectionSpans {
    std::span<T> x, y, z, pdf;
};

namespace detail {

// Kernels written for a Real. Those for numbers alone seem to take lanes too, for GLM offers to convert any vector.
template <class S, class L>
concept SamplesLanes = requires(const S strategy, glm::vec<2, L> u) {
    { strategy.sample(u).pdf } -> std::same_as<L&&>;
};
template <class F, class L>
concept EvaluatesLanes = requires(const F function, const Direction<L> w) {
    { function(w) } -> std::same_as<L>;
};

// Hands out chunks of `count` numbers: chunk(load, store), where load(span) yields lanes and store(lanes, span) writes them.
// The last lanes of a chunk that is not full are copies of its last number, and are not written.
template <class L, class Chunk>
void for_each_chunk(std::size_t count, Chunk chunk) {
    using T = typename L::Lane;
    std::size_t first = 0;
    for (; first + L::size <= count; first += L::size) {
        chunk([&](std::span<const T> from) { return L::load(from.data() + first); },
              [&](L lanes, std::span<T> to) { lanes.store(to.data() + first); });
    }
    if (first == count) return;
    chunk(
        [&](std::span<const T> from) {
            L lanes{from[count - 1]};
            for (std::size_t i = first; i < count; ++i) lanes.set(i - first, from[i]);
            return lanes;
        },
        [&](L lanes, std::span<T> to) {
            for (std::size_t i = first; i < count; ++i) to[i] = lanes[i - first];
        });
}

}  // namespace detail

// values[i] = function(direction i). `function` is pure; one that takes a glm::vec<3, R> of any Real R is called with lanes.
template <std::floating_point T, class F>
void evaluate_n(const F& function, std::span<const T> x, std::span<const T> y, std::span<const T> z,
                std::span<T> values) {
    using L = NativeLanes<T>;
    LUMIS_ASSERT(x.size() == values.size() && y.size() == values.size() && z.size() == values.size());
    if constexpr (detail::EvaluatesLanes<F, L>) {
        detail::for_each_chunk<L>(values.size(), [&](auto load, auto store) {
            store(L(function(Direction<L>{load(x), load(y), load(z)})), values);
        });
    } else {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = function(Direction<T>{x[i], y[i], z[i]});
    }
}

// out[i] is strategy.sample({u.x[i], u.y[i]}).
template <Strategy S, class T = typename S::Scalar>
    requires(S::dimensions == 2 && std::same_as<typename S::Point, Direction<T>>)
void sample_n(const S& strategy, std::type_identity_t<UniformSpans<T>> u, std::type_identity_t<DirectionSpans<T>> out) {
    using L = NativeLanes<T>;
    const std::size_t count = out.pdf.size();
    LUMIS_ASSERT(u.x.size() == count && u.y.size() == count);
    LUMIS_ASSERT(out.x.size() == count && out.y.size() == count && out.z.size() == count);
    // Small strategies are copied: otherwise the compiler must assume that each store to `out` changes their members, and
    // loads them again.
    detail::Held<const S&> held = strategy;
    if constexpr (detail::SamplesLanes<S, L>) {
        detail::for_each_chunk<L>(count, [&](auto load, auto store) {
            const auto drawn = held.sample(glm::vec<2, L>{load(u.x), load(u.y)});
            store(drawn.value.x, out.x);
            store(drawn.value.y, out.y);
            store(drawn.value.z, out.z);
            store(drawn.pdf, out.pdf);
        });
    } else {
        for (std::size_t i = 0; i < count; ++i) {
            const auto drawn = held.sample({u.x[i], u.y[i]});
            out.x[i] = drawn.value.x;
            out.y[i] = drawn.value.y;
            out.z[i] = drawn.value.z;
            out.pdf[i] = drawn.pdf;
        }
    }
}

// pdf[i] is strategy.pdf of direction i.
template <Strategy S, class T = typename S::Scalar>
    requires std::same_as<typename S::Point, Direction<T>>
void pdf_n(const S& strategy, std::type_identity_t<std::span<const T>> x, std::type_identity_t<std::span<const T>> y,
           std::type_identity_t<std::span<const T>> z, std::type_identity_t<std::span<T>> pdf) {
    detail::Held<const S&> held = strategy;
    evaluate_n<T>([&held](const auto& w) -> decltype(held.pdf(w)) { return held.pdf(w); }, x, y, z, pdf);
}

// weights[i] is the weight of technique `own` where the techniques have effective densities densities[0][i], densities[1][i],
// and so on. The heuristic weighs by densities; a PointHeuristic needs none, its owner(x) is the answer.
template <class H, std::floating_point T, std::size_t N>
    requires DensityHeuristic<H, T, N>
void mis_weight_n(const H& heuristic, std::size_t own, const std::array<std::span<const T>, N>& densities,
                  std::type_identity_t<std::span<T>> weights) {
    using L = NativeLanes<T>;
    for ([[maybe_unused]] const auto& technique : densities) LUMIS_ASSERT(technique.size() == weights.size());
    detail::for_each_chunk<L>(weights.size(), [&](auto load, auto store) {
        std::array<L, N> lanes;
        detail::for_each_index<N>([&](auto k) { lanes[k] = load(densities[k]); });
        store(detail::weigh(heuristic, own, std::span<const L, N>{lanes}), weights);
    });
}

// The weight of the technique that drew the samples, with densities `own`, against one other technique.
template <class H, std::floating_point T>
    requires DensityHeuristic<H, T, 2>
void mis_weight_n(const H& heuristic, std::type_identity_t<std::span<const T>> own,
                  std::type_identity_t<std::span<const T>> other, std::span<T> weights) {
    mis_weight_n(heuristic, 0, std::array{own, other}, weights);
}

}  // namespace lumis
