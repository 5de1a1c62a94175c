// Builds the nodes of a light tree, top down: lights are sorted into bins along each axis, and divided where the cost of both
// sides is least (Conty Estevez and Kulla 2018, section 4.3). O(n log n).
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/throw.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/detail/light_bounds_checks.hpp"
#include "lumis/lights/detail/light_group.hpp"
#include "lumis/lights/detail/light_tree_node.hpp"
#include "lumis/lights/detail/normal_cone.hpp"
#include "lumis/lights/light_bounds.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::detail {

// The two-bit number of the child at each level, the root's in the lowest bits.
using LightPath = std::uint64_t;
inline constexpr LightPath not_in_tree = ~LightPath{0};
inline constexpr unsigned most_levels = 31;

template <std::floating_point T>
struct BuiltLightTree {
    std::vector<LightTreeNode<T>> nodes;  // the root first
    std::vector<LightPath> paths;         // of each light
    unsigned levels = 0;                  // the most nodes on the way to a light
    Box<T> place{glm::vec<3, T>{T(0)}, glm::vec<3, T>{T(0)}};
};

template <std::floating_point T>
class LightTreeBuilder {
  public:
    explicit LightTreeBuilder(std::span<const LightBounds<T>> bounds) : bounds_{bounds} {
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            require_light_bounds(bounds[i], i);
            largest_ = real::greater(largest_, bounds[i].intensity);
        }
        built_.paths.assign(bounds.size(), not_in_tree);
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            if (bounds[i].intensity > 0) lights_.push_back(to_place(i));
        }
        for (const LightToPlace<T>& light : lights_) sum_ += static_cast<double>(light.intensity);
    }

    // Lights of intensity 0 are left out.
    [[nodiscard]] BuiltLightTree<T> build() && {
        if (!lights_.empty()) {
            require_counts();
            built_.nodes.reserve(lights_.size() / 2 + 1);
            built_.place = build({0, lights_.size()}, 0, 0).place;
            built_.nodes.shrink_to_fit();
        }
        return std::move(built_);
    }

  private:
    struct Cluster {
        Box<T> place{};
        NormalCone cone{};
        double intensity{};
        std::size_t lights{};

        void add(const Cluster& other) {
            place.add(other.place);
            cone = cone_about(cone, other.cone);
            intensity += other.intensity;
            lights += other.lights;
        }
    };

    // A quarter of the counts are enough for one each, see require_enough_counts.
    void require_counts() const {
        constexpr std::size_t most = total_counts<T> / 4;
        if (lights_.size() > most) {
            refuse("lumis: a light tree of " + std::to_string(lights_.size()) + " lights; there may be " +
                   std::to_string(most));
        }
    }

    [[nodiscard]] LightToPlace<T> to_place(std::size_t i) const {
        const LightBounds<T>& light = bounds_[i];
        const NormalCone cone = normal_cone(light);
        glm::vec<3, double> axis = cone.axis;
        if (cone.sides == Sides::Both) {
            // Either side will do: that whose largest component is positive.
            const int x_or_y = std::abs(axis.x) < std::abs(axis.y) ? 1 : 0;
            const int largest = std::abs(axis[x_or_y]) < std::abs(axis.z) ? 2 : x_or_y;
            if (axis[largest] < 0) axis = -axis;
        }
        const double reach = 2 * std::sin(cone.angle / 2);
        Box<T> axes;
        for (int k = 0; k < 3; ++k) {
            axes.lower[k] = static_cast<T>((std::max)(axis[k] - reach, -1.0));
            axes.upper[k] = static_cast<T>((std::min)(axis[k] + reach, 1.0));
        }
        return {{light.lower, light.upper}, axes, light.intensity / largest_, static_cast<std::uint32_t>(i)};
    }

    struct Range {
        std::size_t begin, end;
        [[nodiscard]] std::size_t size() const noexcept { return end - begin; }
    };

    struct Children {
        std::array<Range, light_tree_width> range;
        std::size_t count;
    };

    // Divides the largest part of a range until there are four.
    Children children_of(const Range& whole, bool evenly) {
        Children children{{whole}, 1};
        while (children.count < light_tree_width) {
            const auto first = children.range.begin(), end = first + static_cast<std::ptrdiff_t>(children.count);
            const auto largest =
                std::max_element(first, end, [](const Range& a, const Range& b) { return a.size() < b.size(); });
            if (largest->size() < 2) break;
            const std::size_t middle = divide(*largest, evenly);
            const Range rest{middle, largest->end};
            largest->end = middle;
            std::move_backward(largest + 1, end, end + 1);
            *(largest + 1) = rest;
            ++children.count;
        }
        return children;
    }

    // Makes the node of a range of lights, and those below.
    Cluster build(const Range& range, unsigned level, LightPath path) {
        built_.levels = (std::max)(built_.levels, level + 1);
        const std::size_t id = built_.nodes.size();
        built_.nodes.emplace_back();
        // Halves where others might leave too many lights for the levels that remain.
        const bool evenly = static_cast<unsigned>(std::bit_width(range.size())) > 2 * (most_levels - 1 - level);
        const Children children = children_of(range, evenly);
        Cluster whole{};
        for (std::size_t i = 0; i < children.count; ++i) {
            const Range& part = children.range[i];
            const LightPath path_of_child = path | LightPath{i} << 2 * level;
            const auto next = static_cast<std::uint32_t>(built_.nodes.size());
            const bool is_light = part.size() == 1;
            const LightToPlace<T>& first = lights_[part.begin];
            const Cluster cluster = is_light ? alone(first, path_of_child) : build(part, level + 1, path_of_child);
            set_child(built_.nodes[id], i, cluster, is_light ? first.index | LightTreeNode<T>::light_bit : next);
            if (i == 0) {
                whole = cluster;
            } else {
                whole.add(cluster);
            }
        }
        // Children that are none stand among the others, so that nothing they are computed with is out of range.
        for (std::size_t i = children.count; i < light_tree_width; ++i) {
            set_child(built_.nodes[id], i, {whole.place, whole.cone, 0, 0}, 0);
        }
        return whole;
    }

    Cluster alone(const LightToPlace<T>& light, LightPath path) {
        built_.paths[light.index] = path;
        return {light.place, normal_cone(bounds_[light.index]), static_cast<double>(light.intensity), 1};
    }

    void set_child(LightTreeNode<T>& node, std::size_t i, const Cluster& cluster, std::uint32_t child) const {
        constexpr T far_out = (std::numeric_limits<T>::max)();
        for (int k = 0; k < 3; ++k) {
            const T lower = cluster.place.lower[k], upper = cluster.place.upper[k], center = cluster.place.center()[k];
            const T half = real::greater(T(upper - center), T(center - lower));
            node.center[k][i] = center;
            node.half[k][i] = half > 0 ? std::nextafter(half, far_out) : half;
            node.axis[k][i] = static_cast<T>(cluster.cone.axis[k]);
        }
        const T cosine = static_cast<T>(std::cos(cluster.cone.angle));
        const bool is_one = !(cluster.cone.angle > 0);
        node.cos_cone[i] = is_one ? T(1) : cluster.cone.is_all() ? T(-1) : std::nextafter(cosine, T(-1));
        node.against[i] = cluster.cone.sides == Sides::Both ? T(-1) : T(1);
        node.intensity[i] = cluster.lights == 0 ? T(0)
                                                : real::greater(static_cast<T>(cluster.intensity / sum_),
                                                                (std::numeric_limits<T>::min)());
        node.lights[i] = static_cast<std::uint32_t>(cluster.lights);
        node.child[i] = child;
    }

    // Sorts the lights of a range into two parts, and yields where the second begins. Neither is empty.
    std::size_t divide(const Range& range, bool evenly) {
        const auto first = lights_.begin() + static_cast<std::ptrdiff_t>(range.begin),
                   last = first + static_cast<std::ptrdiff_t>(range.size());
        Box<T> centers;
        LightGroup<T> whole;
        for (auto light = first; light != last; ++light) {
            const glm::vec<3, T> center = light->place.center();
            centers.add(Box<T>{center, center});
            if (!evenly) whole.place.add(light->place);
        }
        const glm::vec<3, T> extent = centers.upper - centers.lower;
        const int longest = extent.x < extent.y ? (extent.y < extent.z ? 2 : 1) : (extent.x < extent.z ? 2 : 0);
        if (!evenly && range.size() > 2) {
            const Division best = best_division(range, centers, extent, longest, whole.place);
            if (best.axis >= 0) {
                const auto middle = std::partition(first, last, [&](const LightToPlace<T>& light) {
                    return bin_of(light, best.axis, centers, extent, best.bins) <= best.bin;
                });
                return static_cast<std::size_t>(middle - lights_.begin());
            }
        }
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last, [&](const LightToPlace<T>& a, const LightToPlace<T>& b) {
            return a.place.center()[longest] < b.place.center()[longest];
        });
        return static_cast<std::size_t>(middle - lights_.begin());
    }

    [[nodiscard]] static std::size_t bin_of(const LightToPlace<T>& light, int axis, const Box<T>& centers,
                                            const glm::vec<3, T>& extent, std::size_t bins) noexcept {
        return index_of(T((light.place.center()[axis] - centers.lower[axis]) / extent[axis]), bins);
    }

    struct Division {
        int axis = -1;  // none
        std::size_t bin = 0, bins = 0;
    };

    // The last bin of the first part, along the axis where that costs least. A box that is short along the axis costs more, so
    // that none becomes too thin.
    [[nodiscard]] Division best_division(const Range& range, const Box<T>& centers, const glm::vec<3, T>& extent,
                                         int longest, const Box<T>& place) const {
        const std::size_t bins = (std::min)(most_bins, range.size());
        const double largest = longest_component(place.half());
        const double inverse_extent = largest > 0 ? 1 / largest : 0.0;
        Division best;
        double least = (std::numeric_limits<double>::max)();
        for (int axis = 0; axis < 3; ++axis) {
            if (!(extent[axis] > 0)) continue;
            std::array<LightGroup<T>, most_bins> group;
            for (std::size_t i = range.begin; i < range.end; ++i) {
                group[bin_of(lights_[i], axis, centers, extent, bins)].add(lights_[i]);
            }
            std::array<double, most_bins> cost_behind{};
            LightGroup<T> behind;
            for (std::size_t bin = bins - 1; bin > 0; --bin) {
                behind.add(group[bin]);
                cost_behind[bin - 1] = behind.lights > 0 ? behind.cost(inverse_extent) : 0.0;
            }
            const double thinness = static_cast<double>(extent[longest]) / static_cast<double>(extent[axis]);
            LightGroup<T> before;
            for (std::size_t bin = 0; bin + 1 < bins; ++bin) {
                before.add(group[bin]);
                if (before.lights == 0 || before.lights == range.size()) continue;
                const double cost = thinness * (before.cost(inverse_extent) + cost_behind[bin]);
                if (!(cost < least)) continue;
                least = cost;
                best = {axis, bin, bins};
            }
        }
        return best;
    }

    static constexpr std::size_t most_bins = 12;
    std::span<const LightBounds<T>> bounds_;
    std::vector<LightToPlace<T>> lights_;  // in the order of the tree, as far as it is built
    T largest_{0};                         // intensity
    double sum_{0};                        // of the intensities over the largest
    BuiltLightTree<T> built_;
};

template <std::floating_point T>
[[nodiscard]] BuiltLightTree<T> build_light_tree(std::span<const LightBounds<T>> lights) {
    return LightTreeBuilder<T>{lights}.build();
}

}  // namespace lumis::LUMIS_ISA::detail
