// The equations that optimal weights solve (Kondapaneni et al. 2019, "Optimal Multiple Importance Sampling"): A alpha = b with
// A_ik = integral of p_i p_k / S and b_i = integral of f p_i / S, both as sums over samples. S = sum n_k p_k, and S = sum c_k p_k
// in the one-sample model.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <array>
#include <cstddef>

namespace lumis::LUMIS_ISA::detail {

// A symmetric matrix, its lower triangle row by row.
template <std::size_t K>
struct Symmetric {
    std::array<double, K*(K + 1) / 2> entries{};

    [[nodiscard]] LUMIS_HD constexpr double& operator()(std::size_t i, std::size_t k) noexcept {
        return entries[index(i, k)];
    }
    [[nodiscard]] LUMIS_HD constexpr double operator()(std::size_t i, std::size_t k) const noexcept {
        return entries[index(i, k)];
    }

  private:
    [[nodiscard]] LUMIS_HD static constexpr std::size_t index(std::size_t i, std::size_t k) noexcept {
        return i >= k ? i * (i + 1) / 2 + k : k * (k + 1) / 2 + i;
    }
};

// Wide is double, or a glm::vec of doubles: each component has a right-hand side and a solution of its own.
template <class Wide, std::size_t K>
struct NormalEquations {
    Symmetric<K> a;                   // sums of q_i q_k, where q_k = p_k / S at a sample
    std::array<Wide, K> b{};          // sums of g q_i, where g = f / S
    std::array<double, K> factors{};  // sums of n_k or c_k over rounds

    LUMIS_INLINE constexpr void add_sample(const Wide& g, const std::array<double, K>& q) noexcept {
        for (std::size_t i = 0; i < K; ++i) {
            for (std::size_t k = 0; k <= i; ++k) a(i, k) += q[i] * q[k];
            b[i] += g * q[i];
        }
    }

    LUMIS_INLINE constexpr void add(const NormalEquations& other) noexcept {
        for (std::size_t i = 0; i < a.entries.size(); ++i) a.entries[i] += other.a.entries[i];
        for (std::size_t i = 0; i < K; ++i) {
            b[i] += other.b[i];
            factors[i] += other.factors[i];
        }
    }

    // alpha, given the number of rounds. A technique whose density is 0 at all samples has 0.
    //
    // alpha in proportion to n leaves the balance heuristic's estimate as it is. The multiple that fits best is taken first,
    // and the equations are solved for what it leaves, with a ridge on the matrix scaled to a diagonal of ones: 1 / the number
    // of samples. So a few samples yield weights near balance, and a singular matrix (two techniques alike) does no harm.
    [[nodiscard]] LUMIS_HD constexpr std::array<Wide, K> solution(double rounds) const noexcept {
        if (!(rounds > 0)) return {};
        std::array<double, K> n{}, image{};  // n_k or c_k, the mean over rounds; A n
        double samples = 0;                  // n . A n, for n . q is 1
        Wide fit{};
        for (std::size_t k = 0; k < K; ++k) n[k] = factors[k] / rounds;
        for (std::size_t i = 0; i < K; ++i) {
            for (std::size_t k = 0; k < K; ++k) image[i] += a(i, k) * n[k];
            samples += n[i] * image[i];
            fit += b[i] * n[i];
        }
        if (!(samples > 0)) return {};
        fit *= 1 / samples;

        // A + ridge = L D L^T; x is first L^-1 times the right-hand side.
        std::array<std::array<double, K>, K> l{}, l_d{};
        std::array<double, K> inverse_d{};
        std::array<Wide, K> x{};
        for (std::size_t i = 0; i < K; ++i) {
            double d = a(i, i) * (1 + 1 / samples);
            x[i] = b[i] - fit * image[i];
            for (std::size_t k = 0; k < i; ++k) {
                l_d[i][k] = a(i, k);
                for (std::size_t j = 0; j < k; ++j) l_d[i][k] -= l[i][j] * l_d[k][j];
                l[i][k] = l_d[i][k] * inverse_d[k];
                d -= l[i][k] * l_d[i][k];
                x[i] -= x[k] * l[i][k];
            }
            inverse_d[i] = real::quotient_where(d > lost_digits * a(i, i), 1.0, d);
        }
        for (std::size_t i = K; i-- > 0;) {
            x[i] *= inverse_d[i];
            for (std::size_t k = i + 1; k < K; ++k) x[i] -= x[k] * l[k][i];
        }
        for (std::size_t i = 0; i < K; ++i) {
            if (a(i, i) > 0) x[i] += fit * n[i];
        }
        return x;
    }

  private:
    // A pivot below this share of its diagonal entry is rounding; the ridge alone is more, up to 1e14 samples.
    static constexpr double lost_digits = 1e-14;
};

}  // namespace lumis::LUMIS_ISA::detail
