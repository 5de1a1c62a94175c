// One of 10 to a million lights selected for a point: evenly, by power, by a light tree, and exactly. Prints a table in Markdown.
//
//     light_selection [largest number of lights]
//
// A light gives what its middle does, and half of the lights are hidden, others from each point, which no selection knows.
// Variances are sums over all lights, not estimates: that of given / probability, over the square of what all lights would give,
// in the mean over points. CPU times are those of a selection, with what the light gives added up. Errors at equal time are
// relative to that by power, without shadow rays and with one of a microsecond each.
//
// A second table has CPU times of an estimate that combines a cosine with the lights by MIS, without its rays.
#include "../many_lights.hpp"
#include <lumis/combine/multi_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>
#include <lumis/lights/light_set.hpp>
#include <lumis/lights/light_tree.hpp>
#include <lumis/lights/selected_light.hpp>
#include <lumis/tables/alias_table.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using Point = ManyLights::Point;

// CPU time.
double seconds_since(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// The fewest seconds of five runs: other programs disturb.
double fastest(const auto& run) {
    double least = 1e30;
    for (int i = 0; i < 5; ++i) {
        const auto start = std::clock();
        run();
        least = std::fmin(least, seconds_since(start));
    }
    return least;
}

struct Row {
    std::string name;
    double variance, nanoseconds, build_milliseconds, bytes;
};

// Half of the lights, another one for each point.
bool is_hidden(std::size_t light, std::size_t point) {
    return ((light * 0x9e3779b97f4a7c15 ^ point * 0xbf58476d1ce4e5b9) * 0x94d049bb133111eb) >> 63 != 0;
}

// table_at(point) selects by sample(u) and tells pdf(index).
Row measure(const std::string& name, const ManyLights& lights, double build, double bytes, const auto& table_at) {
    const std::size_t size = lights.bounds.size(), looked_at = size > 100'000 ? 20 : 200;
    double variance = 0;
    for (std::size_t k = 0; k < looked_at; ++k) {
        const Point& point = lights.points[k];
        const auto& table = table_at(point);
        double all = 0, seen = 0, squares = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const double given = double{lights.given(i, point)};
            all += given;
            if (!(given > 0) || is_hidden(i, k)) continue;
            seen += given;
            squares += given * given / double{table.pdf(i)};
        }
        if (all > 0) variance += (squares - seen * seen) / (all * all);
    }
    const std::size_t draws = 1'000'000 / (name == "exact" ? size : 10);
    lumis::Uniforms<std::mt19937_64, float> uniforms{std::mt19937_64{1}};
    std::vector<float> u(lights.points.size());
    for (float& one : u) one = uniforms.next<1>().x;
    float total = 0;
    const double time = fastest([&] {
        for (std::size_t i = 0; i < draws; ++i) {
            const Point& point = lights.points[i % u.size()];
            const auto& table = table_at(point);
            glm::vec<std::remove_cvref_t<decltype(table)>::dimensions, float> uniform(0.5f);
            uniform.x = u[i % u.size()];
            const auto drawn = table.sample(uniform);
            if (drawn.pdf > 0) total += lights.given(drawn.value, point) / drawn.pdf;
        }
    });
    if (total < 0) std::puts("a negative sum");  // so that it is wanted
    return {name, variance / static_cast<double>(looked_at), time * 1e9 / static_cast<double>(draws), build * 1e3,
            bytes / static_cast<double>(size)};
}

void study(std::size_t size) {
    const ManyLights lights{size};
    const auto make = [](const auto& made) {
        const auto start = std::clock();
        auto table = made();
        return std::pair{std::move(table), seconds_since(start)};
    };
    std::vector<Row> rows;
    const std::vector<float> ones(size, 1.0f);
    const auto evenly = make([&] { return lumis::AliasTable<float>{ones}; });
    const auto by_power = make([&] { return lumis::AliasTable<float>{lights.intensities}; });
    const auto made = make([&] { return lumis::LightTree{lights.bounds}; });
    const lumis::LightTree<float>& tree = made.first;
    const double eight = 8 * static_cast<double>(size), bytes = static_cast<double>(tree.memory_bytes());
    rows.push_back(measure(
        "by power", lights, by_power.second, eight, [&](const Point&) -> const auto& { return by_power.first; }));
    rows.push_back(measure(
        "evenly", lights, 0, 0, [&](const Point&) -> const auto& { return evenly.first; }));
    rows.push_back(measure("light tree", lights, made.second, bytes,
                           [&](const Point& point) { return tree.from(point.position, point.normal); }));
    if (size <= 10'000) {
        std::vector<float> given(size);
        rows.push_back(measure("exact", lights, 0, 0, [&](const Point& point) {
            for (std::size_t i = 0; i < size; ++i) given[i] = lights.given(i, point);
            return lumis::AliasTable<float>{given};
        }));
    }
    // Errors are as the root of variance times time.
    const auto error = [](const Row& row, double ray) { return std::sqrt(row.variance * (row.nanoseconds + ray)); };
    for (const Row& row : rows) {
        std::printf("| %zu | %s | %.3g | %.0f ns | %.3g ms | %.0f | %.3g | %.3g |\n", size, row.name.c_str(),
                    row.variance, row.nanoseconds, row.build_milliseconds, row.bytes, error(row, 0) / error(rows[0], 0),
                    error(row, 1000) / error(rows[0], 1000));
    }
    std::fflush(stdout);
}

// Over pairs of a light and a direction, MIS asks one light; over directions, every light. A ray of the cosine's meets any light.
void combine(std::size_t size) {
    const ManyLights lights{size};
    const lumis::CosineHemisphere<float> cosine;
    const auto both = [](const auto& bsdf, const auto& light) {
        return lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, bsdf), lumis::take(1, light));
    };
    const auto over_pairs = [&](const auto& set, auto& uniforms) {
        const lumis::SelectedLight one{set};
        const auto any_light = [&](const glm::vec3& w) {
            return static_cast<std::size_t>((1 - w.z * w.z) * 0.99f * static_cast<float>(size));
        };
        return both(lumis::MetLight{one, cosine, any_light}, one)
            .estimate([](const auto& x) { return std::fmax(x.direction.z, 0.0f); }, uniforms);
    };
    const auto over_directions = [&](const auto& set, auto& uniforms) {
        return both(cosine, set).estimate([](const glm::vec3& w) { return std::fmax(w.z, 0.0f); }, uniforms);
    };
    const auto measure_both = [&](const char* selected, const auto& table_at) {
        const auto nanoseconds = [&](std::size_t estimates, const auto& estimate) {
            lumis::Uniforms<std::mt19937_64, float> uniforms{std::mt19937_64{1}};
            float total = 0;
            const double time = fastest([&] {
                for (std::size_t i = 0; i < estimates; ++i) {
                    const glm::vec3 position = lights.points[i % lights.points.size()].position;
                    const auto light = [&](std::size_t k) {
                        const glm::vec3 &lower = lights.bounds[k].lower, &upper = lights.bounds[k].upper;
                        const lumis::Sphere<float> shape{0.5f * (lower + upper), 0.5f * (upper.x - lower.x)};
                        return lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle>{shape, position};
                    };
                    total += estimate(lumis::LightSet{light, table_at(position)}, uniforms);
                }
            });
            if (total < 0) std::puts("a negative sum");  // so that it is wanted
            return time * 1e9 / static_cast<double>(estimates);
        };
        std::printf("| %zu | %s | %.0f ns | %.0f ns |\n", size, selected, nanoseconds(100'000, over_pairs),
                    nanoseconds(1 + 100'000 / size, over_directions));
        std::fflush(stdout);
    };
    const lumis::AliasTable<float> by_power{lights.intensities};
    const lumis::LightTree<float> tree{lights.bounds};
    measure_both(
        "by power", [&](const glm::vec3&) -> const auto& { return by_power; });
    measure_both("light tree", [&](const glm::vec3& position) {
        return tree.from(position, glm::vec3{0.0f, 0.0f, 1.0f});
    });
}

}  // namespace

int main(int argc, char** argv) {
    const double largest = argc > 1 ? std::atof(argv[1]) : 1e6;
    std::puts(
        "| lights | selected | relative variance | a sample | build | bytes a light | error at equal time, by power = "
        "1 "
        "| the same with shadow rays |");
    std::puts("| ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |");
    const auto for_sizes = [&](auto work) {
        for (const double size : {1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
            if (size <= largest) work(static_cast<std::size_t>(size));
        }
    };
    for_sizes(study);
    std::puts("\n| lights | selected | an estimate over pairs, by MetLight | over directions, by LightSet |");
    std::puts("| ---: | --- | ---: | ---: |");
    for_sizes(combine);
}
