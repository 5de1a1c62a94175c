// Subjects of lane_subjects.hpp: strategies of directions, and what is made of a unit vector or a frame.
#pragma once

#include "lane_numbers.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace subjects {

template <template <class> class Hemisphere>
struct WithoutParameters {
    static constexpr std::size_t parameters = 0;
    template <class R>
    static auto make(const std::array<R, 0>&) {
        return Hemisphere<R>{};
    }
    template <class T>
    static std::array<T, 0> random(std::mt19937&) {
        return {};
    }
    template <class T>
    static std::vector<std::array<T, 0>> degenerate() {
        return {{}};
    }
};

// Made of the half-angle.
struct Cone {
    static constexpr std::size_t parameters = 1;
    template <class R>
    static auto make(const std::array<R, 1>& half_angle) {
        return lumis::UniformCone<R>{half_angle[0]};
    }
    template <class T>
    static std::array<T, 1> random(std::mt19937& engine) {
        std::uniform_real_distribution<double> logarithm{-10, 1};
        return {T(std::exp(logarithm(engine)))};
    }
    template <class T>
    static std::vector<std::array<T, 1>> degenerate() {
        return {{0}, {-1}, {not_a_number<T>}, {T(1e-30)}, {4}};
    }
};

// Made of wo and the mean cosine.
struct HenyeyGreenstein {
    static constexpr std::size_t parameters = 4;
    template <class R>
    static auto make(const std::array<R, 4>& p) {
        return lumis::HenyeyGreenstein<R>{lumis::Direction<R>{p[0], p[1], p[2]}, p[3]};
    }
    template <class T>
    static std::array<T, 4> random(std::mt19937& engine) {
        std::uniform_real_distribution<double> mean_cosine{-0.999, 0.999};
        const auto w = random_unit<T>(engine);
        return {w.x, w.y, w.z, T(mean_cosine(engine))};
    }
    template <class T>
    static std::vector<std::array<T, 4>> degenerate() {
        const T nan = not_a_number<T>, even = T(0.3);
        return {{0, 0, 0, even}, {3, 4, 0, even}, {nan, 0, 1, even}, {0, 1, 0, nan},
                {0, 1, 0, 1},    {0, 0, 1, -1},   {0, 0, 1, 2}};
    }
};

// Made of the direction of its centre, and the half-angle.
struct Sun {
    static constexpr std::size_t parameters = 4;
    template <class R>
    static auto make(const std::array<R, 4>& p) {
        return lumis::Sun<R>{lumis::Direction<R>{p[0], p[1], p[2]}, p[3]};
    }
    template <class T>
    static std::array<T, 4> random(std::mt19937& engine) {
        const auto w = random_unit<T>(engine);
        return {w.x, w.y, w.z, Cone::random<T>(engine)[0]};
    }
    template <class T>
    static std::vector<std::array<T, 4>> degenerate() {
        const T nan = not_a_number<T>, wide = T(0.3);
        return {{0, 0, 0, wide}, {0, 0, -1, wide}, {3, 4, 0, wide}, {nan, 0, 1, wide}, {0, 1, 0, nan}, {0, 1, 0, 0}};
    }
};

struct MakeInFrame {
    template <class R>
    auto operator()(const lumis::Direction<R>& normal) const {
        return lumis::in_frame(lumis::Frame<R>{normal}, lumis::CosineHemisphere<R>{});
    }
};
struct MakeDirectionalLight {
    template <class R>
    auto operator()(const lumis::Direction<R>& w) const {
        return lumis::DirectionalLight<R>{w};
    }
};

// Made of a unit vector: x, y, z.
template <class MakeOf>
struct OfUnitVector {
    static constexpr std::size_t parameters = 3;
    template <class R>
    static auto make(const std::array<R, 3>& n) {
        return MakeOf{}(lumis::Direction<R>{n[0], n[1], n[2]});
    }
    template <class T>
    static std::array<T, 3> random(std::mt19937& engine) {
        const auto n = random_unit<T>(engine);
        return {n.x, n.y, n.z};
    }
    template <class T>
    static std::vector<std::array<T, 3>> degenerate() {
        return {{0, 0, 0}, {0, 0, -1}, {0, T(-0.0), 1}, {3, 4, 0}, {not_a_number<T>, 0, 1}, {T(1e-30), 0, T(1e-30)}};
    }
};

// Made of tangent, bitangent and normal.
struct InFrameOfThree {
    static constexpr std::size_t parameters = 9;
    template <class R>
    static auto make(const std::array<R, 9>& v) {
        return lumis::in_frame(lumis::Frame<R>{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}},
                               lumis::CosineHemisphere<R>{});
    }
    template <class T>
    static std::array<T, 9> of(const lumis::Direction<T>& t, const lumis::Direction<T>& b,
                               const lumis::Direction<T>& n) {
        return {t.x, t.y, t.z, b.x, b.y, b.z, n.x, n.y, n.z};
    }
    template <class T>
    static std::array<T, 9> random(std::mt19937& engine) {
        const lumis::Frame<T> frame{random_unit<T>(engine)};
        return of(frame.tangent(), frame.bitangent(), frame.normal());
    }
    template <class T>
    static std::vector<std::array<T, 9>> degenerate() {
        using V = lumis::Direction<T>;
        const V x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, none{T(0)};
        return {of(y, x, z),       of(T(2) * x, y, z),           of(x + T(0.25) * z, y, z),
                of(x, y, none),    of(x, y, V{not_a_number<T>}), of(z, y, z),
                of(none, none, z), of(y, x, T(0.5) * z)};
    }
};

}  // namespace subjects
