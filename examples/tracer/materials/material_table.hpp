// The materials of a scene, a table for each kind: Materials<Diffuse, Metal> holds no other kind's code.
#pragma once

#include "geometry/geometry.hpp"
#include "paths/packet.hpp"
#include "type_name.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace tracer {

// What fills the inside of such a material absorbs light.
template <class Material>
concept Absorbs = requires(const Material& material) {
    material.absorption;
};

// Kinds are materials of floats, see materials.hpp.
template <class... Kinds>
class Materials {
  public:
    static constexpr bool transmit = (Kinds::transmits || ...);
    static constexpr bool absorb = (Absorbs<Kinds> || ...);

    // Uniforms that sample any of the kinds.
    static constexpr int dimensions = std::max({decltype(std::declval<Kinds>().strategy(glm::vec3{}))::dimensions...});

    // What each kind samples: "Diffuse: CosineHemisphere".
    [[nodiscard]] static std::vector<std::string> strategies() {
        return {type_name<Kinds>() + ": " + type_name<typename Kinds::Lobes>()...};
    }

    // The surface that a material makes.
    template <class Kind>
    Surface add(const Kind& material) {
        constexpr std::size_t kind = index_of<Kind>();
        static_assert(kind < sizeof...(Kinds), "the scene's Materials do not list this kind");
        auto& table = std::get<kind>(tables_);
        table.push_back(material);
        Surface surface;
        surface.kind = static_cast<std::uint32_t>(kind);
        surface.material = static_cast<std::uint32_t>(table.size() - 1);
        return surface;
    }

    // All of one kind, in the order in which they were added.
    template <class Kind>
    [[nodiscard]] const std::vector<Kind>& of_kind() const {
        return std::get<std::vector<Kind>>(tables_);
    }

    // visit(material, mask) for each kind that occurs in the lanes asked for, with each lane's own material. Lanes of
    // different kinds take turns.
    template <lumis::Real R>
    LUMIS_INLINE void visit(const Indices<R>& kinds, const Indices<R>& entries, const Mask<R>& asked,
                            auto visit) const {
        const auto visit_kind = [&]<std::size_t K, class Kind>() {
            const Mask<R> mask = asked && are<R>(kinds, K);
            if (!any(mask)) return;
            visit(gather<typename Kind::template In<R>, R>(std::get<K>(tables_), filled<R>(entries, mask)), mask);
        };
        [&]<std::size_t... K>(std::index_sequence<K...>) {
            (visit_kind.template operator()<K, Kinds>(), ...);
        }
        (std::index_sequence_for<Kinds...>{});
    }

    // Whether they are delta materials.
    template <lumis::Real R>
    [[nodiscard]] LUMIS_INLINE static Mask<R> are_delta(const Indices<R>& kinds) {
        if constexpr (!(Kinds::is_delta || ...)) {
            return Mask<R>(false);
        } else {
            Mask<R> result(false);
            std::uint32_t kind = 0;
            ((result = Kinds::is_delta ? result || are<R>(kinds, kind) : result, ++kind), ...);
            return result;
        }
    }

  private:
    template <class Kind>
    static constexpr std::size_t index_of() {
        std::size_t at = 0;
        static_cast<void>(((std::is_same_v<Kind, Kinds> || (++at, false)) || ...));
        return at;
    }

    std::tuple<std::vector<Kinds>...> tables_;
};

}  // namespace tracer
