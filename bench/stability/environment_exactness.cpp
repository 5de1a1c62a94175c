// Whether texels of an environment map are drawn as often as the density says.
#include "cases.hpp"
#include "picture.hpp"

#include <algorithm>
#include <cstdint>

namespace stability {

namespace {

// What an outdoor picture is like: a smooth sky, a dark ground, a sun of few texels, and one texel next to nothing.
Picture<float> outdoors(std::size_t width, std::size_t height) {
    const auto w = static_cast<double>(width), h = static_cast<double>(height);
    return {width, height, [=](std::size_t x, std::size_t y) {
                const double u = (static_cast<double>(x) + 0.5) / w, v = (static_cast<double>(y) + 0.5) / h;
                const double sky = v < 0.5 ? 1.2 - v + 0.1 * std::sin(40 * u) : 0.02 + 0.01 * std::sin(97 * u);
                const bool sun = std::hypot(u - 0.3, (v - 0.25) / 2) < 0.002;
                return x == 7 ? 1e-9 : sky + (sun ? 2e4 : 0.0);
            }};
}

// The row where a table of cumulative sums in float goes most wrong, and by how much.
struct WorstRow {
    std::size_t row;
    double error;
};
WorstRow worst_row_of_float_sums(const Picture<float>& picture) {
    WorstRow worst{0, 0};
    for (std::size_t y = 0; y < picture.height; ++y) {
        const float* texels = &picture.texels[y * picture.width];
        double exact = 0;
        float sum = 0;
        for (std::size_t x = 0; x < picture.width; ++x) exact += double{texels[x]}, sum += texels[x];
        float before = 0, last = 0;
        for (std::size_t x = 0; x < picture.width; ++x) {
            before += texels[x];
            const float now = before / sum;
            const double probability = double{texels[x]} / exact;
            const double error = std::abs(double{now - last} - probability) / probability;
            // Texels that no float uniform would meet at all say nothing.
            if (probability > 1e-6 && error > worst.error) worst = {y, error};
            last = now;
        }
    }
    return worst;
}

template <class T>
std::size_t column_of(const lumis::Direction<T>& w, std::size_t width) {
    const double u = 0.5 + std::atan2(double{w.z}, double{w.x}) / (2 * std::numbers::pi);
    return std::min(static_cast<std::size_t>((u < 1 ? u : u - 1) * static_cast<double>(width)), width - 1);
}

// How often the texels of a row are drawn: of all 2^24 uniforms of float; of double's 2^53, by bisection for the first
// that draws each texel.
template <class T>
std::vector<double> frequencies_in_row(const lumis::EnvironmentMap<T>& map, T row_uniform, std::uint64_t step) {
    std::vector<double> drawn(map.width());
    constexpr std::uint64_t all = std::uint64_t{1} << lumis::uniform_bits<T>;
    const auto column = [&](std::uint64_t k) {
        const T u = static_cast<T>(k) / static_cast<T>(all);
        return column_of(map.sample({u, row_uniform}).value, map.width());
    };
    if constexpr (std::same_as<T, float>) {
        for (std::uint64_t k = 0; k < all; k += step) drawn[column(k)] += static_cast<double>(step) / double{all};
    } else {
        std::uint64_t begin = 0;
        while (begin < all) {
            const std::size_t here = column(begin);
            std::uint64_t low = begin, high = all;  // the last that draws this texel lies in [low, high)
            while (high - low > 1) {
                const std::uint64_t middle = low + (high - low) / 2;
                (column(middle) == here ? low : high) = middle;
            }
            drawn[here] += static_cast<double>(high - begin) / static_cast<double>(all);
            begin = high;
        }
    }
    return drawn;
}

template <class T>
Measured environment_exactness(Effort effort, std::size_t width) {
    Measured measured;
    const Picture<float> picture = outdoors(width, width / 2);
    const Picture<T> same{width, width / 2,
                          [&](std::size_t x, std::size_t y) { return picture.texels[y * width + x]; }};
    const auto map = same.map();
    const auto [row, usual_error] = worst_row_of_float_sums(picture);
    if constexpr (std::same_as<T, float>) measured.usual(1 + usual_error, Quad{1});

    // The uniform that draws the row's middle, found by its own inverse.
    const auto inside = map.invert(centre_of<T>(width / 2, row, width, width / 2));
    std::vector<double> reported(width);
    double sum = 0;
    for (std::size_t x = 0; x < width; ++x) {
        const T pdf = map.pdf(centre_of<T>(x, row, width, width / 2));
        measured.density(pdf);
        reported[x] = double{pdf};
        sum += reported[x];
    }
    // Densities are rounded; the probability behind one is the whole number of counts next to it.
    const double counts = double{lumis::detail::total_counts<T>};
    const std::uint64_t step = effort.quick ? 64 : 1;
    const auto drawn = frequencies_in_row<T>(map, inside.y, step);
    for (std::size_t x = 0; x < width; ++x) {
        const double mass = std::round(reported[x] / sum * counts) / counts;
        measured.expect(mass > 0);
        if (step == 1) measured.error(std::abs(drawn[x] - mass) / mass);
    }
    for_each_uniform<T>(1000, [&](const auto& u) {
        const auto sample = map.sample(u);
        measured.sample<T>(sample, map.pdf(sample.value));
        measured.expect(sample.pdf > 0 && sample.pdf == map.pdf(sample.value));
    });
    return measured;
}

}  // namespace

template <class T>
Measured environment_1k(Effort effort) {
    return environment_exactness<T>(effort, 1024);
}
template <class T>
Measured environment_4k(Effort effort) {
    return environment_exactness<T>(effort, 4096);
}
template <class T>
Measured environment_8k(Effort effort) {
    return environment_exactness<T>(effort, 8192);
}

template Measured environment_1k<float>(Effort);
template Measured environment_1k<double>(Effort);
template Measured environment_4k<float>(Effort);
template Measured environment_4k<double>(Effort);
template Measured environment_8k<float>(Effort);
template Measured environment_8k<double>(Effort);

}  // namespace stability
