// The forms of drawing and of evaluating a density, for a strategy of Lumis and its textbook counterpart.
#pragma once

#include "kernel.hpp"
#include "subjects.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/core/detail/held.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>

// The results of a pass are wanted, all of them.
template <class T>
void keep(Results<T>& out) {
    benchmark::DoNotOptimize(&out);
    benchmark::ClobberMemory();
}

// Small strategies are copied first, as the batch does: else every store might be one to their members.
template <class T, class S>
void sample_each(const S& strategy, const Uniforms<T>& u, std::size_t pass, Results<T>& out) {
    const lumis::detail::Held<const S&> held = strategy;
    const auto x = part(u.x, pass), y = part(u.y, pass);
    for (std::size_t i = 0; i < batch; ++i) {
        one_at_a_time(i);
        const auto drawn = held.sample({x[i], y[i]});
        out.x[i] = drawn.value.x;
        out.y[i] = drawn.value.y;
        out.z[i] = drawn.value.z;
        out.pdf[i] = drawn.pdf;
    }
}

template <class T, class S>
void pdf_each(const S& strategy, const Directions<T>& w, std::size_t pass, Results<T>& out) {
    const lumis::detail::Held<const S&> held = strategy;
    const auto x = part(w.x, pass), y = part(w.y, pass), z = part(w.z, pass);
    for (std::size_t i = 0; i < batch; ++i) {
        one_at_a_time(i);
        out.pdf[i] = held.pdf({x[i], y[i], z[i]});
    }
}

// A kernel that runs work(strategy, input, pass number, results); make_strategy() and make_input() yield shared pointers.
template <class T, class MakeStrategy, class MakeInput, class Work>
void add_form(const std::string& name, MakeStrategy make_strategy, MakeInput make_input, Work work) {
    add_kernel(name + "/" + scalar_name<T>, [=]() -> Pass {
        return [=, strategy = make_strategy(), input = make_input(), out = std::make_shared<Results<T>>(),
                pass = std::size_t{0}]() mutable {
            work(*strategy, *input, pass++, *out);
            keep(*out);
        };
    });
}

// All the forms of a strategy. make_textbook: nullptr if it has no counterpart.
template <class T, class MakeStrategy, class MakeTextbook>
void add_strategy(const std::string& name, MakeStrategy make_strategy, MakeTextbook make_textbook,
                  std::size_t passes = few) {
    const auto uniforms = lazily([passes] { return Uniforms<T>{passes}; });
    const auto directions = lazily([=] { return half_own_half_anywhere(*make_strategy(), passes); });
    const auto sample_single = [](const auto& s, const auto& u, auto pass, auto& out) { sample_each(s, u, pass, out); };
    const auto pdf_single = [](const auto& s, const auto& w, auto pass, auto& out) { pdf_each(s, w, pass, out); };

    add_form<T>("sample/" + name + "/single", make_strategy, uniforms, sample_single);
    add_form<T>("pdf/" + name + "/single", make_strategy, directions, pdf_single);
    add_form<T>("sample/" + name + "/batch", make_strategy, uniforms,
                [](const auto& s, const auto& u, auto pass, auto& out) {
                    lumis::sample_n(s, {part(u.x, pass), part(u.y, pass)}, {out.x, out.y, out.z, out.pdf});
                });
    add_form<T>("pdf/" + name + "/batch", make_strategy, directions,
                [](const auto& s, const auto& w, auto pass, auto& out) {
                    lumis::pdf_n(s, part(w.x, pass), part(w.y, pass), part(w.z, pass), out.pdf);
                });
    if constexpr (!std::is_same_v<MakeTextbook, std::nullptr_t>) {
        add_form<T>("sample/" + name + "/textbook", make_textbook, uniforms, sample_single);
        add_form<T>("pdf/" + name + "/textbook", make_textbook, directions, pdf_single);
    }
}

// A strategy that is there already.
template <class S>
[[nodiscard]] auto ready(const S& strategy) {
    return lazily([strategy] { return strategy; });
}
