// Tables made of any sizes and any weights: either std::invalid_argument that says what is wrong, or a table whose samples,
// densities and total mass are right. There are as many weights as the input has room for.
#include "check.hpp"
#include <lumis/lumis.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using fuzz::Input;
using fuzz::is_density;

template <class T>
bool is_weight(T w) {
    return w >= 0 && w <= std::numeric_limits<T>::max();
}

// make() if the table can be made of these weights; what it throws must say which of them, or which size, is wrong.
template <class T, class Make>
auto try_make(const std::vector<T>& weights, bool size_is_right, Make make) -> std::optional<decltype(make())> {
    const auto wrong = std::ranges::find_if_not(weights, is_weight<T>);
    const bool is_right = size_is_right && wrong == weights.end();
    try {
        std::optional<decltype(make())> table{make()};
        CHECK(is_right);
        return table;
    } catch (const std::invalid_argument& error) {
        CHECK(!is_right);
        const std::string message = error.what();
        CHECK(message.starts_with("lumis: "));
        if (size_is_right) {
            const std::string index = std::to_string(wrong - weights.begin());
            CHECK(message.find("weight " + index + " is " + std::to_string(*wrong)) != std::string::npos);
        }
        return std::nullopt;
    }
}

bool is_near_one(double mass, double tolerance) {
    return std::abs(mass - 1) <= tolerance;
}

// weight(x): 0 if nothing may be drawn at x.
template <class Table, class Weight>
void check_samples(Input& input, const Table& table, Weight weight) {
    using T = typename Table::Scalar;
    const auto check = [&](const lumis::UniformsOf<Table>& u) {
        const auto sample = table.sample(u);
        if constexpr (requires { sample.value.length(); }) {
            for (int i = 0; i < sample.value.length(); ++i) CHECK(std::isfinite(sample.value[i]));
        } else {
            CHECK(std::isfinite(static_cast<T>(sample.value)));
        }
        CHECK(is_density(sample.pdf));
        CHECK(table.pdf(sample.value) == sample.pdf || table.empty());
        CHECK((sample.pdf > 0) == !table.empty());
        if (sample.pdf > 0) CHECK(weight(sample.value) > 0);
    };
    check(lumis::UniformsOf<Table>(T(0)));
    check(lumis::UniformsOf<Table>(T(1)));
    for (int i = 0; i < 4; ++i) check(input.uniforms<lumis::UniformsOf<Table>>());
}

template <class Table, class T>
void fuzz_index_table(Input& input, const std::vector<T>& weights) {
    const auto table = try_make(weights, !weights.empty(), [&] { return Table{weights}; });
    if (!table) return;
    check_samples(input, *table, [&](std::size_t i) { return weights.at(i); });
    double mass = 0;
    for (std::size_t i = 0; i < table->size(); ++i) {
        CHECK((table->pdf(i) > 0) == (weights[i] > 0));
        mass += double{table->pdf(i)};
    }
    CHECK(table->empty() ? mass == 0 : mass == 1);
    CHECK(table->pdf(table->size()) == 0 && table->pdf(~std::size_t{0}) == 0);
    if constexpr (requires { table->invert(0, T(0)); }) {
        const auto any = input.bits<std::size_t>();
        CHECK(std::isfinite(table->invert(any, T(0.5)).x) &&
              std::isfinite(table->invert(any % weights.size(), T(0.5)).x));
        const auto u = input.uniforms<glm::vec<1, T>>();
        const auto drawn = table->sample_remapped(u);
        CHECK(drawn.value == table->sample(u).value && drawn.rest > 0 && drawn.rest < 1);
        CHECK(std::abs(table->invert(drawn.value, drawn.rest).x - u.x) <= 2 * std::numeric_limits<T>::epsilon());
    }
}

template <class T>
void fuzz_1d(Input& input, const std::vector<T>& weights) {
    const auto table = try_make(weights, !weights.empty(), [&] { return lumis::PiecewiseConstant1D{weights}; });
    if (!table) return;
    const auto weight = [&](T x) { return weights[lumis::detail::index_of(x, weights.size())]; };
    check_samples(input, *table, weight);
    const double n = static_cast<double>(table->size());
    double mass = 0;
    for (std::size_t i = 0; i < table->size(); ++i) {
        mass += double{table->pdf(static_cast<T>((static_cast<double>(i) + 0.5) / n))} / n;
    }
    CHECK(table->empty() ? mass == 0 : is_near_one(mass, 1e-6));
    const T any = input.number<T>();
    CHECK(is_density(table->pdf(any)));
    (void)table->invert(any);
}

template <class T>
void fuzz_2d(Input& input, int width, int height, const std::vector<T>& weights) {
    const bool size_is_right =
        width > 0 && height > 0 && std::int64_t{width} * height == static_cast<std::int64_t>(weights.size());
    const auto table = try_make(weights, size_is_right, [&] {
        return lumis::PiecewiseConstant2D{width, height, weights};
    });
    if (!table) return;
    const std::size_t w = table->width(), h = table->height();
    check_samples(input, *table, [&](const glm::vec<2, T>& x) {
        return weights[lumis::detail::index_of(x.y, h) * w + lumis::detail::index_of(x.x, w)];
    });
    double mass = 0;
    for (std::size_t i = 0; i < w * h; ++i) {
        const glm::dvec2 x{(static_cast<double>(i % w) + 0.5) / width, (static_cast<double>(i / w) + 0.5) / height};
        mass += double{table->pdf(glm::vec<2, T>(x))} / width / height;
    }
    CHECK(table->empty() ? mass == 0 : is_near_one(mass, 1e-5));
    const auto any = input.numbers<glm::vec<2, T>>();
    CHECK(is_density(table->pdf(any)));
    (void)table->invert(any);
}

template <class T>
void fuzz_environment_map(Input& input, int width, int height, const std::vector<T>& weights, unsigned flags) {
    const lumis::EnvironmentOptions options{flags & 1 ? lumis::Interpolation::Bilinear : lumis::Interpolation::Nearest,
                                            (flags & 2) != 0};
    const bool size_is_right =
        width > 0 && height > 0 && std::int64_t{width} * height == static_cast<std::int64_t>(weights.size());
    const auto map = try_make(weights, size_is_right, [&] {
        return lumis::EnvironmentMap{width, height, weights, options};
    });
    if (!map) return;
    CHECK(map->empty() == std::ranges::all_of(weights, [](T w) { return w == 0; }));
    // The largest luminance that the interpolation may reach from a texel.
    const auto weight = [&](const glm::vec<3, T>& direction) {
        const auto uv = lumis::latlong_from_direction(direction);
        const auto w = static_cast<int>(map->width()), h = static_cast<int>(map->height());
        const auto column = static_cast<int>(lumis::detail::index_of(uv.x, map->width()));
        const auto row = static_cast<int>(lumis::detail::index_of(uv.y, map->height()));
        const int reach = options.interpolation == lumis::Interpolation::Bilinear ? 1 : 0;
        T largest = 0;
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                const int x = (column + dx + w) % w, y = std::clamp(row + dy, 0, h - 1);
                largest = std::max(largest, weights[static_cast<std::size_t>(y * w + x)]);
            }
        }
        return largest;
    };
    check_samples(input, *map, weight);
    double mass = 0;
    for (int row = 0; row < height; ++row) {
        const double top = std::numbers::pi * row / height, bottom = std::numbers::pi * (row + 1) / height;
        const double theta = (top + bottom) / 2;
        const double solid_angle = 2 * std::numbers::pi / width * 2 * std::sin(theta) * std::sin((bottom - top) / 2);
        for (int column = 0; column < width; ++column) {
            const double phi = 2 * std::numbers::pi * ((column + 0.5) / width - 0.5);
            const glm::dvec3 w{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
            mass += double{map->pdf(glm::vec<3, T>(w))} * solid_angle;
        }
    }
    CHECK(map->empty() ? mass == 0 : is_near_one(mass, 1e-5));
    const auto any = input.numbers<glm::vec<3, T>>();
    CHECK(is_density(map->pdf(any)));
    (void)map->invert(any);
}

template <class T>
void fuzz_tables(Input& input, unsigned kind) {
    // Sizes that do not match, or those of a grid with a row of any length.
    const auto claimed = input.bits<std::int32_t>();
    const auto width_of_grid = input.bits<std::uint8_t>();
    const auto flags = input.bits<std::uint8_t>();
    Input uniforms = input;  // the same bytes make the weights and the points to look at
    std::vector<T> weights;
    const bool raw = (kind & 1) != 0;
    while (input.left() > 0) weights.push_back(raw ? input.bits<T>() : std::abs(input.number<T>()));
    int width = claimed, height = static_cast<int>(weights.size());
    if (flags & 4) {
        width = std::max(1, int{width_of_grid});
        height = static_cast<int>(weights.size()) / width;
        if (height > 0) weights.resize(static_cast<std::size_t>(width * height));
    }
    switch (kind / 4 % 4) {
        case 0:
            if (kind & 16) return fuzz_index_table<lumis::DiscreteTable<T>>(uniforms, weights);
            return fuzz_index_table<lumis::AliasTable<T>>(uniforms, weights);
        case 1:
            return fuzz_1d(uniforms, weights);
        case 2:
            return fuzz_2d(uniforms, width, height, weights);
        default:
            return fuzz_environment_map(uniforms, width, height, weights, flags);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input input{data, size};
    const auto kind = input.bits<std::uint8_t>();
    if (kind & 2) {
        fuzz_tables<float>(input, kind);
    } else {
        fuzz_tables<double>(input, kind);
    }
    return 0;
}
