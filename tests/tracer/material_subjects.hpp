// Subjects of the tests of materials: one of each, and what surrounds it.
#pragma once

#include "dielectric_subjects.hpp"
#include "materials/materials.hpp"
#include "scattering_subjects.hpp"
#include <lumis/testing/cells.hpp>
#include <lumis/testing/charts.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

namespace subjects {

using namespace tracer;

inline constexpr float roughness = 0.3f, glass_index = 1.5f;  // of all that are rough, and of all glass

// Calls visit(name, material) with each that has a density.
inline void for_each_rough(const auto& visit) {
    const Diffuse<float> chalk{{0.8f, 0.5f, 0.2f}};
    const Coated<float> plastic{{0.07f, 0.09f, 0.13f}, roughness, 2};
    const Metal<float> metal{silver, roughness};
    const RoughGlass<float> glass{roughness, glass_index};
    visit("diffuse", chalk);
    visit("coated", plastic);
    visit("metal", metal);
    visit("tinted metal", Metal<float, Tint>{{{1, 0.7f, 0.3f}}, roughness});
    visit("compensated metal", Compensated<Metal<float>>{metal});
    visit("ground glass", glass);
    visit("metal and chalk", Blend<Metal<float>, Diffuse<float>>{metal, chalk, 0.6f});
    visit("glass and plastic", Blend<RoughGlass<float>, Coated<float>>{glass, plastic, 0.3f});
}
inline void for_each_polished(const auto& visit) {
    visit("mirror", Mirror<float>{silver});
    visit("tinted mirror", Mirror<float, Tint>{{{1, 0.7f, 0.3f}}});
    visit("glass", SmoothGlass<float>{glass_index});
}

template <class M>
inline constexpr std::size_t count = sizeof(M) / sizeof(typename M::Scalar);

template <class M>
std::array<float, count<M>> numbers(const M& material) {
    return std::bit_cast<std::array<float, count<M>>>(material);
}

// The material in double.
template <class M>
auto in_double(const M& material) {
    std::array<double, count<M>> wide;
    for (std::size_t k = 0; k < count<M>; ++k) wide[k] = double{numbers(material)[k]};
    return std::bit_cast<typename M::template In<double>>(wide);
}

// Directions from which a material is looked at.
template <class M>
std::vector<glm::dvec3> viewed_from(const M&) {
    std::vector<glm::dvec3> all{direction(0.95, 0.4), direction(0.3, 2)};
    if (M::transmits) all.insert(all.end(), {direction(-0.9, 1), direction(-0.4, -2)});
    return all;
}

// Dense where its lobes are.
template <class M>
lumis::testing::DirectionChart chart(const M&, const glm::dvec3& wo) {
    const auto normals = normals_chart(glm::dvec2{double{roughness}});
    return M::transmits ? scattered_chart(wo, double{glass_index}, normals)
                        : lumis::testing::reflected_chart(wo, normals);
}

// The integral of scattered green light times g(wi), to 1e-4 or so.
template <class M>
double quadrature(const M& material, const glm::dvec3& wo, const auto& g) {
    const auto bsdf = in_double(material).strategy(wo);
    const lumis::testing::Density<glm::dvec3> f = [&](const glm::dvec3& wi) {
        return bsdf.evaluate(wi).reflected.y * g(wi);
    };
    return lumis::testing::Cells<glm::dvec3>{chart(material, wo), 2, 2}.mass(f, {5e-5, 10, 1e5}).value;
}

}  // namespace subjects
