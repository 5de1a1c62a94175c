// Uniforms by the four, as an estimate of two directions takes them: uniforms/<source>/single/<scalar>. mt19937 is the standard
// library's, in the place of a textbook.
#include "kernel.hpp"
#include "subjects.hpp"
#include <lumis/core/uniforms.hpp>
#include <lumis/qmc/sobol.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace {

// next(i) yields the numbers of item i.
template <class T>
void add_source(const std::string& name, const auto& make, const auto& next) {
    add_kernel("uniforms/" + name + "/single/" + scalar_name<T>, [=]() -> Pass {
        return [source = make(), next, sums = std::vector<T>(batch), pass = std::uint32_t{0}]() mutable {
            for (std::size_t i = 0; i < batch; ++i) {
                one_at_a_time(i);
                const glm::vec<4, T> u = next(source, pass + static_cast<std::uint32_t>(i));
                sums[i] = u.x + u.y + u.z + u.w;
            }
            pass += batch;
            benchmark::DoNotOptimize(sums.data());
            benchmark::ClobberMemory();
        };
    });
}

template <class T>
struct Added {
    Added() {
        const auto two_by_two = [](auto& source) {
            const auto a = source.template next<2>(), b = source.template next<2>();
            return glm::vec<4, T>{a.x, a.y, b.x, b.y};
        };
        add_source<T>(
            "sobol", [] { return lumis::Sobol<T>{1}; },
            [=](auto& source, std::uint32_t i) {
                source.start(i);
                return two_by_two(source);
            });
        add_source<T>(
            "mt19937", [] { return lumis::Uniforms<std::mt19937, T>{std::mt19937{1}}; },
            [=](auto& source, std::uint32_t) { return two_by_two(source); });
    }
};
const Added<float> floats;
const Added<double> doubles;

}  // namespace
