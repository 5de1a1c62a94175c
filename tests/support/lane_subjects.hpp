// Strategies of which each lane may have its own parameters. A subject says how many numbers its strategy is made of, how
// to make it of numbers or of lanes, which numbers are ordinary, and which are wrong or degenerate.
#pragma once

#include <lumis/lumis.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

namespace subjects {

template <class T>
lumis::Direction<T> random_unit(std::mt19937& engine) {
    std::normal_distribution<double> normal;
    return lumis::Direction<T>(glm::normalize(glm::dvec3{normal(engine), normal(engine), normal(engine)}));
}

template <class T>
inline constexpr T not_a_number = std::numeric_limits<T>::quiet_NaN();

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

// A light: the numbers of its shape, and the reference point. Coordinates are near 1; shapes are met in front of, behind and
// inside them.
template <class MakeOf, std::size_t K>
struct Light {
    static constexpr std::size_t parameters = K;
    template <class R>
    static auto make(const std::array<R, K>& p) {
        return MakeOf{}(p);
    }
    template <class T>
    static std::array<T, K> random(std::mt19937& engine) {
        std::normal_distribution<double> normal;
        std::array<T, K> result;
        for (T& x : result) x = static_cast<T>(normal(engine));
        return result;
    }
    // Nothing but zeros, which has no area and is seen from itself; a number that is none, each; and numbers out of range.
    template <class T>
    static std::vector<std::array<T, K>> degenerate() {
        std::vector<std::array<T, K>> result{{}};
        std::mt19937 engine{3};
        for (std::size_t k = 0; k < K; ++k) {
            for (const T x : {not_a_number<T>, std::numeric_limits<T>::infinity(), T(0),
                              (std::numeric_limits<T>::max)(), (std::numeric_limits<T>::min)()}) {
                result.push_back(random<T>(engine));
                result.back()[k] = x;
            }
        }
        for (const auto& more : MakeOf::template degenerate<T>()) result.push_back(more);
        return result;
    }
};

template <class R, std::size_t K>
glm::vec<3, R> vector_at(const std::array<R, K>& p, std::size_t first) {
    return {p[first], p[first + 1], p[first + 2]};
}

struct MakeTriangle {
    template <class R>
    auto operator()(const std::array<R, 12>& p) const {
        return lumis::AreaLight{lumis::Triangle{vector_at(p, 0), vector_at(p, 3), vector_at(p, 6)}, vector_at(p, 9)};
    }
    // Edge-on, at a vertex, a line, a sliver, close by.
    template <class T>
    static std::vector<std::array<T, 12>> degenerate() {
        return {{1, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0},
                {1, 0, 0, 0, 1, 0, -1, 0, 0, 1, 0, 0},
                {1, 0, 1, 2, 0, 2, 3, 0, 3, 0, 0, 0},
                {1, 0, 1, 2, 0, 1, 1, T(1e-5), 1, 0, 0, 0},
                {1, 0, 0, 0, 1, 0, -1, -1, 0, 0, 0, T(1e-4)}};
    }
};
struct MakeParallelogram {
    template <class R>
    auto operator()(const std::array<R, 12>& p) const {
        return lumis::AreaLight{lumis::Parallelogram{vector_at(p, 0), vector_at(p, 3), vector_at(p, 6)},
                                vector_at(p, 9)};
    }
    template <class T>
    static std::vector<std::array<T, 12>> degenerate() {
        return {{-1, -1, 0, 2, 0, 0, 0, 2, 0, 0, 0, 0},
                {-1, -1, 0, 2, 0, 0, 0, 2, 0, -1, -1, 0},
                {-1, -1, 1, 2, 0, 0, 1, 0, 0, 0, 0, 0},
                {-1, -1, T(1e-4), 2, 0, 0, 0, 2, 0, 0, 0, 0}};
    }
};
struct MakeDisk {
    template <class R>
    auto operator()(const std::array<R, 10>& p) const {
        return lumis::AreaLight{lumis::Disk{vector_at(p, 0), vector_at(p, 3), p[9]}, vector_at(p, 6)};
    }
    // Edge-on, seen from the centre, without a radius, close by.
    template <class T>
    static std::vector<std::array<T, 10>> degenerate() {
        return {{1, 0, 0, 0, 0, 1, 0, 0, 0, 1},
                {0, 0, 0, 0, 0, 1, 0, 0, 0, 1},
                {0, 0, 1, 0, 0, 1, 0, 0, 0, -1},
                {0, 0, T(1e-4), 0, 0, 1, 0, 0, 0, 1}};
    }
};
template <class Sampling>
struct MakeSphere {
    template <class R>
    auto operator()(const std::array<R, 7>& p) const {
        return lumis::AreaLight<lumis::Sphere<R>, Sampling>{{vector_at(p, 0), lumis::real::abs(p[6])}, vector_at(p, 3)};
    }
    // Inside, at the centre, on the surface and just above it; of no radius.
    template <class T>
    static std::vector<std::array<T, 7>> degenerate() {
        return {{0, 0, 0, T(0.3), 0, 0, 1},
                {0, 0, 0, 0, 0, 0, 1},
                {0, 0, 0, 1, 0, 0, 1},
                {0, 0, 0, T(1.0001), 0, 0, 1},
                {0, 0, 2, 0, 0, 0, 0}};
    }
};

struct MakePointLight {
    template <class R>
    auto operator()(const std::array<R, 6>& p) const {
        return lumis::PointLight{vector_at(p, 0), vector_at(p, 3)};
    }
    template <class T>
    static std::vector<std::array<T, 6>> degenerate() {
        return {{1, 2, 3, 1, 2, 3}};
    }
};

using WithOwnParameters =
    std::tuple<WithoutParameters<lumis::CosineHemisphere>, WithoutParameters<lumis::UniformHemisphere>,
               WithoutParameters<lumis::UniformSphere>, Cone, HenyeyGreenstein, Sun, OfUnitVector<MakeDirectionalLight>,
               OfUnitVector<MakeInFrame>, InFrameOfThree, OfDirectionAndRoughness<MakeGgxNdf>,
               OfDirectionAndRoughness<MakeGgxVndf>, OfDirectionAndRoughness<MakeGgxReflection>,
               OfDirectionAndRoughness<MakeGgxBoundedReflection>, OfDirectionAndRoughness<MakeReflectedNdf>,
               OfDirectionAndRoughness<MakePerfectReflection>, MixtureOfLobes, OfBoundary<MakeGgxDielectric>,
               OfBoundary<MakeSmoothDielectric>, Light<MakeTriangle, 12>, Light<MakeParallelogram, 12>,
               Light<MakeDisk, 10>, Light<MakeSphere<lumis::ByArea>, 7>, Light<MakeSphere<lumis::BySolidAngle>, 7>,
               Light<MakePointLight, 6>>;

}  // namespace subjects
