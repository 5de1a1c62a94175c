// Path tracing with next event estimation and multiple importance sampling at every bounce. A path's next ray serves twice: it
// goes on, and where it meets a light it is the BSDF's sample of direct light.
#pragma once

#include "geometry/geometry.hpp"
#include "lights/lights.hpp"
#include "materials/material_table.hpp"
#include "materials/materials.hpp"
#include "paths/direct_rounds.hpp"
#include "paths/packet.hpp"
#include "paths/sampler.hpp"
#include "paths/transport.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

namespace tracer {

// A scene is a type: what it does not list is not compiled.
template <class S>
concept Scene = requires(const S scene) {
    { scene.geometry() } -> std::same_as<const Geometry&>;
    typename S::MaterialTable;  // Materials<...>
    typename S::LightTable;     // Lights<...>
    { scene.materials() } -> std::same_as<const typename S::MaterialTable&>;
    { scene.lights() } -> std::same_as<const typename S::LightTable&>;
};

// What a path has found, in each lane.
template <lumis::Real R>
struct Found {
    Vector<R> radiance;
    Vector<R> albedo, normal;  // of the first surface
};

template <Scene S, lumis::Real R>
class PathTracer {
  public:
    PathTracer(const S& scene, Integrator integrator, int bounces, PixelUniforms<R>& uniforms)
        : scene_{scene}, integrator_{integrator}, bounces_{bounces}, uniforms_{uniforms} {}

    using Rounds = DirectRounds<R, S::LightTable::counts.size()>;

    // The radiance that arrives along a ray, in the lanes asked for. With optimal weights, direct light at the first surface is
    // left out of it and added to the pixel's sums.
    [[nodiscard]] Found<R> along(Ray<R> ray, const Mask<R>& asked, typename Rounds::Sums& sums) {
        Mask<R> alive = asked, asks_first(false);
        Hit<R> hit = scene_.geometry().closest(ray, alive, Rays::Alike);
        Surfaces on = surfaces_of(hit, alive);
        Found<R> found{emitted(ray, on, alive), black, hit.normal};
        Vector<R> throughput{R(1.0f)};
        Vector<R> absorption = black;  // of the medium that the path is in: a camera stands in the open
        for (int bounce = 1; bounce <= bounces_; ++bounce) {
            alive = alive && on.reflects;
            if (!any(alive)) break;
            const Vertex vertex{hit, ray.direction, alive};
            const auto lights =
                scene_.lights().template seen_from<R>(vertex.receiver(integrator_ != Integrator::Light), bounce);

            // A polished material asks no light. The one-sample model asks lights in half of all cases, else the BSDF.
            const Mask<R> is_found_by_both = !on.is_polished && Mask<R>(asks_lights(integrator_));
            Mask<R> asks = alive && is_found_by_both, goes_on = alive;
            if (integrator_ == Integrator::OneSample) {
                asks = asks && uniforms_.template next<1>().x < 0.5f;
                goes_on = alive && !asks;
            }

            Rounds* const rounds = integrator_ == Integrator::Optimal && bounce == 1 ? &rounds_ : nullptr;
            if (bounce == 1) asks_first = asks;

            // Directions of both: by the BSDF, and towards lights. The BSDF's uniforms come first, for Sobol's points are even in
            // four dimensions: those of the pixel's filter and of the first direction.
            const auto u = uniforms_.template next<S::MaterialTable::dimensions>();
            Draws draws;
            if (asks_lights(integrator_)) draw_from(lights, bounce, asks, draws);
            const Scattered next = scattered(on, vertex, alive, goes_on, asks, u, draws);
            if (bounce == 1) found.albedo = next.albedo;
            if (any(asks)) found.radiance += throughput * direct_light(draws, vertex, absorption, asks, rounds);

            // The path goes on.
            throughput *= next.factor;
            alive = goes_on && next.is_drawn;
            if (integrator_ == Integrator::OneSample) {
                throughput *= lumis::real::select(is_found_by_both, R(2.0f), R(1.0f));
            }
            if (integrator_ == Integrator::Light && bounce == bounces_) {
                alive = alive && !is_found_by_both;  // nothing is left to be found
            }
            if (bounce >= sure_bounces && bounce < bounces_) alive = alive && survives(throughput);
            if (!any(alive)) break;
            ray = {hit.position, lumis::real::select(alive, next.direction, up)};
            hit = scene_.geometry().closest(ray, alive);
            if constexpr (S::MaterialTable::absorb) {
                absorption = lumis::real::select(next.changes_medium, next.absorption, absorption);
                throughput *= left_after(hit.distance, absorption);
            }
            on = surfaces_of(hit, alive);
            found.radiance += throughput * emitted(ray, hit, on, alive, bounce, lights, next, is_found_by_both, rounds);
        }
        if (integrator_ == Integrator::Optimal) rounds_.move_to(sums, asked, asks_first, S::LightTable::counts);
        return found;
    }

  private:
    static constexpr int sure_bounces = 3;  // before Russian roulette
    const Vector<R> black{R(0.0f)}, up{R(0.0f), R(0.0f), R(1.0f)};

    // What is met, in each lane.
    struct Surfaces {
        Indices<R> kind, material, group, light;
        Mask<R> reflects, is_polished;
    };
    [[nodiscard]] LUMIS_INLINE Surfaces surfaces_of(const Hit<R>& hit, const Mask<R>& alive) const {
        Surfaces on;
        for (std::size_t i = 0; i < lanes<R>; ++i) {
            const bool is_met = lane(hit.is_met, i) && lane(alive, i);
            const Surface surface = is_met ? scene_.geometry().surface(hit.surface[i]) : Surface{};
            on.kind[i] = surface.kind;
            on.material[i] = surface.material;
            on.group[i] = is_met ? surface.group : background;
            on.light[i] = surface.light;
        }
        on.reflects = !are<R>(on.kind, Surface::none);
        on.is_polished = scene_.materials().template are_delta<R>(on.kind);
        return on;
    }
    static constexpr std::uint32_t background = Surface::none - 1;

    // A point where light is scattered; idle lanes have directions all the same.
    struct Vertex {
        Vector<R> position, normal, wo;  // in world space; the normal is the shape's own

        Vertex(const Hit<R>& hit, const Vector<R>& direction, const Mask<R>& alive)
            : position{hit.position},
              normal{lumis::real::select(alive, hit.normal, Vector<R>{R(0.0f), R(0.0f), R(1.0f)})},
              wo{lumis::real::select(alive, -direction, Vector<R>{R(0.0f), R(0.0f), R(1.0f)})} {}

        // Materials that do not transmit turn their normal to the viewer's side.
        template <bool transmits>
        [[nodiscard]] LUMIS_INLINE lumis::Frame<R> frame() const {
            if constexpr (transmits) {
                return lumis::Frame<R>{normal};
            } else {
                return lumis::Frame<R>{towards_viewer()};
            }
        }
        [[nodiscard]] LUMIS_INLINE Receiver<R> receiver(bool has_bsdf_samples) const {
            return {position, S::MaterialTable::transmit ? Vector<R>{R(0.0f)} : towards_viewer(), has_bsdf_samples};
        }

      private:
        [[nodiscard]] LUMIS_INLINE Vector<R> towards_viewer() const {
            return lumis::real::select(glm::dot(normal, wo) < 0.0f, -normal, normal);
        }
    };

    // Samples of light, each with what the material scatters of it.
    struct Draw {
        LightDraw<R> light;
        R own;  // its effective density
        Scattering<R> scattering;
        std::size_t group;
        float count;  // of the group's draws
    };
    struct Draws {
        std::array<Draw, S::LightTable::samples> all{};
        std::size_t count = 0;

        [[nodiscard]] auto begin() { return all.begin(); }
        [[nodiscard]] auto end() { return all.begin() + static_cast<std::ptrdiff_t>(count); }
        [[nodiscard]] auto begin() const { return all.begin(); }
        [[nodiscard]] auto end() const { return all.begin() + static_cast<std::ptrdiff_t>(count); }
    };

    // Uniforms are spent whether or not a lane asks: what one lane finds does not depend on the others.
    LUMIS_INLINE void draw_from(const auto& lights, int bounce, const Mask<R>& asks, Draws& draws) {
        scene_.lights().for_each([&](const auto& group, auto g) {
            const std::size_t count = S::LightTable::samples_at(bounce, group);
            for (std::size_t i = 0; i < count; ++i) {
                glm::vec<3, R> u = uniforms_.template next<3>();
                if (!any(asks)) continue;
                u.x = (u.x + static_cast<float>(i)) * (1.0f / static_cast<float>(count));
                const LightDraw<R> light = std::get<g>(lights).sample(u);
                draws.all[draws.count++] = {light,
                                            effective(static_cast<float>(count) * light.pdf),
                                            {black, R(0.0f)},
                                            g,
                                            static_cast<float>(count)};
            }
        });
    }

    // A density times the probability of taking a sample.
    [[nodiscard]] LUMIS_INLINE R effective(const R& density) const {
        return integrator_ == Integrator::OneSample ? R(0.5f * density) : density;
    }

    // A direction drawn by the BSDF. factor: what throughput is multiplied by.
    struct Scattered {
        Vector<R> direction, factor;
        R pdf;  // 0 of a polished material
        Mask<R> is_drawn;
        Vector<R> albedo;  // of the material
        Mask<R> changes_medium;
        Vector<R> absorption;  // of the medium that it then goes on in
    };

    // Draws by the BSDF in the lanes that go on, and tells lanes that ask lights what it scatters of their draws.
    [[nodiscard]] LUMIS_INLINE Scattered scattered(const Surfaces& on, const Vertex& vertex, const Mask<R>& alive,
                                                   const Mask<R>& goes_on, const Mask<R>& asks, const auto& u,
                                                   Draws& draws) {
        Scattered next{up, black, R(0.0f), Mask<R>(false), black, Mask<R>(false), black};
        scene_.materials().template visit<R>(
            on.kind, on.material, alive, [&](const auto& material, const Mask<R>& mask) {
                using Material = std::remove_cvref_t<decltype(material)>;
                const auto frame = vertex.template frame<Material::transmits>();
                const Vector<R> wo = frame.to_local(vertex.wo);
                const auto bsdf = material.strategy(wo);
                next.albedo = lumis::real::select(mask, Vector<R>(material.albedo_seen(wo)), next.albedo);
                if constexpr (!Material::is_delta) {
                    const Mask<R> hears = mask && asks;
                    if (any(hears)) {
                        for (Draw& draw : draws) {
                            Scattering<R> one = bsdf.evaluate(frame.to_local(draw.light.direction));
                            if (S::LightTable::is_delta(draw.group)) one.pdf = R(0.0f);
                            draw.scattering = {lumis::real::select(hears, one.reflected, draw.scattering.reflected),
                                               lumis::real::select(hears, one.pdf, draw.scattering.pdf)};
                        }
                    }
                }
                const auto drawn = bsdf.sample(first<std::remove_cvref_t<decltype(bsdf)>::dimensions>(u));
                const Mask<R> is_drawn = mask && goes_on && drawn.pdf > 0.0f;
                const auto [value, pdf] = value_at(bsdf, drawn);
                const Vector<R> factor = value * lumis::real::quotient_where(is_drawn, R(1.0f), drawn.pdf);
                next.direction = lumis::real::select(is_drawn, frame.to_world(drawn.value), next.direction);
                next.factor = lumis::real::select(is_drawn, factor, next.factor);
                next.pdf = lumis::real::select(is_drawn, pdf, next.pdf);
                next.is_drawn = next.is_drawn || is_drawn;
                if constexpr (S::MaterialTable::absorb && Material::transmits) {
                    next.changes_medium = next.changes_medium || is_drawn;
                    if constexpr (Absorbs<Material>) {
                        const Mask<R> is_inside = is_drawn && drawn.value.z < 0.0f;
                        next.absorption = lumis::real::select(is_inside, material.absorption, next.absorption);
                    }
                }
            });
        return next;
    }

    [[nodiscard]] LUMIS_INLINE static Scattering<R> value_at(const auto& bsdf, const auto& drawn) {
        if constexpr (requires { bsdf.coefficient(drawn.value); }) {
            return {bsdf.coefficient(drawn.value), R(0.0f)};
        } else {
            return {bsdf.evaluate(drawn.value).reflected, drawn.pdf};
        }
    }

    // What the material scatters of the draws that nothing hides, weighted.
    [[nodiscard]] LUMIS_INLINE Vector<R> direct_light(const Draws& draws, const Vertex& vertex,
                                                      const Vector<R>& absorption, const Mask<R>& asks,
                                                      Rounds* rounds) {
        Vector<R> sum = black;
        for (const Draw& draw : draws) {
            const Mask<R> is_drawn = asks && draw.light.pdf > 0.0f;
            const R weight = weight_of_light_sample(integrator_, draw.own, effective(draw.scattering.pdf));
            const R factor = lumis::real::quotient_where(is_drawn, weight, draw.own);
            Vector<R> light = draw.scattering.reflected * draw.light.radiance * factor;
            if constexpr (S::MaterialTable::absorb) light *= left_after(draw.light.distance, absorption);
            Mask<R> arrives = is_drawn && light.x + light.y + light.z > 0.0f;
            if (rounds != nullptr) arrives = arrives || (is_drawn && draw.scattering.pdf > 0.0f);
            if (any(arrives)) {
                const Ray<R> shadow{vertex.position, lumis::real::select(arrives, draw.light.direction, up)};
                arrives = arrives && !scene_.geometry().is_occluded(shadow, draw.light.distance, arrives);
            }
            if (rounds != nullptr) {
                rounds->add_light_sample(asks, arrives,
                                         {draw.group, draw.count, light, draw.scattering.pdf, draw.light.pdf});
            } else {
                sum += lumis::real::select(arrives, light, black);
            }
        }
        return sum;
    }

    // Light that the camera's ray meets.
    [[nodiscard]] LUMIS_INLINE Vector<R> emitted(const Ray<R>& ray, const Surfaces& on, const Mask<R>& alive) const {
        Vector<R> result = black;
        scene_.lights().for_each([&](const auto& group, auto g) {
            const Mask<R> is_met = meets<g>(group, on, alive);
            if (!any(is_met)) return;
            if constexpr (std::remove_cvref_t<decltype(group)>::is_background) {
                result = lumis::real::select(is_met, group.template radiance<R>(ray.direction), result);
            } else {
                result = lumis::real::select(is_met, group.template radiance<R>(filled<R>(on.light, is_met)), result);
            }
        });
        return result;
    }

    // Light that the BSDF's ray meets, weighted: light sampling, as seen from the ray's origin, could have found it too.
    [[nodiscard]] LUMIS_INLINE Vector<R> emitted(const Ray<R>& ray, const Hit<R>& hit, const Surfaces& on,
                                                 const Mask<R>& alive, int bounce, const auto& lights,
                                                 const Scattered& drawn, const Mask<R>& is_found_by_both,
                                                 Rounds* rounds) const {
        Vector<R> result = black;
        scene_.lights().for_each([&](const auto& group, auto g) {
            const Mask<R> is_met = meets<g>(group, on, alive);
            if (!any(is_met)) return;
            Vector<R> radiance;
            R light_pdf;
            if constexpr (std::remove_cvref_t<decltype(group)>::is_background) {
                const auto met = std::get<g>(lights).met(ray.direction);
                radiance = met.radiance, light_pdf = met.pdf;
            } else {
                const Indices<R> light = filled<R>(on.light, is_met);
                radiance = group.template radiance<R>(light);
                light_pdf = std::get<g>(lights).pdf_from_hit(light, hit.distance, glm::dot(hit.normal, ray.direction));
            }
            const auto count = static_cast<float>(S::LightTable::samples_at(bounce, group));
            const R own = effective(drawn.pdf), other = effective(count * light_pdf);
            const R weight =
                lumis::real::select(is_found_by_both, weight_of_bsdf_sample(integrator_, own, other), R(1.0f));
            Vector<R> light = radiance * weight;
            if (rounds != nullptr) {
                // The balance heuristic's weight over the BSDF's density is one over the sum of both.
                const Mask<R> is_round = is_met && is_found_by_both;
                rounds->add_bsdf_sample(is_round, {g, count, drawn.factor * light, drawn.pdf, light_pdf});
                light = lumis::real::select(is_round, black, light);
            }
            result = lumis::real::select(is_met, light, result);
        });
        return result;
    }

    template <std::size_t G, class Group>
    [[nodiscard]] LUMIS_INLINE static Mask<R> meets(const Group& /*group*/, const Surfaces& on, const Mask<R>& alive) {
        constexpr std::uint32_t met = Group::is_background ? background : static_cast<std::uint32_t>(G);
        return alive && are<R>(on.group, met);
    }

    // Russian roulette: a path that goes on stands for those that end.
    [[nodiscard]] LUMIS_INLINE Mask<R> survives(Vector<R>& throughput) {
        using lumis::real::greater;
        const R survival = lumis::real::lesser(greater(greater(throughput.x, throughput.y), throughput.z), 1.0f);
        const Mask<R> goes_on = uniforms_.template next<1>().x < survival;
        throughput *= lumis::real::quotient_where(goes_on, R(1.0f), survival);
        return goes_on;
    }

    template <int N, int M>
    [[nodiscard]] LUMIS_INLINE static glm::vec<N, R> first(const glm::vec<M, R>& u) {
        glm::vec<N, R> result;
        for (int k = 0; k < N; ++k) result[k] = u[k];
        return result;
    }

    const S& scene_;
    Integrator integrator_;
    int bounces_;
    PixelUniforms<R>& uniforms_;
    Rounds rounds_;
};

}  // namespace tracer
