// One of many lights selected for a point, and its probability: by a light tree, by power (see alias_table in tables.cpp), and
// exactly, by what each gives to the point, which looks at all of them. build/light_tree_<size>/single.
#include "kernel.hpp"
#include "many_lights.hpp"
#include "subjects.hpp"
#include <lumis/lights/light_tree.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

namespace {

struct WithTree {
    ManyLights lights;
    lumis::LightTree<float> tree{lights.bounds};
};

// work(with tree, point, u) yields what is to be kept.
void add(const std::string& name, const auto& make, auto work) {
    add_kernel(name, [=]() -> Pass {
        return [with_tree = make(), u = Uniforms<float>{many}, out = Results<float>{}, pass = std::size_t{0},
                work]() mutable {
            const auto x = part(u.x, pass++);
            for (std::size_t i = 0; i < batch; ++i) {
                one_at_a_time(i);
                out.pdf[i] = work(*with_tree, with_tree->lights.points[i], x[i]);
            }
            benchmark::DoNotOptimize(&out);
            benchmark::ClobberMemory();
        };
    });
}

float select_exactly(const ManyLights& lights, const ManyLights::Point& point, float u, std::vector<float>& sums) {
    float sum = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sum += lights.given(i, point);
    std::size_t selected = 0;
    while (selected + 1 < sums.size() && sums[selected] < u * sum) ++selected;
    return sum > 0 ? lights.given(selected, point) / sum : 0;
}

const bool added = [] {
    for (const std::size_t size : {std::size_t{10}, std::size_t{1000}, std::size_t{100'000}}) {
        const auto make = lazily([=] { return WithTree{ManyLights{size}}; });
        const std::string tree = "light_tree_" + std::to_string(size);
        add("sample/" + tree + "/single/float", make, [](const WithTree& lit, const auto& point, float u) {
            return lit.tree.from(point.position, point.normal).sample(glm::vec1{u}).pdf;
        });
        add("pdf/" + tree + "/single/float", make, [](const WithTree& lit, const auto& point, float u) {
            const auto seen = lit.tree.from(point.position, point.normal);
            return seen.pdf(static_cast<std::size_t>(u * static_cast<float>(seen.size())));
        });
        benchmark::RegisterBenchmark(("build/" + tree + "/single/float").c_str(), [size](benchmark::State& state) {
            const ManyLights lights{size, 0};
            for (auto _ : state) {
                const lumis::LightTree<float> built{lights.bounds};
                benchmark::DoNotOptimize(&built);
                benchmark::ClobberMemory();
            }
        })->Unit(benchmark::kMillisecond);
        if (size > 1000) continue;
        add("sample/" + tree + "/textbook/float", make,
            [sums = std::vector<float>(size)](const WithTree& lit, const auto& point, float u) mutable {
                return select_exactly(lit.lights, point, u, sums);
            });
    }
    return true;
}();

}  // namespace
