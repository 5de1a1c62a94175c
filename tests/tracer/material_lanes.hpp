// Materials in lanes against each of them alone.
#pragma once

#include "assertions.hpp"
#include "catch.hpp"
#include "material_subjects.hpp"
#include "paths/packet.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <type_traits>
#include <vector>

namespace subjects {

// A packet of materials, gathered as a packet of paths gathers them, against each of them alone.
template <class M>
class LanesAndNumbers {
  public:
    explicit LanesAndNumbers(const M& typical) : typical_{numbers(typical)} {}

    // Each lane has its own material, the typical one with each number scaled. Where some are broken, every other lane has
    // a number that is none, in its material or a direction.
    void run(bool some_are_broken) {
        std::vector<M> materials;
        std::vector<glm::vec3> wo, wi;
        for (std::size_t i = 0; i < Packet::size; ++i) {
            auto own = typical_;
            for (float& x : own) x *= 0.8f + 0.2f * uniform_(engine_);  // an index near 1 would magnify what is rounded
            wo.push_back(direction_above()), wi.push_back(direction_above());
            is_sound_[i] = !some_are_broken || i % 2 == 0;
            if (!is_sound_[i]) {
                own[engine_() % own.size()] = broken_number();
                (i % 4 < 2 ? wo[i] : wi[i])[static_cast<int>(engine_() % 3)] = broken_number();
            }
            materials.push_back(std::bit_cast<M>(own));
        }
        const CaughtAssertions caught;
        const auto lanes = gathered<typename M::template In<Packet>>(materials).strategy(gathered<Vector<Packet>>(wo));
        lumis::UniformsOf<std::remove_cvref_t<decltype(lanes)>> u;
        for (int k = 0; k < lanes.dimensions; ++k) u[k] = Packet::of_lanes([&](auto) { return uniform_(engine_); });
        const auto drawn = lanes.sample(u);
        const auto of_drawn = value_at(lanes, drawn.value), of_wi = value_at(lanes, gathered<Vector<Packet>>(wi));
        for (std::size_t i = 0; i < Packet::size; ++i) {
            INFO("lane " << i);
            const auto alone = materials[i].strategy(wo[i]);
            const auto one = alone.sample(lumis::detail::lane_of(u, i));
            const glm::vec3 value = lane_of<Packet>(drawn.value, i);
            if (is_sound_[i]) {
                REQUIRE(close(drawn.pdf[i], one.pdf));
                if (one.pdf > 0) REQUIRE(glm::length(value - one.value) <= (fused ? 256 : 4) * epsilon);
            }
            require_same(of_drawn, value_at(alone, value), i);
            require_same(of_wi, value_at(alone, wi[i]), i);
            REQUIRE(close(value_at(alone, wi[i]).pdf, alone.pdf(wi[i])));
        }
    }

  private:
    template <class To>
    static To gathered(const auto& of_each) {
        Indices<Packet> all;
        std::iota(all.begin(), all.end(), std::uint32_t{0});
        return gather<To, Packet>(of_each, all);
    }

    // The coefficient of a delta material.
    template <lumis::Real R>
    static Scattering<R> value_at(const auto& bsdf, const Vector<R>& wi) {
        if constexpr (M::is_delta) {
            return {bsdf.coefficient(wi), R(0.0f)};
        } else {
            return bsdf.evaluate(wi);
        }
    }

    void require_same(const Scattering<Packet>& lanes, const Scattering<float>& one, std::size_t i) const {
        const glm::vec3 reflected = lane_of<Packet>(lanes.reflected, i);
        for (int k = 0; k < 3; ++k) {
            for (const float x : {reflected[k], one.reflected[k]}) REQUIRE((x >= 0 && std::isfinite(x)));
            REQUIRE((!is_sound_[i] || close(reflected[k], one.reflected[k])));
        }
        REQUIRE((!is_sound_[i] || close(lanes.pdf[i], one.pdf)));
        REQUIRE((M::is_delta || one.pdf > 0 || one.reflected == glm::vec3{0}));
    }

    // Equal up to rounding: where products are fused, numbers round in other ways than lanes.
    static bool close(float a, float b) {
        return a == b || std::abs(a - b) <= (fused ? 4096 : 16) * epsilon * std::abs(b);
    }

    float broken_number() {
        constexpr float infinity = std::numeric_limits<float>::infinity(),
                        nan = std::numeric_limits<float>::quiet_NaN();
        constexpr std::array all{nan, infinity, -infinity, 0.0f, -1.0f, 1e30f, 1e-30f};
        return all[engine_() % all.size()];
    }
    // Not grazing, where rounding is magnified; of what transmits, on either side.
    glm::vec3 direction_above() {
        const float versine = 0.9f * uniform_(engine_), turn = uniform_(engine_);
        const glm::vec3 w = lumis::direction_at(versine, turn);
        return M::transmits && engine_() % 2 == 0 ? -w : w;
    }

    static constexpr float epsilon = std::numeric_limits<float>::epsilon();
    std::array<float, count<M>> typical_;
    std::array<bool, Packet::size> is_sound_{};
    std::mt19937 engine_{1};
    std::uniform_real_distribution<float> uniform_{0, 0.99f};
};

}  // namespace subjects
