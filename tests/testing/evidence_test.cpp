// Evidence is fair: whatever comes of sequences that are as likely as the hypothesis says, its mean is 1.
#include "catch.hpp"
#include <lumis/testing/evidence.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace {

namespace laws = lumis::testing;

// The mean of evidence over all sequences of `length` symbols with the given probabilities, each sequence by itself.
template <std::size_t N, class Evidence, class Add>
double mean_evidence(const std::array<double, N>& probabilities, int length, const Evidence& fresh, const Add& add) {
    double mean = 0, sequences = std::pow(N, length);
    for (double n = 0; n < sequences; ++n) {
        Evidence evidence = fresh;
        double probability = 1, rest = n;
        for (int i = 0; i < length; ++i, rest = std::floor(rest / N)) {
            const auto symbol = static_cast<std::size_t>(std::fmod(rest, N));
            probability *= probabilities[symbol];
            add(evidence, symbol);
        }
        mean += probability * std::exp(evidence.log());
    }
    return mean;
}

// log of Gamma(c) / Gamma(c + n) product of Gamma(c p + n_k) / Gamma(c p) / p^n_k.
double dirichlet_multinomial(double c, const std::vector<double>& p, const std::vector<double>& counts) {
    double log = std::lgamma(c), n = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        log += std::lgamma(c * p[k] + counts[k]) - std::lgamma(c * p[k]) - counts[k] * std::log(p[k]);
        n += counts[k];
    }
    return log - std::lgamma(c + n);
}

}  // namespace

TEST_CASE("evidence about cells is fair", "[laws]") {
    const std::array probabilities{0.6, 0.3, 0.1};
    const laws::CellEvidence fresh{{0.6, 0.3, 0.1}};
    const auto add = [](auto& evidence, std::size_t cell) { evidence.add(cell); };
    for (const int length : {1, 4, 8}) {
        CHECK(std::abs(mean_evidence(probabilities, length, fresh, add) - 1) <= 1e-12);
    }
    // It is not if other cells are as likely as they are: there is something to win.
    CHECK(mean_evidence(std::array{0.1, 0.3, 0.6}, 8, fresh, add) > 1.5);
}

TEST_CASE("evidence about cells is a ratio of likelihoods", "[laws]") {
    const std::vector p{0.05, 0.2, 0.25, 0.5}, counts{20.0, 15.0, 4.0, 61.0};
    laws::CellEvidence evidence{p};
    for (std::size_t cell = 0; cell < p.size(); ++cell) {
        for (int i = 0; i < counts[cell]; ++i) evidence.add(cell);
    }
    std::vector<double> logs;
    for (const double d : laws::CellEvidence::deviations) logs.push_back(dirichlet_multinomial(4 / (d * d), p, counts));
    CHECK(std::abs(evidence.log() - laws::detail::log_mean(logs)) <= 1e-9);
}

TEST_CASE("a sample where none can be is all the evidence one needs", "[laws]") {
    laws::CellEvidence evidence{{0.5, 0.5, 0}};
    for (int i = 0; i < 100; ++i) evidence.add(static_cast<std::size_t>(i % 2));
    CHECK(evidence.log() < 0);
    evidence.add(2);
    evidence.add(0);
    CHECK(evidence.log() == std::numeric_limits<double>::infinity());
}

TEST_CASE("evidence about means is fair, whatever their bound", "[laws]") {
    const std::array probabilities{0.5, 0.3, 0.2};
    for (const auto& bound : {std::array{0.0, 1.0}, std::array{-3.0, 50.0}}) {
        const double low = bound[0], high = bound[1];
        const std::array numbers{low, low + 0.25 * (high - low), high};
        const double mean = 0.5 * numbers[0] + 0.3 * numbers[1] + 0.2 * numbers[2];
        const auto add = [&](auto& evidence, std::size_t symbol) { evidence.add(numbers[symbol]); };
        const auto of = [&](double answer, double error) {
            return mean_evidence(probabilities, 8, laws::MeanEvidence{low, high, answer, error}, add);
        };
        INFO(low << " to " << high);
        CHECK(std::abs(of(mean, 0) - 1) <= 1e-12);
        // An answer that is off by no more than its error is not told from one that is right.
        const double off = 0.1 * (high - low);
        CHECK(of(mean + off, off) < 1);
        CHECK(of(mean - off, off) < 1);
        CHECK(of(mean + off, 0) > 1.01);
        CHECK(of(mean - off, 0) > 1.01);
    }
}

TEST_CASE("capital stays positive, and finite where the answer is at a bound", "[laws]") {
    for (const double answer : {0.0, 1e-12, 0.5, 1.0}) {
        for (const double number : {0.0, 0.5, 1.0}) {
            laws::MeanEvidence evidence{0, 1, answer};
            for (int i = 0; i < 40; ++i) evidence.add(number);
            INFO(number << " for " << answer);
            CHECK((std::abs(number - answer) <= 1e-9 ? evidence.log() <= 1e-6 : evidence.log() > 5));
            CHECK(evidence.log() > -10);
        }
    }
}
