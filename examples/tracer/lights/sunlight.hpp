// The sun: a cone of directions that shines evenly where rays meet nothing, alone or in a sky.
#pragma once

#include "lights/lights.hpp"
#include "paths/packet.hpp"
#include <lumis/combine/mixture.hpp>
#include <lumis/lights/sun.hpp>

#include <cstddef>
#include <limits>
#include <utility>

namespace tracer {

class Sunlight {
  public:
    static constexpr bool is_background = true, is_delta = false;
    static constexpr std::size_t samples = 1;
    using Strategy = lumis::Sun<float>;

    Sunlight(const Strategy& sun, const glm::vec3& radiance) : sun_{sun}, radiance_{radiance} {}

    template <lumis::Real R>
    [[nodiscard]] Vector<R> radiance(const Vector<R>& w) const {
        return lumis::real::select(sun_.pdf(w) > 0.0f, Vector<R>(radiance_), Vector<R>{R(0.0f)});
    }

    // The same wherever it is seen from.
    template <lumis::Real R>
    class Seen {
      public:
        explicit Seen(const Sunlight& light) : light_{light} {}

        [[nodiscard]] LightDraw<R> sample(const glm::vec<3, R>& u) const {
            const auto drawn = light_.sun_.sample(glm::vec<2, R>{u.x, u.y});
            return {drawn.value, drawn.pdf, drawn.distance, Vector<R>(light_.radiance_)};
        }
        [[nodiscard]] MetSky<R> met(const Vector<R>& w) const { return {light_.radiance(w), light_.sun_.pdf(w)}; }

      private:
        const Sunlight& light_;
    };

    template <lumis::Real R>
    [[nodiscard]] Seen<R> seen_from(const Receiver<R>& /*receiver*/, std::size_t /*count*/) const {
        return Seen<R>{*this};
    }

  private:
    lumis::Sun<float> sun_;
    glm::vec3 radiance_;
};

// A sun in a sky, whose radiances add up. One is chosen by half; two samples are one of each.
template <class Sky>
class SunAndSky {
  public:
    static constexpr bool is_background = true, is_delta = false;
    static constexpr std::size_t samples = 2;
    using Strategy = lumis::Mixture<Sunlight::Strategy, typename Sky::Strategy>;

    SunAndSky(const Sunlight& sun, Sky sky) : sun_{sun}, sky_{std::move(sky)} {}

    template <lumis::Real R>
    [[nodiscard]] Vector<R> radiance(const Vector<R>& w) const {
        return sun_.radiance(w) + sky_.radiance(w);
    }

    template <lumis::Real R>
    class Seen {
      public:
        Seen(const SunAndSky& both, const Receiver<R>& receiver)
            : sun_{both.sun_.seen_from(receiver, 1)}, sky_{both.sky_.seen_from(receiver, 1)} {}

        // u.x chooses.
        [[nodiscard]] LightDraw<R> sample(const glm::vec<3, R>& u) const {
            const Mask<R> is_sun = u.x < 0.5f, is_sky = !is_sun;
            const glm::vec<3, R> rest{u.x + u.x - lumis::real::select(is_sun, R(0.0f), R(1.0f)), u.y, u.z};
            LightDraw<R> drawn{};
            if (any(is_sun)) drawn = sun_.sample(rest);
            if (any(is_sky)) {
                const LightDraw<R> of_sky = sky_.sample(rest);
                drawn.direction = lumis::real::select(is_sky, of_sky.direction, drawn.direction);
                drawn.pdf = lumis::real::select(is_sky, of_sky.pdf, drawn.pdf);
            }
            const MetSky<R> there = met(drawn.direction);
            return {drawn.direction, lumis::real::select(drawn.pdf > 0.0f, there.pdf, 0.0f),
                    R(std::numeric_limits<float>::infinity()), there.radiance};
        }

        [[nodiscard]] MetSky<R> met(const Vector<R>& w) const {
            const MetSky<R> sun = sun_.met(w), sky = sky_.met(w);
            return {sun.radiance + sky.radiance, 0.5f * (sun.pdf + sky.pdf)};
        }

      private:
        typename Sunlight::Seen<R> sun_;
        typename Sky::template Seen<R> sky_;
    };

    template <lumis::Real R>
    [[nodiscard]] Seen<R> seen_from(const Receiver<R>& receiver, std::size_t /*count*/) const {
        return Seen<R>{*this, receiver};
    }

  private:
    Sunlight sun_;
    Sky sky_;
};

}  // namespace tracer
