// Directions towards what a receiver sees of a triangle or parallelogram above its horizon, nearly in proportion to the cosine
// there. The polygon is a fan of spherical triangles about its point nearest to the receiver's normal, the apex a:
//
//     v3 ------- v2           Each triangle is drawn evenly by solid angle at uniforms that a bilinear warp has moved to where the
//      \  .    .  |           cosine is large (Hart et al. 2020). One triangle is chosen in proportion to its solid angle times the
//       \   .     |           mean of its bilinear weights, so that the density is the weight over one sum for all.
//         - a -- v1
//
// Spherical triangles move evenly in y = (1 - cos s) / (1 - cos S) along an arc of length S from a to the edge before them. The
// cosine there, exactly, is
//     cos(theta) = cos(theta_a) (1 - y (1 - cos S)) + D sin(s) / sin(S),   D = cos(theta_q) - cos(theta_a) cos(S) <= 0
// with q the arc's end. The first term is linear in y, and all of it if a is the normal. In the second sin(s) is nearly
// sin(S) sqrt(y), for which stands the line next to it in the mean square, 4/15 + 4/5 y.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/lights/detail/bilinear_warp.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/detail/horizon_polygon.hpp"
#include "lumis/lights/detail/spherical_triangle.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>

namespace lumis::LUMIS_ISA::detail {

template <class Shape>
class CosineFan {
    using T = typename Shape::Scalar;
    using Polygon = HorizonPolygon<Shape>;
    using W = typename FlatShape<Shape>::Wide;
    using Vector = glm::vec<3, W>;
    using Point = HorizonPoint<W>;

  public:
    // nearest: of the polygon, at a cosine above 0.
    LUMIS_INLINE CosineFan(const Polygon& polygon, const typename Polygon::NearestPoint& nearest_point) noexcept {
        const auto& [nearest, next, apex] = nearest_point;
        closed_ = nearest == Polygon::Nearest::Normal;
        // Around from the vertex after the apex: to where it began, to the vertex before it, or to the one before the apex.
        const int triangles = closed_                             ? polygon.size()
                              : nearest == Polygon::Nearest::Edge ? polygon.size() - 1
                                                                  : polygon.size() - 2;
        const W scale = 1 / apex.cosine;
        auto start = spoke_to(polygon[next], apex, scale);
        Vector to_start = polygon.between(apex, polygon[next]);
        for (int i = next; i < next + triangles; ++i) {
            const Point &b = polygon[i], &c = polygon[i + 1];
            const auto end = spoke_to(c, apex, scale);
            const Vector to_end = polygon.between(apex, c);
            const SphericalTriangle<T> triangle{apex.position, b.position, c.position, to_start, to_end};
            if (triangle.solid_angle() > 0) {
                const BilinearWarp<T> warp{start.at_apex, end.at_apex, start.at_edge, end.at_edge};
                sum_ += triangle.solid_angle() * warp.mean();
                // Scaled, so that no square of a component leaves the range of T.
                const Vector side =
                    polygon.is_clockwise() ? cross(to_end, apex.position) : cross(apex.position, to_end);
                const W length = real::length(side);
                const Vector beyond = side * real::quotient_where(length > 0, W(1), length);
                pieces_[size_++] = {triangle, warp, Direction<T>{beyond}, sum_};
            }
            start = end;
            to_start = to_end;
        }
        const T inverse = real::quotient_where(sum_ > 0, T(1), sum_);
        for (int i = 0; i < size_; ++i) pieces_[i].end *= inverse;
        if (size_ > 0) pieces_[size_ - 1].end = 1;
        scale_ = density_or_zero(inverse);
    }

    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return !(scale_ > 0); }

    // The direction, and its density. Not of an empty fan, as below.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE Sample<Direction<R>, R> sample(const glm::vec<2, R>& u) const noexcept {
        if constexpr (std::floating_point<R>) {
            int i = 0;
            while (i + 1 < size_ && !(u.x < pieces_[i].end)) ++i;
            return sample_of(i, u);
        } else {
            Sample<Direction<R>, R> drawn = sample_of(0, u);
            for (int i = 1; i < size_; ++i) {
                const auto here = u.x >= pieces_[i - 1].end;
                const Sample<Direction<R>, R> other = sample_of(i, u);
                drawn.value = real::select(here, other.value, drawn.value);
                drawn.pdf = real::select(here, other.pdf, drawn.pdf);
            }
            return drawn;
        }
    }

    // w: towards the part of the shape that is above the horizon.
    [[nodiscard]] LUMIS_HD T pdf(const Direction<T>& w) const noexcept {
        const auto& piece = pieces_[piece_of(w)];
        return piece.warp.weight(within_square(piece.triangle.invert(w))) * scale_;
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const int i = piece_of(w);
        const glm::vec<2, T> u = pieces_[i].warp.invert(within_square(pieces_[i].triangle.invert(w)));
        return {start_of(i) + u.x * (pieces_[i].end - start_of(i)), u.y};
    }

  private:
    struct Piece {
        SphericalTriangle<T> triangle;
        BilinearWarp<T> warp;
        Direction<T> beyond{0, 0, 0};  // w lies beyond the arc from the apex to the triangle's end if w . beyond > 0
        T end{0};                      // of its share in u.x
    };

    // The weights at both ends of an arc from the apex, over the cosine at the apex.
    struct Spoke {
        T at_apex, at_edge;
    };
    [[nodiscard]] LUMIS_INLINE static Spoke spoke_to(const Point& q, const Point& apex, W scale) noexcept {
        const W lengths = apex.length * q.length;
        const W cos_arc = real::quotient_where(lengths > 0, W(glm::dot(apex.position, q.position)), lengths);
        const W d = scale * q.cosine - cos_arc;
        // Positive throughout: a density of 0 anywhere above the horizon would be a bias.
        const W least = real::greater(scalar_of<W>(0.5) * scale * q.cosine, scalar_of<W>(1.0 / 256));
        return {static_cast<T>(1 + d * scalar_of<W>(4.0 / 15)),
                static_cast<T>(real::greater(scale * q.cosine + d * scalar_of<W>(1.0 / 15), least))};
    }

    [[nodiscard]] LUMIS_HD T start_of(int i) const noexcept { return i > 0 ? pieces_[i - 1].end : T(0); }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE Sample<Direction<R>, R> sample_of(int i, const glm::vec<2, R>& u) const noexcept {
        const Piece& piece = pieces_[i];
        // A share may be too small to count beside the others.
        const T start = start_of(i), share = piece.end - start;
        const glm::vec<2, R> own{real::clamp(real::quotient_where(MaskOf<R>(share > 0), R(u.x - start), share), 0, 1),
                                 u.y};
        const glm::vec<2, R> at = piece.warp.sample(own);
        return {piece.triangle.sample(at), piece.warp.weight(at) * scale_};
    }

    // The triangle that w lies in. Next to an arc between two triangles either will do, for their weights are the same there.
    [[nodiscard]] LUMIS_HD int piece_of(const Direction<T>& w) const noexcept {
        bool beyond_start = !closed_ || glm::dot(w, pieces_[size_ - 1].beyond) > 0;
        int i = 0;
        for (; i + 1 < size_; ++i) {
            const bool beyond_end = glm::dot(w, pieces_[i].beyond) > 0;
            if (beyond_start && !beyond_end) break;
            beyond_start = beyond_end;
        }
        return i;
    }

    Piece pieces_[Polygon::most_vertices];
    int size_{0};
    bool closed_{false};  // whether the triangles go all the way around
    T sum_{0};            // of solid angles times mean weights
    T scale_{0};          // 1 / sum
};

}  // namespace lumis::LUMIS_ISA::detail
