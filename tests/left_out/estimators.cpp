// Estimates of direct light, each made by the library and written out by hand as a textbook has it. Both use the same
// strategies and the same random numbers, so that what differs is the estimator alone. Under callgrind the program dumps the
// instructions of each; without it, it measures the ratio of their times.
#include <lumis/combine/in_frame.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>
#include <lumis/microfacets/ggx_reflection.hpp>

#include <valgrind/callgrind.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr int samples = 2000;
bool all_agree = true;

// A count that no compiler knows.
volatile int count = 1;

// A host's sampler whose numbers are there already.
template <class T>
struct Prepared {
    const T* numbers;

    template <int N>
    glm::vec<N, T> next() {
        glm::vec<N, T> u;
        for (int i = 0; i < N; ++i) u[i] = *numbers++;
        return u;
    }
};

template <class T>
std::vector<T> random_numbers() {
    lumis::Uniforms<std::mt19937_64, T> source{std::mt19937_64{1}};
    std::vector<T> numbers(std::size_t{5} * samples);
    for (T& number : numbers) number = source.template next<1>().x;
    return numbers;
}

// The function whose instructions are counted.
template <class T, class Estimate>
[[gnu::noinline]] T mean(const std::vector<T>& numbers, const Estimate& estimate) {
    Prepared<T> uniforms{numbers.data()};
    T sum = 0;
    for (int i = 0; i < samples; ++i) sum += estimate(uniforms);
    return sum / samples;
}

template <class T, class Estimate>
T counted(const std::string& name, const std::vector<T>& numbers, const Estimate& estimate) {
    CALLGRIND_ZERO_STATS;
    const T result = mean(numbers, estimate);
    CALLGRIND_DUMP_STATS_AT(name.c_str());
    return result;
}

template <class T, class Ours, class ByHand>
double ratio_of_times(const std::vector<T>& numbers, const Ours& ours, const ByHand& by_hand) {
    std::vector<double> ratios;
    volatile T used = 0;
    for (int repetition = 0; repetition < 21; ++repetition) {
        const auto start = std::clock();
        for (int i = 0; i < 4; ++i) used = used + mean(numbers, ours);
        const auto middle = std::clock();
        for (int i = 0; i < 4; ++i) used = used + mean(numbers, by_hand);
        ratios.push_back(static_cast<double>(middle - start) / static_cast<double>(std::clock() - middle));
    }
    std::ranges::nth_element(ratios, ratios.begin() + 10);
    return ratios[10];
}

template <class T, class Ours, class ByHand>
void compare(const std::string& name, const Ours& ours, const ByHand& by_hand) {
    const auto numbers = random_numbers<T>();
    const std::string full = name + (sizeof(T) == sizeof(float) ? "/float" : "/double");
    const T a = counted("ours " + full, numbers, ours), b = counted("by_hand " + full, numbers, by_hand);
    // The same numbers give the same estimate, or else the comparison would mean nothing.
    const bool agree = b > 0 && std::abs(a - b) <= T(1e-5) * b;
    all_agree = all_agree && agree;
    if (!agree) std::printf("%s: ours %.9g, by hand %.9g\n", full.c_str(), double{a}, double{b});
    if (!RUNNING_ON_VALGRIND) std::printf("%s %.2f\n", full.c_str(), ratio_of_times(numbers, ours, by_hand));
}

// Calls S and is never inlined: whether a compiler inlines S here or there would weigh more than what is to be measured.
template <class S>
struct Called {
    using Scalar = typename S::Scalar;
    using Point = typename S::Point;
    using Measure = typename S::Measure;
    static constexpr int dimensions = S::dimensions;

    S strategy;

    [[nodiscard, gnu::noinline]] auto sample(lumis::UniformsOf<S> u) const noexcept { return strategy.sample(u); }
    [[nodiscard, gnu::noinline]] Scalar pdf(const Point& x) const noexcept { return strategy.pdf(x); }
};

template <class S>
Called(S) -> Called<S>;

template <class T>
struct Integrand {
    T operator()(const lumis::Direction<T>& w) const { return w.z > 0 ? w.z * (2 + w.x + w.y) : T(0); }
};

// p / (p + q) and p^2 / (p^2 + q^2) (Veach 1997, eq. 9.8 and section 9.2.3).
struct Balance {
    using Ours = lumis::BalanceHeuristic;
    static auto weight(auto p, auto q) { return p / (p + q); }
};
struct Power {
    using Ours = lumis::PowerHeuristic;
    static auto weight(auto p, auto q) { return p * p / (p * p + q * q); }
};

// One technique: f / p.
template <class T>
void compare_one(const std::string& name, const auto& strategy) {
    using namespace lumis;
    const Integrand<T> f;
    const auto by_hand = [&](auto& u) {
        const auto s = strategy.sample(u.template next<2>());
        return s.pdf > 0 ? f(s.value) / s.pdf : T(0);
    };
    const auto multi = [&](auto& u) {
        return multi_sample(PowerHeuristic{}, take(1, std::cref(strategy))).estimate(f, u);
    };
    const auto single = [&](auto& u) {
        return one_sample(PowerHeuristic{}, choose(1, std::cref(strategy))).estimate(f, u);
    };
    compare<T>("one/multi_sample/" + name, multi, by_hand);
    compare<T>("one/one_sample/" + name, single, by_hand);

    // Composed beforehand, with a count that is known only then.
    const auto composed = multi_sample(PowerHeuristic{}, take(count, strategy));
    const auto mean_by_hand = [&, n = count](auto& u) {
        T sum = 0;
        for (int k = 0; k < n; ++k) {
            const auto s = strategy.sample(u.template next<2>());
            if (s.pdf > 0) sum += f(s.value) / s.pdf;
        }
        return sum / static_cast<T>(n);
    };
    compare<T>(
        "one_n/multi_sample/" + name, [&](auto& u) { return composed.estimate(f, u); }, mean_by_hand);
}

// Two techniques (Veach 1997, eq. 9.4).
template <class T, class Heuristic>
void compare_two(const std::string& name, const auto& a, const auto& b) {
    using namespace lumis;
    const Integrand<T> f;
    using Ours = typename Heuristic::Ours;
    const auto by_hand = [&](auto& u) {
        T sum = 0;
        const auto s = a.sample(u.template next<2>());
        if (s.pdf > 0) sum += f(s.value) * Heuristic::weight(s.pdf, b.pdf(s.value)) / s.pdf;
        const auto t = b.sample(u.template next<2>());
        if (t.pdf > 0) sum += f(t.value) * Heuristic::weight(t.pdf, a.pdf(t.value)) / t.pdf;
        return sum;
    };
    const auto ours = [&](auto& u) {
        return multi_sample(Ours{}, take(1, std::cref(a)), take(1, std::cref(b))).estimate(f, u);
    };
    compare<T>("two/multi_sample/" + name, ours, by_hand);

    const auto composed = multi_sample(Ours{}, take(count, a), take(count, b));
    const auto means_by_hand = [&, n = count, m = count](auto& u) {
        const T n_a = static_cast<T>(n), n_b = static_cast<T>(m);
        T sum_a = 0, sum_b = 0;
        for (int k = 0; k < n; ++k) {
            const auto s = a.sample(u.template next<2>());
            if (s.pdf > 0) sum_a += f(s.value) * Heuristic::weight(n_a * s.pdf, n_b * b.pdf(s.value)) / s.pdf;
        }
        for (int k = 0; k < m; ++k) {
            const auto s = b.sample(u.template next<2>());
            if (s.pdf > 0) sum_b += f(s.value) * Heuristic::weight(n_b * s.pdf, n_a * a.pdf(s.value)) / s.pdf;
        }
        return sum_a / n_a + sum_b / n_b;
    };
    compare<T>(
        "two_n/multi_sample/" + name, [&](auto& u) { return composed.estimate(f, u); }, means_by_hand);
}

template <class T>
void every_case() {
    using Vector = glm::vec<3, T>;
    const lumis::Frame<T> frame{glm::normalize(Vector{T(0.1), T(0.2), 1})};
    const Called cosine{lumis::in_frame(frame, lumis::CosineHemisphere<T>{})};
    const Vector wo = glm::normalize(Vector{T(0.6), 0, T(0.8)});
    const Called ggx{lumis::in_frame(frame, lumis::GgxReflection<T>{wo, glm::vec<2, T>{T(0.3)}})};
    const lumis::Sphere<T> ball{Vector{T(0.3), T(0.2), 2}, T(0.7)};
    const Called sphere{lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{ball, Vector{0}}};
    const lumis::Triangle<T> corner{Vector{-1, -1, 1}, Vector{1, -1, 1}, Vector{0, 1, T(1.5)}};
    const Called triangle{lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>{corner, Vector{0}}};

    compare_one<T>("cosine", cosine);
    compare_one<T>("ggx", ggx);
    compare_one<T>("sphere", sphere);
    compare_one<T>("triangle", triangle);
    compare_two<T, Balance>("balance/cosine+sphere", cosine, sphere);
    compare_two<T, Power>("power/cosine+sphere", cosine, sphere);
    compare_two<T, Balance>("balance/ggx+triangle", ggx, triangle);
    compare_two<T, Power>("power/ggx+triangle", ggx, triangle);
}

}  // namespace

int main() {
    every_case<float>();
    every_case<double>();
    return all_agree ? 0 : 1;
}
