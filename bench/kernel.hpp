// A kernel is work that is measured: its time by Google Benchmark, or its instructions by running it a given number of
// times under a profiler (see main.cpp). Its name is <what>/<of what>/<form>/<scalar>, with the form
//   single    one call of Lumis after the other
//   batch     lumis/batch
//   textbook  the same as books and renderers have it, see textbook/
// All forms read the same numbers, made beforehand, and write their results to the same kind of arrays.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// Items of one pass: few enough that numbers and results stay in the first cache.
inline constexpr std::size_t batch = 1024;

using Pass = std::function<void()>;

struct Kernel {
    std::string name;
    std::function<Pass()> prepare;  // makes what the kernel works on, as late as it is wanted
};

inline std::vector<Kernel>& kernels() {
    static std::vector<Kernel> all;
    return all;
}

inline void add_kernel(std::string name, std::function<Pass()> prepare) {
    kernels().push_back({std::move(name), std::move(prepare)});
}

// A value that is made when it is first wanted, and then shared: for tables of a hundred megabytes.
template <class Make>
[[nodiscard]] auto lazily(Make make) {
    using Value = decltype(make());
    return [make, value = std::make_shared<std::optional<Value>>()]() -> std::shared_ptr<const Value> {
        if (!*value) value->emplace(make());
        return {value, &**value};
    };
}

// Between the items of a loop of single calls: the compiler may not work on several at once, as it cannot in a renderer.
inline void one_at_a_time(std::size_t& i) {
    asm volatile("" : "+r"(i));
}
