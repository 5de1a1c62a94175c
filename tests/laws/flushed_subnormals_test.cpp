// Results where the processor flushes subnormal numbers to 0 (FTZ, DAZ), as hosts ask it to for speed and programs linked
// with -ffast-math do.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/combine/heuristics.hpp>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#ifdef __SSE2__

#include <xmmintrin.h>

namespace {

// While one lives, subnormal operands and results are 0 on this thread.
class FlushedSubnormals {
  public:
    FlushedSubnormals() noexcept : before_{_mm_getcsr()} { _mm_setcsr(before_ | flush_to_zero | denormals_are_zero); }
    ~FlushedSubnormals() { _mm_setcsr(before_); }
    FlushedSubnormals(const FlushedSubnormals&) = delete;
    FlushedSubnormals& operator=(const FlushedSubnormals&) = delete;

  private:
    static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    unsigned before_;
};

}  // namespace

TEMPLATE_TEST_CASE("flushed squares of densities change no weight", "[heuristics]", float, double) {
    using T = TestType;
    const FlushedSubnormals flushed;
    const auto check = [](const auto& heuristic) {
        const std::vector<T> p{1, T(3e-3), T(0.9), T(0.8), T(0.7), T(0.7), 0};
        constexpr int range = std::numeric_limits<T>::max_exponent;
        // The smallest density is a normal number at every scale.
        for (int exponent = 12 - range; exponent < range - 1; ++exponent) {
            auto scaled = p;
            for (T& density : scaled) density = std::ldexp(density, exponent);
            for (std::size_t i = 0; i < p.size(); ++i) {
                const T expected = lumis::mis_weight(heuristic, i, std::span<const T>{p});
                const T weight = lumis::mis_weight(heuristic, i, std::span<const T>{scaled});
                INFO("times 2^" << exponent);
                REQUIRE(std::abs(weight - expected) <= 2 * std::numeric_limits<T>::epsilon() * expected);
            }
        }
    };
    check(lumis::BalanceHeuristic{});
    check(lumis::PowerHeuristic{});
    check(lumis::PowerHeuristic{1.5});
    check(lumis::PowerHeuristic{5});
    check(lumis::MaximumHeuristic{});
    check(lumis::CutoffHeuristic{0.5});
    check(lumis::EqualWeights{});
}

#endif
