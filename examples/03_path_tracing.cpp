// A path tracer's loop with both halves of multiple importance sampling. At every vertex one direction towards the lamp
// is sampled (next event estimation) and one from the BSDF; the lamp's light is counted by both, each with its weight.
//
// The test is a furnace: in a closed room whose every surface emits what it does not reflect, radiance is 1 everywhere.
#include <lumis/lumis.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace {

using glm::vec3;

// A diffuse base and a rough metallic lobe of roughness 1, each reflecting the given fraction.
struct Material {
    float diffuse, glossy;

    // Local frame: +z is the normal, wo points to where the path came from, wi to where it goes.
    [[nodiscard]] auto bsdf(const vec3& wo) const {
        const float sum = diffuse + glossy;
        return lumis::Mixture{lumis::choose(diffuse / sum, lumis::CosineHemisphere<float>{}),
                              lumis::choose(glossy / sum, lumis::GgxReflection<float>{wo, glm::vec2{1}})};
    }
    // Reflectance times the cosine at wi.
    [[nodiscard]] float reflected(const vec3& wo, const vec3& wi) const {
        if (!(wo.z > 0 && wi.z > 0)) return 0;
        return (diffuse * std::numbers::inv_pi_v<float> + glossy * lumis::Ggx<float>{glm::vec2{1}}.brdf(wo, wi)) * wi.z;
    }
    // What it does not reflect. The lobe's albedo at roughness 1 is 1 - mu log(1 + 1 / mu), with mu the cosine at wo.
    [[nodiscard]] float emitted(float mu) const {
        const float lost = mu > 0 ? mu * std::log1p(1 / mu) : 0.0f;
        return 1 - diffuse - glossy * (1 - lost);
    }
};

struct Ball {
    lumis::Sphere<float> shape;
    Material material;
};

// A room from -2 to 2 along each axis, with four balls in it. The walls shine as well, but only the balls are sampled as
// lights.
constexpr Material walls{0.3f, 0.4f};
constexpr std::array<Ball, 4> balls{{{{{0.9f, 0.9f, 0.8f}, 0.8f}, {0.4f, 0}},
                                     {{{-1, -1, 0.6f}, 0.9f}, {0.2f, 0.7f}},
                                     {{{0.9f, -1.1f, -0.9f}, 0.8f}, {0, 0.8f}},
                                     {{{-0.8f, 0.7f, 1.2f}, 0.6f}, {0.1f, 0}}}};

struct Hit {
    float distance;
    vec3 position, normal;  // the geometric normal, towards the side that was hit
    std::size_t ball;       // its index; that of none: a wall
    const Material* material;
};

// The first surface along a ray. A ray that starts on a ball points away from it: nothing meets itself.
Hit closest(const vec3& origin, const vec3& direction) {
    Hit hit{std::numeric_limits<float>::infinity(), {}, {}, balls.size(), &walls};
    for (int axis = 0; axis < 3; ++axis) {
        const float distance = (std::copysign(2.0f, direction[axis]) - origin[axis]) / direction[axis];
        if (!(distance < hit.distance)) continue;
        hit.distance = std::max(distance, 0.0f);
        hit.normal = vec3{0};
        hit.normal[axis] = -std::copysign(1.0f, direction[axis]);
    }
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const auto& [center, r] = balls[i].shape;
        const vec3 to_center = center - origin;
        const float along = glm::dot(to_center, direction);
        const vec3 across = to_center - along * direction;
        const float half_chord = std::sqrt(std::max(r * r - glm::dot(across, across), 0.0f));
        if (!(along > 0 && half_chord > 0 && along - half_chord < hit.distance)) continue;
        hit.distance = std::max(along - half_chord, 0.0f);
        hit.normal = -(across + half_chord * direction) / r;
        hit.ball = i;
        hit.material = &balls[i].material;
    }
    hit.position = origin + hit.distance * direction;
    return hit;
}

// A ball as seen from a point. A ball does not light itself: from its own surface it may subtend anything.
using Light = lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle>;

float radiance(const vec3& origin, vec3 direction, const lumis::AliasTable<float>& choice, auto& uniforms) {
    Hit hit = closest(origin, direction);
    float sum = hit.material->emitted(-glm::dot(hit.normal, direction)), throughput = 1;
    while (true) {
        // Two techniques share what a ball emits towards this vertex. One of the lights is chosen and sampled.
        const lumis::Frame<float> frame{hit.normal};
        const vec3 wo = frame.to_local(-direction);
        const auto seen_from_here = [&](std::size_t i) { return Light{balls[i].shape, hit.position}; };
        const lumis::LightSet lights{seen_from_here, choice};
        const auto bsdf = lumis::in_frame(frame, hit.material->bsdf(wo));
        const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, std::cref(bsdf)),
                                                lumis::take(1, std::cref(lights)));

        // The first half: next event estimation, weighed against the BSDF.
        const auto [chosen, sample] = lights.sample_one(uniforms.template next<3>());
        const float reflected = hit.material->reflected(wo, frame.to_local(sample.value));
        if (sample.pdf > 0 && reflected > 0 && chosen != hit.ball) {
            const Hit seen = closest(hit.position, sample.value);  // the shadow ray
            if (seen.ball == chosen) {
                const float emitted = seen.material->emitted(-glm::dot(seen.normal, sample.value));
                sum += throughput * reflected * emitted * direct.template weighted<1>(sample).factor();
            }
        }

        // The path goes on along the BSDF. Nothing drawn means that the path is absorbed: that counts, as a contribution of 0.
        const auto next = direct.template weighted_sample<0>(uniforms);
        if (!(next.density > 0)) return sum;
        throughput *= hit.material->reflected(wo, frame.to_local(next.sample.value)) / next.density;

        // The second half: emission that the BSDF's ray meets. If it is a light's, light sampling could have found it too,
        // with the probability of choosing this light times its density from here.
        const Hit met = closest(hit.position, next.sample.value);
        const float cosine = -glm::dot(met.normal, next.sample.value);
        float weight = 1;
        if (met.ball < balls.size()) {
            const float density = seen_from_here(met.ball).pdf_from_hit(met.distance, cosine);
            weight = next.template weight_given<1>(choice.pdf(met.ball) * density);
        }
        sum += throughput * weight * met.material->emitted(cosine);

        // Russian roulette: a path that goes on stands for those that end. A largest depth would lose their light.
        const float survival = std::min(throughput, 1.0f);
        if (!(uniforms.template next<1>().x < survival)) return sum;
        throughput /= survival;

        direction = next.sample.value, hit = met;
    }
}

}  // namespace

// 03_path_tracing [paths [seed]]: fails if the mean is off by four standard errors, once in 16,000 seeds by chance.
int main(int argc, char** argv) {
    const int paths = argc > 1 ? std::atoi(argv[1]) : 200'000;
    lumis::Uniforms uniforms{std::mt19937{argc > 2 ? static_cast<std::mt19937::result_type>(std::atoi(argv[2])) : 1}};
    const lumis::AliasTable<float> choice{std::array{1.0f, 1.0f, 1.0f, 1.0f}};  // in proportion to power, for instance
    lumis::RunningMoments<float> moments;
    for (int i = 0; i < paths; ++i) {
        const auto sample = lumis::UniformSphere<float>{}.sample(uniforms.next<2>());
        moments.add(radiance(vec3{-1, 1, -1}, sample.value, choice, uniforms));
    }
    std::printf("%.4f +- %.4f, exactly 1\n", moments.mean(), moments.standard_error());
    return std::abs(moments.mean() - 1) <= 4 * moments.standard_error() && moments.rejected() == 0 ? 0 : 1;
}
