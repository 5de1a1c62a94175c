// Resampling as papers have it: a running sum, and the pick of each candidate by its share (Bitterli et al. 2020, algorithm 3).
#pragma once

#include <glm/vec3.hpp>

namespace textbook {

template <class Item, class T>
struct Reservoir {
    Item item{};
    T sum = 0;
    unsigned count = 0;

    void add(const Item& candidate, T weight, T u) {
        sum += weight;
        ++count;
        if (u < weight / sum) item = candidate;
    }
};

// `candidates` of a strategy, one of which is selected by target, and f there.
template <class T>
[[nodiscard]] T resampled(int candidates, const auto& strategy, const auto& target, const auto& f, auto&& uniforms) {
    Reservoir<glm::vec<3, T>, T> kept;
    for (int i = 0; i < candidates; ++i) {
        const auto drawn = strategy.sample(uniforms.template next<2>());
        kept.add(drawn.value, drawn.pdf > 0 ? target(drawn.value) / drawn.pdf : T(0), uniforms.template next<1>().x);
    }
    if (!(kept.sum > 0)) return 0;
    return f(kept.item) * kept.sum / (static_cast<T>(candidates) * target(kept.item));
}

}  // namespace textbook
