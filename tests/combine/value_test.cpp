// What an estimate is: of the type that the integrand returns, whatever a host makes of zeros, products and sums.
#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/microfacets/perfect_reflection.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace {

using glm::vec3;
using lumis::choose;
using lumis::take;

// As hosts have them: the default constructor leaves the bands to whoever sets them next.
class Spectrum {
  public:
    Spectrum() : bands_{1e9f, 1e9f} {}
    Spectrum(float first, float second) : bands_{first, second} {}
    [[nodiscard]] float operator[](std::size_t i) const { return bands_[i]; }
    friend Spectrum operator+(const Spectrum& a, const Spectrum& b) { return {a[0] + b[0], a[1] + b[1]}; }
    friend Spectrum operator*(const Spectrum& a, float s) { return {a[0] * s, a[1] * s}; }

  private:
    float bands_[2];
};

// Neither literal nor of a fixed size, and a class template.
template <class T>
struct Bands {
    std::vector<T> numbers;
    explicit Bands(std::vector<T> v) : numbers{std::move(v)} {}
    friend Bands operator+(const Bands& a, const Bands& b) {
        Bands sum = a;
        for (std::size_t i = 0; i < sum.numbers.size(); ++i) sum.numbers[i] += b.numbers[i];
        return sum;
    }
    friend Bands operator*(const Bands& a, T s) {
        Bands product = a;
        for (T& number : product.numbers) number *= s;
        return product;
    }
};

// Products and sums are expressions that refer to their operands, as Eigen's do.
template <class Of>
struct Expression {
    Of of;
    [[nodiscard]] double operator[](int i) const { return of(i); }
    friend auto operator*(const Expression& e, double s) {
        return make([&e, s](int i) { return e[i] * s; });
    }
    template <class Other>
    friend auto operator+(const Expression& e, const Expression<Other>& f) {
        return make([&e, &f](int i) { return e[i] + f[i]; });
    }
    template <class F>
    static Expression<F> make(F f) {
        return {f};
    }
};
template <class Of>
Expression(Of) -> Expression<Of>;

struct Array {
    double numbers[3];
    Array(double x, double y, double z) : numbers{x, y, z} {}
    template <class Of>
    Array(const Expression<Of>& e) : numbers{e[0], e[1], e[2]} {}
    [[nodiscard]] double operator[](int i) const { return numbers[i]; }
    [[nodiscard]] auto expression() const {
        return Expression{[this](int i) { return numbers[i]; }};
    }
    friend auto operator*(const Array& a, double s) {
        return Expression{[&a, s](int i) { return a[i] * s; }};
    }
    friend auto operator+(const Array& a, const Array& b) {
        return Expression{[&a, &b](int i) { return a[i] + b[i]; }};
    }
};
struct Color : Array {
    using Array::Array;
};

struct WithInitialiser {
    float x = 1;
};
struct Plain {
    float x, y;
};

}  // namespace

template <>
struct lumis::zero<Spectrum> {
    static Spectrum value() { return {0, 0}; }
};
template <class T>
struct lumis::zero<Bands<T>> {
    static Bands<T> value() { return Bands<T>{std::vector<T>(2)}; }
};
template <std::derived_from<Array> A>
struct lumis::zero<A> {
    static A value() { return A{0, 0, 0}; }
};

namespace {

const lumis::CosineHemisphere<float> cosine;
const lumis::UniformHemisphere<float> uniform;
const lumis::PerfectReflection<float> below{vec3{0, 0, -1}};  // draws nothing

// Both models, over strategies of float or double.
auto models(const auto& first, const auto& second, const auto& f) {
    using T = typename std::remove_cvref_t<decltype(first)>::Scalar;
    CountingUniforms<T> uniforms, again;
    return std::array{
        lumis::multi_sample(lumis::BalanceHeuristic{}, take(2, first), take(1, second)).estimate(f, uniforms),
        lumis::one_sample(lumis::BalanceHeuristic{}, choose(0.5, first), choose(0.5, second)).estimate(f, again)};
}

using F = lumis::Lanes<float, 4>;
using D = lumis::Lanes<double, 4>;
struct Halves {
    template <int N>
    [[nodiscard]] glm::vec<N, F> next() const {
        return glm::vec<N, F>(F(0.5f));
    }
};

// The weights and numbers of w.z, in a value made of them.
template <class Make>
auto of_z(Make make) {
    return [make](const auto& w) { return make(w.z); };
}

}  // namespace

TEST_CASE("a zero is known of what the language sets to zeros, and of nothing else that has not told it", "[zero]") {
    STATIC_REQUIRE(lumis::HasZero<float> && lumis::HasZero<int> && lumis::HasZero<lumis::Lanes<double, 4>>);
    STATIC_REQUIRE(lumis::HasZero<glm::dvec3> && lumis::HasZero<glm::vec<3, lumis::Lanes<float, 8>>>);
    STATIC_REQUIRE(lumis::HasZero<Plain> && lumis::HasZero<std::array<Spectrum, 2>>);
    STATIC_REQUIRE_FALSE(lumis::HasZero<WithInitialiser> || lumis::HasZero<std::array<WithInitialiser, 2>>);
    STATIC_REQUIRE_FALSE(lumis::HasZero<Expression<int>&> || lumis::HasZero<void>);
    STATIC_REQUIRE(lumis::zero<vec3>::value() == vec3{0, 0, 0});
    CHECK(lumis::zero<std::array<Spectrum, 2>>::value()[1][0] == 0);
    CHECK(lumis::zero<lumis::Lanes<float, 4>>::value()[3] == 0);
}

TEST_CASE("where nothing is drawn, an estimate is the host's zero", "[zero]") {
    CountingUniforms<float> uniforms;
    const auto white = [](const auto&, auto...) { return Spectrum{1, 1}; };
    const auto is_zero = [](const Spectrum& s) { return s[0] == 0 && s[1] == 0; };
    const lumis::PowerHeuristic power;
    CHECK(is_zero(lumis::multi_sample(power, take(3, below)).estimate(white, uniforms)));
    CHECK(is_zero(lumis::multi_sample(power, take(0, cosine), take(0, uniform)).estimate(white, uniforms)));
    CHECK(is_zero(lumis::one_sample(power, choose(0, cosine)).estimate(white, uniforms)));
    // A hundred estimates, half of which draw nothing, sum to what the other half draws.
    const auto half = lumis::one_sample(power, choose(0.5, uniform));
    float sum = 0, number = 0;
    for (int i = 0; i < 100; ++i) {
        const Spectrum s = half.estimate(white, uniforms);
        sum += s[1];
        number += half.estimate([](const vec3&) { return 1.0f; }, uniforms) > 0 ? 1.0f : 0.0f;
    }
    CHECK(number > 30);
    CHECK(sum < 100 * 2 * 2 * 3.15f);
    const auto with_mirror = lumis::multi_sample(power, take(1, below), take(1, uniform));
    CHECK(std::abs(with_mirror.estimate(white, uniforms)[0] - 6.2831853f) <= 1e-5f);
}

TEST_CASE("an estimate is of the type that the integrand returns", "[zero]") {
    const auto check = [](const auto& first, const auto& second) {
        const auto numbers = models(first, second, of_z([](auto z) { return z; }));
        const auto check_value = [&](auto make, auto component, double tolerance) {
            const auto values = models(first, second, of_z(make));
            STATIC_REQUIRE(std::is_same_v<decltype(values[0]), decltype(std::as_const(values)[0])>);
            STATIC_REQUIRE(std::is_same_v<std::remove_cvref_t<decltype(values[0])>, decltype(make(1.0f))>);
            for (std::size_t i = 0; i < 2; ++i) {
                const double expected = 2 * static_cast<double>(numbers[i]);
                CHECK(expected > 0);
                CHECK(std::abs(static_cast<double>(component(values[i])) - expected) <= tolerance * expected);
            }
        };
        const auto last = [](const auto& v) { return v[1]; };
        check_value([](auto z) { return static_cast<float>(2 * z); }, [](float x) { return x; }, 3e-7);
        check_value([](auto z) { return static_cast<double>(2 * z); }, [](double x) { return x; }, 3e-7);
        check_value([](auto z) { return vec3(0, 2 * z, 3); }, last, 3e-7);
        check_value([](auto z) { return glm::dvec3(0, 2 * z, 3); }, last, 3e-7);
        check_value([](auto z) { return Spectrum(1, static_cast<float>(2 * z)); }, last, 3e-7);
        check_value(
            [](auto z) {
                return Bands<double>{{1, 2.0 * z}};
            },
            [](const auto& b) { return b.numbers[1]; }, 3e-7);
        check_value([](auto z) { return Array{1, 2.0 * z, 3}; }, last, 3e-7);
        check_value([](auto z) { return Color{1, 2.0 * z, 3}; }, last, 3e-7);
    };
    check(cosine, uniform);
    check(lumis::CosineHemisphere<double>{}, lumis::UniformHemisphere<double>{});
}

TEST_CASE("an integrand of whole numbers is weighed as one of numbers", "[zero]") {
    const auto whole = models(cosine, uniform, [](const vec3& w) { return w.z > 0.5f ? 1 : 0; });
    const auto truth = models(cosine, uniform, [](const vec3& w) { return w.z > 0.5f; });
    const auto number = models(cosine, uniform, [](const vec3& w) { return w.z > 0.5f ? 1.0f : 0.0f; });
    STATIC_REQUIRE(std::is_same_v<decltype(whole), decltype(number)>);
    CHECK(whole == number);
    CHECK(truth == number);
}

TEST_CASE("doubles over lanes of floats, and floats over lanes of doubles", "[zero][lanes]") {
    const auto direct = lumis::multi_sample(lumis::BalanceHeuristic{}, take(1, cosine), take(1, uniform));
    const F floats = direct.estimate([](const auto& w) { return w.z; }, Halves{});
    const auto in_lanes = direct.estimate([](const glm::vec<3, F>& w) { return D(w.z); }, Halves{});
    const auto by_lane = direct.estimate([](const vec3& w) { return glm::dvec3{w}; }, Halves{});
    STATIC_REQUIRE(std::is_same_v<decltype(in_lanes), const D>);
    STATIC_REQUIRE(std::is_same_v<decltype(by_lane), const glm::vec<3, D>>);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(std::abs(in_lanes[i] - double{floats[i]}) <= 1e-6);
        CHECK(std::abs(by_lane.z[i] - double{floats[i]}) <= 1e-6);
    }
}

TEST_CASE("an expression, the operands of which are gone, is no value", "[zero]") {
    const Array stored{1, 2, 3};
    const auto value = [&](const vec3& w) -> Array { return stored * static_cast<double>(w.z); };
    const auto expression = [&](const vec3&) { return stored.expression(); };
    const auto product = [&](const vec3& w) { return stored * static_cast<double>(w.z); };
    STATIC_REQUIRE(lumis::Integrand<decltype(value), lumis::CosineHemisphere<float>>);
    STATIC_REQUIRE_FALSE(lumis::Integrand<decltype(expression), lumis::CosineHemisphere<float>>);
    STATIC_REQUIRE_FALSE(lumis::Integrand<decltype(product), lumis::CosineHemisphere<float>>);
}
