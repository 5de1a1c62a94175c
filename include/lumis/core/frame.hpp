// An orthonormal right-handed frame; its local +z is the normal.
#pragma once

#include "lumis/core/sample.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>

namespace lumis {

template <std::floating_point T = float>
class Frame {
  public:
    // Any frame around a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
    [[gnu::always_inline]] explicit Frame(const Direction<T>& normal) noexcept : normal_{normal} {
        const T sign = std::copysign(T(1), normal.z);
        const T a = real::divide(T(-1), sign + normal.z);
        const T b = normal.x * normal.y * a;
        tangent_ = {T(1) + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
        bitangent_ = {b, sign + normal.y * normal.y * a, -normal.y};
    }

    // Three orthonormal vectors as they are: for anisotropic materials.
    constexpr Frame(const Direction<T>& tangent, const Direction<T>& bitangent, const Direction<T>& normal) noexcept
        : tangent_{tangent}, bitangent_{bitangent}, normal_{normal} {}

    template <RealOf<T> R = T>
    [[nodiscard]] constexpr Direction<R> to_world(const Direction<R>& v) const noexcept {
        return v.x * Direction<R>(tangent_) + v.y * Direction<R>(bitangent_) + v.z * Direction<R>(normal_);
    }
    template <RealOf<T> R = T>
    [[nodiscard]] constexpr Direction<R> to_local(const Direction<R>& v) const noexcept {
        return {glm::dot(v, Direction<R>(tangent_)), glm::dot(v, Direction<R>(bitangent_)),
                glm::dot(v, Direction<R>(normal_))};
    }

    [[nodiscard]] constexpr const Direction<T>& tangent() const noexcept { return tangent_; }
    [[nodiscard]] constexpr const Direction<T>& bitangent() const noexcept { return bitangent_; }
    [[nodiscard]] constexpr const Direction<T>& normal() const noexcept { return normal_; }

  private:
    Direction<T> tangent_, bitangent_, normal_;
};

}  // namespace lumis
