// Which floating-point exceptions a computation raises.
#pragma once

#include <cfenv>

namespace detail {

// Nothing is moved into or out of a function that is not inlined and has effects that a compiler does not know.
template <class F>
[[gnu::noinline]] void run_apart(F& computation) {
    asm volatile("" : : : "memory");
    computation();
    asm volatile("" : : : "memory");
}

}  // namespace detail

// The invalid operations and divisions by zero of a computation, FE_INVALID | FE_DIVBYZERO or one or none of them. What it
// computes should go to keep(), or else a compiler leaves it out.
template <class F>
[[nodiscard]] int exceptions_raised_by(F computation) {
    std::feclearexcept(FE_ALL_EXCEPT);
    detail::run_apart(computation);
    return std::fetestexcept(FE_INVALID | FE_DIVBYZERO);
}

template <class T>
void keep(const T& value) {
    asm volatile("" : : "m"(value) : "memory");
}

// x, of which the compiler does not know the value.
template <class T>
[[nodiscard]] T unknown(T x) {
    volatile T hidden = x;
    return hidden;
}
