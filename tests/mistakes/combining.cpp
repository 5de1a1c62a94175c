// Mistakes in what is combined, each beside what was meant; see mistakes.py.
#include <lumis/batch/batch.hpp>
#include <lumis/lumis.hpp>

#include <array>
#include <random>
#include <span>
#include <variant>

using namespace lumis;

namespace {

const CosineHemisphere<float> cosine;
const UniformHemisphere<float> uniform;
const PerfectReflection<float> mirror{glm::vec3{0, 0, 1}};
Uniforms uniforms{std::mt19937{1}};
const auto even = [](const glm::vec3&) { return 1; };

// The same points, but their density is one per area.
struct PerArea : UniformHemisphere<float> {
    using Measure = measure::Area;
};

// As Eigen has them: a product is an expression that refers to what it is made of.
struct Product;
struct Vector {
    float x, y, z;
    Vector(float all) : x{all}, y{all}, z{all} {}
    Vector(const Product& product);
};
struct Product {
    const Vector& vector;
    float scale;
};
inline Vector::Vector(const Product& p) : x{p.vector.x * p.scale}, y{p.vector.y * p.scale}, z{p.vector.z * p.scale} {}
[[maybe_unused]] Product operator*(const Vector& a, float b) {
    return {a, b};
}
[[maybe_unused]] Vector operator+(const Vector& a, const Vector&) {
    return a;
}
const Vector white{1};

// What its default constructor sets is the host's business.
struct Spectrum {
    float bands[4];
    Spectrum() {}
    explicit Spectrum(float all) : bands{all, all, all, all} {}
    friend Spectrum operator+(const Spectrum& a, const Spectrum&) { return a; }
    friend Spectrum operator*(const Spectrum& a, float) { return a; }
};

}  // namespace

template <>
struct lumis::zero<Vector> {
    static Vector value() { return {0}; }
};
#ifndef ZERO_NOT_TOLD  // says: an integrand's value has a zero, but its default constructor may set none
template <>
struct lumis::zero<Spectrum> {
    static Spectrum value() { return Spectrum{0}; }
};
#endif

namespace {

[[maybe_unused]] void heuristics() {
#ifdef FORGOTTEN_HEURISTIC  // says: the_first_argument_must_be_a_heuristic
    (void)multi_sample(take(1, cosine), take(1, uniform));
#else
    (void)multi_sample(BalanceHeuristic{}, take(1, cosine), take(1, uniform));
#endif
#ifdef FORGOTTEN_HEURISTIC_OF_ONE_SAMPLE  // says: the_first_argument_must_be_a_heuristic
    (void)one_sample(choose(0.5, cosine), choose(0.5, uniform));
#else
    (void)one_sample(PowerHeuristic{}, choose(0.5, cosine), choose(0.5, uniform));
#endif
#ifdef NUMBER_FOR_A_HEURISTIC  // says: Heuristic
    (void)multi_sample(2.0, take(1, cosine), take(1, uniform));
#else
    (void)multi_sample(PowerHeuristic{2.0}, take(1, cosine), take(1, uniform));
#endif
#ifdef STRATEGY_FOR_A_HEURISTIC  // says: Heuristic
    (void)multi_sample(cosine, take(1, cosine), take(1, uniform));
#else
    (void)multi_sample(EqualWeights{}, take(1, cosine), take(1, uniform));
#endif
#ifdef WEIGHT_WITHOUT_A_HEURISTIC  // says: DensityHeuristic
    (void)mis_weight(0.5f, 0.25f, 0.25f);
#else
    (void)mis_weight(BalanceHeuristic{}, 0.5f, 0.25f, 0.25f);
#endif
    const std::array<float, 1> densities{1};
    std::array<float, 1> weights{};
#ifdef WEIGHTS_WITHOUT_A_HEURISTIC  // says: DensityHeuristic
    mis_weight_n(uniform, std::span{densities}, std::span{densities}, std::span<float>{weights});
#else
    mis_weight_n(BalanceHeuristic{}, std::span{densities}, std::span{densities}, std::span<float>{weights});
#endif
}

[[maybe_unused]] void optimal_weights() {
#ifdef COLOUR_IN_A_NUMBER  // says: optimal<glm::vec3>\(...\) for a glm::vec3
    auto best = optimal(take(1, cosine), take(1, uniform));
#else
    auto best = optimal<glm::vec3>(take(1, cosine), take(1, uniform));
#endif
    best.add([](const glm::vec3& w) { return w; }, uniforms);
#ifdef SPECTRUM_IN_DOUBLE  // says: integrands that return a number or a glm::vec
    best.add([](const glm::vec3&) { return Spectrum{1}; }, uniforms);
#endif
}

[[maybe_unused]] void techniques() {
#ifdef SHAPE_FOR_A_STRATEGY  // says: Strategy
    (void)take(1, Sphere<float>{});
#else
    (void)take(1, AreaLight{Sphere<float>{}, glm::vec3{}});
#endif
#ifdef FRACTION_OF_A_SAMPLE  // says: integral
    (void)take(0.5, cosine);
#else
    (void)choose(0.5, cosine);
#endif
#ifdef CHANCE_IN_A_MULTI_SAMPLE  // says: Choose
    (void)multi_sample(BalanceHeuristic{}, choose(0.5, cosine), choose(0.5, uniform));
#else
    (void)one_sample(BalanceHeuristic{}, choose(0.5, cosine), choose(0.5, uniform));
#endif
#ifdef FLOAT_AND_DOUBLE  // says: SameScalar
    (void)multi_sample(BalanceHeuristic{}, take(1, cosine), take(1, UniformHemisphere<double>{}));
#else
    (void)multi_sample(BalanceHeuristic{}, take(1, cosine), take(1, UniformHemisphere<float>{}));
#endif
    const std::array<float, 2> table{1, 2};
#ifdef DIRECTIONS_AND_NUMBERS  // says: SamePoint
    (void)one_sample(BalanceHeuristic{}, choose(0.5, cosine), choose(0.5, PiecewiseConstant1D{table}));
#else
    (void)one_sample(BalanceHeuristic{}, choose(1, PiecewiseConstant1D{table}));
#endif
#ifdef SOLID_ANGLE_AND_AREA  // says: SameMeasure
    (void)multi_sample(BalanceHeuristic{}, take(1, cosine), take(1, PerArea{}));
#else
    (void)multi_sample(BalanceHeuristic{}, take(1, PerArea{}));
#endif
#ifdef MIRROR_IN_A_MIXTURE  // says: a delta strategy has no density to mix
    (void)Mixture{choose(0.5, cosine), choose(0.5, mirror)};
#else
    (void)one_sample(BalanceHeuristic{}, choose(0.5, cosine), choose(0.5, mirror));
#endif
#ifdef MIRROR_IN_A_VARIANT  // says: a delta strategy is no alternative
    (void)VariantStrategy{std::variant<CosineHemisphere<float>, PerfectReflection<float>>{cosine}};
#else
    (void)VariantStrategy{std::variant<CosineHemisphere<float>, UniformHemisphere<float>>{cosine}};
#endif
#ifdef RESAMPLED_MIRROR  // says: a delta strategy has no density to resample
    (void)resample(even, take(2, mirror));
#else
    (void)resample(even, take(2, cosine));
#endif
#ifdef POINT_LIGHTS_IN_A_SET  // says: lights of a set are strategies with a density
    const auto lamps = [](std::size_t) { return PointLight{glm::vec3{0, 0, 1}, glm::vec3{0}}; };
#else
    const auto lamps = [](std::size_t) { return AreaLight{Sphere<float>{{0, 0, 2}, 1}, glm::vec3{0}}; };
#endif
    (void)LightSet{lamps, table};
}

[[maybe_unused]] void targets() {
#ifdef COLOUR_FOR_A_TARGET  // says: a target is a number: of a colour, its luminance
    const auto target = [](const glm::vec3& w) { return w; };
#else
    const auto target = even;
#endif
    (void)resample(target, take(2, cosine)).sample(uniforms);
#ifdef FORGOTTEN_TARGET  // says: a target takes the point
    (void)resample(BalanceHeuristic{}, take(2, cosine), take(1, uniform)).sample(uniforms);
#else
    (void)resample(BalanceHeuristic{}, even, take(2, cosine), take(1, uniform)).sample(uniforms);
#endif
}

[[maybe_unused]] void integrands() {
    const auto direct = multi_sample(BalanceHeuristic{}, take(1, cosine), take(1, uniform));
    const auto reflected = multi_sample(BalanceHeuristic{}, take(1, cosine), take(1, mirror));
#ifdef NOTHING_RETURNED  // says: an integrand returns its value, but this one returns void
    const auto nothing = [](const glm::vec3&) {};
#else
    const auto nothing = [](const glm::vec3&) { return 0; };
#endif
    (void)direct.estimate(nothing, uniforms);
#ifdef WHOLE_NUMBERS_FOR_A_COLOUR  // says: an integrand's value, times a number, is one of the same type
    const auto colour = [](const glm::vec3&) { return glm::ivec3{1, 2, 3}; };
#else
    const auto colour = [](const glm::vec3& w) { return glm::dvec3{w}; };
#endif
    (void)direct.estimate(colour, uniforms);
#ifdef EXPRESSION  // says: one that returns an expression template says what value it stands for
    const auto expression = [](const glm::vec3& w) { return white * w.z; };
#else
    const auto expression = [](const glm::vec3& w) -> Vector { return white * w.z; };
#endif
    (void)direct.estimate(expression, uniforms);
    (void)direct.estimate([](const glm::vec3&) { return Spectrum{1}; }, uniforms);
#ifdef OTHER_POINT  // says: an integrand takes the point, .* or the whole sample
    const auto two_coordinates = [](float, float) { return 1.0f; };
#else
    const auto two_coordinates = [](const glm::vec3&) { return 1.0f; };
#endif
    (void)direct.estimate(two_coordinates, uniforms);
#ifdef NO_COEFFICIENT  // says: a delta strategy asks the integrand for its coefficient
    const auto coated = [](const glm::vec3& w) { return w.z; };
#else
    const auto coated = [](const glm::vec3& w, auto... is_delta) { return sizeof...(is_delta) > 0 ? 1.0f : w.z; };
#endif
    (void)reflected.estimate(coated, uniforms);
#ifdef DISTANCE_WITHOUT_A_LIGHT  // says: no member named .distance
    const auto shadowed = [](const AnySample auto& s) { return s.distance; };
#else
    const auto shadowed = [](const AnySample auto& s) { return s.value.z; };
#endif
    (void)direct.estimate(shadowed, uniforms);
#ifdef COLOUR_AND_NUMBER  // says: an integrand returns one type, whichever technique drew its point
    struct {
        glm::vec3 operator()(const glm::vec3& w) const { return w; }
        float operator()(const glm::vec3& w, delta_t) const { return w.z; }
    } two_types;
#else
    struct {
        glm::vec3 operator()(const glm::vec3& w) const { return w; }
        glm::vec3 operator()(const glm::vec3& w, delta_t) const { return w; }
    } two_types;
#endif
    (void)reflected.estimate(two_types, uniforms);
#ifdef PLAN_FOR_A_PARTITION  // says: an allocation weighs by densities
    const auto owner = PartitionWeights{[](const glm::vec3& w) { return w.z > 0.5f ? 0 : 1; }};
#else
    const BalanceHeuristic owner;
#endif
    (void)allocate(owner, take(1, cosine), take(1, uniform));
}

}  // namespace
