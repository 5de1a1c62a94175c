// What a caller gets wrong and only values can tell: it fails an assertion, and where assertions are compiled out, as here
// where they are counted, what is drawn stays what the density says.
#include "assertions.hpp"
#include "catch.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/agreement.hpp>
#include <lumis/testing/integration.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cfenv>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace laws = lumis::testing;

namespace {

template <class T>
constexpr T not_a_number = std::numeric_limits<T>::quiet_NaN();

// How many assertions fail.
int failed(const auto& make) {
    const CaughtAssertions caught;
    make();
    return caught.count();
}

void check(const std::string& name, const laws::LawResult& law) {
    INFO(name << ": " << law.message);
    CHECK(law.passed);
}

// The strategy's density is that of its samples, and it integrates to 1 over the sphere but for what is drawn into nothing.
template <class S>
void check_consistent(const std::string& name, const S& strategy) {
    check(name, laws::agreement(strategy));
    check(name, laws::integration(strategy));
}

}  // namespace
