// An image depends on the seed alone, and estimators contain what their scene needs and nothing else.
#include "renderer.hpp"

#include "catch.hpp"

#include <oneapi/tbb/global_control.h>

#include <algorithm>

namespace {

using namespace tracer;

Image render(const Renderer& renderer, std::uint64_t seed, std::size_t threads) {
    const oneapi::tbb::global_control limit{oneapi::tbb::global_control::max_allowed_parallelism, threads};
    Film film{24, 16};
    for (std::uint64_t pass = 0; pass < 3; ++pass) renderer.add_pass(film, "power", 2, seed, pass);
    return film.image();
}

bool any_contains(const std::vector<std::string>& names, std::string_view part) {
    return std::ranges::any_of(names, [&](const std::string& name) { return name.find(part) != std::string::npos; });
}

std::vector<std::string> strategies(std::string_view scene, std::string_view integrator) {
    return find_scene(scene)->make({8, 8, {}})->strategies(integrator);
}

}  // namespace

TEST_CASE("an image depends on the seed alone") {
    for (const SceneEntry& scene : scenes()) {
        const auto renderer = scene.make({24, 16, {}});
        const Image one = render(*renderer, 7, 1);
        CHECK(one.pixels == render(*renderer, 7, 2).pixels);
        CHECK(one.pixels == render(*renderer, 7, 5).pixels);
        CHECK(one.pixels != render(*renderer, 8, 2).pixels);
    }
}

TEST_CASE("estimators contain what their scene needs and nothing else") {
    CHECK(any_contains(strategies("sky", "power"), "EnvironmentMap"));
    CHECK(!any_contains(strategies("veach", "power"), "EnvironmentMap"));
    CHECK(!any_contains(strategies("cornell", "power"), "EnvironmentMap"));
    CHECK(any_contains(strategies("veach", "power"), "Sphere"));
    CHECK(!any_contains(strategies("cornell", "power"), "Sphere"));

    // One technique alone contains neither the other nor a heuristic's terms.
    CHECK(!any_contains(strategies("veach", "bsdf"), "AreaLight"));
    CHECK(!any_contains(strategies("veach", "light"), "Ggx"));

    // A mirror asks no light, whatever the integrator; a diffuse wall has no GGX.
    for (const auto integrator : integrator_names) {
        for (const std::string& name : strategies("sky", integrator)) {
            if (name.starts_with("Mirror"))
                CHECK(name == "Mirror: MultiSample<BalanceHeuristic, InFrame<PerfectReflection>>");
            if (name.starts_with("Diffuse")) CHECK(name.find("Ggx") == std::string::npos);
        }
    }
}
