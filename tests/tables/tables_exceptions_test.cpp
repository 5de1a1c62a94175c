// Turns, tables and moments raise neither FE_INVALID nor FE_DIVBYZERO, where they are made and where they are used.
#include "catch.hpp"
#include "exceptions.hpp"
#include "table_weights.hpp"
#include <lumis/core/latlong.hpp>
#include <lumis/statistics/running_moments.hpp>
#include <lumis/tables/alias_table.hpp>
#include <lumis/tables/piecewise_constant.hpp>

#include <limits>
#include <vector>

TEMPLATE_TEST_CASE("turns, tables and moments raise no exceptions", "[exceptions]", float, double) {
    using T = TestType;
    CHECK(exceptions_raised_by([] {
              for (const T x : {T(-1), T(-0.3), T(0), T(0.3), T(1)}) {
                  for (const T y : {T(-1), T(-1e-20), T(0), T(0.3), T(1)}) {
                      keep(lumis::turn_of(unknown(x), unknown(y)));
                      keep(lumis::real::acos(unknown(x)));
                      keep(lumis::latlong_from_direction(lumis::Direction<T>{unknown(x), unknown(y), unknown(x)}));
                  }
                  keep(lumis::unit_circle(unknown(x * x)));
              }
          }) == 0);
    for (const auto& weights : weight_classes<T>()) {
        CHECK(exceptions_raised_by([&] {
                  const lumis::AliasTable<T> table{weights};
                  const lumis::PiecewiseConstant1D<T> line{weights};
                  for (int i = 0; i <= 100; ++i) {
                      const glm::vec<1, T> u{unknown(static_cast<T>(i) / 100)};
                      keep(table.sample(u));
                      keep(line.sample(u));
                  }
              }) == 0);
    }
    CHECK(exceptions_raised_by([] {
              keep(lumis::AliasTable<T>{std::vector<T>(5)}.sample(glm::vec<1, T>{T(0.5)}));
              lumis::RunningMoments<T> moments, others;
              keep(moments.standard_error());
              for (int i = 0; i < 100; ++i) {
                  moments.add(unknown(i % 2 == 0 ? std::numeric_limits<T>::max() : -std::numeric_limits<T>::max()));
                  others.add(unknown(static_cast<T>(i)));
              }
              moments.merge(others);
              keep(moments.variance());
          }) == 0);
}
