// Tables as books have them: float cumulative sums and std::upper_bound (Pharr, Jakob and Humphreys 2023, section A.5.4),
// alias bins with float probabilities (section A.1), and the environment map over them, with theta, phi and
// 1 / sin(theta) (2016, section 14.2.4).
#pragma once

#include <lumis/core/sample.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace textbook {

using lumis::Direction;
using lumis::LightSample;
using lumis::Sample;

template <std::floating_point T>
class PiecewiseConstant1D {
  public:
    explicit PiecewiseConstant1D(std::span<const T> weights)
        : function_(weights.begin(), weights.end()), cdf_(weights.size() + 1) {
        const auto n = static_cast<T>(weights.size());
        for (std::size_t i = 0; i < weights.size(); ++i) cdf_[i + 1] = cdf_[i] + function_[i] / n;
        integral_ = cdf_.back();
        for (std::size_t i = 1; i < cdf_.size(); ++i) cdf_[i] = integral_ > 0 ? cdf_[i] / integral_ : T(i) / n;
    }

    struct Draw {
        T position;  // in [0, 1]
        T pdf;
        std::size_t index;
    };

    [[nodiscard]] Draw sample(T u) const noexcept {
        const auto above = std::upper_bound(cdf_.begin(), cdf_.end(), u);
        const std::size_t index =
            std::clamp<std::size_t>(static_cast<std::size_t>(above - cdf_.begin()), 1, size()) - 1;
        const T width = cdf_[index + 1] - cdf_[index];
        const T within = width > 0 ? (u - cdf_[index]) / width : T(0);
        return {(static_cast<T>(index) + within) / static_cast<T>(size()), pdf(index), index};
    }

    [[nodiscard]] T pdf(std::size_t index) const noexcept {
        return integral_ > 0 ? function_[index] / integral_ : T(0);
    }
    [[nodiscard]] T value(std::size_t index) const noexcept { return function_[index]; }
    [[nodiscard]] T integral() const noexcept { return integral_; }
    [[nodiscard]] std::size_t size() const noexcept { return function_.size(); }

  private:
    std::vector<T> function_, cdf_;
    T integral_{};
};

// Row by row; u.y draws the row.
template <std::floating_point T>
class PiecewiseConstant2D {
  public:
    PiecewiseConstant2D(std::size_t width, std::size_t height, std::span<const T> weights)
        : conditional_{rows(width, height, weights)}, marginal_{integrals()} {}

    [[nodiscard]] Sample<glm::vec<2, T>, T> sample(glm::vec<2, T> u) const noexcept {
        const auto y = marginal_.sample(u.y);
        const auto x = conditional_[y.index].sample(u.x);
        return {{x.position, y.position}, x.pdf * y.pdf};
    }

    [[nodiscard]] T pdf(const glm::vec<2, T>& p) const noexcept {
        const auto index = [](T x, std::size_t size) {
            return std::min(static_cast<std::size_t>(x * static_cast<T>(size)), size - 1);
        };
        const auto& row = conditional_[index(p.y, conditional_.size())];
        return row.value(index(p.x, row.size())) / marginal_.integral();
    }

  private:
    static std::vector<PiecewiseConstant1D<T>> rows(std::size_t width, std::size_t height, std::span<const T> weights) {
        std::vector<PiecewiseConstant1D<T>> result;
        result.reserve(height);
        for (std::size_t y = 0; y < height; ++y) result.emplace_back(weights.subspan(y * width, width));
        return result;
    }
    [[nodiscard]] std::vector<T> integrals() const {
        std::vector<T> result;
        for (const auto& row : conditional_) result.push_back(row.integral());
        return result;
    }

    std::vector<PiecewiseConstant1D<T>> conditional_;
    PiecewiseConstant1D<T> marginal_;
};

// Row 0 at +y, v = acos(y) / pi, u = 1/2 + atan2(z, x) / (2 pi).
template <std::floating_point T>
class EnvironmentMap {
    static constexpr T pi = std::numbers::pi_v<T>;

  public:
    EnvironmentMap(std::size_t width, std::size_t height, std::span<const T> luminance)
        : table_{width, height, weighted(width, height, luminance)} {}

    [[nodiscard]] LightSample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const auto drawn = table_.sample(u);
        const T theta = pi * drawn.value.y, phi = 2 * pi * (drawn.value.x - T(0.5));
        const T sin_theta = std::sin(theta);
        if (drawn.pdf == 0 || sin_theta == 0) return {};
        return {{sin_theta * std::cos(phi), std::cos(theta), sin_theta * std::sin(phi)},
                drawn.pdf / (2 * pi * pi * sin_theta),
                std::numeric_limits<T>::infinity()};
    }

    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept {
        const T theta = std::acos(std::clamp(w.y, T(-1), T(1))), phi = std::atan2(w.z, w.x);
        const T sin_theta = std::sin(theta);
        if (sin_theta == 0) return 0;
        return table_.pdf({T(0.5) + phi / (2 * pi), theta / pi}) / (2 * pi * pi * sin_theta);
    }

  private:
    static std::vector<T> weighted(std::size_t width, std::size_t height, std::span<const T> luminance) {
        std::vector<T> result(luminance.begin(), luminance.end());
        for (std::size_t y = 0; y < height; ++y) {
            const T sine = std::sin(pi * (static_cast<T>(y) + T(0.5)) / static_cast<T>(height));
            for (std::size_t x = 0; x < width; ++x) result[y * width + x] *= sine;
        }
        return result;
    }

    PiecewiseConstant2D<T> table_;
};

template <std::floating_point T>
class AliasTable {
  public:
    explicit AliasTable(std::span<const T> weights) : bins_(weights.size()) {
        double sum = 0;
        for (const T weight : weights) sum += weight;
        struct Outcome {
            T p_hat;
            std::size_t index;
        };
        std::vector<Outcome> under, over;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            bins_[i].p = static_cast<T>(weights[i] / sum);
            const T p_hat = bins_[i].p * static_cast<T>(weights.size());
            (p_hat < 1 ? under : over).push_back({p_hat, i});
        }
        while (!under.empty() && !over.empty()) {
            const Outcome low = under.back(), high = over.back();
            under.pop_back(), over.pop_back();
            bins_[low.index].q = low.p_hat;
            bins_[low.index].alias = static_cast<std::uint32_t>(high.index);
            const T rest = low.p_hat + high.p_hat - 1;
            (rest < 1 ? under : over).push_back({rest, high.index});
        }
    }

    [[nodiscard]] Sample<std::size_t, T> sample(glm::vec<1, T> u) const noexcept {
        const T scaled = u.x * static_cast<T>(bins_.size());
        const std::size_t bin = std::min(static_cast<std::size_t>(scaled), bins_.size() - 1);
        const T within = std::min(scaled - static_cast<T>(bin), 1 - std::numeric_limits<T>::epsilon() / 2);
        const std::size_t index = within < bins_[bin].q ? bin : bins_[bin].alias;
        return {index, bins_[index].p};
    }

    [[nodiscard]] T pdf(std::size_t index) const noexcept { return bins_[index].p; }

  private:
    struct Bin {
        T q = 1, p = 0;
        std::uint32_t alias = 0;
    };
    std::vector<Bin> bins_;
};

}  // namespace textbook
