// Google Benchmark over all kernels, time_each being that of one item. `lumis_bench --run <kernel> <passes>` only runs a
// kernel, for a profiler: the difference between two such runs is that of their passes alone.
#include "kernel.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

int run(std::string_view name, long passes) {
    const auto kernel = std::ranges::find(kernels(), name, &Kernel::name);
    if (kernel == kernels().end()) {
        std::fprintf(stderr, "there is no kernel %s\n", name.data());
        return 1;
    }
    const Pass pass = kernel->prepare();
    for (long i = 0; i < passes; ++i) pass();
    return 0;
}

void measure(benchmark::State& state, const Kernel& kernel) {
    const Pass pass = kernel.prepare();
    for (auto _ : state) pass();
    // Shown in seconds with a prefix: 12n is 12 ns.
    state.counters["time_each"] = benchmark::Counter(static_cast<double>(state.iterations()) * double{batch},
                                                     benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 4 && std::string_view{argv[1]} == "--run") return run(argv[2], std::atol(argv[3]));
    for (const Kernel& kernel : kernels()) benchmark::RegisterBenchmark(kernel.name.c_str(), measure, kernel);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
