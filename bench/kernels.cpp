// Time of one draw and of one density evaluation for every strategy: sample/<strategy>/single/<scalar> and
// pdf/<strategy>/single/<scalar>. Random numbers and directions are made beforehand; the time of an item is that of one
// call. A new strategy adds one line to register_strategies.
#include "subjects.hpp"
#include <lumis/lumis.hpp>

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <utility>

namespace {

template <class S>
void sample_kernel(benchmark::State& state, const S& strategy) {
    const auto uniforms = random_uniforms<S::dimensions, typename S::Scalar>();
    for (auto _ : state) {
        for (const auto& u : uniforms) benchmark::DoNotOptimize(strategy.sample(u));
    }
    count_items(state, uniforms.size());
}

template <class S>
void pdf_kernel(benchmark::State& state, const S& strategy) {
    const auto directions = half_own_half_anywhere(strategy);
    for (auto _ : state) {
        for (const auto& w : directions) benchmark::DoNotOptimize(strategy.pdf(w));
    }
    count_items(state, directions.size());
}

template <class S>
void register_strategy(const std::string& name, S strategy) {
    const auto held = std::make_shared<const S>(std::move(strategy));
    const std::string suffix = "/" + name + "/single/" + scalar_name<typename S::Scalar>;
    benchmark::RegisterBenchmark(("sample" + suffix).c_str(), [held](auto& state) { sample_kernel(state, *held); });
    benchmark::RegisterBenchmark(("pdf" + suffix).c_str(), [held](auto& state) { pdf_kernel(state, *held); });
}

template <class T>
void register_strategies() {
    const Scene<T> scene;
    register_strategy("cosine_hemisphere", lumis::CosineHemisphere<T>{});
    register_strategy("uniform_hemisphere", lumis::UniformHemisphere<T>{});
    register_strategy("ggx_vndf", lumis::GgxVndf<T>{scene.wo, scene.alpha});
    register_strategy("ggx_reflection", lumis::GgxReflection<T>{scene.wo, scene.alpha});
    register_strategy("perfect_reflection", lumis::PerfectReflection<T>{scene.wo});
    register_strategy("triangle", lumis::AreaLight{scene.triangle, scene.origin});
    register_strategy("parallelogram", lumis::AreaLight{scene.parallelogram, scene.origin});
    register_strategy("sphere_by_area", lumis::AreaLight<lumis::Sphere<T>, lumis::ByArea>{scene.sphere, scene.origin});
    register_strategy("sphere_by_solid_angle",
                      lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{scene.sphere, scene.origin});
    register_strategy("environment", lumis::EnvironmentMap{1024, 512, sky<T>(1024, 512)});
    register_strategy("mixture", lumis::Mixture{lumis::choose(0.5, lumis::CosineHemisphere<T>{}),
                                                lumis::choose(0.5, lumis::GgxReflection<T>{scene.wo, scene.alpha})});
}

void build_environment(benchmark::State& state, int width, int height) {
    const auto luminance = sky<float>(width, height);
    for (auto _ : state) {
        const lumis::EnvironmentMap map{width, height, luminance};
        benchmark::DoNotOptimize(map.empty());
    }
    count_items(state, luminance.size());
}

const bool registered = [] {
    register_strategies<float>();
    register_strategies<double>();
    for (const int width : {1024, 4096, 8192}) {
        const std::string name = "build/environment/" + std::to_string(width) + "x" + std::to_string(width / 2);
        benchmark::RegisterBenchmark(name.c_str(), build_environment, width, width / 2)->Unit(benchmark::kMillisecond);
    }
    return true;
}();

}  // namespace
