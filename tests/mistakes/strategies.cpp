// Mistakes in strategies, in sources of uniforms and in how long things live, each beside what was meant; see mistakes.py.
#include <lumis/lumis.hpp>

#include <array>
#include <cstddef>
#include <random>
#include <vector>

using namespace lumis;

namespace {

constexpr std::array<float, 8> luminance{1, 2, 3, 4, 5, 6, 7, 8};

struct Complete {
    using Scalar = float;
    using Point = float;
    using Measure = measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] Sample<float, float> sample(glm::vec1 u) const noexcept { return {u.x, 1}; }
    [[nodiscard]] float pdf(float x) const noexcept { return x >= 0 && x <= 1 ? 1.0f : 0.0f; }
};

struct WithoutDimensions {
    using Scalar = float;
    using Point = float;
    using Measure = measure::Lebesgue;
#ifndef NO_DIMENSIONS  // says: dimensions
    static constexpr int dimensions = 1;
#endif
    [[nodiscard]] Sample<float, float> sample(glm::vec1 u) const noexcept {
        return {u.x, 1};
    }
    [[nodiscard]] float pdf(float) const noexcept {
        return 1;
    }
};
static_assert(Strategy<WithoutDimensions>);

struct WithoutMeasure : Complete {
#ifdef NO_MEASURE  // says: Measure
  private:
    using Measure = void;
#endif
};
static_assert(Strategy<WithoutMeasure>);

struct WithoutPdf : Complete {
#ifdef NO_PDF  // says: strategy.pdf
    void pdf() const;
#endif
};
static_assert(Strategy<WithoutPdf>);

struct DensityForAnother : Complete {
#ifdef DENSITY_OF_ANOTHER_POINT  // says: strategy.pdf
    [[nodiscard]] float pdf(const glm::vec3&) const noexcept {
        return 1;
    }
#endif
};
static_assert(Strategy<DensityForAnother>);

#ifdef LONG_DOUBLE  // says: long double
[[maybe_unused]] const CosineHemisphere<long double> precise{};
#else
[[maybe_unused]] const CosineHemisphere<double> precise{};
#endif
#ifdef LONG_DOUBLE_TABLE  // says: long double
const std::vector<long double> weights{1, 2};
#else
const std::vector<double> weights{1, 2};
#endif
const AliasTable table{weights};

#ifdef LONG_DOUBLE_UNIFORMS  // says: long double
[[maybe_unused]] Uniforms<std::mt19937, long double> wide{std::mt19937{1}};
#else
[[maybe_unused]] Uniforms<std::mt19937, double> wide{std::mt19937{1}};
#endif

[[maybe_unused]] void sources() {
    const auto plain = multi_sample(BalanceHeuristic{}, take(1, Complete{}));
    const auto f = [](float x) { return x; };
    std::mt19937 engine{1};
#ifdef ENGINE_FOR_A_SOURCE  // says: UniformSource
    (void)plain.estimate(f, engine);
#else
    (void)plain.estimate(f, Uniforms{engine});
#endif
}

[[maybe_unused]] auto outlived_map() {
    const EnvironmentMap sky{4, 2, luminance};
#ifdef OUTLIVED_MAP  // clang++ says: address of stack memory associated with local variable 'sky' returned
    return multi_sample(BalanceHeuristic{}, take(1, sky), take(1, UniformSphere<float>{}));
#else
    return multi_sample(BalanceHeuristic{}, take(1, EnvironmentMap{sky}), take(1, UniformSphere<float>{}));
#endif
}

[[maybe_unused]] auto outlived_mixture_part() {
    const EnvironmentMap sky{4, 2, luminance};
#ifdef OUTLIVED_PART  // clang++ says: address of stack memory associated with local variable 'sky' returned
    return Mixture{choose(0.5, sky), choose(0.5, UniformSphere<float>{})};
#else
    return Mixture{choose(0.5, EnvironmentMap{sky}), choose(0.5, UniformSphere<float>{})};
#endif
}

[[maybe_unused]] auto outlived_turned_map() {
    const EnvironmentMap sky{4, 2, luminance};
    const Frame<float> turned{glm::vec3{0, 1, 0}};
#ifdef OUTLIVED_TURNED_MAP  // clang++ says: address of stack memory associated with local variable 'sky' returned
    return in_frame(turned, sky);
#else
    return in_frame(turned, EnvironmentMap{sky});
#endif
}

[[maybe_unused]] auto outlived_table() {
    const AliasTable<float> by_power{luminance};
    const auto light = [](std::size_t) { return AreaLight{Sphere<float>{{0, 0, 2}, 1}, glm::vec3{0}}; };
#ifdef OUTLIVED_TABLE  // clang++ says: address of stack memory associated with local variable 'by_power' returned
    return LightSet{light, by_power};
#else
    return LightSet{light, AliasTable{by_power}};
#endif
}

// What is small is copied: its owner may go.
[[maybe_unused]] auto copied() {
    const Frame<float> frame{glm::vec3{0, 0, 1}};
    const GgxReflection<float> bsdf{glm::vec3{0, 0, 1}, glm::vec2{0.1f}};
    const auto both = one_sample(BalanceHeuristic{}, choose(0.5, in_frame(frame, bsdf)), choose(0.5, bsdf));
    return both;
}

}  // namespace
