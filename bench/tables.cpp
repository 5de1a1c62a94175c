// Tables: environment maps and alias tables of several sizes, drawn from and asked for densities at ever new places, and
// build/environment_<size>/<form>. Tables are made when a benchmark of theirs runs, and shared by its forms.
#include "textbook/tables.hpp"

#include "forms.hpp"
#include "subjects.hpp"
#include <lumis/lumis.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace {

template <class Map, class T>
void build(benchmark::State& state, int width) {
    const auto height = width / 2;
    const std::vector<T> luminance = sky<T>(width, height);
    for (auto _ : state) {
        const Map map(static_cast<std::size_t>(width), static_cast<std::size_t>(height), luminance);
        benchmark::DoNotOptimize(&map);
        benchmark::ClobberMemory();
    }
}

template <class T>
void add_environment(int width) {
    using Map = lumis::EnvironmentMap<T>;
    using Alias = lumis::AliasEnvironmentMap<T>;
    using Book = textbook::EnvironmentMap<T>;
    const std::string name = "environment_" + std::to_string(width) + "x" + std::to_string(width / 2);
    const auto w = static_cast<std::size_t>(width);
    add_strategy<T>(name, lazily([=] {
                        return Map{w, w / 2, sky<T>(width, width / 2)};
                    }),
                    lazily([=] {
                        return Book{w, w / 2, sky<T>(width, width / 2)};
                    }),
                    many);
    add_strategy<T>(name + "_alias", lazily([=] { return Alias{w, w / 2, sky<T>(width, width / 2)}; }), nullptr, many);

    const auto add_build = [&](const char* form, auto function) {
        const std::string full = "build/" + name + "/" + form + "/" + scalar_name<T>;
        benchmark::RegisterBenchmark(full.c_str(), function, width)->Unit(benchmark::kMillisecond);
    };
    add_build("single", build<Map, T>);
    add_build("alias", build<Alias, T>);
    add_build("textbook", build<Book, T>);
}

// Tables of indices. Book: nullptr_t if there is none.
template <class Table, class Book, class T = typename Table::Scalar>
void add_index_table(const std::string& name, std::size_t size) {
    const auto weights = [size] {
        std::vector<T> result = Uniforms<T>{(size + batch - 1) / batch}.x;
        result.resize(size);
        return result;
    };
    struct Drawn {
        std::vector<std::size_t> index = std::vector<std::size_t>(batch);
        std::vector<T> pdf = std::vector<T>(batch);
    };
    const auto add = [&](const char* form, auto make) {
        add_kernel("sample/" + name + "_" + std::to_string(size) + "/" + form + "/" + scalar_name<T>, [=]() -> Pass {
            return [table = make(), u = Uniforms<T>{many}, out = Drawn{}, pass = std::size_t{0}]() mutable {
                const auto x = part(u.x, pass++);
                for (std::size_t i = 0; i < batch; ++i) {
                    one_at_a_time(i);
                    const auto drawn = table->sample(glm::vec<1, T>{x[i]});
                    out.index[i] = drawn.value;
                    out.pdf[i] = drawn.pdf;
                }
                benchmark::DoNotOptimize(&out);
                benchmark::ClobberMemory();
            };
        });
    };
    add("single", lazily([=] { return Table{weights()}; }));
    if constexpr (!std::is_same_v<Book, std::nullptr_t>) add("textbook", lazily([=] { return Book{weights()}; }));
}

const bool added = [] {
    for (const int width : {1024, 4096, 8192}) add_environment<float>(width);
    add_environment<double>(1024);
    for (const std::size_t size : {std::size_t{1000}, std::size_t{1000000}}) {
        add_index_table<lumis::AliasTable<float>, textbook::AliasTable<float>>("alias_table", size);
        add_index_table<lumis::AliasTable<double>, textbook::AliasTable<double>>("alias_table", size);
        add_index_table<lumis::DiscreteTable<float>, std::nullptr_t>("discrete_table", size);
        add_index_table<lumis::DiscreteTable<double>, std::nullptr_t>("discrete_table", size);
    }
    return true;
}();

}  // namespace
