// Ways to break a strategy on purpose, for tests of the laws.
#pragma once

#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/testing/laws.hpp>

#include <glm/vec3.hpp>

namespace laws = lumis::testing;

// A strategy whose samples and densities pass through a spoiler: spoil_sample(sample), spoil_pdf(w, pdf).
template <class S, class SpoilSample, class SpoilPdf>
struct Broken {
    using Scalar = typename S::Scalar;
    using Point = typename S::Point;
    using Measure = typename S::Measure;
    static constexpr int dimensions = S::dimensions;

    S strategy;
    SpoilSample spoil_sample;
    SpoilPdf spoil_pdf;

    auto sample(lumis::UniformsOf<S> u) const noexcept { return spoil_sample(strategy.sample(u)); }
    Scalar pdf(const Point& w) const noexcept { return spoil_pdf(w, strategy.pdf(w)); }
};
template <class S, class SpoilSample, class SpoilPdf>
Broken(S, SpoilSample, SpoilPdf) -> Broken<S, SpoilSample, SpoilPdf>;

using V = glm::dvec3;
using Cosine = lumis::CosineHemisphere<double>;
using Uniform = lumis::UniformHemisphere<double>;

constexpr auto same_sample = [](auto sample) { return sample; };
constexpr auto same_pdf = [](const V&, double pdf) { return pdf; };

// Sample and density spoilt alike, by a function of direction and density.
template <class S, class Spoil>
auto consistently_broken(const S& strategy, Spoil spoil) {
    return Broken{strategy,
                  [spoil](auto sample) {
                      sample.pdf = spoil(sample.value, sample.pdf);
                      return sample;
                  },
                  spoil};
}
