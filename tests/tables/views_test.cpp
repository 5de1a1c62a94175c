// Views of tables: small, and the same as the table, of which they may outlive all but a copy of its arrays.
#include "catch.hpp"
#include "copies.hpp"
#include "table_weights.hpp"
#include <lumis/tables/alias_table.hpp>
#include <lumis/tables/piecewise_constant.hpp>

#include <cstddef>
#include <optional>
#include <random>
#include <type_traits>
#include <vector>

namespace {

template <class S>
void check_same(const S& table, const auto& view, auto points) {
    std::mt19937 engine{7};
    std::uniform_real_distribution<typename S::Scalar> uniform;
    for (int i = 0; i < 1000; ++i) {
        lumis::UniformsOf<S> u;
        for (int k = 0; k < S::dimensions; ++k) u[k] = uniform(engine);
        const auto a = table.sample(u), b = view.sample(u);
        CHECK(a.value == b.value);
        CHECK(a.pdf == b.pdf);
        CHECK(table.pdf(a.value) == view.pdf(a.value));
        if constexpr (lumis::InvertibleStrategy<S>) CHECK(table.invert(a.value) == view.invert(a.value));
    }
    for (const auto& x : points) CHECK(table.pdf(x) == view.pdf(x));
    CHECK(table.empty() == view.empty());
}

// A view of the table, and one of copies that is used when the table is gone.
template <class S>
void check_views(auto make, std::size_t arrays, const std::vector<typename S::Point>& points) {
    std::optional<S> table{make()};
    using View = std::remove_const_t<decltype(table->view())>;
    STATIC_REQUIRE(lumis::Strategy<View>);
    STATIC_REQUIRE(lumis::InvertibleStrategy<View> == lumis::InvertibleStrategy<S>);
    STATIC_REQUIRE(std::is_trivially_copyable_v<View>);
    check_same(*table, table->view(), points);
    Copies copies;
    const View copied = table->view(copies);
    CHECK(copies.size() == arrays);
    table.reset();
    check_same(make(), copied, points);
}

}  // namespace

TEMPLATE_TEST_CASE("views draw and evaluate as their tables do", "[views]", float, double) {
    using T = TestType;
    for (const std::size_t size : {std::size_t{1}, std::size_t{5}, std::size_t{1000}, std::size_t{70'000}}) {
        const auto weights = random_weights<T>(size, 6);
        check_views<lumis::AliasTable<T>>([&] { return lumis::AliasTable<T>{weights}; }, 1, {size - 1, size, ~size});
        check_views<lumis::PiecewiseConstant1D<T>>([&] { return lumis::PiecewiseConstant1D<T>{weights}; }, 2,
                                                   {T(-1), T(0), T(1), T(2)});
    }
    const auto weights = random_weights<T>(37 * 20, 6);
    check_views<lumis::PiecewiseConstant2D<T>>(
        [&] {
            return lumis::PiecewiseConstant2D<T>{37, 20, weights};
        },
        5, {{T(-1), T(0)}, {T(0), T(0)}, {T(1), T(1)}});
    const std::vector<T> nothing(6);
    check_views<lumis::AliasTable<T>>([&] { return lumis::AliasTable<T>{nothing}; }, 1, {0, 7});
    check_views<lumis::PiecewiseConstant2D<T>>(
        [&] {
            return lumis::PiecewiseConstant2D<T>{3, 2, nothing};
        },
        5, {{T(0), T(0)}});
}

TEST_CASE("a view of a fine alias table draws as that does", "[views]") {
    const auto weights = random_weights<float>(1000, 12);
    check_views<lumis::FineAliasTable>([&] { return lumis::FineAliasTable{weights}; }, 1, {0, 999, 1000});
}

TEST_CASE("a copy of a table is another table", "[views]") {
    std::optional<lumis::AliasTable<float>> table{std::vector<float>{1, 2, 5}};
    const lumis::AliasTable copy{*table};
    const auto view = copy.view();
    table.reset();
    CHECK(view.pdf(2) == 0.625f);
    CHECK(copy.pdf(2) == 0.625f);
}

TEST_CASE("weights of another type make the table that they make in its own type", "[views]") {
    const std::vector<double> doubles{1, 2, 0, 5};
    const std::vector<float> floats{1, 2, 0, 5};
    const std::vector<int> integers{1, 2, 0, 5};
    const auto check = [](const auto& a, const auto& b, auto x) {
        CHECK(a.pdf(x) == b.pdf(x));
        CHECK(a.pdf(x) > 0);
    };
    check(lumis::AliasTable<float>{doubles}, lumis::AliasTable{floats}, std::size_t{3});
    check(lumis::AliasTable<float>{integers}, lumis::AliasTable{floats}, std::size_t{3});
    check(lumis::AliasTable<double>{floats}, lumis::AliasTable{doubles}, std::size_t{3});
    check(lumis::FineAliasTable{doubles}, lumis::FineAliasTable{floats}, std::size_t{3});
    check(lumis::PiecewiseConstant1D<float>{doubles}, lumis::PiecewiseConstant1D{floats}, 0.9f);
    check(lumis::PiecewiseConstant2D<float>{2, 2, doubles}, lumis::PiecewiseConstant2D{2, 2, floats},
          glm::vec2{0.9f, 0.9f});
    // Beyond what a float holds: only their shares count.
    const lumis::AliasTable<float> huge{std::vector<double>{1e300, 3e300}};
    CHECK(huge.pdf(0) == 0.25f);
    CHECK_THROWS_WITH(lumis::AliasTable<float>(std::vector<double>{1, -2}),
                      Catch::Matchers::Contains("weight 1 is -2"));
    CHECK_THROWS_WITH(lumis::AliasTable<float>(std::vector<int>{1, -2}), Catch::Matchers::Contains("weight 1 is -2"));
}
