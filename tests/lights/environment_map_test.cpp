// Environment maps: the density is the frequency really drawn; which texel is where; maps that are refused or black.
#include "catch.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace laws = lumis::testing;
constexpr double pi = std::numbers::pi;

using Texel = std::pair<std::size_t, std::size_t>;  // column, row

// The texel that a direction points at, told without the library.
template <class T>
Texel texel_of(const glm::vec<3, T>& w, std::size_t width, std::size_t height) {
    const double u = 0.5 + std::atan2(double{w.z}, double{w.x}) / (2 * pi);
    const double v = std::atan2(std::hypot(double{w.x}, double{w.z}), double{w.y}) / pi;
    return {std::min(static_cast<std::size_t>(u * static_cast<double>(width)), width - 1),
            std::min(static_cast<std::size_t>(v * static_cast<double>(height)), height - 1)};
}

double solid_angle(std::size_t row, std::size_t width, std::size_t height) {
    const double edge = pi / static_cast<double>(height);
    const double top = edge * static_cast<double>(row), middle = top + edge / 2;
    return 2 * pi / static_cast<double>(width) * 2 * std::sin(middle) * std::sin(edge / 2);
}

// The direction of the centre of a texel.
glm::dvec3 centre(std::size_t column, std::size_t row, std::size_t width, std::size_t height) {
    const double phi = 2 * pi * ((static_cast<double>(column) + 0.5) / static_cast<double>(width) - 0.5);
    const double theta = pi * (static_cast<double>(row) + 0.5) / static_cast<double>(height);
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

template <class T>
auto random_texels(std::size_t size, double decades) {
    std::mt19937_64 engine{7};
    std::uniform_real_distribution<double> exponent{-decades, 0};
    std::vector<T> texels(size);
    for (auto& texel : texels) texel = static_cast<T>(std::pow(10, exponent(engine)));
    return texels;
}

template <class T>
void expect_refusal(int width, int height, const std::vector<T>& texels, const std::vector<std::string>& parts) {
    try {
        const lumis::EnvironmentMap map{width, height, texels};
        FAIL("accepted");
    } catch (const std::invalid_argument& error) {
        for (const auto& part : parts) CHECK_THAT(error.what(), Catch::Matchers::Contains(part));
    }
}

}  // namespace

// Every number that a float source can yield, for one row and then for the rows.
TEST_CASE("float: a texel's mass is the frequency with which it is drawn", "[environment_map]") {
    constexpr std::size_t width = 1024, height = 512;
    constexpr std::uint32_t lattice = 1u << 24;
    const auto uniform = [](std::uint32_t k) { return static_cast<float>(k) * 0x1p-24f; };

    // Weights over eight decades, and black texels; in the worst row one texel outshines all others.
    auto texels = random_texels<float>(width * height, 8);
    for (std::size_t i = 0; i < texels.size(); i += 7) texels[i] = 0;
    constexpr std::size_t worst_row = 300;
    texels[worst_row * width + 511] = 1e4f;
    const lumis::EnvironmentMap map{width, height, texels};

    std::vector<std::uint32_t> rows(height);
    float in_worst_row = -1;
    for (std::uint32_t k = 0; k < lattice; ++k) {
        const auto row = texel_of(map.sample({0.5f, uniform(k)}).value, width, height).second;
        ++rows[row];
        if (row == worst_row) in_worst_row = uniform(k);
    }
    REQUIRE(in_worst_row >= 0);

    std::vector<std::uint32_t> columns(width);
    bool stays_in_row = true;
    for (std::uint32_t k = 0; k < lattice; ++k) {
        const auto [column, row] = texel_of(map.sample({uniform(k), in_worst_row}).value, width, height);
        ++columns[column];
        stays_in_row = stays_in_row && row == worst_row;
    }
    CHECK(stays_in_row);

    const double row_probability = rows[worst_row] / double{lattice};
    double worst_error = 0;
    std::size_t never_drawn = 0, wrongly_drawn = 0;
    for (std::size_t x = 0; x < width; ++x) {
        const bool black = texels[worst_row * width + x] == 0;
        never_drawn += !black && columns[x] == 0;
        wrongly_drawn += black && columns[x] != 0;
        const double pdf = map.pdf(glm::vec3(centre(x, worst_row, width, height)));
        const double reported = pdf * solid_angle(worst_row, width, height) / row_probability * double{lattice};
        const double drawn = columns[x];
        worst_error = std::fmax(worst_error, std::abs(reported - drawn) / std::fmax(drawn, 1));
    }
    CHECK(never_drawn == 0);
    CHECK(wrongly_drawn == 0);
    // Counts are whole: what is left is the rounding of a density to float.
    CHECK(worst_error <= 2 * double{std::numeric_limits<float>::epsilon()});
    for (std::size_t y = 0; y < height; ++y) CHECK(rows[y] > 0);
}

TEMPLATE_TEST_CASE("the masses of all texels sum to 1, and follow the luminance", "[environment_map]", float, double) {
    using T = TestType;
    constexpr std::size_t width = 64, height = 32;
    const auto texels = random_texels<T>(width * height, 2);
    const lumis::EnvironmentMap map{width, height, texels};
    double light = 0, mass = 0, worst = 0;
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) light += double{texels[y * width + x]} * solid_angle(y, width, height);
    }
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const double pdf = map.pdf(glm::vec<3, T>(centre(x, y, width, height)));
            mass += pdf * solid_angle(y, width, height);
            worst = std::fmax(worst, std::abs(pdf * light / double{texels[y * width + x]} - 1));
        }
    }
    CHECK(mass == Approx(1).epsilon(1e-6));
    // A texel has at least 2^24 / (64 100) counts of its row's, of which one is the rounding.
    CHECK(worst <= 2e-3);
}

TEMPLATE_TEST_CASE("a hot texel is found where it is", "[environment_map]", float, double) {
    using T = TestType;
    constexpr std::size_t width = 16, height = 8;
    const Texel hot_texels[] = {{0, 0}, {15, 0}, {3, 2}, {8, 4}, {12, 5}, {0, 7}, {9, 7}};
    for (const auto& [column, row] : hot_texels) {
        std::vector<T> texels(width * height);
        texels[row * width + column] = T(1e6);
        const lumis::EnvironmentMap map{width, height, texels};
        lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{1}};
        glm::dvec3 mean{0};
        bool inside = true;
        for (int i = 0; i < 2000; ++i) {
            const auto sample = map.sample(uniforms.template next<2>());
            inside = inside && texel_of(sample.value, width, height) == Texel{column, row};
            mean += glm::dvec3{sample.value} / 2000.0;
        }
        INFO("column " << column << ", row " << row);
        CHECK(inside);
        // Evenly by solid angle: the mean height is half-way between the row's edges. Half a texel is 0.2 rad.
        const glm::dvec3 middle = centre(column, row, width, height);
        CHECK(mean.y == Approx(middle.y * std::cos(pi / 2 / height)).margin(0.01));
        CHECK(std::abs(std::remainder(std::atan2(mean.z, mean.x) - std::atan2(middle.z, middle.x), 2 * pi)) <= 0.02);
        for (std::size_t y = 0; y < height; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                const double pdf = map.pdf(glm::vec<3, T>(centre(x, y, width, height)));
                const bool hot = x == column && y == row;
                CHECK(pdf == Approx(hot ? 1 / solid_angle(y, width, height) : 0.0));
            }
        }
    }
}

// The convention in words: row 0 is up, the middle column looks along +x, a quarter further on lies +z.
TEMPLATE_TEST_CASE("the axes of the world on the map", "[environment_map]", float, double) {
    using T = TestType;
    constexpr std::size_t width = 8, height = 4;
    const auto brightest = [&](std::size_t column, std::size_t row) {
        std::vector<T> texels(width * height);
        texels[row * width + column] = T(1);
        return lumis::EnvironmentMap{width, height, texels};
    };
    const T t = T(0.1);  // a little aside, off the texels' corners
    CHECK(brightest(4, 1).pdf(glm::normalize(glm::vec<3, T>{T(1), t, t})) > 0);
    CHECK(brightest(6, 2).pdf(glm::normalize(glm::vec<3, T>{-t, -t, T(1)})) > 0);
    CHECK(brightest(0, 1).pdf(glm::normalize(glm::vec<3, T>{T(-1), t, -t})) > 0);
    CHECK(brightest(7, 1).pdf(glm::normalize(glm::vec<3, T>{T(-1), t, t})) > 0);
    CHECK(brightest(2, 1).pdf(glm::normalize(glm::vec<3, T>{t, t, T(-1)})) > 0);
    CHECK(brightest(5, 0).pdf(glm::normalize(glm::vec<3, T>{t, T(1), t})) > 0);
    CHECK(brightest(5, 3).pdf(glm::normalize(glm::vec<3, T>{t, T(-1), t})) > 0);
    CHECK(std::isinf(brightest(4, 3).sample({t, t}).distance));
}

TEMPLATE_TEST_CASE("bilinear radiance is never met by a density of 0", "[environment_map]", float, double) {
    using T = TestType;
    constexpr int width = 16, height = 8;
    std::mt19937_64 engine{3};
    std::uniform_real_distribution<double> uniform{0, 1};
    std::vector<T> texels(width * height);
    for (const std::size_t lit : {0u, 15u, 35u, 77u, 112u, 127u})
        texels[lit] = T(1e-3) + T(1e3) * static_cast<T>(uniform(engine));
    const lumis::EnvironmentMap map{width, height, texels, lumis::EnvironmentOptions{lumis::Interpolation::Bilinear}};
    const auto texel = [&](int x, int y) {
        return texels[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + (x + width) % width)];
    };
    int unmet = 0, lit = 0, dark_density = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double u = uniform(engine), v = uniform(engine);
        const double x = u * width - 0.5, y = v * height - 0.5;
        const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
        const double radiance =
            (double{texel(x0, y0)} * (x0 + 1 - x) + double{texel(x0 + 1, y0)} * (x - x0)) * (y0 + 1 - y) +
            (double{texel(x0, y0 + 1)} * (x0 + 1 - x) + double{texel(x0 + 1, y0 + 1)} * (x - x0)) * (y - y0);
        const double phi = 2 * pi * (u - 0.5), theta = pi * v;
        const glm::dvec3 w{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
        const T pdf = map.pdf(glm::vec<3, T>(w));
        lit += radiance > 0;
        unmet += radiance > 1e-6 && !(pdf > 0);
        dark_density += pdf > 0 && radiance == 0;
    }
    CHECK(lit > 10'000);
    CHECK(unmet == 0);
    // A texel lights the four half texels around it, and is drawn in those nine that are lit in part.
    CHECK(dark_density < 1.25 * lit);
}

TEMPLATE_TEST_CASE("maps that are refused", "[environment_map]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const auto with = [](std::size_t index, T value) {
        std::vector<T> texels(8, T(1));
        texels[index] = value;
        return texels;
    };
    expect_refusal(4, 2, with(5, nan), {"5", "nan"});
    expect_refusal(4, 2, with(0, inf), {"0", "inf"});
    expect_refusal(4, 2, with(7, -inf), {"7", "inf"});
    expect_refusal(4, 2, with(3, T(-0.25)), {"3", "-0.25"});
    expect_refusal(4, 2, std::vector<T>(7, T(1)), {"4 x 2", "7"});
    expect_refusal(4, 2, std::vector<T>(9, T(1)), {"4 x 2", "9"});
    expect_refusal(0, 2, std::vector<T>{}, {"width", "0"});
    expect_refusal(4, 0, std::vector<T>{}, {"height", "0"});
    expect_refusal(-4, -2, std::vector<T>(8, T(1)), {"width", "-4"});
}

TEMPLATE_TEST_CASE("a black map draws nothing", "[environment_map]", float, double) {
    using T = TestType;
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{5, 1}, std::pair{1, 5}, std::pair{16, 8}}) {
        for (const auto interpolation : {lumis::Interpolation::Nearest, lumis::Interpolation::Bilinear}) {
            const std::vector<T> black(static_cast<std::size_t>(width * height));
            const lumis::EnvironmentMap map{width, height, black, lumis::EnvironmentOptions{interpolation}};
            CHECK(map.empty());
            const auto law = laws::draws_nothing(map);
            INFO(law.message);
            CHECK(law.passed);
        }
    }
}

TEMPLATE_TEST_CASE("maps of extreme luminance stay finite", "[environment_map]", float, double) {
    using T = TestType;
    const T smallest = std::numeric_limits<T>::denorm_min(), largest = std::numeric_limits<T>::max();
    for (const auto& texels : {std::vector<T>(32, smallest), std::vector<T>(32, largest), [&] {
                                   std::vector<T> mixed(32, smallest);
                                   mixed[13] = largest;
                                   return mixed;
                               }()}) {
        for (const auto interpolation : {lumis::Interpolation::Nearest, lumis::Interpolation::Bilinear}) {
            const lumis::EnvironmentMap map{8, 4, texels, lumis::EnvironmentOptions{interpolation}};
            CHECK_FALSE(map.empty());
            const auto law = laws::stays_finite(map);
            INFO(law.message);
            CHECK(law.passed);
            // Every texel with light can be drawn.
            for (std::size_t i = 0; i < 32; ++i) CHECK(map.pdf(glm::vec<3, T>(centre(i % 8, i / 8, 8, 4))) > 0);
        }
    }
}
