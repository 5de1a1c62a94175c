// The laws over the strategy that docs/problems.md shows: its file is compiled here, as a part of this one.
#include "catch.hpp"
#include "problems/quarter_circle.cpp"
#include <lumis/testing/laws.hpp>

TEST_CASE("the laws over the documented problem's own strategy") {
    namespace laws = lumis::testing;
    const auto chart = laws::interval_chart(1);
    CHECK(laws::agreement(Falling{}));
    CHECK(laws::integrates(Falling{}, chart, {.probability = 1.0}));
    CHECK(laws::covers(Falling{}, laws::everywhere, chart));
    CHECK(laws::chi_square(Falling{}, chart));
    CHECK(laws::stays_finite(Falling{}));
    CHECK(laws::jacobian(Falling{}));
}
