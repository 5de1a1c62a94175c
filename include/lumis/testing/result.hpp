// What a law answers. A law is a property that every strategy keeps; it can be asked in any unit-test framework:
//     const auto law = lumis::testing::agreement(strategy);
//     CHECK_MESSAGE(law.passed, law.message);
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <type_traits>

namespace lumis::testing {

struct LawResult {
    bool passed{};
    double number{};      // the law's worst error, or its p-value
    std::string message;  // what was measured and, on failure, where

    explicit operator bool() const noexcept { return passed; }
};

// What a statistical law may do wrongly: it fails a correct strategy with probability false_alarm over a whole family
// of tests, whatever the family's size (Sidak 1967).
struct Significance {
    double false_alarm = 0.01;
    std::size_t family = 1;

    // The p-value below which a single test of the family fails.
    [[nodiscard]] double threshold() const noexcept {
        return -std::expm1(std::log1p(-false_alarm) / static_cast<double>(family));
    }
};

namespace detail {

template <class T>
    requires std::is_arithmetic_v<T>
void write(std::ostream& out, T x) {
    out << x;
}
template <int N, class T, glm::qualifier Q>
void write(std::ostream& out, const glm::vec<N, T, Q>& v) {
    for (int i = 0; i < N; ++i) out << (i == 0 ? "(" : ", ") << v[i];
    out << ')';
}
inline void write(std::ostream& out, const char* text) {
    out << text;
}

// Numbers with enough digits to be typed in again.
template <class... Parts>
[[nodiscard]] std::string text(const Parts&... parts) {
    std::ostringstream out;
    out.precision(9);
    (write(out, parts), ...);
    return out.str();
}

}  // namespace detail

}  // namespace lumis::testing
