// What shines. A group holds lights of one shape and knows how to sample one of them from a point; a scene lists its groups
// as a type, so that it contains no other shape's code.
#pragma once

#include "geometry/geometry.hpp"
#include "lights/emitters.hpp"
#include "paths/packet.hpp"
#include <lumis/lumis.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace tracer {

// The place where light is looked for: a point, and the side of its surface, below whose horizon it receives nothing. A surface
// that transmits has no such side: its normal is 0.
template <lumis::Real R>
struct Receiver {
    Vector<R> position, normal;
    bool has_bsdf_samples;  // which find what samples of light leave out
};

// What a ray meets that meets no surface: the radiance, and the density of its direction.
template <lumis::Real R>
struct MetSky {
    Vector<R> radiance;
    R pdf;
};

// A ball that holds a shape, and the shape's largest cross-section.
template <lumis::Real R>
struct Extent {
    Vector<R> center;
    R radius, area;
};
[[nodiscard]] inline Extent<float> extent(const lumis::Sphere<float>& s) {
    return {s.center, s.radius, std::numbers::pi_v<float> * s.radius * s.radius};
}
[[nodiscard]] inline Extent<float> extent(const lumis::Parallelogram<float>& p) {
    const float diagonal = std::max(glm::length(p.edge_u + p.edge_v), glm::length(p.edge_u - p.edge_v));
    return {p.corner + 0.5f * (p.edge_u + p.edge_v), 0.5f * diagonal, glm::length(glm::cross(p.edge_u, p.edge_v))};
}
[[nodiscard]] inline Extent<float> extent(const lumis::Disk<float>& d) {
    return {d.center, d.radius, std::numbers::pi_v<float> * d.radius * d.radius};
}

// A few lights of one shape: one is chosen in proportion to the irradiance that each can cause at most, roughly, and sampled.
// Each is asked at every point: for up to eight.
// Samples: that a point takes of them; their choices are spread evenly.
template <template <class> class Shape, class Sampling, std::size_t Samples = 1>
class FewLights {
  public:
    static constexpr std::size_t most = 8, samples = Samples;
    static constexpr bool is_background = false, is_delta = Emitters<Shape, Sampling>::is_delta;
    using Strategy = typename Emitters<Shape, Sampling>::Strategy;

    // Returns the light's index.
    std::uint32_t add(const Shape<float>& shape, const glm::vec3& radiance) {
        if (extents_.size() == most) throw std::length_error("more than eight lights: choose them by ManyLights");
        const Extent<float> bounds = extent(shape);
        const float brightest = std::max({radiance.r, radiance.g, radiance.b});
        extents_.push_back({bounds.center, bounds.radius, bounds.area * brightest});
        return emitters_.add(shape, radiance);
    }

    template <lumis::Real R>
    [[nodiscard]] Vector<R> radiance(const Indices<R>& light) const {
        return emitters_.template radiance<R>(light);
    }

    // Each light is taken once if there are as many samples as lights; fewer samples go to those that can cause the most.
    template <lumis::Real R>
    class Seen {
      public:
        Seen(const FewLights& lights, const Receiver<R>& receiver, std::size_t count)
            : lights_{lights}, position_{receiver.position} {
            const bool takes_each = count >= lights.extents_.size();
            for (std::size_t i = 0; i < lights.extents_.size(); ++i) {
                const Extent<float>& one = lights.extents_[i];
                const Vector<R> to_center = Vector<R>(one.center) - position_;
                const R squared = lumis::real::greater(glm::dot(to_center, to_center), one.radius * one.radius);
                const R height = glm::dot(to_center, receiver.normal), distance = lumis::real::sqrt(squared);
                const R cosine = lumis::real::lesser((height + one.radius) / distance, 1.0f);
                const R has_side = glm::dot(receiver.normal, receiver.normal);
                const R received = lumis::real::select(has_side > 0.0f, lumis::real::greater(cosine, 0.0f), R(1.0f));
                const R caused = one.area * received / squared;
                total_ += takes_each ? lumis::real::select(caused > 0.0f, R(1.0f), R(0.0f)) : caused;
                up_to_[i] = total_;
            }
        }

        // u.x chooses the light.
        [[nodiscard]] LightDraw<R> sample(const glm::vec<3, R>& u) const {
            const R at = u.x * total_;
            Indices<R> chosen{};
            R share = up_to_[0];
            for (std::size_t i = 1; i < lights_.extents_.size(); ++i) {
                const Mask<R> is_beyond = at >= up_to_[i - 1] && up_to_[i] > up_to_[i - 1];
                share = lumis::real::select(is_beyond, up_to_[i] - up_to_[i - 1], share);
                for (std::size_t k = 0; k < lanes<R>; ++k) {
                    chosen[k] = lane(is_beyond, k) ? static_cast<std::uint32_t>(i) : chosen[k];
                }
            }
            LightDraw<R> drawn = lights_.emitters_.template sample<R>(chosen, position_, glm::vec<2, R>{u.y, u.z});
            drawn.pdf *= lumis::real::quotient_where(total_ > 0.0f, share, total_);
            return drawn;
        }

        // The density of a direction that has met a light.
        [[nodiscard]] R pdf_from_hit(const Indices<R>& light, const R& distance, const R& cosine) const {
            R share(0.0f);
            for (std::size_t i = 0; i < lights_.extents_.size(); ++i) {
                const Mask<R> is_met = are<R>(light, static_cast<std::uint32_t>(i));
                share = lumis::real::select(is_met, i == 0 ? up_to_[0] : up_to_[i] - up_to_[i - 1], share);
            }
            const R pdf = lights_.emitters_.template pdf_from_hit<R>(light, position_, distance, cosine);
            return lumis::real::quotient_where(total_ > 0.0f, share, total_) * pdf;
        }

      private:
        const FewLights& lights_;
        Vector<R> position_;
        R total_{0.0f};
        std::array<R, most> up_to_;  // sums of what each light can cause
    };

    template <lumis::Real R>
    [[nodiscard]] Seen<R> seen_from(const Receiver<R>& receiver, std::size_t count) const {
        return Seen<R>{*this, receiver, count};
    }

  private:
    Emitters<Shape, Sampling> emitters_;
    std::vector<Extent<float>> extents_;  // whose areas are times radiance
};

// The groups of lights of a scene. At most one of them is a background: it shines where rays meet nothing.
template <class... Groups>
class Lights {
    static_assert((std::size_t{Groups::is_background} + ...) <= 1, "two backgrounds are one group: SunAndSky");

  public:
    static constexpr std::array<std::size_t, sizeof...(Groups)> counts{Groups::samples...};  // of samples at a point
    static constexpr std::size_t samples = (Groups::samples + ...);

    // Whether no ray can meet the lights of a group: a BSDF never draws them, whatever the density of its directions.
    [[nodiscard]] static constexpr bool is_delta(std::size_t group) {
        constexpr std::array<bool, sizeof...(Groups)> are{Groups::is_delta...};
        return (Groups::is_delta || ...) && are[group];
    }

    Lights() = default;
    explicit Lights(Groups... groups) : groups_{std::move(groups)...} {}

    // Puts a light into a group: its surface, which has the material of the surface given, if any.
    template <std::size_t G>
    Surface add(const auto& shape, const glm::vec3& radiance, Surface surface = {}) {
        return Lights::surface<G>(std::get<G>(groups_).add(shape, radiance), surface);
    }

    // The surface of a light that its group holds already.
    template <std::size_t G>
    [[nodiscard]] static Surface surface(std::size_t light, Surface surface = {}) {
        static_assert(G < sizeof...(Groups));
        surface.light = static_cast<std::uint32_t>(light);
        surface.group = static_cast<std::uint32_t>(G);
        return surface;
    }

    template <std::size_t G>
    [[nodiscard]] const auto& group() const {
        return std::get<G>(groups_);
    }

    // What falls on the first surface is seen best; further on, one sample of a group is enough.
    [[nodiscard]] static constexpr std::size_t samples_at(int bounce, const auto& group) {
        return bounce == 1 ? std::remove_cvref_t<decltype(group)>::samples : 1;
    }

    // The groups as seen from a point.
    template <lumis::Real R>
    [[nodiscard]] auto seen_from(const Receiver<R>& receiver, int bounce) const {
        return std::apply(
            [&](const auto&... group) {
                return std::tuple{group.template seen_from<R>(receiver, samples_at(bounce, group))...};
            },
            groups_);
    }

    // visit(group, index of it as a constant).
    void for_each(auto visit) const {
        [&]<std::size_t... G>(std::index_sequence<G...>) {
            (visit(std::get<G>(groups_), std::integral_constant<std::size_t, G>{}), ...);
        }
        (std::index_sequence_for<Groups...>{});
    }

  private:
    std::tuple<Groups...> groups_;
};

}  // namespace tracer
