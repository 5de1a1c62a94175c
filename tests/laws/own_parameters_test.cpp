// Lanes that each have their own parameters: lane i of a strategy made of lanes is the strategy made of lane i's numbers,
// whatever the lanes beside it are made of. Parameters are wrong and degenerate in some lanes: there assertions fail, and
// nothing is drawn.
#include "assertions.hpp"
#include "catch.hpp"
#include "lane_subjects.hpp"
#include "subject.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/agreement.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using lumis::Direction;

using lumis::detail::lane_of;
using subjects::fused;  // numbers in other ways than lanes, which grazing views magnify

// Lanes of which each is made of its own numbers.
template <class L, std::size_t K>
std::array<L, K> joined(const std::array<std::array<typename L::Lane, K>, L::size>& of_lane) {
    std::array<L, K> result;
    for (std::size_t k = 0; k < K; ++k) {
        for (std::size_t i = 0; i < L::size; ++i) result[k].set(i, of_lane[i][k]);
    }
    return result;
}

template <class Made, class T, std::size_t N>
class Comparison {
    using L = lumis::Lanes<T, N>;
    static constexpr std::size_t K = Made::parameters;

  public:
    explicit Comparison(unsigned seed) : engine_{seed} {}

    void run() {
        std::array<std::array<T, K>, N> numbers;
        std::vector<std::array<T, K>> degenerate = Made::template degenerate<T>();
        for (auto& of_lane : numbers) {
            of_lane = uniform_(engine_) < T(0.4) ? degenerate[engine_() % degenerate.size()]
                                                 : Made::template random<T>(engine_);
        }
        const CaughtAssertions caught;
        const auto lanes = Made::make(joined<L>(numbers));
        lumis::UniformsOf<decltype(lanes)> u;
        Direction<L> anywhere;
        for (std::size_t i = 0; i < N; ++i) {
            for (int k = 0; k < u.length(); ++k) u[k].set(i, uniform());
            const auto w = subjects::random_unit<T>(engine_);
            anywhere.x.set(i, w.x), anywhere.y.set(i, w.y), anywhere.z.set(i, w.z);
        }
        const auto drawn = lanes.sample(u);
        const auto pdf_drawn = lanes.pdf(drawn.value), pdf_anywhere = lanes.pdf(anywhere);
        for (std::size_t i = 0; i < N; ++i) {
            INFO("lane " << i << " made of " << text(numbers[i]) << "; u.x = " << u.x[i] << ", u.y = " << u.y[i]);
            const auto single = Made::make(numbers[i]);
            const auto one = single.sample(lane_of(u, i));
            drawn_ += one.pdf > 0;
            const auto w = lane_of(drawn.value, i);
            REQUIRE(is_finite(w));
            if (one.pdf == 0 || drawn.pdf[i] == 0) {
                REQUIRE(drawn.pdf[i] == one.pdf);
            } else {
                for (int k = 0; k < 3; ++k) REQUIRE(std::abs(w[k] - one.value[k]) <= directions * epsilon);
                require_density(single, one.value, drawn.pdf[i], one.pdf);
                if constexpr (requires { one.distance; }) require_same(drawn.distance[i], one.distance);
                if constexpr (requires { single.invert(w); }) {
                    require_inverse(lane_of(lanes.invert(drawn.value), i), single.invert(w), u.x[i]);
                }
            }
            require_density(single, w, pdf_drawn[i], single.pdf(w));
            require_density(single, lane_of(anywhere, i), pdf_anywhere[i], single.pdf(lane_of(anywhere, i)));
            if constexpr (requires { single.distance_along(w); }) {
                require_distance(lanes.distance_along(drawn.value)[i], single.distance_along(w));
                require_distance(lanes.distance_along(anywhere)[i], single.distance_along(lane_of(anywhere, i)));
            }
        }
    }

    // How many samples were there.
    [[nodiscard]] int drawn() const { return drawn_; }

  private:
    static constexpr T epsilon = std::numeric_limits<T>::epsilon();
    static constexpr T directions = fused ? 4096 : 2, rounding = fused ? 65'536 : 4;  // in units of epsilon

    static bool is_finite(const Direction<T>& w) { return std::isfinite(w.x + w.y + w.z); }
    static void require_same(T a, T b) { REQUIRE((a == b || std::abs(a - b) <= rounding * epsilon * std::abs(b))); }

    // Where products are fused, rounding may decide whether an edge is met.
    static void require_distance(T a, T b) {
        if (!(fused && std::isinf(a) != std::isinf(b))) require_same(a, b);
    }

    // The same up to rounding or, where products are fused, some density that is found within the direction's rounding.
    static void require_density(const auto& single, const Direction<T>& w, T a, T b) {
        if (fused && !(std::abs(a - b) <= rounding * epsilon * b)) {
            const auto [low, high] = lumis::testing::detail::density_range(single, w, directions * epsilon);
            REQUIRE(low * (1 - rounding * epsilon) <= a);
            REQUIRE(a <= (high + (high - low) / 32) * (1 + rounding * epsilon));
        } else {
            require_same(a, b);
        }
    }

    // A turn may be 0 or 1. Near the pole of a map, which is at 0, rounding makes any turn.
    static void require_inverse(const glm::vec<2, T>& a, const glm::vec<2, T>& b, T from_pole) {
        const T allowed = rounding * epsilon;
        if (fused && from_pole < T(0.05)) return;
        REQUIRE((std::abs(a.x - b.x) <= allowed && std::abs(std::remainder(a.y - b.y, T(1))) <= allowed));
    }

    static std::string text(const auto& numbers_of_lane) {
        std::string result;
        for (const T x : numbers_of_lane) result += ' ' + Catch::Detail::stringify(x);
        return result;
    }

    // Next to 1 maps may turn the rounding of a fused product into any direction.
    T uniform() {
        const T u = uniform_(engine_), last = fused ? T(0.95) : 1 - epsilon / 2;
        return u < T(0.05) ? T(0) : u > T(0.95) ? last : u;
    }

    std::mt19937 engine_;
    std::uniform_real_distribution<T> uniform_{0, 1};
    int drawn_ = 0;
};

template <class Made, class T, std::size_t N>
void compare() {
    constexpr int trials = 500;
    Comparison<Made, T, N> comparison{1};
    for (int i = 0; i < trials; ++i) comparison.run();
    CHECK(comparison.drawn() > trials * static_cast<int>(N) / 4);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("lanes with their own parameters agree with numbers", "[own_parameters]",
                        subjects::WithOwnParameters) {
    compare<TestType, float, lumis::NativeLanes<float>::size>();
    compare<TestType, double, lumis::NativeLanes<double>::size>();
}
