// Evidence against a null hypothesis that one may look at after every sample: an e-process. It is the capital of gamblers who
// begin with 1 and bet, at odds that are fair if the hypothesis holds, on what comes next. Then its expectation is at most 1
// whenever one stops, and it ever reaches 1 / alpha with probability alpha at most (Ville 1939). Each gambler knows one way in
// which the hypothesis may be wrong; the capital is their mean, so it costs a factor of their number to have many.
#pragma once

#include "lumis/core/platform.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

namespace detail {

// The logarithm of the mean of numbers given by their logarithms.
[[nodiscard]] inline double log_mean(std::span<const double> logs) noexcept {
    const double largest = *std::max_element(logs.begin(), logs.end());
    if (!std::isfinite(largest)) return largest;
    double sum = 0;
    for (const double log : logs) sum += std::exp(log - largest);
    return largest + std::log(sum / static_cast<double>(logs.size()));
}

// What gamblers make of a capital of 1 each. Products are kept beside their logarithms, which are taken now and then.
class Capitals {
  public:
    explicit Capitals(std::size_t gamblers) : products_(gamblers, 1.0), logs_(gamblers, 0.0) {}

    // returns(j): by which factor gambler j's capital grows in this round; between 1e-9 and 1e9, else what is lost or won is
    // taken for all there is.
    template <class Returns>
    void bet(const Returns& returns) noexcept {
        for (std::size_t j = 0; j < products_.size(); ++j) products_[j] *= returns(j);
        if (++rounds_ == 32) settle();
    }

    [[nodiscard]] double log_mean() noexcept {
        settle();
        return detail::log_mean(logs_);
    }

  private:
    void settle() noexcept {
        for (std::size_t j = 0; j < products_.size(); ++j) logs_[j] += std::log(std::exchange(products_[j], 1.0));
        rounds_ = 0;
    }

    std::vector<double> products_, logs_;
    int rounds_ = 0;
};

}  // namespace detail

// Against the hypothesis that samples fall into cells with the given probabilities. After n samples, of which n_k fell into
// cell k, a gambler with the Dirichlet prior of mean p and concentration c expects the next one there with probability
// (c p_k + n_k) / (c + n), and bets by that. The capital is the Dirichlet-multinomial likelihood over that of p:
// Gamma(c) / Gamma(c + n) product of Gamma(c p_k + n_k) / Gamma(c p_k) / p_k^n_k. Concentrations of K / d^2 in K cells look for
// deviations of about the share d of the cells' probabilities.
class CellEvidence {
  public:
    static constexpr double deviations[] = {1, 0.3, 0.1, 0.03};

    // Positive probabilities that sum to 1; a cell of probability 0 is taken for impossible.
    explicit CellEvidence(std::vector<double> probabilities)
        : probabilities_{std::move(probabilities)},
          over_expected_(probabilities_.size(), 0.0),
          capitals_{std::size(deviations)} {}

    void add(std::size_t cell) noexcept {
        if (!(probabilities_[cell] > 0)) impossible_ = true;
        if (impossible_) return;
        const double cells = static_cast<double>(probabilities_.size()), ratio = over_expected_[cell];
        capitals_.bet([&](std::size_t j) {
            const double c = cells / (deviations[j] * deviations[j]);
            return (c + ratio) / (c + samples_);
        });
        over_expected_[cell] += 1 / probabilities_[cell];
        ++samples_;
    }

    // Infinite once an impossible cell was drawn.
    [[nodiscard]] double log() noexcept {
        return impossible_ ? std::numeric_limits<double>::infinity() : capitals_.log_mean();
    }

  private:
    std::vector<double> probabilities_, over_expected_;  // n_k / p_k
    double samples_ = 0;
    bool impossible_ = false;
    detail::Capitals capitals_;
};

// Against the hypothesis that numbers of [low, high] have a mean within `error` of the answer, each given those before it.
// Half of the gamblers bet that the mean is larger: capitals grow by 1 + b (x - m), where b is fixed and 1 - b m stays positive;
// half bet that it is smaller (Waudby-Smith and Ramdas 2023, "Estimating means of bounded random variables by betting"). The
// fractions b halve from one to the next: the best of them is never off by more than sqrt(2), for any variance.
class MeanEvidence {
  public:
    MeanEvidence(double low, double high, double answer, double error = 0)
        : low_{low},
          width_{high - low},
          largest_{(answer + error - low) / width_},
          least_{(answer - error - low) / width_},
          capitals_{2 * fractions} {
        double fraction = boldest;
        for (std::size_t j = 0; j < fractions; ++j, fraction /= 2) {
            bets_.push_back(fraction / (std::max)(largest_, tiny));
            bets_.push_back(-fraction / (std::max)(1 - least_, tiny));
        }
    }

    // A number of [low, high].
    void add(double number) noexcept {
        const double x = (number - low_) / width_, over = x - largest_, under = x - least_;
        capitals_.bet([&](std::size_t j) { return 1 + bets_[j] * (j % 2 == 0 ? over : under); });
    }

    [[nodiscard]] double log() noexcept { return capitals_.log_mean(); }

  private:
    static constexpr std::size_t fractions = 16;
    static constexpr double boldest = 0.75;  // of what a gambler may lose in a round
    static constexpr double tiny = 1e-8;     // of the width: an answer as near to its bound

    double low_, width_, largest_, least_;  // the means that are not wrong, in [0, 1]
    std::vector<double> bets_;
    detail::Capitals capitals_;
};

}  // namespace lumis::LUMIS_ISA::testing
