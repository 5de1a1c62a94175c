// Strategies of which each lane may have its own parameters. A subject says how many numbers its strategy is made of, how
// to make it of numbers or of lanes, which numbers are ordinary, and which are wrong or degenerate.
#pragma once

#include "lane_directions.hpp"
#include "lane_lights.hpp"
#include "lane_microfacets.hpp"
#include <lumis/lumis.hpp>

#include <tuple>

namespace subjects {

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
