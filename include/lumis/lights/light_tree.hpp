// One of many lights, selected for the point that is lit: by distance, orientation and the point's horizon. Time grows as the
// logarithm of their number, that of a light's probability as well. Counting measure.
// Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".
//
//     const LightTree<float> tree{bounds};                       // once; light_bounds(shape, radiance, sides) each
//     const LightSet set{lights, tree.from(point, normal)};      // at each point: in place of a table of weights
//     const SelectedLight one{set};                              // its density takes O(levels)
//
// Lights that lie below the horizon as a whole, and those that face away, are left out: their probability is 0. That of any
// light which may contribute is positive.
//
// The reported probability is the one drawn, exactly: a whole number of the uniform's lattice points, 2^24 in float, 2^53 in
// double (see detail/light_tree_node.hpp). A larger uniform never draws a light that stands before in the tree, so that Sobol
// points and strata stay spread over neighbouring lights.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/measure.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/detail/light_tree_builder.hpp"
#include "lumis/lights/detail/light_tree_node.hpp"
#include "lumis/lights/light_bounds.hpp"
#include "lumis/tables/detail/arrays.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace lumis::LUMIS_ISA {

namespace detail {
template <std::floating_point T, template <class> class Array>
class BasicLightTree;
}  // namespace detail

// A light tree as seen from a point: what LightSet takes for a table. Refers to the tree's arrays; made by LightTree::from.
// Uniforms: 2 for LightTree::from_finely, else 1.
template <std::floating_point T = float, int Uniforms = 1>
class LightTreeFrom {
  public:
    using Scalar = T;
    using Point = std::size_t;
    using Measure = measure::Counting;
    static constexpr int dimensions = Uniforms;

    // The number of lights that the tree was made of.
    [[nodiscard]] LUMIS_HD std::size_t size() const noexcept { return size_; }

    // True if no light can contribute, as far as the root's bounds tell: then nothing is drawn.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept {
        return !has_lights_ || detail::deal_to_children(nodes_[0], at_, all_counts).back() == 0;
    }

    // A probability of 0: nothing was drawn. The uniform led to lights that turned out, nearer by, not to contribute.
    [[nodiscard]] LUMIS_HD Sample<Point, T> sample(glm::vec<Uniforms, T> u) const noexcept {
        std::uint64_t place = lattice_index(u.x);
        if constexpr (Uniforms == 2) place = place << uniform_bits<T> | lattice_index(u.y);
        const auto choose = [&](const auto& ends) {
            std::size_t child = 0;
            for (std::size_t i = 0; i + 1 < detail::light_tree_width; ++i) child += place >= ends[i];
            place -= child > 0 ? ends[child - 1] : 0;
            return child;
        };
        return has_lights_ ? descend(choose) : Sample<Point, T>{};
    }

    [[nodiscard]] LUMIS_HD T pdf(Point index) const noexcept {
        if (!(index < size_)) return T(0);
        detail::LightPath path = paths_[index];
        if (path == detail::not_in_tree) return T(0);
        const auto follow = [&](const auto&) {
            const auto child = static_cast<std::size_t>(path % detail::light_tree_width);
            path /= detail::light_tree_width;
            return child;
        };
        return descend(follow).pdf;
    }

  private:
    template <std::floating_point, template <class> class>
    friend class detail::BasicLightTree;
    static_assert(Uniforms == 1 || (Uniforms == 2 && std::same_as<T, float>), "a double is fine enough alone");
    static constexpr std::uint64_t all_counts = std::uint64_t{1} << (Uniforms * uniform_bits<T>);

    LUMIS_HD LightTreeFrom(const auto& nodes, const auto& paths, std::size_t size, bool has_lights,
                           const detail::LitPoint<T>& at) noexcept
        : nodes_{nodes.data()}, paths_{paths.data()}, size_{size}, has_lights_{has_lights}, at_{at} {}

    // Goes from the root to the light at the end of the way that choose(ends) says.
    [[nodiscard]] LUMIS_HD Sample<Point, T> descend(auto choose) const noexcept {
        std::uint64_t counts = all_counts;
        std::uint32_t index = 0;
        while (true) {
            const detail::LightTreeNode<T>& node = nodes_[index];
            const auto ends = detail::deal_to_children(node, at_, counts);
            const std::size_t child = choose(ends);
            counts = ends[child] - (child > 0 ? ends[child - 1] : 0);
            if (counts == 0) return {};
            index = node.child[child];
            if (index >= detail::LightTreeNode<T>::light_bit) break;
        }
        constexpr T probability_of_count = T(1) / static_cast<T>(all_counts);
        return {std::size_t{index & ~detail::LightTreeNode<T>::light_bit},
                static_cast<T>(static_cast<std::int64_t>(counts)) * probability_of_count};
    }

    const detail::LightTreeNode<T>* nodes_;
    const detail::LightPath* paths_;
    std::size_t size_;
    bool has_lights_;
    detail::LitPoint<T> at_;
};

// The same from a point in each lane, R: an index for each, found for one lane after another. Made by LightTree::from.
template <Real R>
class LightTreeFromLanes {
  public:
    using Scalar = scalar_of<R>;
    using Indices = std::array<std::size_t, R::size>;
    static constexpr int dimensions = 1;

    // Nothing was drawn in a lane whose probability is 0.
    [[nodiscard]] LUMIS_HD Sample<Indices, R> sample(const glm::vec<1, R>& u) const noexcept {
        Sample<Indices, R> result;
        for (std::size_t i = 0; i < R::size; ++i) {
            const auto drawn = lanes_[i].sample(glm::vec<1, Scalar>{u.x[i]});
            result.value[i] = drawn.value;
            result.pdf.set(i, drawn.pdf);
        }
        return result;
    }

    [[nodiscard]] LUMIS_HD R pdf(const Indices& index) const noexcept {
        return R::of_lanes([&](auto i) { return lanes_[i].pdf(index[i]); });
    }

    [[nodiscard]] LUMIS_HD std::size_t size() const noexcept { return lanes_[0].size(); }

    // The tree as seen from the point of lane i: a table for LightSet.
    [[nodiscard]] LUMIS_HD const LightTreeFrom<Scalar>& operator[](std::size_t i) const noexcept { return lanes_[i]; }

  private:
    template <std::floating_point, template <class> class>
    friend class detail::BasicLightTree;
    LUMIS_HD explicit LightTreeFromLanes(const std::array<LightTreeFrom<Scalar>, R::size>& lanes) noexcept
        : lanes_{lanes} {}

    std::array<LightTreeFrom<Scalar>, R::size> lanes_;
};

namespace detail {

// What LightTree and LightTreeView share.
template <std::floating_point T, template <class> class Array>
class BasicLightTree {
  public:
    using Scalar = T;

    // The number of lights that the tree was made of.
    [[nodiscard]] LUMIS_HD std::size_t size() const noexcept { return size_; }
    // True if none has an intensity above 0.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return levels_ == 0; }
    // The most nodes that are looked at for a light.
    [[nodiscard]] LUMIS_HD unsigned levels() const noexcept { return levels_; }

    // The tree as seen from a point. normal: the unit normal of a surface that only reflects; lights below its horizon are
    // left out. Give none where light is transmitted or scattered all around.
    // One uniform selects a light. Each light in reach has one of its lattice points at least: among a million lights, a 16th
    // of the draws are even in float.
    [[nodiscard]] LUMIS_HD LightTreeFrom<T> from(const glm::vec<3, T>& point) const noexcept LUMIS_LIFETIME_BOUND {
        return seen<1>(point, Direction<T>{T(0)}, false);
    }
    [[nodiscard]] LUMIS_HD LightTreeFrom<T> from(const glm::vec<3, T>& point,
                                                 const Direction<T>& normal) const noexcept LUMIS_LIFETIME_BOUND {
        return seen<1>(point, normal, true);
    }
    // The same from a point, and with a normal, in each lane.
    template <RealOf<T> R>
        requires(!std::same_as<R, T>)
    [[nodiscard]] LUMIS_HD LightTreeFromLanes<R> from(const glm::vec<3, R>& points) const noexcept
        LUMIS_LIFETIME_BOUND {
        return in_lanes<R>([&](std::size_t i) { return from(lane_of(points, i)); });
    }
    template <RealOf<T> R>
        requires(!std::same_as<R, T>)
    [[nodiscard]] LUMIS_HD LightTreeFromLanes<R> from(const glm::vec<3, R>& points,
                                                      const Direction<R>& normals) const noexcept LUMIS_LIFETIME_BOUND {
        return in_lanes<R>([&](std::size_t i) { return from(lane_of(points, i), lane_of(normals, i)); });
    }
    // The same with 2^48 counts, see FineAliasTable: the second uniform refines the first.
    [[nodiscard]] LUMIS_HD LightTreeFrom<T, 2> from_finely(const glm::vec<3, T>& point) const noexcept
        LUMIS_LIFETIME_BOUND requires std::same_as<T, float> {
        return seen<2>(point, Direction<T>{T(0)}, false);
    }
    [[nodiscard]] LUMIS_HD LightTreeFrom<T, 2> from_finely(const glm::vec<3, T>& point, const Direction<T>& normal)
        const noexcept LUMIS_LIFETIME_BOUND requires std::same_as<T, float> {
        return seen<2>(point, normal, true);
    }

  protected:
    BasicLightTree() = default;

    explicit BasicLightTree(BuiltLightTree<T>&& built)
        : nodes_{std::move(built.nodes)},
          paths_{std::move(built.paths)},
          size_{paths_.size()},
          levels_{built.levels},
          center_{built.place.center()},
          extent_{longest_component(built.place.half())} {}

    BasicLightTree(const BasicLightTree<T, Owned>& owner, auto& place)
        : nodes_{viewed(owner.nodes_, place)},
          paths_{viewed(owner.paths_, place)},
          size_{owner.size_},
          levels_{owner.levels_},
          center_{owner.center_},
          extent_{owner.extent_} {}

    template <int Uniforms>
    [[nodiscard]] LUMIS_HD LightTreeFrom<T, Uniforms> seen(const glm::vec<3, T>& point, const Direction<T>& normal,
                                                           bool has_normal) const noexcept {
        LUMIS_ASSERT(!is_nan(point) && (!has_normal || is_unit(normal)));
        // Lengths are measured in that from the point to the farthest light, so that no square leaves T's range.
        const T reach = longest_component(glm::vec<3, T>(center_ - point)) + extent_;
        const T unit = real::clamp(reach, (std::numeric_limits<T>::min)(), (std::numeric_limits<T>::max)() / 4);
        return {nodes_, paths_, size_, levels_ > 0, LitPoint<T>{point, normal, 1 / unit, has_normal}};
    }

    Array<LightTreeNode<T>> nodes_;
    Array<LightPath> paths_;
    std::size_t size_{0};
    unsigned levels_{0};
    glm::vec<3, T> center_{T(0)};  // of the box about all lights
    T extent_{0};                  // half of its longest side

  private:
    template <std::floating_point, template <class> class>
    friend class BasicLightTree;

    template <Real R>
    [[nodiscard]] LUMIS_HD static LightTreeFromLanes<R> in_lanes(auto from_lane) noexcept {
        const auto all = [&]<std::size_t... I>(std::index_sequence<I...>) {
            return std::array<LightTreeFrom<T>, R::size>{from_lane(I)...};
        };
        return LightTreeFromLanes<R>{all(std::make_index_sequence<R::size>{})};
    }
};

}  // namespace detail

template <std::floating_point T>
class LightTree;

// A LightTree's way to draw, without its memory: made by LightTree::view, trivially copyable.
template <std::floating_point T = float>
class LightTreeView : public detail::BasicLightTree<T, detail::Viewed> {
    friend class LightTree<T>;
    using detail::BasicLightTree<T, detail::Viewed>::BasicLightTree;
};

template <std::floating_point T = float>
class LightTree : public detail::BasicLightTree<T, detail::Owned> {
    using Base = detail::BasicLightTree<T, detail::Owned>;

  public:
    // No lights; another tree may be assigned.
    LightTree() = default;

    // O(n log n). Throws std::invalid_argument, and names the light, for an intensity that is NaN, infinite or negative, for
    // bounds that are not finite or out of order, and for an axis or a cosine that is none; and for more than 2^22 lights in
    // float, 2^29 in double. No lights, and intensities that are all 0, are legal: see empty().
    // Keeps about 120 bytes a light in float, 220 in double.
    explicit LightTree(std::span<const LightBounds<T>> lights) : Base{detail::build_light_tree(lights)} {}

    // A view refers to the tree, which must live as long, or to a copy of its arrays: see alias_table.hpp.
    [[nodiscard]] LightTreeView<T> view() const noexcept LUMIS_LIFETIME_BOUND { return view(detail::InPlace{}); }
    [[nodiscard]] LightTreeView<T> view(auto&& place) const { return LightTreeView<T>{*this, place}; }

    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return this->nodes_.size() * sizeof(detail::LightTreeNode<T>) + this->paths_.size() * sizeof(detail::LightPath);
    }
};

template <detail::Spannable R>
LightTree(const R&) -> LightTree<typename detail::ElementOf<R>::Scalar>;

}  // namespace lumis::LUMIS_ISA
