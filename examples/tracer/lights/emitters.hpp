// Lights of one shape: where they are, what they shine, and how one of them is sampled from a point. Which of them is up to
// the groups of lights.hpp and many_lights.hpp.
#pragma once

#include "paths/packet.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tracer {

// A direction towards a light. pdf 0: none was drawn.
template <lumis::Real R>
struct LightDraw {
    Vector<R> direction;
    R pdf;  // per solid angle, the choice of this light included
    R distance;
    Vector<R> radiance;
};

// Sampling of a shape without extent, see delta_lights.hpp.
struct Delta {};

// The strategy of the library that draws directions towards a shape.
template <class Shape, class Sampling>
struct StrategyOf {
    using Type = lumis::AreaLight<Shape, Sampling>;
};
template <class Shape>
struct StrategyOf<Shape, Delta> {
    using Type = typename Shape::Strategy;
};

// A light of a shape.
template <class Shape>
struct Emitter {
    Shape shape;
    Vector<typename Shape::Scalar> radiance;
};

template <template <class> class Shape, class Sampling>
class Emitters {
  public:
    static constexpr bool is_delta = std::same_as<Sampling, Delta>;
    using Strategy = typename StrategyOf<Shape<float>, Sampling>::Type;

    // Returns the light's index.
    std::uint32_t add(const Shape<float>& shape, const glm::vec3& radiance) {
        table_.push_back({shape, radiance});
        return static_cast<std::uint32_t>(table_.size() - 1);
    }

    template <lumis::Real R>
    [[nodiscard]] Vector<R> radiance(const Indices<R>& light) const {
        return gather<Emitter<Shape<R>>, R>(table_, light).radiance;
    }

    // Towards each lane's own light, without the probability of its choice.
    template <lumis::Real R>
    [[nodiscard]] LUMIS_INLINE LightDraw<R> sample(const Indices<R>& light, const Vector<R>& from,
                                                   const glm::vec<2, R>& u) const {
        const Emitter<Shape<R>> emitter = gather<Emitter<Shape<R>>, R>(table_, light);
        if constexpr (is_delta) {
            const auto drawn = emitter.shape.drawn_from(from);
            return {drawn.value, drawn.pdf, drawn.distance, emitter.radiance};
        } else if constexpr (samples_lanes<R>) {
            const auto drawn = lumis::AreaLight<Shape<R>, Sampling>{emitter.shape, from}.sample(u);
            return {drawn.value, drawn.pdf, drawn.distance, emitter.radiance};
        } else {
            std::array<lumis::LightSample<glm::vec3, float>, lanes<R>> drawn;
            for (std::size_t i = 0; i < lanes<R>; ++i) {
                const glm::vec2 of_lane{lane(u.x, i), lane(u.y, i)};
                drawn[i] = lumis::AreaLight<Shape<float>, Sampling>{table_[light[i]].shape, lane_of<R>(from, i)}.sample(
                    of_lane);
            }
            const auto number = [&](const auto& member) {
                return of_lanes<R>([&](auto i) { return member(drawn[i]); });
            };
            return {{number([](const auto& one) { return one.value.x; }),
                     number([](const auto& one) { return one.value.y; }),
                     number([](const auto& one) { return one.value.z; })},
                    number([](const auto& one) { return one.pdf; }),
                    number([](const auto& one) { return one.distance; }),
                    emitter.radiance};
        }
    }

    // The density with which it draws a direction that has met the light: at this distance, the cosine that at the light. No
    // ray meets a light without extent.
    template <lumis::Real R>
    [[nodiscard]] LUMIS_INLINE R pdf_from_hit(const Indices<R>& light, const Vector<R>& from, const R& distance,
                                              const R& cosine) const {
        if constexpr (is_delta) {
            return R(0.0f);
        } else if constexpr (samples_lanes<R>) {
            const auto shape = gather<Emitter<Shape<R>>, R>(table_, light).shape;
            return lumis::AreaLight<Shape<R>, Sampling>{shape, from}.pdf_from_hit(distance, cosine);
        } else {
            return of_lanes<R>([&](auto i) {
                return lumis::pdf_from_hit<Sampling>(table_[light[i]].shape, lane_of<R>(from, i), lane(distance, i),
                                                     lane(cosine, i));
            });
        }
    }

  private:
    // Lanes take turns where the library samples no packets.
    template <lumis::Real R>
    static constexpr bool samples_lanes = std::floating_point<R> || std::same_as<Sampling, lumis::ByArea> ||
                                          std::same_as<Shape<float>, lumis::Sphere<float>>;

    std::vector<Emitter<Shape<float>>> table_;
};

}  // namespace tracer
