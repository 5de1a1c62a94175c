// Grids of counts: rows and cells by their weights, whatever their magnitude.
#include "catch.hpp"
#include <lumis/tables/detail/alias_rows.hpp>
#include <lumis/tables/detail/count_grid.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

template <class T, template <class, template <class> class> class Rows = lumis::detail::GuidedRows>
lumis::detail::CountGrid<T, Rows> grid_of(std::size_t width, const std::vector<double>& weights,
                                          const std::vector<double>& scales = {}) {
    lumis::detail::CountGrid<T, Rows> grid{width, weights.size() / width, weights.size()};
    grid.deal(
        [&](std::size_t y, std::span<double> row) {
            for (std::size_t x = 0; x < width; ++x) row[x] = weights[y * width + x];
        },
        [&](std::size_t y) { return scales.empty() ? 1.0 : scales[y]; }, lumis::detail::InOrder{});
    return grid;
}

}  // namespace

TEMPLATE_TEST_CASE("a grid's rows and cells own every count and none without a weight", "[count_grid]", float, double) {
    using T = TestType;
    const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
    const std::vector<std::vector<double>> tables{{1, 2, 3, 4, 5, 6},
                                                  {0, 0, 0, 1, 0, 0},
                                                  {huge, huge, huge, tiny, tiny, tiny},
                                                  {tiny, 0, 0, 0, 0, tiny},
                                                  {0, 0, 0, 0, 0, 0, 1, 1e-8, 1}};
    const auto check = [](const auto& grid, const std::vector<double>& weights) {
        std::uint64_t rows = 0;
        for (std::size_t y = 0; y < grid.height(); ++y) {
            double row_weight = 0;
            std::uint64_t cells = 0;
            for (std::size_t x = 0; x < 3; ++x) {
                const double weight = weights[3 * y + x];
                row_weight = row_weight > weight ? row_weight : weight;
                cells += grid.cell_counts(x, y);
                CHECK((grid.cell_counts(x, y) > 0) == (weight > 0 || (row_weight == 0 && x == 2)));
            }
            rows += grid.row_counts(y);
            CHECK((grid.row_counts(y) > 0) == (row_weight > 0));
            CHECK(cells == lumis::detail::total_counts<T>);
        }
        CHECK(rows == lumis::detail::total_counts<T>);
        CHECK_FALSE(grid.empty());
    };
    for (const auto& weights : tables) {
        check(grid_of<T>(3, weights), weights);
        check(grid_of<T, lumis::detail::AliasRows>(3, weights), weights);
    }
}

TEMPLATE_TEST_CASE("a grid's rows are scaled as told", "[count_grid]", float, double) {
    using T = TestType;
    const auto grid = grid_of<T>(2, {1, 3, 2, 2, 4, 0}, {1, 2, 0.25});
    const double all = lumis::detail::total_counts<T>;  // rows weigh 4, 8 and 1
    CHECK(std::abs(grid.row_counts(0) / all - 4.0 / 13) <= 3 / all);
    CHECK(std::abs(grid.row_counts(1) / all - 8.0 / 13) <= 3 / all);
    CHECK(std::abs(grid.row_counts(2) / all - 1.0 / 13) <= 3 / all);
    CHECK(std::abs(grid.cell_counts(0, 0) / all - 0.25) <= 2 / all);
    CHECK(grid.cell_counts(0, 1) == grid.cell_counts(1, 1));
    CHECK(grid.cell_counts(1, 2) == 0);
}

TEMPLATE_TEST_CASE("a grid finds the cell of a point and the uniforms of a cell", "[count_grid]", float, double) {
    using T = TestType;
    const auto grid = grid_of<T>(4, {1, 2, 0, 4, 5, 6, 7, 8, 0, 0, 0, 1});
    const auto at = [&](double x, double y) { return grid.locate({static_cast<T>(x), static_cast<T>(y)}); };
    CHECK((at(0, 0).column == 0 && at(0, 0).row == 0));
    CHECK((at(1, 1).column == 3 && at(1, 1).row == 2));
    CHECK((at(0.6, 0.5).column == 2 && at(0.6, 0.5).row == 1));
    CHECK(std::abs(double{at(0.6, 0.5).position.x} - 0.4) <= 1e-6);
    CHECK(std::abs(double{at(0.6, 0.5).position.y} - 0.5) <= 1e-6);
    for (const T u : {T(0), T(0.1), T(0.5), T(0.9), 1 - std::numeric_limits<T>::epsilon() / 2, T(1)}) {
        for (const T v : {T(0), T(0.1), T(0.5), T(0.9), 1 - std::numeric_limits<T>::epsilon() / 2, T(1)}) {
            const auto drawn = grid.draw({u, v});
            CHECK(grid.cell_counts(drawn.column, drawn.row) > 0);
            CHECK((drawn.position.x > 0 && drawn.position.x < 1 && drawn.position.y > 0 && drawn.position.y < 1));
            const auto back = grid.invert({drawn.column, drawn.row, drawn.position});
            CHECK(std::abs(double{back.x} - double{u}) <= 64 * double{std::numeric_limits<T>::epsilon()} + 1e-9);
            CHECK(std::abs(double{back.y} - double{v}) <= 64 * double{std::numeric_limits<T>::epsilon()} + 1e-9);
        }
    }
}

TEST_CASE("sizes that a grid refuses are named", "[count_grid]") {
    using Catch::Matchers::Contains;
    const auto refusal = [](auto width, auto height, std::size_t values) {
        try {
            const lumis::detail::CountGrid<float> grid{width, height, values};
        } catch (const std::invalid_argument& error) {
            return std::string{error.what()};
        }
        return std::string{"accepted"};
    };
    CHECK(refusal(3, 2u, 6) == "accepted");
    CHECK_THAT(refusal(0, 2, 0), Contains("width is 0"));
    CHECK_THAT(refusal(2, -1, 0), Contains("height is -1"));
    CHECK_THAT(refusal(std::size_t{1} << 62, 4, 0), Contains("width is 4611686018427387904"));
    CHECK_THAT(refusal((1 << 24) + 1, 1, 5), Contains("width is 16777217"));
    // Nothing is allocated for a size that the values do not have.
    CHECK_THAT(refusal(1 << 24, 1 << 24, 5), Contains("16777216 x 16777216") && Contains("5 values"));
    CHECK(grid_of<float>(2, {0, 0, 0, 0}).empty());
}
