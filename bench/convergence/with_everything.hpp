// A scene with everything in: its types have every kind of material and of light that the tracer knows, and only at run time
// turns out that the scene has no such thing. It is what a renderer that composes nothing carries along.
#pragma once

#include "lights/environment.hpp"
#include "lights/many_lights.hpp"
#include "scene_renderer.hpp"

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

namespace tracer {

// A group of lights that the scene does not have. The type is compiled in, and asked at run time.
template <class Group>
class Absent {
  public:
    static constexpr bool is_background = Group::is_background, is_delta = Group::is_delta;
    static constexpr std::size_t samples = Group::samples;
    using Strategy = typename Group::Strategy;

    template <lumis::Real R>
    [[nodiscard]] Vector<R> radiance(const auto& at) const {
        return group_ ? group_->template radiance<R>(at) : Vector<R>{R(0.0f)};
    }

    template <lumis::Real R>
    class Seen {
      public:
        Seen(const std::optional<Group>& group, const Receiver<R>& receiver, std::size_t count) {
            if (group) seen_.emplace(group->template seen_from<R>(receiver, count));
        }
        [[nodiscard]] LightDraw<R> sample(const glm::vec<3, R>& u) const {
            if (seen_) return seen_->sample(u);
            return {{R(0.0f), R(0.0f), R(1.0f)}, R(0.0f), R(0.0f), Vector<R>{R(0.0f)}};
        }
        [[nodiscard]] R pdf_from_hit(const Indices<R>& light, const R& distance, const R& cosine) const {
            return seen_ ? seen_->pdf_from_hit(light, distance, cosine) : R(0.0f);
        }
        [[nodiscard]] auto met(const Vector<R>& w) const {
            using Met = decltype(seen_->met(w));
            return seen_ ? seen_->met(w) : Met{Vector<R>{R(0.0f)}, R(0.0f)};
        }

      private:
        std::optional<typename Group::template Seen<R>> seen_;
    };
    template <lumis::Real R>
    [[nodiscard]] Seen<R> seen_from(const Receiver<R>& receiver, std::size_t count) const {
        return Seen<R>{group_, receiver, count};
    }

  private:
    std::optional<Group> group_;
};

// Kind as a type in a tuple, unless it is one of Own.
template <class Kind, class... Own>
[[nodiscard]] auto kind_unless_there() {
    if constexpr ((std::same_as<Kind, Own> || ...)) {
        return std::tuple{};
    } else {
        return std::tuple{std::type_identity<Kind>{}};
    }
}
// A group that is absent, unless one of Own samples its lights.
template <class Group, class... Own>
[[nodiscard]] auto group_unless_there() {
    if constexpr ((std::same_as<typename Group::Strategy, typename Own::Strategy> || ...)) {
        return std::tuple{};
    } else {
        return std::tuple{Absent<Group>{}};
    }
}

// The scene's own kinds and groups come first, so that its surfaces keep their numbers.
template <class... Own>
[[nodiscard]] auto with_everything(const Materials<Own...>& materials) {
    const auto all_kinds =
        std::tuple_cat(kind_unless_there<Diffuse<float>, Own...>(), kind_unless_there<Coated<float>, Own...>(),
                       kind_unless_there<Metal<float>, Own...>(), kind_unless_there<Mirror<float>, Own...>(),
                       kind_unless_there<RoughGlass<float>, Own...>(), kind_unless_there<SmoothGlass<float>, Own...>(),
                       kind_unless_there<Absorbing<SmoothGlass<float>>, Own...>());
    return std::apply(
        [&](auto... missing) {
            Materials<Own..., typename decltype(missing)::type...> table;
            const auto copy = [&]<class Kind>() {
                for (const Kind& one : materials.template of_kind<Kind>()) table.add(one);
            };
            (copy.template operator()<Own>(), ...);
            return table;
        },
        all_kinds);
}
template <class... Own>
[[nodiscard]] auto with_everything(const Lights<Own...>& lights) {
    const auto own = [&]<std::size_t... G>(std::index_sequence<G...>) {
        return std::tuple{lights.template group<G>()...};
    }
    (std::index_sequence_for<Own...>{});
    const auto all_groups =
        std::tuple_cat(own, group_unless_there<FewLights<lumis::Sphere, lumis::BySolidAngle>, Own...>(),
                       group_unless_there<FewLights<lumis::Parallelogram, lumis::ByArea>, Own...>(),
                       group_unless_there<ManyLights<lumis::Parallelogram, lumis::BySolidAngle>, Own...>(),
                       group_unless_there<Environment, Own...>());
    return std::apply([](auto... groups) { return Lights{std::move(groups)...}; }, all_groups);
}

template <Scene S>
class WithEverything {
  public:
    using MaterialTable = decltype(with_everything(std::declval<const typename S::MaterialTable&>()));
    using LightTable = decltype(with_everything(std::declval<const typename S::LightTable&>()));

    explicit WithEverything(S scene)
        : scene_{std::move(scene)},
          materials_{with_everything(scene_.materials())},
          lights_{with_everything(scene_.lights())} {}

    [[nodiscard]] const Geometry& geometry() const { return scene_.geometry(); }
    [[nodiscard]] const MaterialTable& materials() const { return materials_; }
    [[nodiscard]] const LightTable& lights() const { return lights_; }

  private:
    S scene_;
    MaterialTable materials_;
    LightTable lights_;
};

template <Scene S>
[[nodiscard]] std::unique_ptr<Renderer> render_with_everything(S scene, const SceneOptions& options) {
    return std::make_unique<SceneRenderer<WithEverything<S>>>(WithEverything<S>{std::move(scene)}, options,
                                                              S::camera());
}

}  // namespace tracer
