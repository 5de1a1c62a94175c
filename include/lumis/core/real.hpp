// What kernels ask of a number. A kernel is written once, for a Real: a floating-point type for the single call, or
// several lanes of one (see batch/lanes.hpp). Where lanes may differ, a kernel selects instead of branching.
//
// What makes a strategy or samples it is inlined by decree (gnu::always_inline). Compilers do not by themselves, and hand
// vectors over in memory, written in parts and read as a whole: a processor then waits until all that came before is done,
// table look-ups too.
#pragma once

#include <glm/vec3.hpp>

#include <cmath>
#include <concepts>
#include <type_traits>

namespace lumis {

namespace detail {

template <class R>
struct ScalarOf {};
template <std::floating_point T>
struct ScalarOf<T> {
    using type = T;
};
template <class R>
    requires requires {
        typename R::Lane;
    }
struct ScalarOf<R> {
    using type = typename R::Lane;
};

}  // namespace detail

// The floating-point type that R is, or is made of lanes of.
template <class R>
using scalar_of = typename detail::ScalarOf<R>::type;

template <class R>
concept Real = std::floating_point<R> || requires {
    typename R::Lane;
};

// A T, or lanes of T.
template <class R, class T>
concept RealOf = Real<R> && std::same_as<scalar_of<R>, T>;

// What a comparison of two R yields: bool, or one for each lane.
template <Real R>
using MaskOf = decltype(R{} < R{});

namespace real {

// Of a number by the machine's instruction: around that, std::sqrt has a comparison and a call for the sake of errno.
// Without AVX, making a vector of the number costs as much.
template <Real R>
[[nodiscard, gnu::always_inline]] inline R sqrt(R x) noexcept {
#ifdef __AVX__
    if constexpr (std::same_as<R, float>) {
        using Vector [[gnu::vector_size(16)]] = float;
        return __builtin_ia32_sqrtss(Vector{x})[0];
    } else if constexpr (std::same_as<R, double>) {
        using Vector [[gnu::vector_size(16)]] = double;
        return __builtin_ia32_sqrtsd(Vector{x})[0];
    }
#endif
    using std::sqrt;
    return sqrt(x);
}

template <Real R>
[[nodiscard, gnu::always_inline]] inline R length(const glm::vec<3, R>& v) noexcept {
    return sqrt(R(v.x * v.x + v.y * v.y + v.z * v.z));
}

template <Real R>
[[nodiscard]] R abs(R x) noexcept {
    using std::abs;
    return abs(x);
}

template <Real R>
[[nodiscard]] R copysign(R magnitude, R sign) noexcept {
    using std::copysign;
    return copysign(magnitude, sign);
}

// a b + c in one expression, which a compiler may fuse.
template <Real R>
[[nodiscard]] constexpr R mul_add(R a, std::type_identity_t<R> b, std::type_identity_t<R> c) noexcept {
    if constexpr (std::floating_point<R>) {
        return a * b + c;
    } else {
        return R::mul_add(a, b, c);
    }
}

// a where the condition holds, else b.
template <Real R>
[[nodiscard]] constexpr R select(const MaskOf<R>& condition, R a, std::type_identity_t<R> b) noexcept {
    if constexpr (std::floating_point<R>) {
        return condition ? a : b;
    } else {
        return R::select(condition, a, b);
    }
}

template <Real R>
[[nodiscard]] constexpr glm::vec<3, R> select(const MaskOf<R>& condition, const glm::vec<3, R>& a,
                                              const glm::vec<3, R>& b) noexcept {
    return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

// a() where the condition holds, else b(); a number asks for just one of them.
template <class Condition, class A, class B>
[[nodiscard]] constexpr auto either(const Condition& condition, A a, B b) noexcept {
    if constexpr (std::same_as<Condition, bool>) {
        return condition ? a() : b();
    } else {
        return select(condition, a(), b());
    }
}

// As std::min and std::max: a NaN in b yields a.
template <Real R>
[[nodiscard]] constexpr R min(R a, std::type_identity_t<R> b) noexcept {
    return select(b < a, b, a);
}
template <Real R>
[[nodiscard]] constexpr R max(R a, std::type_identity_t<R> b) noexcept {
    return select(a < b, b, a);
}

template <Real R>
[[nodiscard]] constexpr R clamp(R x, std::type_identity_t<R> low, std::type_identity_t<R> high) noexcept {
    return max(min(x, high), low);
}

// The largest of a range of numbers, of which there is at least one.
[[nodiscard]] constexpr auto largest_of(const auto& numbers) noexcept {
    auto largest = *numbers.begin();
    for (const auto number : numbers) largest = largest < number ? number : largest;
    return largest;
}

// Whether a condition holds in every lane.
[[nodiscard]] constexpr bool all(bool condition) noexcept {
    return condition;
}
template <class Mask>
[[nodiscard]] constexpr bool all(const Mask& condition) noexcept {
    return condition.all();
}

}  // namespace real

}  // namespace lumis
