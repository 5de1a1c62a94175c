// Lanes that no register holds: an array of registers, or one of numbers where the compiler has no vectors. It has the
// operators of a compiler's vector. (Compilers work on vectors wider than a register too, but g++ compares them number by
// number, and clang++ warns wherever one is passed on.)
#pragma once

#include "lumis/core/detail/registers.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/scalar.hpp"

#include <cstddef>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

// What an array is made of.
#ifdef LUMIS_HAS_VECTORS
template <class T>
inline constexpr std::size_t lanes_of_part = LUMIS_VECTOR_BYTES / sizeof(T);
template <class T>
using Register = typename RegisterOf<T, lanes_of_part<T>>::type;
#else
template <class T>
inline constexpr std::size_t lanes_of_part = 1;
template <class T>
using Register = T;
#endif

template <class T, std::size_t N>
struct Array {
    static constexpr std::size_t size = N / lanes_of_part<T>;
    Register<T> parts[size];

    [[nodiscard]] LUMIS_INLINE T operator[](std::size_t i) const noexcept {
#ifdef LUMIS_HAS_VECTORS
        return parts[i / lanes_of_part<T>][i % lanes_of_part<T>];
#else
        return parts[i];
#endif
    }

    LUMIS_INLINE friend Array operator+(const Array& a, const Array& b) noexcept {
        return Array::each([](auto x, auto y) { return x + y; }, a, b);
    }
    LUMIS_INLINE friend Array operator-(const Array& a, const Array& b) noexcept {
        return Array::each([](auto x, auto y) { return x - y; }, a, b);
    }
    LUMIS_INLINE friend Array operator*(const Array& a, const Array& b) noexcept {
        return Array::each([](auto x, auto y) { return x * y; }, a, b);
    }
    LUMIS_INLINE friend Array operator/(const Array& a, const Array& b) noexcept {
        return Array::each([](auto x, auto y) { return x / y; }, a, b);
    }
    LUMIS_INLINE friend Array operator&(const Array& a, const Array& b) noexcept {
        return Array::each([](auto x, auto y) { return x & y; }, a, b);
    }
    LUMIS_INLINE friend Array operator|(const Array& a, const Array& b) noexcept {
        return Array::each([](auto x, auto y) { return x | y; }, a, b);
    }
    LUMIS_INLINE friend Array operator-(const Array& a) noexcept {
        return Array::each([](auto x) { return -x; }, a);
    }
    LUMIS_INLINE friend Array operator~(const Array& a) noexcept {
        return Array::each([](auto x) { return ~x; }, a);
    }

    LUMIS_INLINE friend auto operator<(const Array& a, const Array& b) noexcept {
        return Mask::each([](auto x, auto y) { return as_mask(x < y); }, a, b);
    }
    LUMIS_INLINE friend auto operator<=(const Array& a, const Array& b) noexcept {
        return Mask::each([](auto x, auto y) { return as_mask(x <= y); }, a, b);
    }
    LUMIS_INLINE friend auto operator>(const Array& a, const Array& b) noexcept {
        return Mask::each([](auto x, auto y) { return as_mask(x > y); }, a, b);
    }
    LUMIS_INLINE friend auto operator>=(const Array& a, const Array& b) noexcept {
        return Mask::each([](auto x, auto y) { return as_mask(x >= y); }, a, b);
    }
    LUMIS_INLINE friend auto operator==(const Array& a, const Array& b) noexcept {
        return Mask::each([](auto x, auto y) { return as_mask(x == y); }, a, b);
    }

    // The array of f of each array's first part, of their second parts, and so on.
    template <class F, class... Arrays>
    [[nodiscard]] LUMIS_INLINE static Array each(F f, const Arrays&... arrays) noexcept {
        return Array::of_parts([&]([[maybe_unused]] std::size_t i) { return f(arrays.parts[i]...); },
                               std::make_index_sequence<size>{});
    }

  private:
    using Mask = Array<BitsOf<T>, N>;

    template <class F, std::size_t... I>
    LUMIS_INLINE static Array of_parts(F part, std::index_sequence<I...>) noexcept {
        return {{part(I)...}};
    }
    LUMIS_INLINE static Register<BitsOf<T>> as_mask(auto comparison) noexcept {
#ifdef LUMIS_HAS_VECTORS
        return reinterpret_cast<Register<BitsOf<T>>>(comparison);
#else
        return comparison ? -1 : 0;
#endif
    }
};

}  // namespace lumis::LUMIS_ISA::detail
