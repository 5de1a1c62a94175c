#include "integral_study.hpp"

#include "one_dimensional.hpp"
#include "thread_clock.hpp"
#include <lumis/lumis.hpp>

#include <pcg_random.hpp>

#include <chrono>

namespace convergence {

namespace {

using Source = lumis::Uniforms<pcg64, double>;

// Runs estimators of one integral, one after another, and collects what comes out.
template <class F>
class Bench {
  public:
    Bench(Study& study, const F& f, double seconds, const Progress& progress)
        : study_{study}, f_{f}, seconds_{seconds}, progress_{progress} {}

    void run(const std::string& name, const auto& estimator, bool unbiased = true) const {
        Series series{name, unbiased, doubling_up_to(affordable_samples(estimator)), {}, {}};
        // Fewer than this the clock cannot time.
        std::erase_if(series.samples, [](std::int64_t n) { return n < 64; });
        for (const std::uint64_t seed : study_.seeds) {
            progress_(study_.name + ", " + name);
            series.runs.push_back(run(estimator, series.samples, seed));
        }
        study_.series.push_back(std::move(series));
    }

  private:
    // As many as fit in the time; finding out warms the machine up as well.
    std::int64_t affordable_samples(const auto& estimator) const {
        const std::int64_t trial = 1 << 14;
        const double seconds = run(estimator, {trial, 2 * trial}, 0).back().cpu_seconds;
        return std::max(std::int64_t{1024}, static_cast<std::int64_t>(2 * trial * seconds_ / seconds));
    }

    std::vector<Measurement> run(const auto& estimator, const std::vector<std::int64_t>& samples,
                                 std::uint64_t seed) const {
        std::vector<Measurement> measurements;
        Source uniforms{pcg64{seed}};
        double sum = 0, cpu_seconds = 0, wall_seconds = 0;
        std::int64_t done = 0;
        for (const std::int64_t n : samples) {
            const auto start = std::chrono::steady_clock::now();
            const tracer::ThreadClock clock;
            for (; done < n; ++done) sum += estimator.estimate(f_, uniforms);
            cpu_seconds += clock.seconds();
            wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            const double answer = *study_.reference.value;
            const double error = sum / static_cast<double>(n) - answer;
            measurements.push_back({cpu_seconds, wall_seconds, error * error, error * error / (answer * answer)});
        }
        return measurements;
    }

    Study& study_;
    const F& f_;
    double seconds_;
    const Progress& progress_;
};

Study closed_form(const std::string& name, const std::string& title, const std::string& description,
                  std::vector<std::string> strategies, double answer, const std::vector<std::uint64_t>& seeds) {
    Study study;
    study.name = name;
    study.title = title;
    study.description = description;
    study.strategies = std::move(strategies);
    study.reference = {"closed form", answer, 0, 0, {}};
    study.seeds = seeds;
    return study;
}

using lumis::choose;
using lumis::take;

Study step(const std::vector<std::uint64_t>& seeds, double seconds, const Progress& progress) {
    Study study = closed_form("step", "A step",
                              "8 below 0.9 and 80 above. The second technique sees only what lies above: alone it "
                              "converges to 8.",
                              {"uniform on [0, 1)", "uniform on [0.9, 1)"}, Step::integral, seeds);
    const Step f;
    const Bench bench{study, f, seconds, progress};
    const lumis::BalanceHeuristic balance;
    bench.run("technique 1", multi_sample(balance, take(1, everywhere)));
    bench.run("technique 2", multi_sample(balance, take(1, above)), false);
    bench.run("balance", multi_sample(balance, take(1, everywhere), take(1, above)));
    bench.run("power", multi_sample(lumis::PowerHeuristic{}, take(1, everywhere), take(1, above)));
    bench.run("one-sample", one_sample(balance, choose(0.5, everywhere), choose(0.5, above)));
    bench.run("average", multi_sample(lumis::EqualWeights{}, take(1, everywhere), take(1, above)));
    return study;
}

Study bumps(const std::vector<std::uint64_t>& seeds, double seconds, const Progress& progress) {
    Study study = closed_form("bumps", "Two bumps and a bad sampler",
                              "A broad and a narrow bump. The Gaussian fits the narrow one; where it meets the broad "
                              "one it is far too small, the estimate spikes, the more the longer it runs. Half a "
                              "constant density mixed in bounds f/p.",
                              {"Gaussian that is too narrow", "uniform on [0, 1)"}, TwoBumps::integral(), seeds);
    const TwoBumps f;
    const Bench bench{study, f, seconds, progress};
    const lumis::BalanceHeuristic balance;
    bench.run("bad sampler", multi_sample(balance, take(1, too_narrow)));
    bench.run("defensive",
              multi_sample(balance, take(1, lumis::Mixture{choose(0.5, too_narrow), choose(0.5, everywhere)})));
    bench.run("balance", multi_sample(balance, take(1, too_narrow), take(1, everywhere)));
    bench.run("power", multi_sample(lumis::PowerHeuristic{}, take(1, too_narrow), take(1, everywhere)));
    bench.run("one-sample", one_sample(balance, choose(0.5, too_narrow), choose(0.5, everywhere)));
    return study;
}

}  // namespace

std::vector<Study> integral_studies(const std::vector<std::uint64_t>& seeds, double seconds, const Progress& progress) {
    return {step(seeds, seconds, progress), bumps(seeds, seconds, progress)};
}

}  // namespace convergence
