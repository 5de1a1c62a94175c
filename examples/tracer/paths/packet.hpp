// Samples of a pixel are traced in packets, one in each lane: eight at a time, or sixteen where the machine has vectors for them.
// The tracer's kernels are written for a lumis::Real R: a Packet, or a float for a single sample. What lanes need beyond
// arithmetic is here: their masks, and tables' entries.
#pragma once

#include <lumis/core/lanes.hpp>
#include <lumis/core/real.hpp>

#include <glm/vec3.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace tracer {

using Packet = lumis::Lanes<float, LUMIS_VECTOR_BYTES >= 64 ? 16 : 8>;

template <lumis::Real R>
inline constexpr std::size_t lanes = [] {
    if constexpr (std::floating_point<R>) {
        return std::size_t{1};
    } else {
        return R::size;
    }
}();

template <lumis::Real R>
using Vector = glm::vec<3, R>;
template <lumis::Real R>
using Mask = lumis::MaskOf<R>;

// An entry of a table for each lane.
template <lumis::Real R>
using Indices = std::array<std::uint32_t, lanes<R>>;

[[nodiscard]] LUMIS_INLINE inline bool any(bool mask) {
    return mask;
}
[[nodiscard]] LUMIS_INLINE inline bool any(const auto& mask) {
    return mask.any();
}
[[nodiscard]] LUMIS_INLINE inline bool lane(bool mask, std::size_t /*i*/) {
    return mask;
}
[[nodiscard]] LUMIS_INLINE inline auto lane(const auto& lanes_of_something, std::size_t i) {
    return lanes_of_something[i];
}
[[nodiscard]] LUMIS_INLINE inline float lane(float x, std::size_t /*i*/) {
    return x;
}

template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline glm::vec3 lane_of(const Vector<R>& v, std::size_t i) {
    return {lane(v.x, i), lane(v.y, i), lane(v.z, i)};
}

// f(0), f(1), ...: a number for each lane.
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline R of_lanes(const auto& f) {
    if constexpr (std::floating_point<R>) {
        return f(std::integral_constant<std::size_t, 0>{});
    } else {
        return R::of_lanes(f);
    }
}

// The lanes where f(0), f(1), ... hold.
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline Mask<R> mask_of(const auto& f) {
    return of_lanes<R>([&](auto i) { return f(i) ? 1.0f : 0.0f; }) > 0.0f;
}

// The lanes whose entry is `entry`.
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline Mask<R> are(const Indices<R>& entries, std::uint32_t entry) {
    if constexpr (std::floating_point<R>) {
        return entries[0] == entry;
    } else {
        Indices<R> same;
        same.fill(entry);
        typename Mask<R>::Vector numbers, sought;
        std::memcpy(&numbers, entries.data(), sizeof numbers);
        std::memcpy(&sought, same.data(), sizeof sought);
        return Mask<R>{numbers == sought};
    }
}

// Positive numbers, split at the point.
template <lumis::Real R>
struct Split {
    Indices<R> whole;
    R fraction;
};
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline Split<R> split(const R& x) {
    std::array<float, lanes<R>> numbers;
    std::memcpy(numbers.data(), &x, sizeof numbers);
    Split<R> result;
    for (std::size_t i = 0; i < lanes<R>; ++i) {
        const auto whole = static_cast<std::int32_t>(numbers[i]);
        result.whole[i] = static_cast<std::uint32_t>(whole);
        numbers[i] -= static_cast<float>(whole);
    }
    std::memcpy(static_cast<void*>(&result.fraction), numbers.data(), sizeof numbers);
    return result;
}

// Entries where the mask holds; in other lanes one of those.
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline Indices<R> filled(const Indices<R>& entries, const Mask<R>& mask) {
    std::uint32_t present = 0;
    for (std::size_t i = 0; i < lanes<R>; ++i) present = lane(mask, i) ? entries[i] : present;
    Indices<R> result;
    for (std::size_t i = 0; i < lanes<R>; ++i) result[i] = lane(mask, i) ? entries[i] : present;
    return result;
}

// Entries of a table of structures of floats, one in each lane: To has the members of From, made of R. Lanes that share an
// entry, as those of one pixel mostly do, are filled at once.
template <class To, lumis::Real R, class From>
[[nodiscard]] LUMIS_INLINE inline To gather(const std::vector<From>& table, const Indices<R>& at) {
    if constexpr (std::is_same_v<To, From>) {
        return table[at[0]];
    } else {
        constexpr std::size_t members = sizeof(From) / sizeof(float);
        static_assert(sizeof(To) == members * sizeof(R), "a structure of numbers alone");
        std::array<R, members> gathered;
        const bool is_shared = are<R>(at, at[0]).all();
        const auto number = [&](std::size_t lane, std::size_t member) {
            float x;
            std::memcpy(&x, reinterpret_cast<const char*>(&table[at[lane]]) + member * sizeof(float), sizeof x);
            return x;
        };
        if (is_shared) {
            for (std::size_t k = 0; k < members; ++k) gathered[k] = R(number(0, k));
        } else {
            for (std::size_t k = 0; k < members; ++k) {
                gathered[k] = R::of_lanes([&](auto i) { return number(i, k); });
            }
        }
        To result;
        std::memcpy(static_cast<void*>(&result), gathered.data(), sizeof result);
        return result;
    }
}

}  // namespace tracer
