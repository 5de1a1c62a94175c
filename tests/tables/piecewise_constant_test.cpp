// Piecewise constant densities: cells are drawn exactly as often as their density says, and evenly within.
#include "catch.hpp"
#include "table_weights.hpp"
#include <lumis/tables/piecewise_constant.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// The cell that holds x, told without the library.
std::size_t cell_of(double x, std::size_t n) {
    return std::min(static_cast<std::size_t>(x * static_cast<double>(n)), n - 1);
}

template <class Make>
std::string refusal(Make make) {
    try {
        make();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

template <class T>
glm::vec<1, T> one(T u) {
    return glm::vec<1, T>{u};
}

}  // namespace

TEST_CASE("float: a piecewise constant density is the frequency drawn by all 2^24 uniforms", "[piecewise_constant]") {
    for (const auto& weights : weight_classes<float>()) {
        const lumis::PiecewiseConstant1D density{weights};
        const std::size_t n = weights.size();
        if (n < 3) continue;
        std::vector<std::uint32_t> drawn(n);
        bool same = true;
        for (std::uint32_t k = 0; k < 1u << 24; ++k) {
            const auto sample = density.sample(one(static_cast<float>(k) * 0x1p-24f));
            ++drawn.at(cell_of(sample.value, n));
            same = same && sample.pdf == density.pdf(sample.value);
        }
        CHECK(same);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const float centre = (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
            const float frequency = static_cast<float>(drawn[i]) * 0x1p-24f;
            wrong += !(density.pdf(centre) == frequency * static_cast<float>(n));
            wrong += (drawn[i] > 0) != (weights[i] > 0);
        }
        INFO(n << " weights");
        CHECK(wrong == 0);
    }
}

TEMPLATE_TEST_CASE("a piecewise constant density integrates to 1 and follows the weights", "[piecewise_constant]",
                   float, double) {
    using T = TestType;
    for (const auto& weights : weight_classes<T>()) {
        const lumis::PiecewiseConstant1D density{weights};
        const std::size_t n = weights.size();
        long double total = 0, sum = 0;
        double worst = 0;
        for (const T weight : weights) total += weight;
        for (std::size_t i = 0; i < n; ++i) {
            const T pdf = density.pdf((static_cast<T>(i) + T(0.5)) / static_cast<T>(n));
            sum += static_cast<long double>(pdf) / static_cast<long double>(n);
            worst = std::fmax(worst,
                              std::abs(double{pdf} / static_cast<double>(n) - static_cast<double>(weights[i] / total)));
        }
        INFO(n << " weights");
        CHECK(std::abs(static_cast<double>(sum) - 1) <= 2 * double{std::numeric_limits<T>::epsilon()});
        CHECK(worst <= static_cast<double>(2 + n) / double{lumis::detail::total_counts<T>});
        // Total: 0 outside, and for what is no number.
        for (const T x : {T(-0.25), T(1.25), std::numeric_limits<T>::infinity(), std::numeric_limits<T>::quiet_NaN()}) {
            CHECK(density.pdf(x) == 0);
        }
        for (const T u : {T(0), 1 - std::numeric_limits<T>::epsilon() / 2, T(1)}) {
            const auto sample = density.sample(one(u));
            CHECK((sample.value >= 0 && sample.value <= 1));
            CHECK(sample.pdf > 0);
            CHECK(weights[cell_of(double{sample.value}, n)] > 0);
        }
    }
}

TEMPLATE_TEST_CASE("a piecewise constant sample leads back to its uniform", "[piecewise_constant]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    std::mt19937_64 engine{1};
    std::uniform_real_distribution<double> uniform{0, 1};
    for (const auto& weights : weight_classes<T>()) {
        const lumis::PiecewiseConstant1D density{weights};
        double worst = 0;
        for (int i = 0; i < 2000; ++i) {
            const T u = static_cast<T>(uniform(engine));
            const auto sample = density.sample(one(u));
            const double error = std::abs(double{density.invert(sample.value).x} - double{u});
            // By what the rounding of x, and its distance from the cell's edges, can move it; and half a count.
            const double blur = 16 * epsilon * (double{sample.pdf} + 1) + 1 / double{lumis::detail::total_counts<T>};
            worst = std::fmax(worst, error / blur);
            if (!(error >= 0)) worst = 1e9;
        }
        INFO(weights.size() << " weights");
        CHECK(worst <= 1);
    }
    // In a cell points are even: four cells of one weight are the identity, to half a lattice point.
    const lumis::PiecewiseConstant1D even{std::vector<T>(4, T(2))};
    for (const double u : {0.1, 0.37, 0.55, 0.8}) {
        CHECK(std::abs(double{even.sample(one(static_cast<T>(u))).value} - u) <= 1e-7);
    }
}

TEST_CASE("float: a grid's cells are drawn as often as their density says", "[piecewise_constant]") {
    constexpr std::size_t width = 37, height = 13;
    auto weights = random_weights<float>(width * height, 8);
    for (std::size_t i = 0; i < weights.size(); i += 5) weights[i] = 0;
    for (std::size_t x = 0; x < width; ++x) weights[4 * width + x] = 0;  // a black row
    const lumis::PiecewiseConstant2D grid{width, height, weights};
    std::vector<std::uint32_t> rows(height), columns(width);
    std::vector<float> row_uniform(height, -1.0f);
    for (std::uint32_t k = 0; k < 1u << 24; ++k) {
        const float u = static_cast<float>(k) * 0x1p-24f;
        const std::size_t row = cell_of(grid.sample({0.5f, u}).value.y, height);
        ++rows[row];
        row_uniform[row] = u;
    }
    CHECK(rows[4] == 0);
    bool same = true, stays = true;
    for (const std::size_t row : {std::size_t{7}, height - 1}) {
        REQUIRE(row_uniform[row] >= 0);
        std::fill(columns.begin(), columns.end(), 0u);
        for (std::uint32_t k = 0; k < 1u << 24; ++k) {
            const auto sample = grid.sample({static_cast<float>(k) * 0x1p-24f, row_uniform[row]});
            ++columns[cell_of(sample.value.x, width)];
            stays = stays && cell_of(sample.value.y, height) == row;
            same = same && sample.pdf == grid.pdf(sample.value);
        }
        double worst = 0;
        for (std::size_t x = 0; x < width; ++x) {
            CHECK((columns[x] > 0) == (weights[row * width + x] > 0));
            const double drawn = rows[row] * 0x1p-24 * (columns[x] * 0x1p-24) * (width * height);
            const double told = grid.pdf(
                {(static_cast<float>(x) + 0.5f) / float{width}, (static_cast<float>(row) + 0.5f) / float{height}});
            if (drawn > 0) worst = std::fmax(worst, std::abs(told / drawn - 1));
        }
        CHECK(worst <= 4e-7);
    }
    CHECK(same);
    CHECK(stays);
}

TEMPLATE_TEST_CASE("a piecewise constant grid in all its parts", "[piecewise_constant]", float, double) {
    using T = TestType;
    struct Size {
        std::size_t width, height;
    };
    for (const auto& [width, height] : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{64, 32}}) {
        const auto weights = random_weights<T>(width * height, 3);
        const lumis::PiecewiseConstant2D grid{width, height, weights};
        CHECK((grid.width() == width && grid.height() == height && !grid.empty()));
        long double total = 0;
        for (const T weight : weights) total += weight;
        double sum = 0, worst = 0;
        for (std::size_t y = 0; y < height; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                const double pdf = grid.pdf({(static_cast<T>(x) + T(0.5)) / static_cast<T>(width),
                                             (static_cast<T>(y) + T(0.5)) / static_cast<T>(height)});
                const double cells = static_cast<double>(width * height);
                sum += pdf / cells;
                const double share = static_cast<double>(weights[y * width + x] / total);
                worst = std::fmax(worst, std::abs(pdf / cells / share - 1));
            }
        }
        INFO(width << " x " << height);
        CHECK(std::abs(sum - 1) <= 1e-6);
        CHECK(worst <= 0.02);  // the lightest cell has a few hundred counts of its row's
        std::mt19937_64 engine{2};
        std::uniform_real_distribution<double> uniform{0, 1};
        double worst_return = 0;
        for (int i = 0; i < 1000; ++i) {
            const glm::vec<2, T> u{static_cast<T>(uniform(engine)), static_cast<T>(uniform(engine))};
            const auto sample = grid.sample(u);
            CHECK(sample.pdf == grid.pdf(sample.value));
            const auto back = grid.invert(sample.value);
            worst_return = std::max({worst_return, std::abs(double{back.x} - double{u.x}) / (1 + double{sample.pdf}),
                                     std::abs(double{back.y} - double{u.y}) / (1 + double{sample.pdf})});
        }
        CHECK(worst_return <=
              32 * double{std::numeric_limits<T>::epsilon()} + 1 / double{lumis::detail::total_counts<T>});
        for (const T x : {T(-0.5), T(1.5), std::numeric_limits<T>::quiet_NaN()}) {
            CHECK(grid.pdf({x, T(0.5)}) == 0);
            CHECK(grid.pdf({T(0.5), x}) == 0);
        }
    }
}

TEMPLATE_TEST_CASE("piecewise constant weights that are all zero or refused", "[piecewise_constant]", float, double) {
    using T = TestType;
    using Catch::Matchers::Contains;
    const T inf = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    const lumis::PiecewiseConstant1D line{std::vector<T>(3)};
    const lumis::PiecewiseConstant2D grid{3, 2, std::vector<T>(6)};
    CHECK((line.empty() && grid.empty()));
    for (const T u : {T(0), T(0.5), T(1)}) {
        CHECK((line.sample(one(u)).pdf == 0 && line.pdf(u) == 0));
        CHECK((grid.sample({u, u}).pdf == 0 && grid.pdf({u, u}) == 0));
    }
    const auto refused = [](const std::vector<T>& weights) {
        const auto by_line = refusal([&] { lumis::PiecewiseConstant1D<T>{weights}; });
        return by_line + " / " + refusal([&] { lumis::PiecewiseConstant2D<T>{weights.size(), 1, weights}; });
    };
    CHECK_THAT(refused({T(1), T(2), T(-0.5)}), Contains("weight 2 is -0.5") && !Contains("accepted"));
    CHECK_THAT(refused({nan, T(2)}), Contains("weight 0 is") && Contains("nan") && !Contains("accepted"));
    CHECK_THAT(refused({T(1), inf}), Contains("weight 1 is inf") && !Contains("accepted"));
    CHECK_THAT(refused({}), Contains("0") && !Contains("accepted"));
    const std::vector<T> six(6, T(1));
    CHECK_THAT(refusal([&] { lumis::PiecewiseConstant2D<T>{2, 2, six}; }), Contains("2 x 2") && Contains("6"));
    CHECK_THAT(refusal([&] { lumis::PiecewiseConstant2D<T>{-2, -3, six}; }), Contains("width") && Contains("-2"));
    CHECK_THAT(refusal([&] { lumis::PiecewiseConstant2D<T>{6, 0, six}; }), Contains("height") && Contains("0"));
}

TEMPLATE_TEST_CASE("a piecewise constant density of 1e7 cells", "[piecewise_constant]", float, double) {
    using T = TestType;
    constexpr std::size_t size = 10'000'000;
    auto weights = random_weights<T>(size, 10);
    for (std::size_t i = 0; i < size; i += 2) weights[i] = T(0);
    const lumis::PiecewiseConstant1D density{weights};
    std::mt19937_64 engine{3};
    std::size_t dark = 0, disagreeing = 0, ill = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const T u = static_cast<T>(engine() >> 40) * T(0x1p-24);
        const auto sample = density.sample(one(u));
        ill += !(sample.value >= 0 && sample.value <= 1 && sample.pdf > 0);
        // In float a cell is little wider than the spacing of the numbers near 1.
        if constexpr (std::is_same_v<T, double>) {
            dark += !(weights[cell_of(sample.value, size)] > 0);
            disagreeing += !(density.pdf(sample.value) == sample.pdf);
        }
    }
    CHECK(ill == 0);
    CHECK(dark == 0);
    CHECK(disagreeing == 0);
}
