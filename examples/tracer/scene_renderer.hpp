// A renderer for one type of scene: every loop and every estimator below is compiled for just this scene.
#pragma once

#include "camera.hpp"
#include "direct_light.hpp"
#include "random_stream.hpp"
#include "renderer.hpp"
#include "thread_clock.hpp"
#include "type_name.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <functional>
#include <tuple>
#include <type_traits>
#include <utility>

namespace tracer {

template <Scene S, class Integrators = AllIntegrators>
class SceneRenderer final : public Renderer {
  public:
    SceneRenderer(S scene, const SceneOptions& options, const Camera& camera) : scene_{std::move(scene)} {
        seen_.reserve(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height));
        for (int y = 0; y < options.height; ++y) {
            for (int x = 0; x < options.width; ++x) {
                seen_.push_back(look(camera.position, camera.direction(x, y, options.width, options.height)));
            }
        }
    }

    [[nodiscard]] std::vector<std::string> strategies(std::string_view integrator) const override {
        return with_integrator(integrator, [&]<class Integrator>(std::type_identity<Integrator>) {
            return names<Integrator>(std::type_identity<typename S::Material>{});
        });
    }

    double add_pass(Film& film, std::string_view integrator, int samples, std::uint64_t seed,
                    std::uint64_t pass) const override {
        return with_integrator(integrator, [&]<class Integrator>(std::type_identity<Integrator>) {
            const auto add_pixels = [&](const oneapi::tbb::blocked_range<std::size_t>& pixels, double seconds) {
                const ThreadClock clock;
                for (std::size_t i = pixels.begin(); i < pixels.end(); ++i) {
                    lumis::Uniforms uniforms{random_stream(seed, i, pass)};
                    glm::dvec3 sum{0};
                    for (int k = 0; k < samples; ++k) sum += radiance<Integrator>(seen_[i], uniforms);
                    film.pixels[i].add_pass(sum, static_cast<std::uint32_t>(samples));
                }
                return seconds + clock.seconds();
            };
            return oneapi::tbb::parallel_reduce(oneapi::tbb::blocked_range<std::size_t>{0, seen_.size(), 64}, 0.0,
                                                add_pixels, std::plus<>{});
        });
    }

  private:
    // What a pixel shows: a point to be lit, or light itself.
    using Seen = std::variant<Vertex, glm::vec3>;

    [[nodiscard]] Seen look(const glm::vec3& origin, const glm::vec3& direction) const {
        const auto hit = scene_.geometry().closest(origin, direction);
        if (!hit) return scene_.background(direction);
        if (hit->surface->radiance != glm::vec3{0}) return hit->surface->radiance;
        const bool front = glm::dot(hit->normal, direction) < 0;
        const lumis::Frame<float> frame{front ? hit->normal : -hit->normal};
        return Vertex{hit->position, frame, frame.to_local(-direction), hit->surface};
    }

    template <class Integrator>
    [[nodiscard]] glm::dvec3 radiance(const Seen& seen, auto& uniforms) const {
        if (const auto* light = std::get_if<glm::vec3>(&seen)) return *light;
        const Vertex& vertex = std::get<Vertex>(seen);
        return std::visit(
            [&](const auto& material) { return direct_light<Integrator>(scene_, vertex, material, uniforms); },
            scene_.material(*vertex.surface));
    }

    // Calls visit with the integrator of that name.
    template <class Visit>
    static auto with_integrator(std::string_view name, Visit visit) {
        return with_first_of(std::type_identity<Integrators>{}, name, visit);
    }
    template <class First, class... Rest, class Visit>
    static auto with_first_of(std::type_identity<std::tuple<First, Rest...>>, std::string_view name, Visit visit) {
        if constexpr (sizeof...(Rest) > 0) {
            if (name != First::name) return with_first_of(std::type_identity<std::tuple<Rest...>>{}, name, visit);
        }
        return visit(std::type_identity<First>{});
    }

    template <class Integrator, class... Materials>
    [[nodiscard]] static std::vector<std::string> names(std::type_identity<std::variant<Materials...>>) {
        return {type_name<Materials>() + ": " + type_name<Estimator<Integrator, Materials>>()...};
    }
    template <class Integrator, class Material>
    using Estimator =
        decltype(estimator_at<Integrator>(std::declval<S>(), std::declval<Vertex>(), std::declval<Material>()));

    S scene_;
    std::vector<Seen> seen_;  // pixel by pixel
};

}  // namespace tracer
