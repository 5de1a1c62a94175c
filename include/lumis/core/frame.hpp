// An orthonormal frame; its local +z is the normal. It is right-handed unless it is made of three vectors that are not.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/detail/arguments.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>

namespace lumis::LUMIS_ISA {

template <Real T = float>
class Frame {
  public:
    // Any frame around a normal, which is asserted to be a unit vector; else it is scaled to one, and where it has no
    // direction nothing is drawn in the frame (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
    LUMIS_INLINE explicit Frame(const Direction<T>& any_normal) noexcept {
        LUMIS_ASSERT(real::all(detail::is_unit(any_normal)));
        const Direction<T> normal = normal_ = detail::unit_or(any_normal, not_a_number);
        const T sign = real::copysign(T(1), normal.z);
        const T a = real::divide(T(-1), sign + normal.z);
        const T b = normal.x * normal.y * a;
        tangent_ = {T(1) + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
        bitangent_ = {b, sign + normal.y * normal.y * a, -normal.y};
    }

    // Three vectors as they are: for anisotropic materials. They are asserted to be orthonormal; else the nearest frame
    // with this normal, and this tangent's plane, is made of them (Gram and Schmidt).
    LUMIS_HD constexpr Frame(const Direction<T>& tangent, const Direction<T>& bitangent,
                             const Direction<T>& normal) noexcept
        : tangent_{tangent}, bitangent_{bitangent}, normal_{normal} {
        LUMIS_ASSERT(real::all(detail::are_orthonormal(tangent, bitangent, normal)));
        if (!real::all(detail::are_orthonormal(tangent, bitangent, normal))) [[unlikely]]
            *this = orthonormal(tangent, bitangent, normal);
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD constexpr Direction<R> to_world(const Direction<R>& v) const noexcept {
        return v.x * Direction<R>(tangent_) + v.y * Direction<R>(bitangent_) + v.z * Direction<R>(normal_);
    }
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD constexpr Direction<R> to_local(const Direction<R>& v) const noexcept {
        return {glm::dot(v, Direction<R>(tangent_)), glm::dot(v, Direction<R>(bitangent_)),
                glm::dot(v, Direction<R>(normal_))};
    }

    [[nodiscard]] LUMIS_HD constexpr const Direction<T>& tangent() const noexcept { return tangent_; }
    [[nodiscard]] LUMIS_HD constexpr const Direction<T>& bitangent() const noexcept { return bitangent_; }
    [[nodiscard]] LUMIS_HD constexpr const Direction<T>& normal() const noexcept { return normal_; }

  private:
    // A vector that has no direction becomes this, of which strategies draw nothing.
    static constexpr scalar_of<T> not_a_number = std::numeric_limits<T>::quiet_NaN();

    [[nodiscard]] LUMIS_COLD static Frame orthonormal(Direction<T> tangent, Direction<T> bitangent,
                                                      Direction<T> normal) noexcept {
        const auto left_handed = detail::dot(glm::cross(normal, tangent), bitangent) < 0;
        Frame given, frame, none;
        given.tangent_ = tangent, given.bitangent_ = bitangent, given.normal_ = normal;
        none.tangent_ = none.bitangent_ = none.normal_ = Direction<T>{T(not_a_number)};
        frame.normal_ = detail::unit_or(normal, not_a_number);
        // Twice: what the first pass leaves of a tangent next to the normal is rounding as well.
        const Direction<T> across = without_normal(frame.normal_, detail::unit_or(tangent, not_a_number));
        frame.tangent_ =
            detail::unit_or(without_normal(frame.normal_, detail::unit_or(across, not_a_number)), not_a_number);
        frame.bitangent_ = glm::cross(frame.normal_, frame.tangent_) * real::select(left_handed, T(-1), 1);
        const auto has_plane = detail::dot(across, across) >= detail::squared(scalar_of<T>(1e-3));
        return select(detail::are_orthonormal(tangent, bitangent, normal), given, select(has_plane, frame, none));
    }

    LUMIS_HD static constexpr Frame select(const MaskOf<T>& condition, const Frame& a, const Frame& b) noexcept {
        Frame chosen;
        chosen.tangent_ = real::select(condition, a.tangent_, b.tangent_);
        chosen.bitangent_ = real::select(condition, a.bitangent_, b.bitangent_);
        chosen.normal_ = real::select(condition, a.normal_, b.normal_);
        return chosen;
    }

    LUMIS_HD static Direction<T> without_normal(const Direction<T>& normal, const Direction<T>& v) noexcept {
        return v - detail::dot(v, normal) * normal;
    }

    Frame() = default;

    Direction<T> tangent_, bitangent_, normal_;
};

}  // namespace lumis::LUMIS_ISA
