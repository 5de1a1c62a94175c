#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/combine/reservoir.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/core/measure.hpp>
#include <lumis/core/uniforms.hpp>
#include <lumis/testing/agreement.hpp>
#include <lumis/testing/chi_square.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>

namespace {

namespace laws = lumis::testing;
using lumis::Reservoir;

static_assert(std::is_trivially_copyable_v<Reservoir<lumis::LightSample<glm::vec3, float>>>);
static_assert(std::same_as<decltype(Reservoir<lumis::Sample<glm::dvec3, double>>{}.weight()), const double&>);

// Four items as a strategy over their indices, which is what the laws know.
template <class T, int N>
struct OfFour {
    using Scalar = T;
    using Point = std::size_t;
    using Measure = lumis::measure::Counting;
    static constexpr int dimensions = N;

    std::array<T, 4> weights;

    [[nodiscard]] T pdf(std::size_t i) const noexcept {
        return i < 4 ? weights[i] / (weights[0] + weights[1] + weights[2] + weights[3]) : T(0);
    }
    [[nodiscard]] lumis::Sample<std::size_t, T> drawn(const Reservoir<std::size_t, T>& kept) const noexcept {
        return {kept.item(), pdf(kept.item())};
    }
};

// One after the other.
template <class T>
struct Streamed : OfFour<T, 4> {
    [[nodiscard]] auto sample(const glm::vec<4, T>& u) const noexcept {
        Reservoir<std::size_t, T> kept;
        for (std::size_t i = 0; i < 4; ++i) kept.add(i, this->weights[i], u[static_cast<int>(i)]);
        return this->drawn(kept);
    }
};
// The same by a single uniform.
template <class T>
struct Reusing : OfFour<T, 1> {
    [[nodiscard]] auto sample(const glm::vec<1, T>& u) const noexcept {
        Reservoir<std::size_t, T> kept;
        T left = u.x;
        for (std::size_t i = 0; i < 4; ++i) kept.add_reusing(i, this->weights[i], left);
        return this->drawn(kept);
    }
};
// Two streams of two.
template <class T>
struct Merged : OfFour<T, 4> {
    [[nodiscard]] auto sample(const glm::vec<4, T>& u) const noexcept {
        Reservoir<std::size_t, T> kept, other;
        kept.add(0, this->weights[0], T(0.5));
        kept.add(1, this->weights[1], u.x);
        other.add(2, this->weights[2], u.y);
        other.add(3, this->weights[3], u.z);
        kept.merge(other, u.w);
        return this->drawn(kept);
    }
};

TEMPLATE_TEST_CASE("an item is kept in proportion to its weight", "[reservoir]", float, double) {
    using T = TestType;
    constexpr laws::ChiSquareOptions options{.significance = {0.01, 36}};
    for (const std::array<T, 4>& weights : {std::array<T, 4>{T(1), T(2), T(3), T(4)},
                                            {T(0), T(1), T(0), T(2)},
                                            {T(5), T(0), T(0), T(0)},
                                            {T(0), T(0), T(0), T(1e-30)},
                                            {T(1e30), T(3e30), T(1e28), T(2e30)},
                                            {T(1e-3), T(1), T(1e-3), T(1)}}) {
        CHECK(laws::chi_square(Streamed<T>{{weights}}, laws::index_chart(4), options));
        CHECK(laws::chi_square(Reusing<T>{{weights}}, laws::index_chart(4), options));
        CHECK(laws::chi_square(Merged<T>{{weights}}, laws::index_chart(4), options));
    }
}

TEST_CASE("a uniform that was reused is one again", "[reservoir]") {
    constexpr int points = 6000, cells = 10;
    std::array<std::array<int, cells>, 3> counts{};
    for (int k = 0; k < points; ++k) {
        double u = (k + 0.5) / points;
        Reservoir<std::size_t, double> kept;
        for (std::size_t i = 0; i < 3; ++i) kept.add_reusing(i, static_cast<double>(i + 1), u);
        ++counts[kept.item()][static_cast<std::size_t>(u * cells)];
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (const int count : counts[i]) CHECK(std::abs(count - 100 * static_cast<int>(i + 1)) <= 2);
    }
}

TEST_CASE("the sum of many small weights keeps its digits", "[reservoir]") {
    constexpr int many = 20'000'000;
    Reservoir<int> kept;
    for (int i = 0; i < many; ++i) kept.add(i, 0.1f, 0.9999f);
    CHECK(kept.count() == many);
    CHECK(std::abs(double{kept.total_weight()} / (many * double{0.1f}) - 1) <= 1e-7);

    Reservoir<int> both;
    for (int i = 0; i < 1000; ++i) both.merge(kept, 0.5f);
    CHECK(both.count() == std::uint64_t{many} * 1000);
    CHECK(std::abs(double{both.total_weight()} / (1000.0 * many * double{0.1f}) - 1) <= 1e-7);

    using Two = lumis::Lanes<float, 2>;
    Reservoir<Two, Two> lanes;
    for (int i = 0; i < many / 10; ++i) lanes.add(Two(0.0f), Two(0.1f), Two(0.9999f));
    CHECK(std::abs(double{lanes.total_weight()[1]} / (many / 10 * double{0.1f}) - 1) <= 1e-7);
}

// A share of 2^-30 is less than the steps of uniforms in float.
TEST_CASE("a double decides among many floats", "[reservoir]") {
    Reservoir<int> kept;
    kept.add(0, 1, 0.0);
    Reservoir<int> other = kept;
    CHECK(kept.add(1, 0x1p-30f, 0x1p-31));
    CHECK_FALSE(other.add(1, 0x1p-30f, 0x1p-29));
    CHECK(kept.inverse_probability() == 0x1p30f);
}

TEMPLATE_TEST_CASE("what is kept at the ends of weights and uniforms", "[reservoir]", float, double) {
    using T = TestType;
    constexpr T below_one = 1 - std::numeric_limits<T>::epsilon() / 2, tiny = 2 * (std::numeric_limits<T>::min)();
    Reservoir<int, T> kept;
    CHECK(kept.weight() == 0);
    CHECK(kept.inverse_probability() == 0);
    CHECK(kept.contribution_weight(1) == 0);

    // An item of weight 0 never is, and the first other is by any u.
    CHECK_FALSE(kept.add(1, 0, T(0)));
    CHECK_FALSE(kept.add(2, 0, T(1)));
    for (const T u : {T(0), T(0.5), below_one, T(1)}) {
        Reservoir<int, T> one = kept;
        CHECK(one.add(3, tiny, u));
        CHECK_FALSE(one.add(4, 0, T(0)));
        CHECK(one.item() == 3);
        CHECK(one.weight() == tiny);
        CHECK(one.inverse_probability() == 1);
        CHECK(one.contribution_weight(tiny * 4) == T(0.25));
        CHECK(one.contribution_weight(0) == 0);
        CHECK(one.count() == 4);
    }
    // Equal ones share evenly, on any scale.
    for (const T weight : {tiny, T(1e-30), T(1), std::ldexp((std::numeric_limits<T>::max)(), -3)}) {
        Reservoir<int, T> one;
        one.add(1, weight, T(0.5));
        Reservoir<int, T> other = one;
        CHECK(one.add(2, weight, T(0.5) - std::numeric_limits<T>::epsilon()));
        CHECK_FALSE(other.add(2, weight, T(0.5)));
        CHECK(one.inverse_probability() == 2);
        CHECK(other.inverse_probability() == 2);
    }
    // A weight beside which all others vanish is kept for certain, and one that vanishes never is.
    Reservoir<int, T> one;
    one.add(1, tiny, T(0));
    CHECK(one.add(2, 1, T(1)));
    CHECK_FALSE(one.add(3, tiny, T(0)));
    T u = 1;
    CHECK_FALSE(one.add_reusing(4, 1, u));
    CHECK(std::abs(u - 1) <= std::numeric_limits<T>::epsilon());
}

TEMPLATE_TEST_CASE("weights that are none count as 0", "[reservoir]", float, double) {
    using T = TestType;
    using Limits = std::numeric_limits<T>;
    for (const T wrong : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), T(-1), (Limits::max)()}) {
        Reservoir<int, T> kept;
        kept.add(1, 2, T(0));
        const CaughtAssertions caught;
        CHECK_FALSE(kept.add(2, wrong, T(0)));
        CHECK(caught.count() == 1);
        CHECK(kept.item() == 1);
        CHECK(kept.total_weight() == 2);
        CHECK(kept.count() == 2);
    }
}

// Every lane is a reservoir of its own.
TEST_CASE("reservoirs in lanes", "[reservoir]") {
    using Four = lumis::Lanes<float, 4>;
    using Item = lumis::LightSample<lumis::Direction<Four>, Four>;
    lumis::Uniforms<std::mt19937_64, float> uniforms{std::mt19937_64{6}};
    const auto next = [&] { return Four::of_lanes([&](auto) { return uniforms.next<1>().x; }); };
    Reservoir<Item> lanes, merged;
    std::array<Reservoir<float>, 4> numbers, numbers_merged;
    for (int i = 0; i < 100; ++i) {
        const Item item{{next(), next(), next()}, next(), next()};
        const Four weight = Four::select(next() < 0.3f, Four(0.0f), next()), u = next();
        const auto selected = lanes.add(item, weight, u);
        for (std::size_t k = 0; k < 4; ++k) CHECK(numbers[k].add(item.value.y[k], weight[k], u[k]) == selected[k]);
        if (i % 10 < 9) continue;
        const Four v = next();
        merged.merge(lanes, v);
        for (std::size_t k = 0; k < 4; ++k) numbers_merged[k].merge(numbers[k], v[k]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(lanes.item().value.y[k] == numbers[k].item());
        CHECK(std::abs(lanes.total_weight()[k] / numbers[k].total_weight() - 1) <= 1e-6f);
        CHECK(std::abs(lanes.inverse_probability()[k] / numbers[k].inverse_probability() - 1) <= 1e-6f);
        CHECK(merged.item().value.y[k] == numbers_merged[k].item());
        CHECK(merged.weight()[k] == numbers_merged[k].weight());
    }
    CHECK(merged.count() == 550);
}

}  // namespace
