// Time of a weight, weight/<heuristic>/<techniques>/<scalar>, and of a whole estimate of direct light at a point,
// estimate/direct/<model>/<scalar>; random numbers are made beforehand.
#include "subjects.hpp"
#include <lumis/lumis.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace {

// Over twelve decades, `techniques` of them for each item.
template <class T>
std::vector<T> random_densities(std::size_t techniques) {
    const auto uniforms = random_uniforms<1, T>();
    std::vector<T> densities;
    for (std::size_t i = 0; i < batch * techniques; ++i) {
        densities.push_back(std::pow(T(10), 12 * uniforms[(i * 7 + i / batch) % batch].x - 6));
    }
    return densities;
}

template <class T, class Heuristic>
void weight_kernel(benchmark::State& state, const Heuristic& heuristic, std::size_t techniques) {
    const auto densities = random_densities<T>(techniques);
    for (auto _ : state) {
        for (std::size_t i = 0; i < batch; ++i) {
            const std::span<const T> q{densities.data() + i * techniques, techniques};
            benchmark::DoNotOptimize(lumis::mis_weight(heuristic, q, i % techniques));
        }
    }
    count_items(state, batch);
}

template <class T, class Heuristic>
void register_heuristic(const std::string& name, Heuristic heuristic) {
    for (const std::size_t techniques : {2u, 8u, 256u}) {
        const std::string full = "weight/" + name + "/" + std::to_string(techniques) + "/" + scalar_name<T>;
        benchmark::RegisterBenchmark(full.c_str(), weight_kernel<T, Heuristic>, heuristic, techniques);
    }
}

// A host's sampler whose numbers are there already.
template <class T>
struct Prepared {
    std::vector<glm::vec<1, T>> numbers = random_uniforms<1, T>();
    std::size_t position = 0;

    template <int N>
    glm::vec<N, T> next() {
        glm::vec<N, T> u;
        for (int i = 0; i < N; ++i) u[i] = numbers[position++ % batch].x;
        return u;
    }
};

// Diffuse reflection of a sphere light.
template <class T>
struct Reflectance {
    lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> light;
    T operator()(const lumis::Direction<T>& w) const { return w.z > 0 && light.pdf(w) > 0 ? w.z : T(0); }
};

template <class T>
void register_all() {
    register_heuristic<T>("balance", lumis::BalanceHeuristic{});
    register_heuristic<T>("power", lumis::PowerHeuristic{});

    const Scene<T> scene;
    const lumis::CosineHemisphere<T> bsdf;
    const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> light{scene.sphere, scene.origin};
    const auto add = [&](const std::string& model, const auto& estimator) {
        const auto kernel = [=](benchmark::State& state) {
            Prepared<T> uniforms;
            for (auto _ : state) benchmark::DoNotOptimize(estimator.estimate(Reflectance<T>{light}, uniforms));
            count_items(state, 1);
        };
        benchmark::RegisterBenchmark(("estimate/direct/" + model + "/" + scalar_name<T>).c_str(), kernel);
    };
    using namespace lumis;
    add("light", multi_sample(PowerHeuristic{}, take(1, light)));
    add("average", multi_sample(EqualWeights{}, take(1, bsdf), take(1, light)));
    add("balance", multi_sample(BalanceHeuristic{}, take(1, bsdf), take(1, light)));
    add("power", multi_sample(PowerHeuristic{}, take(1, bsdf), take(1, light)));
    add("one_sample", one_sample(BalanceHeuristic{}, choose(0.5, bsdf), choose(0.5, light)));
}

const bool registered = (register_all<float>(), register_all<double>(), true);

}  // namespace
