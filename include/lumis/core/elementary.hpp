// Sine and cosine, arc cosine and arc tangent without branches or tables, so that one definition serves a number and
// lanes of numbers, and compilers inline it. The polynomials are minimax in relative error; tests/core/remez.py makes
// them. The worst errors of the functions as a whole stand with each, in units of epsilon (2^-23, 2^-52), as elementary_test
// measures them.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <glm/vec2.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <type_traits>

namespace lumis::LUMIS_ISA {

namespace detail {

// c[0] + c[1] x + c[2] x^2 + ... by Horner's rule, where coefficients() yields c: CUDA devices have no static arrays of the
// host to refer to.
template <Real R, class Coefficients>
[[nodiscard]] LUMIS_INLINE constexpr R polynomial(R x, Coefficients coefficients) noexcept {
    constexpr auto c = coefficients();
    R sum = c[c.size() - 1];
    for (std::size_t i = c.size() - 1; i > 0; --i) sum = real::mul_add(sum, x, c[i - 1]);
    return sum;
}

// The polynomials: what they approximate, over which range, and how well at most (relative).
template <std::floating_point T>
struct Minimax;

template <>
struct Minimax<float> {
    // sin(2 pi a) / a in a^2, |a| <= 1/4: 5e-9.
    static constexpr std::array sine{6.28318527379f, -41.3416774784f, 81.6022312427f, -76.574992182f, 39.7109181438f};
    // cos(2 pi a) / (1 - 16 a^2) in a^2, |a| <= 1/4: 1e-9.
    static constexpr std::array cosine{0.999999999018f, -3.73920804777f, 5.11195906033f, -3.65981666544f,
                                       1.54586215349f};
    // atan(t) / (2 pi t) in t^2, |t| <= 1: 2e-9.
    static constexpr std::array arc_tangent{
        0.159154942715f,   -0.0530515686106f, 0.0318282289383f,   -0.0226985715242f, 0.0174147827061f,
        -0.0133329116935f, 0.00915970158321f, -0.00490270393298f, 0.00170724617496f, -0.000279146652282f};
    // asin(t) / t in t^2, |t| <= 1/2: 4e-9.
    static constexpr std::array arc_sine{0.999999995584f,  0.166667901097f, 0.074944347585f,
                                         0.0455501854281f, 0.023858169054f, 0.0426356426204f};
};

template <>
struct Minimax<double> {
    // 3e-19.
    static constexpr std::array sine{6.2831853071795864753,  -41.341702240399756229,  81.605249276073406085,
                                     -76.705859752798496385, 42.058693923785165621,   -15.094641620507466995,
                                     3.819927050429970851,   -0.71772357965654757996, 0.10085632871529823912};
    // 3e-20.
    static constexpr std::array cosine{0.99999999999999999997, -3.7392088021787171653,  5.1120531878087853897,
                                       -3.663966201747777392,  1.6211821434358439098,   -0.48734246382981560772,
                                       0.10605616869006554444, -0.01747646276663774443, 0.0021936489348138503871};
    // 4e-20.
    static constexpr std::array arc_tangent{
        0.15915494309189533576,   -0.053051647697298431286,  0.031830988618374468359,  -0.022736420441103921511,
        0.017683882525654991076,  -0.01446862957874348936,   0.012242646253928601433,  -0.010609604116458928882,
        0.0093533540441560021854, -0.0083041111344995744061, 0.0071631082936158802647, -0.0053181172287947100098,
        0.0024095822965673905929};
    // 9e-19.
    static constexpr std::array arc_sine{0.99999999999999999908,   0.1666666666666680849,    0.074999999999636770555,
                                         0.044642857179457122472,  0.030381942523246823362,  0.022372219357241179688,
                                         0.017351543686751447408,  0.01398155075069373276,   0.011393493717322928414,
                                         0.010808157559964286238,  0.0036085695521932184109, 0.021930237256174318826,
                                         -0.021296126068224005878, 0.032804648202608560271};
};

}  // namespace detail

// (cos, sin) of 2 pi turn, for a turn in [-1/4, 1/4]: the right half of the unit circle. Both keep their relative
// accuracy where they are small: within 1.75 epsilon.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline glm::vec<2, R> half_circle(R turn) noexcept {
    using P = detail::Minimax<scalar_of<R>>;
    turn = real::rounded(turn);
    const R square = turn * turn;
    // 1 - 16 turn^2, the cosine's zeros, as a product: neither factor cancels.
    const R zeros = real::rounded(1 - 4 * turn) * real::rounded(1 + 4 * turn);
    return {zeros * detail::polynomial(square, [] { return P::cosine; }),
            turn * detail::polynomial(square, [] { return P::sine; })};
}

// (cos, sin) of 2 pi turn, for a turn in [0, 1], within 1.75 epsilon of 1. No multiple of pi is rounded on the way: 2 pi
// turn alone would cost float up to four units in the last place.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline glm::vec<2, R> unit_circle(R turn) noexcept {
    // Folded at half a turn, where the sine changes its sign, and shifted by a quarter, which turns sine into cosine. Both
    // differences are exact for turns that are points of the uniforms' lattice.
    const R to_half = real::rounded(scalar_of<R>(0.5) - real::rounded(turn));
    const auto shifted = half_circle<R>(real::abs(to_half) - scalar_of<R>(0.25));
    return {shifted.y, real::copysign(shifted.x, to_half)};
}

// The fraction of a turn, in [-1/2, 1/2], at which (x, y) lies, within 2.25 epsilon, relative. (0, 0) gives 0, a NaN NaN.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R signed_turn_of(R x, std::type_identity_t<R> y) noexcept {
    using T = scalar_of<R>;
    // 1. Fold into the first octant, where 0 <= lesser <= greater. No smaller one than the least normal number: then (0, 0) is 0 over it.
    // The two comparisons differ on purpose: of the same one twice, compilers make a branch. min and max may drop a NaN in
    // ax; 0 * ax keeps it.
    const R ax = real::abs(real::rounded(x)), ay = real::abs(real::rounded(y));
    const R lesser = real::lesser(ay, ax);
    const R greater = real::greater(real::greater(ay, ax), (std::numeric_limits<T>::min)()) + real::rounded(0 * ax);

    // 2. The arc tangent of lesser / greater, in turns: from 0 to 1/8.
    R octant;
    if constexpr (std::same_as<T, float>) {
        const R t = real::divide(lesser, greater);
        octant = t * detail::polynomial(R(t * t), [] { return detail::Minimax<T>::arc_tangent; });
    } else {
        // Beyond tan(pi / 8), counted back from 1/8, by the arc tangent of (lesser - greater) / (lesser + greater): the argument
        // stays below tan(pi / 8), which takes half of the terms.
        const auto beyond = lesser > T(0.41421356237309505) * greater;
        const R t = real::divide(real::select(beyond, real::rounded(lesser - greater), lesser),
                                 real::select(beyond, real::rounded(lesser + greater), greater));
        octant = real::mul_add(t, detail::polynomial(R(t * t), [] { return detail::Minimax<T>::arc_tangent; }),
                               real::select(beyond, R(T(0.125)), 0));
    }

    // 3. Unfold by signs, not by branches, which would be guessed wrongly half of the time.
    // |0 - octant| = octant where x is the larger, else |1/4 - octant|.
    const R from_axis = real::rounded(T(0.125) - real::copysign(R(T(0.125)), ax - ay));
    const R quadrant = real::abs(R(from_axis - octant));
    // |0 - quadrant| = quadrant where x is positive, else |1/2 - quadrant|.
    const R from_positive_x = real::rounded(T(0.25) - real::copysign(R(T(0.25)), x));
    const R half = real::abs(R(from_positive_x - quadrant));
    return real::copysign(half, y);
}

// The fraction of a turn, in [0, 1), at which (x, y) lies: the inverse of unit_circle. (0, 0) gives 0.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R turn_of(R x, std::type_identity_t<R> y) noexcept {
    const R turn = signed_turn_of(x, y);
    const R wrapped = real::rounded(real::select(turn < 0, turn + 1, turn));
    // The sum of a tiny negative turn and 1 rounds to 1.
    return real::select(wrapped < 1, wrapped, 0);
}

namespace real {

// atan2(y, x) in radians, within 2.75 epsilon, relative; (0, 0) gives 0.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R atan2(R y, std::type_identity_t<R> x) noexcept {
    return 2 * std::numbers::pi_v<scalar_of<R>> * signed_turn_of(R(x), y);
}

// acos(x) in radians, for x in [-1, 1], within 1.75 epsilon, relative.
template <Real R>
[[nodiscard]] LUMIS_HD R acos(R x) noexcept {
    using T = scalar_of<R>;
    const R ax = abs(rounded(x));
    // Beyond 1/2 by half the angle, which has the sine sqrt((1 - |x|) / 2).
    const auto beyond = ax > T(0.5);
    const R square = select(beyond, rounded(1 - ax) * T(0.5), ax * ax);
    const R sine = select(beyond, sqrt(square), ax);
    const R angle = sine * detail::polynomial(square, [] { return detail::Minimax<T>::arc_sine; });
    const R start = select(beyond, select(x < 0, R(std::numbers::pi_v<T>), 0), std::numbers::pi_v<T> / 2);
    return start + copysign(select(beyond, 2 * angle, angle), select(beyond, x, -x));
}

}  // namespace real

}  // namespace lumis::LUMIS_ISA
