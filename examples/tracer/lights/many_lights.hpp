// A group of any number of lights of one shape: a light tree chooses one of them for each point, in a time that grows as the
// logarithm of their number.
#pragma once

#include "lights/emitters.hpp"
#include "lights/lights.hpp"
#include "paths/packet.hpp"
#include <lumis/lights/light_bounds.hpp>
#include <lumis/lights/light_tree.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tracer {

template <template <class> class Shape, class Sampling>
class ManyLights {
  public:
    static constexpr std::size_t samples = 1;
    static constexpr bool is_background = false, is_delta = false;
    using Strategy = lumis::AreaLight<Shape<float>, Sampling>;

    ManyLights() = default;

    // Indices of lights are places among the shapes. Without any, nothing is drawn.
    explicit ManyLights(std::span<const Emitter<Shape<float>>> lights) {
        std::vector<lumis::LightBounds<float>> bounds;
        for (const auto& [shape, radiance] : lights) {
            emitters_.add(shape, radiance);
            bounds.push_back(lumis::light_bounds(shape, std::max({radiance.r, radiance.g, radiance.b})));
        }
        tree_ = lumis::LightTree<float>{bounds};
    }

    template <lumis::Real R>
    [[nodiscard]] Vector<R> radiance(const Indices<R>& light) const {
        return emitters_.template radiance<R>(light);
    }

    template <lumis::Real R>
    class Seen {
      public:
        Seen(const ManyLights& lights, const Receiver<R>& receiver) : lights_{lights}, receiver_{receiver} {}

        // u.x chooses the light.
        [[nodiscard]] LightDraw<R> sample(const glm::vec<3, R>& u) const {
            if (lights_.tree_.empty()) return {Vector<R>{R(0.0f)}, R(0.0f), R(0.0f), Vector<R>{R(0.0f)}};
            Indices<R> chosen{};
            const R chance = of_lanes<R>([&](auto i) {
                const auto drawn = tree_from(i).sample(glm::vec<1, float>{lane(u.x, i)});
                chosen[i] = drawn.pdf > 0 ? static_cast<std::uint32_t>(drawn.value) : 0;
                return drawn.pdf;
            });
            LightDraw<R> drawn =
                lights_.emitters_.template sample<R>(chosen, receiver_.position, glm::vec<2, R>{u.y, u.z});
            drawn.pdf *= chance;
            return drawn;
        }

        // The density of a direction that has met a light.
        [[nodiscard]] R pdf_from_hit(const Indices<R>& light, const R& distance, const R& cosine) const {
            const R chance = of_lanes<R>([&](auto i) { return tree_from(i).pdf(light[i]); });
            return chance * lights_.emitters_.template pdf_from_hit<R>(light, receiver_.position, distance, cosine);
        }

      private:
        // The tree as a lane's point sees it.
        [[nodiscard]] auto tree_from(std::size_t i) const {
            const glm::vec3 position = lane_of<R>(receiver_.position, i), normal = lane_of<R>(receiver_.normal, i);
            return normal == glm::vec3{0} ? lights_.tree_.from(position) : lights_.tree_.from(position, normal);
        }

        const ManyLights& lights_;
        Receiver<R> receiver_;
    };

    template <lumis::Real R>
    [[nodiscard]] Seen<R> seen_from(const Receiver<R>& receiver, std::size_t /*count*/) const {
        return Seen<R>{*this, receiver};
    }

  private:
    Emitters<Shape, Sampling> emitters_;
    lumis::LightTree<float> tree_;
};

}  // namespace tracer
