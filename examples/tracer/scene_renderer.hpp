// A renderer for one type of scene: every loop below is compiled for just this scene.
#pragma once

#include "paths/camera.hpp"
#include "paths/filter.hpp"
#include "paths/path.hpp"
#include "paths/sampler.hpp"
#include "paths/transport.hpp"
#include "renderer.hpp"
#include "task_order.hpp"
#include "thread_clock.hpp"
#include "type_name.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <functional>
#include <utility>

namespace tracer {

// R: a Packet, or float for one sample after the other.
template <Scene S, lumis::Real R = Packet>
class SceneRenderer final : public Renderer {
  public:
    SceneRenderer(S scene, const SceneOptions& options, const Camera& camera)
        : scene_{std::move(scene)},
          width_{options.width},
          view_{asked(camera, options.camera), options.width, options.height} {}

    [[nodiscard]] std::vector<std::string> strategies() const override {
        std::vector<std::string> names = S::MaterialTable::strategies();
        scene_.lights().for_each([&](const auto& group, auto) {
            names.push_back("light: " + type_name<typename std::remove_cvref_t<decltype(group)>::Strategy>());
        });
        return names;
    }

    [[nodiscard]] std::vector<std::string> notes() const override {
        if constexpr (requires { scene_.notes(); }) return scene_.notes();
        return {};
    }

    double add_pass(Film& film, std::string_view integrator, const RenderOptions& options, const SampleRange& samples,
                    std::uint64_t seed) const override {
        const Integrator chosen = value_named(integrators, integrator);
        // Optimal weights are learnt from samples that are independent of each other.
        const Sampler sampler = chosen == Integrator::Optimal ? Sampler::Random : options.sampler;
        const auto add_pixels = [&](const oneapi::tbb::blocked_range<std::size_t>& pixels, double seconds) {
            TaskOrder::task_begins();
            const ThreadClock clock;
            for (std::size_t i = pixels.begin(); i < pixels.end(); ++i) {
                PixelUniforms<R> uniforms{sampler, seed, i, samples.first};
                add_pixel(film.pixels[i], i, chosen, options, samples, uniforms);
            }
            TaskOrder::task_ends();
            return seconds + clock.seconds();
        };
        TaskOrder::call_begins();
        const double seconds = oneapi::tbb::parallel_reduce(
            oneapi::tbb::blocked_range<std::size_t>{0, film.pixels.size(), 64}, 0.0, add_pixels, std::plus<>{});
        TaskOrder::call_ends();
        return seconds;
    }

  private:
    void add_pixel(Pixel& pixel, std::size_t index, Integrator integrator, const RenderOptions& options,
                   const SampleRange& samples, PixelUniforms<R>& uniforms) const {
        const auto column = static_cast<float>(index % static_cast<std::size_t>(width_)),
                   row = static_cast<float>(index / static_cast<std::size_t>(width_));
        PathTracer<S, R> paths{scene_, integrator, options.bounces, uniforms};
        glm::dvec3 sum{0};
        glm::vec3 albedo{0}, normal{0};
        typename PathTracer<S, R>::Rounds::Sums direct;  // by optimal weights
        const int width = static_cast<int>(lanes<R>);
        for (int sample = 0; sample < samples.count; sample += width) {
            uniforms.start(samples.first + static_cast<std::uint32_t>(sample));
            const glm::vec<2, R> u = uniforms.template next<2>();
            const R x = column + 0.5f + filter_offset(options.filter, u.x),
                    y = row + 0.5f + filter_offset(options.filter, u.y);
            const Mask<R> asked = mask_of<R>([&](auto i) { return sample + static_cast<int>(i) < samples.count; });
            const Found<R> found = paths.along(view_.template ray<R>(x, y), asked, direct);
            for (std::size_t i = 0; i < lanes<R> && sample + static_cast<int>(i) < samples.count; ++i) {
                sum += glm::dvec3{lane_of(found.radiance, i)};
                albedo += lane_of(found.albedo, i);
                normal += lane_of(found.normal, i);
            }
        }
        sum += static_cast<double>(samples.count) * glm::dvec3{direct.estimate()};
        // Sums of the whole pass are added, so that a film of one pass that is merged gives the same bits.
        pixel.add_pass(sum, static_cast<std::uint32_t>(samples.count));
        pixel.albedo += albedo;
        pixel.normal += normal;
    }

    S scene_;
    int width_;
    View view_;
};

}  // namespace tracer
