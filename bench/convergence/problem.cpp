#include "problem.hpp"

#include "paths/random_stream.hpp"

#include <sstream>

namespace convergence {

namespace {

// Made by the first that registers: the order in which files are initialised is not known.
std::vector<Entry>& entries() {
    static std::vector<Entry> all;
    return all;
}

}  // namespace

RandomNumbers::RandomNumbers(std::uint64_t seed, std::uint64_t stream)
    : source_{tracer::random_stream<pcg64>(seed, stream)} {}

void RandomNumbers::refill() {
    for (double& number : numbers_) number = source_.next<1>().x;
    next_ = 0;
}

void Problem::combine(const std::string& heuristic, std::size_t techniques, const std::shared_ptr<const void>& entrants,
                      decltype(Competitor::run_) run) {
    for (const auto& [first, others] : {std::pair{1, 1}, {1, 4}, {4, 1}}) {
        std::vector<int> counts(techniques, others);
        counts.front() = first;
        std::ostringstream name;
        name << heuristic;
        if (first != others) name << ' ' << first << ':' << others;
        competitors.push_back({name.str(), true, {"multi-sample", heuristic, counts, {}}, entrants, run});
    }
    for (const double first : {0.5, 0.1, 0.9}) {
        std::vector<double> probabilities(techniques, (1 - first) / static_cast<double>(techniques - 1));
        probabilities.front() = first;
        std::ostringstream name;
        name << "one-sample";
        if (heuristic != "balance") name << ' ' << heuristic;
        if (first != 0.5) name << ' ' << first;
        competitors.push_back({name.str(), true, {"one-sample", heuristic, {}, probabilities}, entrants, run});
    }
}

Registered::Registered(const std::string& name, const std::function<Problem()>& make) {
    entries().push_back({name, make});
}

std::span<const Entry> registered_problems() {
    return entries();
}

}  // namespace convergence
