// Many samples, densities, weights or estimates at once. A kernel is run on lanes of numbers (see core/lanes.hpp); one that
// is written for single numbers only, as a user's own may be, is called for each. Nothing is allocated, and no thread is
// started.
//
// Spans of a call have one size. They may not overlap, except that an output may be the very span of an input. What is
// written for an element depends on nothing but that element, wherever in a batch it stands, and agrees with the single call
// to a few units in the last place: compilers fuse multiplications and additions differently.
#pragma once

// Macros of a host's that are names here are set aside up to the last line.
#pragma push_macro("D")
#pragma push_macro("Real")
#pragma push_macro("real")
#undef D
#undef Real
#undef real

#include "lumis/combine/heuristics.hpp"
#include "lumis/core/assert.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/detail/held.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace lumis::LUMIS_ISA {

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

// The same of a light, with the distance along the direction.
template <class T>
struct LightSpans {
    std::span<T> x, y, z, pdf, distance;
};

// Where points of any type and their densities go: those of tables are numbers, a glm::vec, or indices.
template <class Point, class T>
struct PointSpans {
    std::span<Point> value;
    std::span<T> pdf;
};

namespace detail {

// Some lanes' worth of consecutive elements. The last chunk may have fewer: its other lanes are copies of its last element,
// and are not written.
template <class L, bool is_full>
class Chunk {
    using T = typename L::Lane;

  public:
    LUMIS_INLINE Chunk(std::size_t first, std::size_t size) : first_{first}, size_{size} {}

    [[nodiscard]] LUMIS_INLINE L load(std::span<const T> from) const {
        if constexpr (is_full) {
            return L::load(from.data() + first_);
        } else {
            L lanes{from[first_ + size_ - 1]};
            for (std::size_t i = 0; i < size_; ++i) lanes.set(i, from[first_ + i]);
            return lanes;
        }
    }
    // Lanes of points, from an array of them.
    template <class Lanes, class Point>
    [[nodiscard]] LUMIS_INLINE Lanes load_points(std::span<const Point> from) const {
        Lanes lanes{};
        for (std::size_t i = 0; i < L::size; ++i) put_lane(lanes, i, from[first_ + (i < size() ? i : size() - 1)]);
        return lanes;
    }

    LUMIS_INLINE void store(L lanes, std::span<T> to) const {
        if constexpr (is_full) {
            lanes.store(to.data() + first_);
        } else {
            for (std::size_t i = 0; i < size_; ++i) to[first_ + i] = lanes[i];
        }
    }
    template <class Lanes, class Point>
    LUMIS_INLINE void store(const Lanes& lanes, std::span<Point> to) const {
        for (std::size_t i = 0; i < size(); ++i) to[first_ + i] = static_cast<Point>(lane_of(lanes, i));
    }

  private:
    [[nodiscard]] LUMIS_INLINE std::size_t size() const { return is_full ? L::size : size_; }

    std::size_t first_, size_;
};

// Calls visit(chunk) for all chunks of `count` elements.
template <class L, class Visit>
void for_each_chunk(std::size_t count, Visit visit) {
    std::size_t first = 0;
    for (; first + L::size <= count; first += L::size) visit(Chunk<L, true>{first, L::size});
    if (first < count) visit(Chunk<L, false>{first, count - first});
}

// Uniforms of a chunk as a source: number k of an estimate or sample comes from column k.
template <class L, class Chunk>
class UniformColumns {
  public:
    LUMIS_INLINE UniformColumns(std::span<const std::span<const typename L::Lane>> columns, const Chunk& chunk)
        : columns_{columns}, chunk_{chunk} {}

    template <int N>
    [[nodiscard]] LUMIS_INLINE glm::vec<N, L> next() {
        glm::vec<N, L> u;
        for (int k = 0; k < N; ++k) u[k] = chunk_.load(columns_[next_++]);
        return u;
    }

  private:
    std::span<const std::span<const typename L::Lane>> columns_;
    const Chunk& chunk_;
    std::size_t next_ = 0;
};

// Calls store(chunk, sample) for all samples that a strategy draws, lanes at a time.
// Small strategies are copied: otherwise the compiler must assume that each store changes their members, and loads them
// again.
template <class S, class Store>
void sample_chunks(const S& strategy, const std::array<std::span<const typename S::Scalar>, S::dimensions>& u,
                   std::size_t count, Store store) {
    using L = NativeLanes<typename S::Scalar>;
    for ([[maybe_unused]] const auto& column : u) LUMIS_ASSERT(column.size() == count);
    Held<const S&> held = strategy;
    for_each_chunk<L>(count, [&](const auto& chunk) {
        glm::vec<S::dimensions, L> numbers;
        for (int k = 0; k < S::dimensions; ++k) numbers[k] = chunk.load(u[static_cast<std::size_t>(k)]);
        store(chunk, sample_in<L>(held, numbers));
    });
}

}  // namespace detail

// values[i] = function(direction i). `function` is pure; one that takes a glm::vec<3, R> of any Real R is called with lanes.
template <std::floating_point T, class F>
void evaluate_n(const F& function, std::span<const T> x, std::span<const T> y, std::span<const T> z,
                std::span<T> values) {
    using L = NativeLanes<T>;
    LUMIS_ASSERT(x.size() == values.size() && y.size() == values.size() && z.size() == values.size());
    if constexpr (detail::EvaluatesLanes<F, Direction<L>, L>) {
        detail::for_each_chunk<L>(values.size(), [&](const auto& chunk) {
            chunk.store(L(function(Direction<L>{chunk.load(x), chunk.load(y), chunk.load(z)})), values);
        });
    } else {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = function(Direction<T>{x[i], y[i], z[i]});
    }
}

// out[i] is strategy.sample({u.x[i], u.y[i]}).
template <Strategy S, class T = typename S::Scalar>
    requires(S::dimensions == 2 && std::same_as<typename S::Point, Direction<T>>)
void sample_n(const S& strategy, std::type_identity_t<UniformSpans<T>> u, std::type_identity_t<DirectionSpans<T>> out) {
    LUMIS_ASSERT(out.x.size() == out.pdf.size() && out.y.size() == out.pdf.size() && out.z.size() == out.pdf.size());
    detail::sample_chunks(strategy, {u.x, u.y}, out.pdf.size(), [&](const auto& chunk, const auto& drawn) {
        chunk.store(drawn.value.x, out.x);
        chunk.store(drawn.value.y, out.y);
        chunk.store(drawn.value.z, out.z);
        chunk.store(drawn.pdf, out.pdf);
    });
}

// The same for a strategy of any dimension, u[k] being the k-th numbers of all samples, and for other kinds of output, which
// are spelt out: LightSpans<T>{x, y, z, pdf, distance} of a light, PointSpans<Point, T>{value, pdf} of any strategy.
template <Strategy S, class Out, class T = typename S::Scalar>
    requires std::same_as<Out, DirectionSpans<T>> || std::same_as<Out, LightSpans<T>> ||
        std::same_as<Out, PointSpans<typename S::Point, T>>
void sample_n(const S& strategy, std::type_identity_t<std::array<std::span<const T>, S::dimensions>> u, Out out) {
    detail::sample_chunks(strategy, u, out.pdf.size(), [&](const auto& chunk, const auto& drawn) {
        if constexpr (std::same_as<Out, PointSpans<typename S::Point, T>>) {
            chunk.store(drawn.value, out.value);
        } else {
            chunk.store(drawn.value.x, out.x);
            chunk.store(drawn.value.y, out.y);
            chunk.store(drawn.value.z, out.z);
        }
        chunk.store(drawn.pdf, out.pdf);
        if constexpr (detail::HasDistance<Out>) chunk.store(drawn.distance, out.distance);
    });
}
template <Strategy S, class Out, class T = typename S::Scalar>
    requires(S::dimensions == 2 &&
             (std::same_as<Out, LightSpans<T>> || std::same_as<Out, PointSpans<typename S::Point, T>>))
void sample_n(const S& strategy, std::type_identity_t<UniformSpans<T>> u, Out out) {
    sample_n(strategy, std::array{u.x, u.y}, out);
}

// pdf[i] is strategy.pdf of direction i.
template <Strategy S, class T = typename S::Scalar>
    requires std::same_as<typename S::Point, Direction<T>>
void pdf_n(const S& strategy, std::type_identity_t<std::span<const T>> x, std::type_identity_t<std::span<const T>> y,
           std::type_identity_t<std::span<const T>> z, std::type_identity_t<std::span<T>> pdf) {
    detail::Held<const S&> held = strategy;
    evaluate_n<T>([&held](const auto& w) -> decltype(held.pdf(w)) { return held.pdf(w); }, x, y, z, pdf);
}

// The same of points of any type, each as one object.
template <Strategy S, class T = typename S::Scalar>
void pdf_n(const S& strategy, std::type_identity_t<std::span<const typename S::Point>> x,
           std::type_identity_t<std::span<T>> pdf) {
    using L = NativeLanes<T>;
    LUMIS_ASSERT(x.size() == pdf.size());
    detail::Held<const S&> held = strategy;
    detail::for_each_chunk<L>(pdf.size(), [&](const auto& chunk) {
        chunk.store(detail::pdf_in<L>(held, chunk.template load_points<detail::PointOf<S, L>>(x)), pdf);
    });
}

// out[i] is estimator.estimate(f, uniforms) with the numbers uniforms[0][i], uniforms[1][i] and so on, as many as
// estimator.uniforms_per_estimate(). `out` is a contiguous range of what f returns: numbers, or glm::vec of them. f is pure;
// it is called with lanes if it takes them, and then also with points that count for nothing.
template <class Estimator, class F, detail::Spannable Out, FloatOrDouble T = typename Estimator::Scalar>
void estimate_n(const Estimator& estimator, const F& f,
                std::type_identity_t<std::span<const std::span<const T>>> uniforms, Out&& out) {
    using L = NativeLanes<T>;
    const std::span values{out};
    LUMIS_ASSERT(uniforms.size() == estimator.uniforms_per_estimate());
    for ([[maybe_unused]] const auto& column : uniforms) LUMIS_ASSERT(column.size() == values.size());
    detail::Held<const Estimator&> held = estimator;
    detail::for_each_chunk<L>(values.size(), [&](const auto& chunk) {
        chunk.store(held.estimate(f, detail::UniformColumns<L, std::remove_cvref_t<decltype(chunk)>>{uniforms, chunk}),
                    values);
    });
}

// weights[i] is the weight of technique `own` where the techniques have effective densities densities[0][i], densities[1][i],
// and so on. The heuristic weighs by densities; a PointHeuristic needs none, its owner(x) is the answer.
template <class H, std::floating_point T, std::size_t N>
    requires DensityHeuristic<H, T, N>
void mis_weight_n(const H& heuristic, std::size_t own, const std::array<std::span<const T>, N>& densities,
                  std::type_identity_t<std::span<T>> weights) {
    using L = NativeLanes<T>;
    for ([[maybe_unused]] const auto& technique : densities) LUMIS_ASSERT(technique.size() == weights.size());
    detail::for_each_chunk<L>(weights.size(), [&](const auto& chunk) {
        std::array<L, N> lanes;
        detail::for_each_index<N>([&](auto k) { lanes[k] = chunk.load(densities[k]); });
        chunk.store(detail::weigh(heuristic, own, std::span<const L, N>{lanes}), weights);
    });
}

// The weight of the technique that drew the samples, with densities `own`, against one other technique.
template <class H, std::floating_point T>
    requires DensityHeuristic<H, T, 2>
void mis_weight_n(const H& heuristic, std::type_identity_t<std::span<const T>> own,
                  std::type_identity_t<std::span<const T>> other, std::span<T> weights) {
    mis_weight_n(heuristic, 0, std::array{own, other}, weights);
}

}  // namespace lumis::LUMIS_ISA

#pragma pop_macro("D")
#pragma pop_macro("Real")
#pragma pop_macro("real")
