// Light trees of any scale and size: lights of no extent around a point, whose probabilities sum to 1, and the sum of what they
// give; each is drawn, and its sample has the probability that is told for it.
#include "cases.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace stability {

template <class T>
Measured light_trees(Effort effort) {
    Measured measured;
    auto source = uniforms<T>(3);
    for (const std::size_t n : {1u, 2u, 10u, 1000u}) {
        sweep(1e-15, 1e15, 10, [&](double scale) {
            std::vector<lumis::LightBounds<T>> lights(n);
            for (auto& light : lights) {
                const auto u = source.template next<4>();
                light.lower = light.upper = static_cast<T>(scale) * (glm::vec<3, T>{u.x, u.y, u.z} - T(0.5));
                light.intensity = static_cast<T>(scale * std::pow(1e3, double{u.w}));
            }
            // Outside, in the middle, and upon a light.
            const lumis::LightTree tree{lights};
            for (const auto& point :
                 {glm::vec<3, T>{static_cast<T>(2 * scale)}, glm::vec<3, T>{T(0)}, lights[0].lower}) {
                const auto seen = tree.from(point);
                const auto given = [&](std::size_t i) {
                    const glm::dvec3 to_light = (glm::dvec3{lights[i].lower} - glm::dvec3{point}) / scale;
                    return double{lights[i].intensity} / scale / std::fmax(glm::dot(to_light, to_light), 1e-3);
                };
                double sum = 0, all = 0;
                for (std::size_t i = 0; i < n; ++i) {
                    measured.expect(seen.pdf(i) > 0);
                    measured.density(seen.pdf(i));
                    sum += double{seen.pdf(i)};
                    all += given(i);
                }
                measured.error(std::abs(sum - 1));
                const auto moments = moments_of<T>(effort.of(3'000), [&](auto& numbers) {
                    const auto drawn = seen.sample(numbers.template next<1>());
                    measured.expect(drawn.value < n && drawn.pdf == seen.pdf(drawn.value));
                    return given(drawn.value) / double{drawn.pdf};
                });
                if (point != lights[0].lower) measured.bias(moments, all, 1e-6);
                for (const T u : corner_values<T>) measured.expect(seen.sample(glm::vec<1, T>{u}).pdf > 0);
            }
        });
    }
    return measured;
}

template Measured light_trees<float>(Effort);
template Measured light_trees<double>(Effort);

}  // namespace stability
