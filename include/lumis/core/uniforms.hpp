// Sources of uniforms in [0, 1). Scaling an integer to float, and some standard library distributions, can round up to
// exactly 1; the adaptors here cannot.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <glm/ext/vector_double1.hpp>
#include <glm/ext/vector_float1.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// next<N>() yields N uniforms at once; x is drawn first. What it returns is converted to glm::vec<N, T>.
template <class U, class T>
concept UniformSource = Real<T> && requires(U uniforms) {
    { uniforms.template next<1>() } -> std::convertible_to<glm::vec<1, T>>;
    { uniforms.template next<2>() } -> std::convertible_to<glm::vec<2, T>>;
    { uniforms.template next<3>() } -> std::convertible_to<glm::vec<3, T>>;
    { uniforms.template next<4>() } -> std::convertible_to<glm::vec<4, T>>;
};

namespace detail {

// The Real that a source yields to strategies of a Scalar: lanes where next<1>() is made of lanes of Scalar, else Scalar.
template <class U, class Scalar>
struct RealYielded : std::type_identity<Scalar> {};
template <class U, class Scalar>
    requires requires(U uniforms) {
        { uniforms.template next<1>().x[0] } -> std::convertible_to<Scalar>;
        requires RealOf<std::remove_cvref_t<decltype(uniforms.template next<1>().x)>, Scalar>;
    }
struct RealYielded<U, Scalar>
    : std::type_identity<std::remove_cvref_t<decltype(std::declval<U&>().template next<1>().x)>> {};

}  // namespace detail

template <class U, class Scalar>
using RealFrom = typename detail::RealYielded<std::remove_reference_t<U>, Scalar>::type;

// A uniform is a point k / 2^digits of the lattice that T can hold evenly: 2^24 of them in float, 2^53 in double.
template <FloatOrDouble T>
inline constexpr int uniform_bits = std::numeric_limits<T>::digits;

// The lattice index of u; u == 1, which no source of ours yields, counts as the last one.
template <FloatOrDouble T>
[[nodiscard]] LUMIS_HD constexpr std::uint64_t lattice_index(T u) noexcept {
    constexpr auto size = std::uint64_t{1} << uniform_bits<T>;
    const auto index = static_cast<std::uint64_t>(static_cast<std::int64_t>(u * static_cast<T>(size)));
    return index < size ? index : size - 1;
}

namespace detail {

// {draw(), draw(), ...}, in this order. (Filled by index, the vector may be used uninitialised as far as g++ -O3 can see.)
template <int N, class T, class F>
[[nodiscard]] LUMIS_HD constexpr glm::vec<N, T> fill(F&& draw) {
    const auto all = [&]<int... I>(std::integer_sequence<int, I...>) {
        return glm::vec<N, T>{(static_cast<void>(I), draw())...};
    };
    return all(std::make_integer_sequence<int, N>{});
}

}  // namespace detail

// std::uniform_random_bit_generator, restated: to include <random> for it would add half of the time that all of Lumis takes
// to compile.
template <class G>
concept RandomBitGenerator = std::invocable<G&> && std::unsigned_integral<std::invoke_result_t<G&>> && requires {
    { (G::min)() } -> std::same_as<std::invoke_result_t<G&>>;
    { (G::max)() } -> std::same_as<std::invoke_result_t<G&>>;
    requires std::bool_constant<((G::min)() < (G::max)())>::value;
};

// Any standard uniform random bit generator as a source. Uniforms{engine} draws from the caller's engine and advances
// it; Uniforms{Engine{seed}} owns the one it is given, and so does Uniforms<Engine, T> spelt out.
template <class Urbg, FloatOrDouble T = float>
class Uniforms {
    using Engine = std::remove_reference_t<Urbg>;
    static_assert(RandomBitGenerator<Engine>);

  public:
    // The argument is kept out of deduction: compilers disagree whether it or the guide below decides.
    LUMIS_HD constexpr explicit Uniforms(std::type_identity_t<Urbg> engine LUMIS_LIFETIME_BOUND)
        : engine_{std::forward<Urbg>(engine)} {}

    template <int N>
    [[nodiscard]] LUMIS_HD constexpr glm::vec<N, T> next() {
        return detail::fill<N, T>([this] { return static_cast<T>(bits()) * spacing; });
    }

  private:
    static constexpr T spacing = T(1) / static_cast<T>(std::uint64_t{1} << uniform_bits<T>);

    // uniform_bits<T> fair bits: the top ones of one draw, or of several.
    LUMIS_HD constexpr std::uint64_t bits() {
        std::uint64_t result = 0;
        for (int missing = uniform_bits<T>; missing > 0; missing -= width) {
            const int taken = width < missing ? width : missing;
            result = result << taken | draw() >> (width - taken);
        }
        return result;
    }

    // `width` fair bits: a draw beyond the largest power of two that the engine's range holds is drawn again.
    LUMIS_HD constexpr std::uint64_t draw() {
        if constexpr (range == largest) {
            return engine_() - (Engine::min)();
        } else {
            std::uint64_t drawn;
            do drawn = engine_() - (Engine::min)();
            while (drawn > largest);
            return drawn;
        }
    }

    static constexpr std::uint64_t range = (Engine::max)() - (Engine::min)();
    static constexpr int width = range + 1 == 0 ? 64 : std::bit_width(range + 1) - 1;
    static constexpr std::uint64_t largest = ~std::uint64_t{0} >> (64 - width);

    Urbg engine_;
};

template <class Urbg>
Uniforms(Urbg&&) -> Uniforms<Urbg, float>;

// A host's own "give me the next number" as a source; what it returns at or above 1 becomes the largest number below 1.
template <FloatOrDouble T, class F>
class UniformsFrom {
  public:
    LUMIS_HD constexpr explicit UniformsFrom(F nullary) : nullary_{std::move(nullary)} {}

    template <int N>
    [[nodiscard]] LUMIS_HD constexpr glm::vec<N, T> next() {
        return detail::fill<N, T>([this] {
            constexpr T below_one = T(1) - std::numeric_limits<T>::epsilon() / 2;
            const T u = static_cast<T>(nullary_());
            return u < T(1) ? u : below_one;
        });
    }

  private:
    F nullary_;
};

template <FloatOrDouble T, class F>
[[nodiscard]] LUMIS_HD constexpr auto uniforms_from(F nullary) {
    return UniformsFrom<T, F>{std::move(nullary)};
}

}  // namespace lumis::LUMIS_ISA
