// A problem: an integral, its answer, and the estimators that compete for it. A file in problems/ states one and
// registers it; measuring, statistics and output are the program's.
#pragma once

#include "learning.hpp"
#include "study.hpp"
#include <lumis/combine/heuristics.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/qmc/sobol.hpp>

#include <pcg_random.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace convergence {

// Random numbers, drawn many at a time.
class RandomNumbers {
  public:
    explicit RandomNumbers(std::uint64_t seed, std::uint64_t stream = 0);

    template <int N>
    [[nodiscard]] glm::vec<N, double> next() {
        if (next_ + N > numbers_.size()) refill();
        glm::vec<N, double> u;
        for (int i = 0; i < N; ++i) u[i] = numbers_[next_++];
        return u;
    }

  private:
    void refill();

    lumis::Uniforms<pcg64, double> source_;
    std::array<double, 256> numbers_;
    std::size_t next_ = numbers_.size();
};

struct Answer {
    double value;
    double error = 0;  // by how much the value may be off: 0 if it is exact
    std::string source = "closed form";
};

template <class S>
struct Technique {
    std::string name;
    S strategy;
    bool sees_all = true;  // false if it never draws some points where the integrand is not 0: alone it is wrong
};

template <class S>
Technique(std::string, S, bool = true) -> Technique<S>;

// Who is responsible for which point: owner(x) is the index of a technique.
template <class Owner>
struct Partition {
    Owner owner;
};
template <class Owner>
Partition(Owner) -> Partition<Owner>;

struct Competitor {
    std::string name;
    bool unbiased;
    Recipe recipe;
    std::shared_ptr<const void> entrants;
    void (*run_)(const void* entrants, const Recipe&, std::span<double> sums, std::int64_t count, RandomNumbers&);
    // The estimates of a sum are made together, from points or weights that depend on how many they are: a run of a length is not
    // the sum of shorter ones, and is measured by itself.
    bool is_whole = false;

    // Each sum becomes that of `count` estimates.
    void run(std::span<double> sums, std::int64_t count, RandomNumbers& uniforms) const {
        run_(entrants.get(), recipe, sums, count, uniforms);
    }
};

namespace detail {

// An integrand and its strategies: what all estimators of a problem share, because an estimator refers to a strategy
// that owns memory. The estimators are composed where they run, from counts or probabilities known only there.
template <class F, class... S>
struct Entrants {
    F f;
    std::tuple<S...> strategies;

    static void add_up(const auto& estimator, const F& f, std::span<double> sums, std::int64_t count,
                       RandomNumbers& uniforms) {
        for (double& sum : sums) {
            sum = 0;
            for (std::int64_t i = 0; i < count; ++i) sum += estimator.estimate(f, uniforms);
        }
    }

    template <std::size_t I>
    static void alone(const void* entrants, const Recipe&, std::span<double> sums, std::int64_t count,
                      RandomNumbers& uniforms) {
        const auto& [f, strategies] = *static_cast<const Entrants*>(entrants);
        const auto& strategy = std::get<I>(strategies);
        add_up(multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, strategy)), f, sums, count, uniforms);
    }

    template <class Heuristic>
    static void all(const void* entrants, const Recipe& recipe, std::span<double> sums, std::int64_t count,
                    RandomNumbers& uniforms) {
        const auto& [f, strategies] = *static_cast<const Entrants*>(entrants);
        all(Heuristic{}, f, strategies, std::index_sequence_for<S...>{}, recipe, sums, count, uniforms);
    }

    template <std::size_t... I>
    static void all(const auto& heuristic, const F& f, const auto& strategies, std::index_sequence<I...>,
                    const Recipe& recipe, std::span<double> sums, std::int64_t count, RandomNumbers& uniforms) {
        if (recipe.counts.empty()) {
            add_up(one_sample(heuristic, lumis::choose(recipe.probabilities[I], std::get<I>(strategies))...), f, sums,
                   count, uniforms);
        } else {
            add_up(multi_sample(heuristic, lumis::take(recipe.counts[I], std::get<I>(strategies))...), f, sums, count,
                   uniforms);
        }
    }

    // Power with the first points of Sobol's sequence, scrambled anew for each sum.
    static void by_sobol(const void* entrants, const Recipe&, std::span<double> sums, std::int64_t count,
                         RandomNumbers& uniforms) {
        const auto& [f, strategies] = *static_cast<const Entrants*>(entrants);
        const auto once_each = [](const auto&... strategy) {
            return multi_sample(lumis::PowerHeuristic{}, lumis::take(1, strategy)...);
        };
        const auto estimator = std::apply(once_each, strategies);
        for (double& sum : sums) {
            lumis::Sobol<double> points{lumis::lattice_index(uniforms.next<1>().x)};
            sum = 0;
            for (std::int64_t i = 0; i < count; ++i) {
                points.start(static_cast<std::uint32_t>(i));
                sum += estimator.estimate(f, points);
            }
        }
    }
};

// The same with a partition.
template <class Owner, class F, class... S>
struct Divided {
    Owner owner;
    Entrants<F, S...> entrants;

    static void all(const void* divided, const Recipe& recipe, std::span<double> sums, std::int64_t count,
                    RandomNumbers& uniforms) {
        const auto& [owner, entrants] = *static_cast<const Divided*>(divided);
        Entrants<F, S...>::all(lumis::PartitionWeights<Owner>{owner}, entrants.f, entrants.strategies,
                               std::index_sequence_for<S...>{}, recipe, sums, count, uniforms);
    }
};

}  // namespace detail

struct Problem {
    std::string group, title, description;
    Answer answer;
    std::vector<std::string> strategies{};
    std::vector<Competitor> competitors{};

    // Each technique alone, all of them combined in every way, see combine(), power with Sobol's points, and what
    // learns from samples.
    template <class F, class... S>
    Problem& compare(const F& f, const Technique<S>&... techniques) {
        (strategies.push_back(techniques.name), ...);
        using Entrants = detail::Entrants<F, S...>;
        const std::shared_ptr<const void> entrants{new Entrants{f, {techniques.strategy...}}};
        add_alone<Entrants>(entrants, std::index_sequence_for<S...>{}, techniques...);
        combine("balance", sizeof...(S), entrants, Entrants::template all<lumis::BalanceHeuristic>);
        combine("power", sizeof...(S), entrants, Entrants::template all<lumis::PowerHeuristic>);
        combine("maximum", sizeof...(S), entrants, Entrants::template all<lumis::MaximumHeuristic>);
        combine("cutoff", sizeof...(S), entrants, Entrants::template all<lumis::CutoffHeuristic>);
        combine("average", sizeof...(S), entrants, Entrants::template all<lumis::EqualWeights>);
        const std::vector<int> once_each(sizeof...(S), 1);
        competitors.push_back({"sobol", true, {"sobol", "power", once_each, {}}, entrants, Entrants::by_sobol, true});
        compete("optimal", true, {"optimal", {}, once_each, {}}, OptimalWeights<F, S...>{f, {techniques.strategy...}},
                true);
        compete("allocated", true, {"allocated", "balance", {}, {}},
                AllocatedSamples<F, S...>{f, {techniques.sees_all...}, techniques.strategy...});
        return *this;
    }

    // The same, and the split by a partition.
    template <class F, class Owner, class... S>
    Problem& compare(const F& f, const Partition<Owner>& partition, const Technique<S>&... techniques) {
        compare(f, techniques...);
        using Divided = detail::Divided<Owner, F, S...>;
        combine("partition", sizeof...(S),
                std::shared_ptr<const void>{new Divided{partition.owner, {f, {techniques.strategy...}}}}, Divided::all);
        return *this;
    }

    // An estimator that none of the above is: runner(sums, count, uniforms) makes each of the sums that of `count` estimates.
    // What it has to find out before it estimates belongs into that call, and so into the time. recipe.model is a word for
    // what it does ("resampled"); a plot has room for it.
    // is_whole: see Competitor.
    template <class Runner>
    Problem& compete(const std::string& competitor, bool unbiased, const Recipe& recipe, const Runner& runner,
                     bool is_whole = false) {
        const auto run = [](const void* made, const Recipe&, std::span<double> sums, std::int64_t count,
                            RandomNumbers& uniforms) { (*static_cast<const Runner*>(made))(sums, count, uniforms); };
        competitors.push_back(
            {competitor, unbiased, recipe, std::shared_ptr<const void>{new Runner{runner}}, run, is_whole});
        return *this;
    }

    // One technique more, by itself.
    template <class F, class S>
    Problem& alone(const F& f, const Technique<S>& technique) {
        using Entrants = detail::Entrants<F, S>;
        add_alone<Entrants>(std::shared_ptr<const void>{new Entrants{f, {technique.strategy}}},
                            std::index_sequence<0>{}, technique);
        return *this;
    }

  private:
    template <class Entrants, std::size_t... I>
    void add_alone(const std::shared_ptr<const void>& entrants, std::index_sequence<I...>, const auto&... techniques) {
        (competitors.push_back(
             {techniques.name, techniques.sees_all, {"alone"}, entrants, Entrants::template alone<I>}),
         ...);
    }

    // A heuristic with counts 1:1, 1:4 and 4:1, and with one technique selected: the first with probability 0.5, 0.1
    // and 0.9. The second count, and the rest of the probability in equal parts, are those of all other techniques.
    // Names leave out what is usual: power, power 1:4, one-sample power 0.1, and one-sample for balance and a half.
    void combine(const std::string& heuristic, std::size_t techniques, const std::shared_ptr<const void>& entrants,
                 decltype(Competitor::run_) run);
};

// A static object of this type makes a problem known to the program by a name: letters, digits, - and _.
struct Registered {
    Registered(const std::string& name, const std::function<Problem()>& make);
};

struct Entry {
    std::string name;
    std::function<Problem()> make;
};
[[nodiscard]] std::span<const Entry> registered_problems();

}  // namespace convergence
