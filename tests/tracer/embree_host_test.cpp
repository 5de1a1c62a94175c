// examples/embree_host against the tracer, which has its own loop, its own intersections, its own materials and other
// estimators; and in a furnace, where the answer is known for paths of any length.
#include "adaptors.hpp"
#include "block_moments.hpp"
#include "coarse_sky.hpp"
#include "folder.hpp"
#include "render.hpp"
#include "scene_renderer.hpp"
#include "textbook/host_parts.hpp"

#include <fstream>
#include <random>

namespace {

const std::string room = LUMIS_EXAMPLES_DATA "/room.obj";
constexpr host::View view{host::room_view.position, host::room_view.target, host::room_view.degrees, 32, 24};

host::Sky sky_of(const tracer::Image& image) {
    host::Sky sky{image.width, image.height, {}};
    for (const glm::vec3& pixel : image.pixels) sky.texels.push_back(host::from_lumis(pixel));
    return sky;
}

// Moments of independent images, of a few samples each.
template <class Parts>
BlockMoments host_moments(const host::Scene& scene, int samples, int bounces) {
    const Parts parts{scene};
    BlockMoments moments{view.width, view.height};
    for (std::uint64_t seed = 0; seed < 32; ++seed) {
        tracer::Image image{view.width, view.height, {}};
        for (const host::Vec& pixel : render(scene, parts, view, samples, bounces, seed)) {
            image.pixels.push_back(host::to_lumis(pixel));
        }
        moments.add(image);
    }
    return moments;
}

// The host's sky for the tracer: each texel all of one radiance.
class SteppedSky {
  public:
    static constexpr bool is_background = true, is_delta = false;
    static constexpr std::size_t samples = 1;
    using Strategy = lumis::EnvironmentMap<float>;

    explicit SteppedSky(const tracer::Image& sky) : sky_{sky}, map_{sky.width, sky.height, luminances(sky)} {}

    template <lumis::Real R>
    [[nodiscard]] glm::vec3 radiance(const glm::vec3& w) const {
        const auto uv = lumis::latlong_from_direction(w);
        const auto at = [](float t, int size) {
            return std::min(static_cast<int>(t * static_cast<float>(size)), size - 1);
        };
        return sky_.pixels[static_cast<std::size_t>(at(uv.y, sky_.height) * sky_.width + at(uv.x, sky_.width))];
    }

    // The same from everywhere.
    struct Seen {
        const SteppedSky& sky;

        [[nodiscard]] tracer::LightDraw<float> sample(const glm::vec3& u) const {
            const auto drawn = sky.map_.sample({u.x, u.y});
            return {drawn.value, drawn.pdf, drawn.distance, sky.radiance<float>(drawn.value)};
        }
        struct Met {
            glm::vec3 radiance;
            float pdf;
        };
        [[nodiscard]] Met met(const glm::vec3& w) const { return {sky.radiance<float>(w), sky.map_.pdf(w)}; }
    };
    template <lumis::Real R>
    [[nodiscard]] Seen seen_from(const tracer::Receiver<R>& /*receiver*/, std::size_t /*count*/) const {
        return {*this};
    }

  private:
    static std::vector<float> luminances(const tracer::Image& sky) {
        std::vector<float> result;
        for (const glm::vec3& pixel : sky.pixels) result.push_back(tracer::luminance(pixel));
        return result;
    }

    tracer::Image sky_;
    Strategy map_;
};

// The same room for the tracer. The corners of its faces, which are parallelograms, are read from the file once more.
class Room {
  public:
    using MaterialTable = tracer::Materials<tracer::Diffuse<float>, tracer::Coated<float>>;
    using LightTable = tracer::Lights<tracer::FewLights<lumis::Parallelogram, lumis::ByArea>, SteppedSky>;

    Room(const host::Scene& scene, const tracer::Image& sky) : lights_{{}, SteppedSky{sky}} {
        std::ifstream file{room};
        std::vector<glm::vec3> corners;
        std::size_t faces = 0;
        for (std::string word; file >> word;) {
            if (word == "v") {
                file >> corners.emplace_back().x >> corners.back().y >> corners.back().z;
            } else if (word == "f") {
                std::array<std::size_t, 4> face{};
                for (std::size_t& corner : face) file >> corner;
                const glm::vec3 a = corners[face[0] - 1];
                const lumis::Parallelogram<float> shape{a, corners[face[1] - 1] - a, corners[face[3] - 1] - a};
                const host::Material& m =
                    scene.materials[scene.triangles[2 * faces++].material];  // two triangles a face
                const glm::vec3 radiance = host::to_lumis(m.emission);
                tracer::Surface surface = surface_of(m);
                if (radiance != glm::vec3{0}) surface = lights_.add<0>(shape, radiance, surface);
                geometry_.add(shape, surface);
            }
        }
        geometry_.commit();
    }

    [[nodiscard]] const tracer::Geometry& geometry() const { return geometry_; }
    [[nodiscard]] const MaterialTable& materials() const { return materials_; }
    [[nodiscard]] const LightTable& lights() const { return lights_; }

  private:
    tracer::Surface surface_of(const host::Material& m) {
        const glm::vec3 albedo = host::to_lumis(m.albedo);
        if (m.alpha > 0) return materials_.add(tracer::Coated<float>{albedo, m.alpha, m.index});
        return materials_.add(tracer::Diffuse<float>{albedo});
    }

    tracer::Geometry geometry_;
    MaterialTable materials_;
    LightTable lights_;
};

}  // namespace

// Written from books in the one, and by Lumis in the other. An image does not show a coat that is 4 % off.
TEST_CASE("the host's coat reflects what the tracer's does") {
    const host::Material mine{{0.2f, 0.3f, 0.4f}, {}, 0.25f, 1.5f};
    const tracer::Coated<float> other{{0.2f, 0.3f, 0.4f}, 0.25f, 1.5f};
    lumis::Uniforms uniforms{std::mt19937{1}};
    for (int i = 0; i < 1000; ++i) {
        const auto wo = lumis::UniformHemisphere<float>{}.sample(uniforms.next<2>()).value;
        const auto wi = lumis::UniformHemisphere<float>{}.sample(uniforms.next<2>()).value;
        const glm::vec3 expected = other.strategy(wo).evaluate(wi).reflected;
        const glm::vec3 reflected =
            host::to_lumis(mine.reflected({0, 0, 1}, host::from_lumis(wo), host::from_lumis(wi)));
        CHECK(glm::length(reflected - expected) <= 1e-4f * glm::length(expected));
    }
}

TEST_CASE("the host's direct light is the tracer's") {
    const tracer::Image sky = coarse_sky();
    const host::Scene scene{room, sky_of(sky)};
    REQUIRE(scene.lights.size() == 6);
    const tracer::Camera camera{host::to_lumis(view.position), host::to_lumis(view.target), {0, 1, 0}, view.degrees};
    const tracer::SceneRenderer<Room, float> renderer{Room{scene, sky}, {view.width, view.height, ""}, camera};
    BlockMoments expected{view.width, view.height};
    for (std::uint64_t seed = 1; seed <= 32; ++seed) {
        tracer::Film film{view.width, view.height};
        renderer.add_pass(film, "power", {.bounces = 1}, {0, 64}, seed);
        expected.add(film.image());
    }
    require_same_means(host_moments<host::LumisParts>(scene, 8, 1), expected, 2, "Lumis");
    require_same_means(host_moments<textbook::HostParts>(scene, 8, 1), expected, 2, "textbook");
}

// Where all surfaces emit half of what the sky does, and reflect the other half, everything looks like the sky.
TEST_CASE("the host's paths see no furnace") {
    const Folder folder;
    std::ifstream obj{room};
    std::ofstream furnace{folder.file("room.obj")}, materials{folder.file("room.mtl")};
    furnace << obj.rdbuf() << std::flush;
    for (const char* name : {"floor", "white", "red", "blue", "slab", "lamp", "strip", "spark"}) {
        materials << "newmtl " << name << "\nKd 0.5 0.5 0.5\nKe 1 1 1\n";
    }
    materials << std::flush;
    const host::Scene scene{folder.file("room.obj"), {1, 1, {host::Vec{2, 2, 2}}}};
    REQUIRE(scene.lights.size() == scene.triangles.size());
    BlockMoments moments = host_moments<host::LumisParts>(scene, 8, 1000);
    BlockMoments exact{view.width, view.height};
    exact.add({view.width, view.height,
               std::vector<glm::vec3>(static_cast<std::size_t>(view.width * view.height), glm::vec3{2})});
    exact.add({view.width, view.height,
               std::vector<glm::vec3>(static_cast<std::size_t>(view.width * view.height), glm::vec3{2})});
    require_same_means(exact, moments, 1, "furnace");
}
