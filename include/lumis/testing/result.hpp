// What a law answers. A law is a property that every strategy keeps; it can be asked in any unit-test framework:
//     CHECK(lumis::testing::agreement(strategy));           // Catch2 prints the result, which prints its message
//     const auto law = lumis::testing::agreement(strategy);
//     CHECK_MESSAGE(law.passed, law.message);               // doctest
#pragma once

#include "lumis/core/platform.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>

namespace lumis::LUMIS_ISA::testing {

struct LawResult {
    bool passed{};
    double number{};      // the law's worst error, or its p-value
    std::string message;  // what was measured and, on failure, where
    // False if the law could not judge: then it has not passed, but the strategy need not be wrong. The message says
    // what the law lacked.
    bool decided = true;

    explicit operator bool() const noexcept { return passed; }

    friend std::ostream& operator<<(std::ostream& out, const LawResult& law) {
        return out << (law.passed ? "passed: " : law.decided ? "failed: " : "undecided: ") << law.message;
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

inline void write(std::ostream& out, const std::string& text) {
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

// The ratios of numbers to what they should equal, over all points where both were compared. A ratio that is the same
// everywhere tells of a wrong constant, one that varies of a wrong formula.
class Ratios {
  public:
    void add(double ratio) noexcept {
        ++count_;
        least_ = (std::min)(least_, ratio);
        largest_ = (std::max)(largest_, ratio);
        sum_ += ratio;
    }

    // What the ratios have in common; those within `tolerance` of each other, relative, are the same.
    [[nodiscard]] std::string spread(double tolerance) const {
        if (!(largest_ - least_ <= tolerance * least_)) {
            return text("by factors from ", least_, " to ", largest_);
        }
        // Rounded to the digits that are the same.
        const double mean = sum_ / static_cast<double>(count_);
        const double unit = std::pow(10, std::floor(std::log10(tolerance * mean)));
        return text("by the same factor ", std::round(mean / unit) * unit, " at all ", count_);
    }

  private:
    std::size_t count_ = 0;
    double least_ = std::numeric_limits<double>::infinity(), largest_ = 0, sum_ = 0;
};

}  // namespace detail

// What a statistical law may do wrongly: it fails a correct strategy with probability false_alarm over a whole family
// of tests, whatever the family's size (Sidak 1967).
struct Significance {
    double false_alarm = 0.01;
    std::size_t family = 1;

    // The p-value below which a single test of the family fails.
    [[nodiscard]] double threshold() const noexcept {
        return -std::expm1(std::log1p(-false_alarm) / static_cast<double>(family));
    }

    // What a test's p-value means.
    [[nodiscard]] std::string meaning(double p) const {
        std::string result = detail::text("p = ", p, ", the probability of so large a deviation if all is right; ",
                                          p >= threshold() ? "not below " : "below ", threshold(),
                                          ", where a correct strategy fails with probability ", false_alarm);
        if (family > 1) result += detail::text(" in any of ", family, " tests");
        return result;
    }
};

}  // namespace lumis::LUMIS_ISA::testing
