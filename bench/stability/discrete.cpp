// Uniforms and discrete choice.
#include "cases.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace stability {

namespace {

// Yields the largest number that an engine of its width can.
template <class Word>
struct AllOnes {
    using result_type = Word;
    static constexpr Word min() { return 0; }
    static constexpr Word max() { return std::numeric_limits<Word>::max(); }
    Word operator()() const { return max(); }
};

template <class T, class Engine>
void check_below_one(Measured& measured, const Engine& engine, std::int64_t samples) {
    lumis::Uniforms<Engine, T> source{engine};
    for (std::int64_t i = 0; i < samples; ++i) {
        const T u = source.template next<1>().x;
        measured.expect(u >= 0 && u < 1);
    }
}

// Weights that break cumulative sums.
template <class T>
std::vector<std::vector<T>> awkward_weights() {
    std::vector<T> decades;
    sweep(1e-10, 1, 1000, [&](double weight) { decades.push_back(static_cast<T>(weight)); });
    std::vector<T> gaps(4096, T(0));
    for (std::size_t i = 0; i < gaps.size(); i += 97) gaps[i] = T(1) / static_cast<T>(i + 1);
    const T largest = std::numeric_limits<T>::max();
    const T least = flushes_subnormals<T>() ? T(0) : std::numeric_limits<T>::denorm_min();
    return {{T(1), T(1e-8), T(1)},     {T(0.3)}, {T(0), T(0), T(1), T(2), T(0), T(0), T(0)},
            {largest, largest, least}, decades,  gaps};
}

// In quad: these may be as large as numbers get.
template <class T>
Quad sum_of(const std::vector<T>& weights) {
    return std::accumulate(weights.begin(), weights.end(), Quad{0});
}

// The probability of every entry: none for weight 0, some for all others, near its share, and 1 altogether.
template <class T>
void check_probabilities(Measured& measured, const std::vector<T>& weights, auto probability) {
    const Quad sum = sum_of(weights);
    const double count = 1 / double{lumis::detail::total_counts<T>};
    Quad total = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double p = probability(i);
        total += p;
        measured.expect(weights[i] > 0 ? p >= 0.999 * count : p == 0);
        const double share = static_cast<double>(weights[i] / sum);
        // One count for being there, and another for rounding; what all those take is missing elsewhere.
        const double allowed = 2 * count + share * static_cast<double>(weights.size()) * count;
        measured.expect(std::abs(p - share) <= 1.001 * allowed);
    }
    measured.error(static_cast<double>(abs(total - 1)));
}

// Every uniform a float can hold evenly: how often each entry is drawn against its probability.
template <class T>
void check_frequencies(Measured& measured, Effort effort, std::size_t entries, auto index_of_u, auto probability) {
    if constexpr (std::same_as<T, float>) {
        if (effort.quick) return;
        std::vector<std::uint32_t> drawn(entries);
        for (std::uint32_t k = 0; k < lumis::detail::total_counts<T>; ++k) {
            ++drawn[index_of_u(static_cast<T>(k) / static_cast<T>(lumis::detail::total_counts<T>))];
        }
        for (std::size_t i = 0; i < entries; ++i) {
            const double frequency = drawn[i] / double{lumis::detail::total_counts<T>}, p = probability(i);
            if (p > 0 || frequency > 0) measured.error(std::abs(frequency - p) / p);
            measured.expect(p > 0 || drawn[i] == 0);
        }
    } else {
        // 2^53 are too many: whether the most probable entry is drawn as often as it should be.
        std::size_t favourite = 0;
        for (std::size_t i = 0; i < entries; ++i) favourite = probability(i) > probability(favourite) ? i : favourite;
        const auto hits = moments_of<T>(effort.of(200'000), [&](auto& source) {
            return index_of_u(source.template next<1>().x) == favourite ? 1.0 : 0.0;
        });
        measured.bias(hits, probability(favourite), 1e-9);
    }
}

// Table: of indices.
template <class Table>
Measured index_table(Effort effort) {
    using T = typename Table::Scalar;
    Measured measured;
    for (const auto& weights : awkward_weights<T>()) {
        const Table table{weights};
        const auto probability = [&](std::size_t i) { return double{table.pdf(i)}; };
        check_probabilities<T>(measured, weights, probability);
        const auto index = [&](T u) {
            const auto sample = table.sample(glm::vec<1, T>{u});
            measured.expect(sample.value < weights.size() && sample.pdf > 0 && weights[sample.value] > 0);
            return sample.value;
        };
        for (const T u : corner_values<T>) index(u);
        check_frequencies<T>(measured, effort, weights.size(), index, probability);
    }
    const Table black{std::vector<T>(100, T(0))};
    for (const T u : corner_values<T>) measured.expect(black.empty() && black.sample(glm::vec<1, T>{u}).pdf == 0);
    return measured;
}

}  // namespace

template <class T>
Measured uniforms_below_one(Effort effort) {
    Measured measured;
    const std::int64_t samples = effort.of(1'000'000);
    check_below_one<T>(measured, AllOnes<std::uint16_t>{}, 1000);
    check_below_one<T>(measured, AllOnes<std::uint32_t>{}, 1000);
    check_below_one<T>(measured, AllOnes<std::uint64_t>{}, 1000);
    check_below_one<T>(measured, std::mt19937{1}, samples);
    check_below_one<T>(measured, std::minstd_rand{1}, samples);
    check_below_one<T>(measured, std::ranlux24{1}, samples / 8);
    for (const double host : {1.0, 1.5, 1 - 1e-9, 1 - 1e-17, 0.0}) {
        auto source = lumis::uniforms_from<T>([&] { return host; });
        const T u = source.template next<2>().y;
        measured.expect(u >= 0 && u < 1);
    }
    const auto mean = moments_of<T>(samples, [](auto& source) { return source.template next<1>().x; });
    measured.bias(mean, 0.5, rounding_of_mean<T>);
    return measured;
}

template <class T>
Measured alias_table(Effort effort) {
    return index_table<lumis::AliasTable<T>>(effort);
}

template <class T>
Measured discrete_table(Effort effort) {
    return index_table<lumis::DiscreteTable<T>>(effort);
}

template <class T>
Measured piecewise_constant(Effort effort) {
    Measured measured;
    for (const auto& weights : awkward_weights<T>()) {
        const lumis::PiecewiseConstant1D<T> table{weights};
        const auto n = static_cast<double>(weights.size());
        const auto probability = [&](std::size_t i) {
            return double{table.pdf(static_cast<T>((static_cast<double>(i) + 0.5) / n))} / n;
        };
        check_probabilities<T>(measured, weights, probability);
        const auto index = [&](T u) {
            const auto sample = table.sample(glm::vec<1, T>{u});
            const auto i = static_cast<std::size_t>(double{sample.value} * n);
            measured.expect(i < weights.size() && weights[i] > 0 && sample.pdf == table.pdf(sample.value));
            return std::min(i, weights.size() - 1);
        };
        for (const T u : corner_values<T>) index(u);
        check_frequencies<T>(measured, effort, weights.size(), index, probability);
    }
    const lumis::PiecewiseConstant1D<T> black{std::vector<T>(100, T(0))};
    for (const T u : corner_values<T>) measured.expect(black.empty() && black.sample(glm::vec<1, T>{u}).pdf == 0);
    return measured;
}

template <class T>
Measured huge_tables(Effort effort) {
    Measured measured;
    std::vector<T> weights(static_cast<std::size_t>(effort.of(10'000'000)));
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = i % 3 == 1 ? T(0) : T(1 + i % 1000);
    const auto check = [&](const auto& table, auto index_of) {
        const auto draw = [&](T u) {
            const auto sample = table.sample(glm::vec<1, T>{u});
            const std::size_t i = index_of(sample.value);
            measured.expect(i < weights.size() && weights[i] > 0 && sample.pdf > 0);
        };
        for (const T u : corner_values<T>) draw(u);
        auto source = uniforms<T>(1);
        for (std::int64_t k = 0; k < effort.of(500'000); ++k) draw(source.template next<1>().x);
    };
    {
        const lumis::AliasTable<T> table{weights};
        check(table, [](std::size_t i) { return i; });
        double sum = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) sum += double{table.pdf(i)};
        measured.error(std::abs(sum - 1));
    }
    const lumis::PiecewiseConstant1D<T> table{weights};
    const auto n = static_cast<double>(weights.size());
    // Positions of 1e7 cells are finer than a float: the drawn point is asked for its density, not for its cell.
    if constexpr (std::same_as<T, double>) {
        check(table, [&](T x) { return static_cast<std::size_t>(x * n); });
    } else {
        auto source = uniforms<T>(1);
        for (std::int64_t k = 0; k < effort.of(500'000); ++k) {
            const auto sample = table.sample(source.template next<1>());
            measured.expect(sample.value >= 0 && sample.value <= 1 && sample.pdf > 0);
        }
    }
    return measured;
}

template Measured uniforms_below_one<float>(Effort);
template Measured uniforms_below_one<double>(Effort);
template Measured alias_table<float>(Effort);
template Measured alias_table<double>(Effort);
template Measured discrete_table<float>(Effort);
template Measured discrete_table<double>(Effort);
template Measured piecewise_constant<float>(Effort);
template Measured piecewise_constant<double>(Effort);
template Measured huge_tables<float>(Effort);
template Measured huge_tables<double>(Effort);

}  // namespace stability
