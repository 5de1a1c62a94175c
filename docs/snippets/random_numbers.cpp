// The guide's sources of random numbers, and how many an estimate takes from them.
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <random>

namespace {

struct HostSampler {
    float next() { return 0.25f; }
};

// Counts what is asked of it.
struct Counted {
    int spent = 0;

    template <int N>
    glm::vec<N, float> next() {
        spent += N;
        return glm::vec<N, float>{0.3f};
    }
};

int spent_by(const auto& estimator) {
    Counted uniforms;
    (void)estimator.estimate([](const glm::vec3&) { return 1.0f; }, uniforms);
    return uniforms.spent;
}

TEST_CASE("sources of random numbers") {
    std::mt19937 engine{1};
    HostSampler sampler;

    lumis::Uniforms from_engine{engine};
    auto from_host = lumis::uniforms_from<float>([&] { return sampler.next(); });

    CHECK(from_engine.next<2>().x < 1);
    CHECK(from_host.next<1>().x == 0.25f);
}

TEST_CASE("what an estimate spends") {
    const lumis::CosineHemisphere<float> bsdf;
    const lumis::UniformSphere<float> light;
    const lumis::BalanceHeuristic balance;
    const lumis::Mixture mixture{lumis::choose(0.5, bsdf), lumis::choose(0.5, light)};
    const lumis::LightSet set{std::array{light, light}, std::array{1.0f, 1.0f}};

    CHECK(spent_by(multi_sample(balance, lumis::take(1, bsdf), lumis::take(3, light))) == 8);
    CHECK(spent_by(multi_sample(balance, lumis::take(1, bsdf), lumis::take(0, light))) == 2);
    CHECK(spent_by(one_sample(balance, lumis::choose(0.5, bsdf), lumis::choose(0.5, light))) == 3);
    CHECK(spent_by(multi_sample(balance, lumis::take(1, mixture))) == 3);
    CHECK(spent_by(multi_sample(balance, lumis::take(1, set))) == 3);
}

}  // namespace
