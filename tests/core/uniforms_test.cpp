#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/core/uniforms.hpp>
#include <lumis/statistics/running_moments.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <random>
#include <tuple>
#include <type_traits>

namespace {

// Few values, and not a power of two.
struct Die {
    using result_type = unsigned char;
    std::mt19937 engine{1};
    static constexpr result_type min() { return 1; }
    static constexpr result_type max() { return 6; }
    result_type operator()() { return static_cast<result_type>(1 + engine() % 6); }
};

struct Coin {
    using result_type = bool;
    std::mt19937 engine{1};
    static constexpr result_type min() { return false; }
    static constexpr result_type max() { return true; }
    result_type operator()() { return (engine() >> 16) % 2 != 0; }
};

// The extremes of a full word, which an adaptor that rounds turns into 1.
template <std::unsigned_integral Word, Word value>
struct Always {
    using result_type = Word;
    static constexpr Word min() { return 0; }
    static constexpr Word max() { return std::numeric_limits<Word>::max(); }
    Word operator()() { return value; }
};
template <std::unsigned_integral Word>
using AlwaysMax = Always<Word, std::numeric_limits<Word>::max()>;
template <std::unsigned_integral Word>
using AlwaysMin = Always<Word, 0>;

template <class T>
constexpr T below_one = 1 - std::numeric_limits<T>::epsilon() / 2;

}  // namespace

template <class T, class Engine>
void check_lattice() {
    static_assert(lumis::UniformSource<lumis::Uniforms<Engine, T>, T>);
    lumis::Uniforms<Engine, T> uniforms{Engine{}};
    lumis::RunningMoments<T> moments;
    bool in_range = true, on_lattice = true;
    int odd = 0;
    constexpr int draws = 50'000;
    for (int i = 0; i < draws; ++i) {
        for (const T u : {uniforms.template next<2>().x, uniforms.template next<1>().x}) {
            in_range = in_range && u >= 0 && u < 1;
            const T index = std::ldexp(u, lumis::uniform_bits<T>);
            on_lattice = on_lattice && index == std::floor(index);
            odd += std::fmod(index, T(2)) != 0;
            moments.add(u);
        }
    }
    CHECK(in_range);
    CHECK(on_lattice);
    constexpr double limit = 5;  // standard deviations: fails a fair source once in 1.7 million times
    CHECK(std::abs(odd - draws) <= limit * std::sqrt(draws / 2.0));  // the last bit is as fair as the others
    CHECK(std::abs(moments.mean() - 0.5) <= limit * std::sqrt(1 / 12.0 / (2 * draws)));
    // The variance of the squared deviation of a uniform number is 1/180.
    CHECK(std::abs(moments.variance() - 1 / 12.0) <= limit * std::sqrt(1 / 180.0 / (2 * draws)));
}

TEMPLATE_TEST_CASE("uniforms are lattice points below 1 whatever the generator", "[uniforms]", std::mt19937,
                   std::mt19937_64, std::minstd_rand, std::ranlux24, std::ranlux48, Die, Coin) {
    check_lattice<float, TestType>();
    check_lattice<double, TestType>();
}

TEMPLATE_TEST_CASE("the extremes of a generator are 0 and the last number below 1", "[uniforms]", float, double) {
    using T = TestType;
    const auto first = []<class Engine>(Engine engine) {
        return lumis::Uniforms<Engine, T>{engine}.template next<1>().x;
    };
    CHECK(first(AlwaysMax<std::uint8_t>{}) == below_one<T>);
    CHECK(first(AlwaysMax<std::uint16_t>{}) == below_one<T>);
    CHECK(first(AlwaysMax<std::uint32_t>{}) == below_one<T>);
    CHECK(first(AlwaysMax<std::uint64_t>{}) == below_one<T>);
    CHECK(first(AlwaysMin<std::uint8_t>{}) == 0);
    CHECK(first(AlwaysMin<std::uint16_t>{}) == 0);
    CHECK(first(AlwaysMin<std::uint32_t>{}) == 0);
    CHECK(first(AlwaysMin<std::uint64_t>{}) == 0);
}

TEST_CASE("an engine is used in place or owned", "[uniforms]") {
    std::mt19937 engine{5}, twin{5};
    lumis::Uniforms by_reference{engine};
    static_assert(std::is_same_v<decltype(by_reference), lumis::Uniforms<std::mt19937&, float>>);
    CHECK(by_reference.next<1>().x == std::ldexp(static_cast<float>(twin() >> 8), -24));
    CHECK(engine == twin);

    lumis::Uniforms owned{std::mt19937{5}};
    static_assert(std::is_same_v<decltype(owned), lumis::Uniforms<std::mt19937, float>>);
    std::mt19937 original{5};
    lumis::Uniforms<std::mt19937> copy{original};
    CHECK(owned.next<1>().x == copy.next<1>().x);
    CHECK(original == std::mt19937{5});
}

TEST_CASE("x is drawn first, and blocks continue one stream", "[uniforms]") {
    lumis::Uniforms a{std::mt19937{9}}, b{std::mt19937{9}};
    const auto block = a.next<4>();
    CHECK(block.x == b.next<1>().x);
    const auto middle = b.next<2>();
    CHECK(block.y == middle.x);
    CHECK(block.z == middle.y);
    CHECK(block.w == b.next<1>().x);

    double next = 0;
    auto counting = lumis::uniforms_from<double>([&next] { return next += 0.125; });
    CHECK(counting.next<3>() == glm::dvec3{0.125, 0.25, 0.375});
    CHECK(counting.next<1>().x == 0.5);
}

TEST_CASE("a host's numbers at or above 1 become the last number below", "[uniforms]") {
    const auto first = []<class T>(T, auto number) {
        auto uniforms = lumis::uniforms_from<T>([=] { return number; });
        static_assert(lumis::UniformSource<decltype(uniforms), T>);
        return uniforms.template next<1>().x;
    };
    CHECK(first(0.0f, 1.0f) == below_one<float>);
    CHECK(first(0.0f, 1 - 1e-12) == below_one<float>);  // rounds to 1 in float
    CHECK(first(0.0f, 2) == below_one<float>);
    CHECK(first(0.0, 1.0) == below_one<double>);
    CHECK(first(0.0, 1.0f) == below_one<double>);
    CHECK(first(0.0f, 0.75) == 0.75f);
    CHECK(first(0.0f, 0) == 0);
    CHECK(first(0.0f, std::numeric_limits<float>::quiet_NaN()) == below_one<float>);
}

TEMPLATE_TEST_CASE("lattice_index counts lattice points, and 1 is the last", "[uniforms]", float, double) {
    using T = TestType;
    constexpr std::uint64_t last = (std::uint64_t{1} << lumis::uniform_bits<T>)-1;
    STATIC_REQUIRE(lumis::lattice_index(T(0)) == 0);
    STATIC_REQUIRE(lumis::lattice_index(T(0.5)) == (last + 1) / 2);
    STATIC_REQUIRE(lumis::lattice_index(below_one<T>) == last);
    STATIC_REQUIRE(lumis::lattice_index(T(1)) == last);
    CHECK(lumis::lattice_index(std::ldexp(T(12345), -lumis::uniform_bits<T>)) == 12345);
    CHECK(lumis::lattice_index(std::ldexp(T(12345.5), -lumis::uniform_bits<T>)) == 12345);
}

TEST_CASE("what is not a source of uniforms is told apart", "[uniforms]") {
    STATIC_REQUIRE_FALSE(lumis::UniformSource<std::mt19937, float>);
    STATIC_REQUIRE_FALSE(lumis::UniformSource<float, float>);
    STATIC_REQUIRE(lumis::UniformSource<lumis::Uniforms<std::mt19937&, float>, float>);
}
