// The guide's threads: strategies are shared, a source of random numbers and its moments belong to one thread.
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <random>
#include <thread>
#include <vector>

namespace {

TEST_CASE("an estimate on several threads") {
    const lumis::AreaLight light{lumis::Parallelogram{glm::vec3{-1, -1, 1}, glm::vec3{2, 0, 0}, glm::vec3{0, 2, 0}},
                                 glm::vec3{0}};
    const auto direct = multi_sample(lumis::PowerHeuristic{}, lumis::take(1, light));
    const auto cosine = [](const glm::vec3& w) { return w.z; };
    const unsigned seed = 7;

    std::vector<lumis::RunningMoments<float>> parts(4);
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < parts.size(); ++i) {
        threads.emplace_back([&, i] {
            std::seed_seq mixed{seed, i};
            lumis::Uniforms uniforms{std::mt19937{mixed}};
            for (int k = 0; k < 25'000; ++k) parts[i].add(direct.estimate(cosine, uniforms));
        });
    }
    for (std::thread& thread : threads) thread.join();
    lumis::RunningMoments<float> all;
    for (const auto& part : parts) all.merge(part);

    CHECK(all.count() == 100'000);
    CHECK(std::abs(all.mean() - 1.740839502734) <= 4 * all.standard_error());
}

}  // namespace
