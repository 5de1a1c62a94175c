// The arithmetic that kernels are written in raises no floating-point exception where its condition fails, and barriers
// change no value. Its use by the kernels is tested by floating_point_exceptions_test and by the stability table.
#include "exceptions.hpp"
#include <lumis/core/lanes.hpp>

#include <cfenv>

namespace real = lumis::real;

static_assert(real::rounded(6.0f) == 6.0f);
static_assert(real::divisor_where(true, 3.0) == 3.0);
static_assert(real::quotient_where(true, 6.0f, 2.0f) == 3.0f);
static_assert(real::quotient_where(false, 6.0f, 0.0f) == 0.0f);

// clang++ divides by x whether or not both conditions hold, where divisor_where is a select.
template <class T>
[[gnu::noinline]] static T scaled_inverse_or(T a, T b, T x, T otherwise) {
    const bool holds = a > 0 && b > 1;
    return real::select(holds, a / real::divisor_where(holds, x), otherwise);
}

TEMPLATE_TEST_CASE("a division whose condition fails raises no exception", "[real]", float, double) {
    using T = TestType;
    const T zero = unknown(T(0)), one = unknown(T(1));
    REQUIRE(exceptions_raised_by([&] { keep(zero / zero); }) == FE_INVALID);
    REQUIRE(exceptions_raised_by([&] { keep(one / zero); }) == FE_DIVBYZERO);

    T quotient;
    CHECK(exceptions_raised_by([&] { keep(quotient = real::quotient_where(zero > 0, zero, zero)); }) == 0);
    CHECK(quotient == 0);
    CHECK(exceptions_raised_by([&] { keep(quotient = real::quotient_where(zero > 0, one, zero)); }) == 0);
    CHECK(quotient == 0);
    CHECK(exceptions_raised_by([&] { keep(quotient = real::quotient_where(one > 0, T(3), T(4 * one))); }) == 0);
    CHECK(quotient == T(0.75));
    CHECK(exceptions_raised_by([&] { keep(quotient = scaled_inverse_or(one, zero, zero, one)); }) == 0);
    CHECK(quotient == 1);
}

TEMPLATE_TEST_CASE("a root of what rounding made negative is 0 without an exception", "[real]", float, double) {
    using T = TestType;
    const T negative = unknown(T(-1e-9f));
    T root;
    REQUIRE(exceptions_raised_by([&] { keep(root = real::sqrt(negative)); }) == FE_INVALID);
    CHECK(exceptions_raised_by([&] { keep(root = real::sqrt_or_zero(negative)); }) == 0);
    CHECK(root == 0);
    CHECK(real::sqrt_or_zero(T(9)) == 3);
}

TEMPLATE_TEST_CASE("what a sum rounds off is found between barriers", "[real]", float, double,
                   lumis::NativeLanes<float>, lumis::NativeLanes<double>) {
    using R = TestType;
    using T = lumis::scalar_of<R>;
    // Knuth's two-sum: flags that allow re-association reduce it to 0 without the barriers.
    const R a = unknown(T(1)), b = unknown(std::numeric_limits<T>::epsilon() / 8);
    const R sum = real::rounded(R(a + b)), b_added = real::rounded(R(sum - a));
    const R a_added = real::rounded(R(sum - b_added));
    const R lost = real::rounded(R(a - a_added)) + real::rounded(R(b - b_added));
    CHECK(real::all(lost == b));
    const R quotient = real::quotient_where(a > 0, b, a);
    CHECK(real::all(quotient == b));
}
