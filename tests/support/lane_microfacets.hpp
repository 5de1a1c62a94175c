// Subjects of lane_subjects.hpp: what rough surfaces reflect and transmit.
#pragma once

#include "lane_numbers.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace subjects {

// wo and the roughness along x and y.
template <class MakeOf>
struct OfDirectionAndRoughness {
    static constexpr std::size_t parameters = 5;
    template <class R>
    static auto make(const std::array<R, 5>& p) {
        return MakeOf{}(lumis::Direction<R>{p[0], p[1], p[2]}, glm::vec<2, R>{p[3], p[4]});
    }
    template <class T>
    static std::array<T, 5> random(std::mt19937& engine) {
        const auto wo = random_unit<T>(engine);
        std::uniform_real_distribution<double> logarithm{-4, 0.5};
        return {wo.x, wo.y, std::abs(wo.z), T(std::exp(logarithm(engine))), T(std::exp(logarithm(engine)))};
    }
    template <class T>
    static std::vector<std::array<T, 5>> degenerate() {
        const T nan = not_a_number<T>, wide = T(0.3);
        return {{T(0.6), 0, T(-0.8), wide, wide},
                {1, 0, 0, wide, wide},
                {0, 0, 1, wide, wide},
                {0, 0, 0, wide, wide},
                {nan, 0, 1, wide, wide},
                {0, T(1.2), T(1.6), wide, 1},
                {T(0.6), 0, T(0.8), nan, wide},
                {T(0.6), 0, T(0.8), 0, 0},
                {T(0.6), 0, T(0.8), wide, -1},
                {T(0.6), 0, T(0.8), 20'000, 1},
                {1, 0, T(1e-30), 0, 10},
                {1, 0, T(1e-6), wide, T(0.01)}};
    }
};

struct MakeGgxNdf {
    template <class R>
    auto operator()(const lumis::Direction<R>&, const glm::vec<2, R>& alpha) const {
        return lumis::GgxNdf<R>{alpha};
    }
};
struct MakeGgxVndf {
    template <class R>
    auto operator()(const lumis::Direction<R>& wo, const glm::vec<2, R>& alpha) const {
        return lumis::GgxVndf<R>{wo, alpha};
    }
};
struct MakeGgxReflection {
    template <class R>
    auto operator()(const lumis::Direction<R>& wo, const glm::vec<2, R>& alpha) const {
        return lumis::GgxReflection<R>{wo, alpha};
    }
};
struct MakeGgxBoundedReflection {
    template <class R>
    auto operator()(const lumis::Direction<R>& wo, const glm::vec<2, R>& alpha) const {
        return lumis::GgxBoundedReflection<R>{wo, alpha};
    }
};
struct MakeReflectedNdf {
    template <class R>
    auto operator()(const lumis::Direction<R>& wo, const glm::vec<2, R>& alpha) const {
        return lumis::Reflected{wo, lumis::GgxNdf<R>{alpha}};
    }
};
struct MakePerfectReflection {
    template <class R>
    auto operator()(const lumis::Direction<R>& wo, const glm::vec<2, R>&) const {
        return lumis::PerfectReflection<R>{wo};
    }
};

// wo on either side of a dielectric, the roughness along x and y, and the index of refraction.
template <class MakeOf>
struct OfBoundary {
    static constexpr std::size_t parameters = 6;
    template <class R>
    static auto make(const std::array<R, 6>& p) {
        return MakeOf{}(lumis::Direction<R>{p[0], p[1], p[2]}, glm::vec<2, R>{p[3], p[4]}, p[5]);
    }
    template <class T>
    static std::array<T, 6> random(std::mt19937& engine) {
        const auto wo = random_unit<T>(engine);
        std::uniform_real_distribution<double> logarithm{-4, 0.5}, of_index{-1, 1};
        const T x = T(std::exp(logarithm(engine))), y = T(std::exp(logarithm(engine)));
        return {wo.x, wo.y, wo.z, x, y, T(std::exp(of_index(engine)))};
    }
    template <class T>
    static std::vector<std::array<T, 6>> degenerate() {
        const T nan = not_a_number<T>, wide = T(0.3), glass = T(1.5);
        return {{T(0.6), 0, T(-0.8), wide, wide, 1},  {T(0.6), 0, T(-0.8), wide, wide, nan},
                {T(0.6), 0, T(0.8), wide, wide, -1},  {T(0.6), 0, T(0.8), wide, wide, 20'000},
                {T(0.6), 0, T(0.8), wide, -1, glass}, {T(0.6), 0, T(0.8), nan, wide, glass},
                {1, 0, 0, wide, wide, glass},         {0, 0, 0, wide, wide, glass},
                {nan, 0, 1, wide, wide, glass},       {0, T(1.2), T(-1.6), wide, 1, glass},
                {0, 0, -1, wide, wide, glass},        {1, 0, T(-1e-6), wide, T(0.01), glass}};
    }
};

// A diffuse lobe and a rough mirror: made of wo, the roughness along x and y, and the mirror's probability.
struct MixtureOfLobes {
    using Mirror = OfDirectionAndRoughness<MakeGgxReflection>;
    static constexpr std::size_t parameters = Mirror::parameters + 1;

    template <class R>
    static auto make(const std::array<R, 6>& p) {
        return lumis::Mixture{lumis::choose(1 - p[5], lumis::CosineHemisphere<R>{}),
                              lumis::choose(p[5], Mirror::make(std::array<R, 5>{p[0], p[1], p[2], p[3], p[4]}))};
    }
    template <class T>
    static std::array<T, 6> with_probability(const std::array<T, 5>& p, T probability) {
        return {p[0], p[1], p[2], p[3], p[4], probability};
    }
    template <class T>
    static std::array<T, 6> random(std::mt19937& engine) {
        std::uniform_real_distribution<T> probability;
        const auto mirror = Mirror::random<T>(engine);
        return with_probability<T>(mirror, probability(engine));
    }
    template <class T>
    static std::vector<std::array<T, 6>> degenerate() {
        std::vector<std::array<T, 6>> result;
        for (const auto& mirror : Mirror::degenerate<T>()) result.push_back(with_probability<T>(mirror, T(0.5)));
        for (const T probability : {T(0), T(1), T(-1), T(2), T(1e-30), not_a_number<T>}) {
            result.push_back(with_probability<T>({T(0.6), 0, T(0.8), T(0.3), T(0.2)}, probability));
        }
        return result;
    }
};

struct MakeGgxDielectric {
    template <class R>
    auto operator()(const lumis::Direction<R>& wo, const glm::vec<2, R>& alpha, const R& eta) const {
        return lumis::GgxDielectric<R>{wo, alpha, eta};
    }
};
struct MakeSmoothDielectric {
    template <class R>
    auto operator()(const lumis::Direction<R>& wo, const glm::vec<2, R>&, const R& eta) const {
        return lumis::SmoothDielectric<R>{wo, eta};
    }
};

}  // namespace subjects
