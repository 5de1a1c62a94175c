// Mixtures, light sets, heuristics and estimators on a CUDA device, and templates that only the host can call in the same
// file.
#include "compare.cuh"
#include "uniforms.cuh"
#include <lumis/lumis.hpp>

#include <cstddef>
#include <random>
#include <span>
#include <variant>
#include <vector>

namespace {

using namespace lumis;
using Light = AreaLight<Sphere<float>, BySolidAngle>;

// What all estimators here are composed of.
struct Parts {
    EnvironmentMapView<float> sky;
    AliasTableView<float> powers;
    std::span<const Light> lights;
    InFrame<GgxReflection<float>> bsdf;
    LightTreeView<float> tree;
};

// Weights of each heuristic for three densities.
struct Heuristics {
    static constexpr int size = 6;

    LUMIS_HD void operator()(unsigned index, float* out) const {
        device::Stream uniforms{index};
        const glm::vec3 p = uniforms.next<3>();
        out[0] = mis_weight(BalanceHeuristic{}, p.x, p.y, p.z);
        out[1] = mis_weight(PowerHeuristic{}, p.x, p.y, p.z);
        out[2] = mis_weight(PowerHeuristic{3.0f}, p.x, p.y, p.z);
        out[3] = mis_weight(MaximumHeuristic{}, p.x, p.y, p.z);
        out[4] = mis_weight(EqualWeights{}, p.x, p.y, p.z);
        out[5] = mis_weight(BalanceWithFactors{2.0, variance_aware_factor(1, 2), 0.5}, p.x, p.y, p.z);
    }
};

// What pilot rounds advise, for 256 of them, and what a rough metal is given back.
struct Plans {
    static constexpr int size = 6;

    LUMIS_HD void operator()(unsigned index, float* out) const {
        device::Stream uniforms{index};
        const GgxReflection<float> metal{{0, 0.6f, 0.8f}, 0.4f};
        const auto f = [&](const glm::vec3& w) { return metal.ggx().brdf({0, 0.6f, 0.8f}, w) * w.z; };
        auto plan = allocate(PowerHeuristic{}, take(1, metal), take(1, CosineHemisphere<float>{}));
        auto optimum = allocate(OptimalWeights{}, take(1, metal), take(1, CosineHemisphere<float>{}));
        float sum = 0;
        for (int i = 0; i < 256; ++i) {
            sum += plan.add(f, uniforms);
            sum += optimum.add(f, uniforms);
        }
        plan.merge(plan);
        out[0] = sum;
        out[1] = static_cast<float>(plan.forecast().multi_sample_variance({2, 1}));
        out[2] = static_cast<float>(optimum.forecast().one_sample_variance({2, 1}));
        out[3] = static_cast<float>(plan.counts({{2, 1}})[0] > 0);
        out[4] = static_cast<float>(plan.probabilities()[0] + plan.probabilities()[1]);
        out[5] = ggx_compensation(metal.ggx(), glm::vec3{0, 0.6f, 0.8f}, 0.9f);
    }
};

struct Mixtures {
    static constexpr int size = 10;
    Parts parts;

    LUMIS_HD void operator()(unsigned index, float* out) const {
        device::Stream uniforms{index};
        const Mixture mixture{choose(0.25f, parts.sky), choose(0.75f, parts.bsdf)};
        const LightSet set{parts.lights, parts.powers};
        const auto a = mixture.sample(uniforms.next<3>());
        const auto b = set.sample(uniforms.next<3>());
        const float numbers[size] = {a.value.x,
                                     a.value.y,
                                     a.value.z,
                                     a.pdf,
                                     mixture.pdf(a.value),
                                     b.value.x,
                                     b.pdf,
                                     b.distance,
                                     set.pdf(b.value),
                                     set.distance_along(a.value)};
        for (int i = 0; i < size; ++i) out[i] = numbers[i] < 1e30f ? numbers[i] : -1;
    }
};

// A host's own value.
struct Color {
    float r, g;
    LUMIS_HD Color(float red, float green) : r{red}, g{green} {}
    LUMIS_HD friend Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g}; }
    LUMIS_HD friend Color operator*(const Color& a, float s) { return {a.r * s, a.g * s}; }
};

}  // namespace

template <>
struct lumis::zero<Color> {
    LUMIS_HD static Color value() { return {0, 0}; }
};

namespace {

// What a path goes on with, a light of either kind, and a host's own values.
struct Paths {
    static constexpr int size = 8;
    Parts parts;

    LUMIS_HD void operator()(unsigned index, float* out) const {
        device::Stream uniforms{index};
        const VariantStrategy<std::variant<Light, CosineHemisphere<float>>> light{parts.lights[0]},
            lobe{CosineHemisphere<float>{}};
        const auto direct = multi_sample(PowerHeuristic{}, take(1, light), take(1, lobe));
        const auto a = direct.weighted_sample<0>(uniforms);
        const auto b = direct.weighted_sample<1>(uniforms);
        const auto mixed = one_sample(BalanceHeuristic{}, choose(0.5f, light), choose(0.4f, lobe));
        float selected = 0;
        const bool drawn = mixed.weighted_sample(uniforms, [&](const auto& s) { selected = s.factor(); });
        const Color color = direct.estimate(
            [](const glm::vec3& w, auto t) {
                return Color{w.x * w.x, t == 0 ? 1.0f : 0.0f};
            },
            uniforms);
        const float numbers[size] = {a.sample.distance,     a.weight(), a.factor(), b.density, b.weight_given<0>(2.0f),
                                     drawn ? selected : -1, color.r,    color.g};
        for (int i = 0; i < size; ++i) out[i] = numbers[i];
    }
};

struct Estimates {
    static constexpr int size = 8;
    Parts parts;

    LUMIS_HD void operator()(unsigned index, float* out) const {
        device::Stream uniforms{index};
        const auto of_point = [](const glm::vec3& w) { return 1 + w.x * w.x; };
        const auto of_sample = [](const AnySample auto& s) { return s.value.x * s.value.x; };
        const auto in_color = [](const glm::vec3& w) { return glm::vec3{1, 2, 3} * (w.z > 0 ? w.z : 0.0f); };
        const LightSet set{parts.lights, parts.powers};
        const auto multi = multi_sample(PowerHeuristic{}, take(2, parts.bsdf), take(1, parts.sky), take(1, set));
        const auto one = one_sample(BalanceHeuristic{}, choose(0.5f, parts.bsdf), choose(0.5f, parts.sky));
        const auto alone = multi_sample(BalanceHeuristic{}, take(1, CosineHemisphere<float>{}));
        const auto with_mirror = multi_sample(PowerHeuristic{}, take(1, PerfectReflection<float>{{0, 0, 1}}),
                                              take(1, UniformHemisphere<float>{}));
        RunningMoments<float> moments;
        for (int i = 0; i < 8; ++i) moments.add(multi.estimate(of_point, uniforms));
        const auto color = one.estimate(in_color, uniforms);
        out[0] = static_cast<float>(moments.mean());
        out[1] = multi.estimate(of_sample, uniforms);
        out[2] = color.x + color.y + color.z;
        out[3] = alone.estimate(of_point, uniforms);
        out[4] = with_mirror.estimate([](const glm::vec3& w, auto...) { return w.z; }, uniforms);
        out[5] = multi.weight<1>({0, 0.6f, 0.8f});
        auto best = optimal(take(1, parts.bsdf), take(1, parts.sky), take(0, UniformSphere<float>{}));
        for (int i = 0; i < 8; ++i) best.add(of_point, uniforms);
        const auto round = rounds_of(choose(0.5f, parts.bsdf), choose(0.4f, parts.sky)).round(of_sample, uniforms);
        out[6] = best.estimate();
        out[7] = static_cast<float>(round.estimate({0.5, 0.25}));
    }
};

// Candidates of one source, of several under each kind of weights, of lights one by one, selected by power and by a tree, and a
// reservoir merged.
struct Candidates {
    static constexpr int size = 8;
    Parts parts;

    LUMIS_HD void operator()(unsigned index, float* out) const {
        device::Stream uniforms{index};
        const auto target = [](const glm::vec3& w) { return 1 + w.x * w.x; };
        const auto f = [](const glm::vec3& w) { return 1 + w.y * w.y; };
        const auto by_distance = [](const AnySample auto& s) { return 1 / (1 + s.distance); };
        const SelectedLight one{LightSet{parts.lights, parts.powers}};
        const SelectedLight by_tree{LightSet{parts.lights, parts.tree.from(glm::vec3{0}, {0, 0, 1})}};
        const auto both = resample(PairwiseWeights{}, target, take(2, parts.bsdf), take(1, parts.sky),
                                   take(1, UniformSphere<float>{}));
        const auto kept = both.sample(uniforms), others = both.sample(uniforms);
        Reservoir<glm::vec3> merged, other;
        merged.add(kept.sample.value, kept.contribution_weight, 0.5f);
        other.add(others.sample.value, others.contribution_weight, 0.5f);
        merged.merge(other, uniforms.next<1>().x);
        const float numbers[size] = {
            resample(target, take(4, parts.sky)).estimate(f, uniforms),
            resample(target, take(2, parts.bsdf), take(2, parts.sky)).estimate(f, uniforms),
            resample(target, 4, choose(0.5f, parts.bsdf), choose(0.5f, parts.sky)).estimate(f, uniforms),
            both.estimate(f, uniforms),
            resample(by_distance, take(4, one)).estimate(by_distance, uniforms),
            resample(by_distance, take(2, by_tree)).estimate(by_distance, uniforms),
            merged.item().x,
            merged.inverse_probability()};
        for (int i = 0; i < size; ++i) out[i] = numbers[i];
    }
};

template <class Probe>
constexpr bool composes_trivially = std::is_trivially_copyable_v<Probe>;
static_assert(composes_trivially<decltype(multi_sample(PowerHeuristic{}, take(1, std::declval<Parts>().sky),
                                                       take(1, CosineHemisphere<float>{})))>);
static_assert(composes_trivially<decltype(Mixture{choose(0.5, std::declval<Parts>().sky),
                                                  choose(0.5, CosineHemisphere<float>{})})>);
static_assert(composes_trivially<LightSet<std::span<const Light>, AliasTableView<float>>>);
static_assert(composes_trivially<LightSet<std::span<const Light>, LightTreeFrom<float>>>);

// The host's own estimator with what no device has: an engine of the standard library, and a vector that grows.
bool host_estimates(const EnvironmentMap<float>& sky, const AliasTable<float>& powers,
                    const std::vector<Light>& lights) {
    Uniforms uniforms{std::mt19937{5}};
    std::vector<float> seen;
    const LightSet set{lights, powers};
    const auto direct = multi_sample(PowerHeuristic{}, take(1, sky), take(1, set), take(1, UniformSphere<float>{}));
    float sum = 0;
    for (int i = 0; i < 1000; ++i) {
        sum += direct.estimate(
            [&](const glm::vec3& w) {
                seen.push_back(w.x);
                return 1.0f;
            },
            uniforms);
    }
    const float error = sum / 1000 / 12.5663706f - 1;
    return !seen.empty() && error * error <= 0.01f;
}

}  // namespace

int main() {
    std::mt19937 engine{1};
    std::vector<float> luminance(64 * 32);
    for (float& x : luminance) x = static_cast<float>(engine() % 1000);
    const EnvironmentMap sky{64, 32, luminance};
    const AliasTable powers{std::vector<float>{1, 2, 3}};
    std::vector<Light> lights;
    std::vector<LightBounds<float>> bounds;
    for (const float x : {-1.0f, 0.0f, 1.5f}) {
        const Sphere<float> sphere{{x, 1, 3}, 0.4f};
        lights.emplace_back(sphere, glm::vec3{0});
        bounds.push_back(light_bounds(sphere, 1));
    }
    const LightTree tree{bounds};
    const Frame frame{glm::vec3{0, 0.6f, 0.8f}};
    const auto bsdf = in_frame(frame, GgxReflection<float>{{0, 0.6f, 0.8f}, glm::vec2{0.3f}});
    if (!host_estimates(sky, powers, lights)) {
        std::puts("The host's estimate of 4 pi is wrong.");
        return 1;
    }
    if (!device::is_present()) return device::skipped;

    device::Copies copies;
    const Parts here{sky.view(), powers.view(), lights, bsdf, tree.view()};
    const Parts there{sky.view(copies), powers.view(copies), copies(std::span<const Light>{lights}), bsdf,
                      tree.view(copies)};
    bool good = device::agrees("heuristics", Heuristics{}, Heuristics{});
    good &= device::agrees("plans", Plans{}, Plans{});
    good &= device::agrees("mixtures and light sets", Mixtures{here}, Mixtures{there});
    good &= device::agrees("paths", Paths{here}, Paths{there});
    good &= device::agrees("estimates", Estimates{here}, Estimates{there});
    good &= device::agrees("candidates", Candidates{here}, Candidates{there});
    return good ? 0 : 1;
}
