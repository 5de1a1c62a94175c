// The part of a triangle or parallelogram above a receiver's horizon, and its point nearest to the receiver's normal, where the
// cosine at the receiver is largest.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/lights/detail/flat_shape.hpp"

#include <glm/geometric.hpp>

#include <limits>

namespace lumis::LUMIS_ISA::detail {

// A point of the shape: its coordinates there, so that differences between points lie in its plane and keep their digits; its
// position relative to the reference point; and its cosine at the receiver.
template <class W>
struct HorizonPoint {
    glm::vec<2, W> at{};
    glm::vec<3, W> position{};
    W height{};  // over the horizon
    W length{};  // of the position
    W cosine{};
};

template <class Shape>
class HorizonPolygon {
    using W = typename FlatShape<Shape>::Wide;
    using Vector = glm::vec<3, W>;
    using Point = HorizonPoint<W>;

  public:
    static constexpr int most_vertices = FlatShape<Shape>::is_triangle ? 4 : 5;

    LUMIS_INLINE HorizonPolygon(const FlatShape<Shape>& shape, const Vector& normal) noexcept
        : edges_{shape.in_units()},
          normal_{normal},
          across_{cross(edges_.edge_u, edges_.edge_v)},
          volume_{glm::dot(edges_.corner, across_)} {
        if (!(volume_ > 0 || volume_ < 0)) return;
        constexpr bool is_triangle = FlatShape<Shape>::is_triangle;
        constexpr int corners = is_triangle ? 3 : 4;
        const glm::vec<2, W> at[] = {{0, 0}, {1, 0}, is_triangle ? glm::vec<2, W>{0, 1} : glm::vec<2, W>{1, 1}, {0, 1}};
        // Summed so that opposite corners are never both above and the other two both below, whatever is rounded.
        const W height = glm::dot(edges_.corner, normal), rise_u = glm::dot(edges_.edge_u, normal),
                rise_v = glm::dot(edges_.edge_v, normal), rise = is_triangle ? rise_v : real::rounded(rise_u + rise_v);
        const W heights[] = {height, height + rise_u, height + rise, height + rise_v};
        for (int i = 0; i < corners; ++i) {
            const int k = i + 1 < corners ? i + 1 : 0;
            // A corner that touches the horizon is one vertex, not two where its edges meet the horizon.
            if (heights[i] >= 0) add(at[i], heights[i]);
            // Where the edge crosses the horizon, as a share of the edge from the end that is above.
            if (heights[i] > 0 && heights[k] < 0)
                add(at[i] + (at[k] - at[i]) * real::divide(heights[i], heights[i] - heights[k]), 0);
            if (heights[i] < 0 && heights[k] > 0)
                add(at[k] + (at[i] - at[k]) * real::divide(heights[k], heights[k] - heights[i]), 0);
        }
    }

    // 0 where nothing is above the horizon, or the shape is edge-on or seen from one of its points.
    [[nodiscard]] LUMIS_HD int size() const noexcept { return size_; }

    // How the vertices are passed, as seen from the reference point.
    [[nodiscard]] LUMIS_HD bool is_clockwise() const noexcept { return volume_ < 0; }

    // Counted around.
    [[nodiscard]] LUMIS_HD const Point& operator[](int i) const noexcept {
        return vertices_[i < size_ ? i : i - size_];
    }

    // Whether it is the whole of a parallelogram, or what a horizon leaves of it that is parallel to an edge.
    [[nodiscard]] LUMIS_HD bool is_parallelogram() const noexcept {
        const glm::vec<2, W> d = vertices_[0].at - vertices_[1].at + vertices_[2].at - vertices_[3].at;
        return size_ == 4 &&
               real::abs(d.x) + real::abs(d.y) <= 8 * std::numeric_limits<typename Shape::Scalar>::epsilon();
    }

    // The way from one of its points to another.
    [[nodiscard]] LUMIS_INLINE Vector between(const Point& from, const Point& to) const noexcept {
        const glm::vec<2, W> d = to.at - from.at;
        return d.x * edges_.edge_u + d.y * edges_.edge_v;
    }

    // Where the polygon is nearest to the normal. `next` is the vertex after it, in the order of the polygon.
    enum class Nearest { Normal, Edge, Vertex };
    struct NearestPoint {
        Nearest is;
        int next;
        Point point;
    };
    // The polygon has vertices.
    [[nodiscard]] LUMIS_INLINE NearestPoint nearest_to_normal() const noexcept {
        int highest = 0;
        for (int i = 1; i < size_; ++i) highest = vertices_[i].cosine > vertices_[highest].cosine ? i : highest;
        NearestPoint nearest{Nearest::Vertex, highest + 1, vertices_[highest]};
        const W facing = glm::dot(across_, normal_);
        bool is_inside = facing > 0 || facing < 0;
        // An edge's own nearest point counts where its cosine is much larger: otherwise it is not worth another triangle.
        W least = nearest.point.cosine * scalar_of<W>(1.1);
        for (int i = 0; i < size_; ++i) {
            const Point &p = vertices_[i], &q = (*this)[i + 1];
            const W side = glm::dot(glm::cross(p.position, between(p, q)), normal_);
            if (is_clockwise() ? side < 0 : side > 0) continue;
            is_inside = false;
            // How steeply the arc rises at either end.
            const W pq = glm::dot(p.position, q.position);
            const W at_p = q.height * (p.length * p.length) - p.height * pq;
            const W at_q = q.height * pq - p.height * (q.length * q.length);
            if (!(at_p > 0 && at_q < 0)) continue;
            const Point foot = point_at(p.at + (q.at - p.at) * real::divide(at_p, at_p - at_q));
            if (!(foot.cosine > least)) continue;
            least = foot.cosine;
            nearest = {Nearest::Edge, i + 1, foot};
        }
        if (is_inside) {
            const glm::vec<2, W> at{glm::dot(cross(edges_.edge_v, edges_.corner), normal_),
                                    glm::dot(cross(edges_.corner, edges_.edge_u), normal_)};
            nearest = {Nearest::Normal, 0, point_at(real::divide(at, facing))};
        }
        return nearest;
    }

  private:
    [[nodiscard]] LUMIS_INLINE Vector position_at(const glm::vec<2, W>& at) const noexcept {
        return edges_.corner + (at.x * edges_.edge_u + at.y * edges_.edge_v);
    }

    [[nodiscard]] LUMIS_INLINE Point point_at(const glm::vec<2, W>& at) const noexcept {
        Point p{at, position_at(at)};
        p.height = glm::dot(p.position, normal_);
        return measured(p);
    }

    [[nodiscard]] LUMIS_INLINE static Point measured(Point p) noexcept {
        p.length = real::length(p.position);
        p.cosine = real::quotient_where(p.length > 0, p.height, p.length);
        return p;
    }

    LUMIS_INLINE void add(const glm::vec<2, W>& at, W height) noexcept {
        if (size_ == most_vertices) return;  // under -ffast-math
        vertices_[size_++] = measured(Point{at, position_at(at), height});
    }

    typename FlatShape<Shape>::Edges edges_;
    Vector normal_;
    Vector across_;  // normal to the shape
    W volume_;
    Point vertices_[most_vertices];
    int size_{0};
};

}  // namespace lumis::LUMIS_ISA::detail
