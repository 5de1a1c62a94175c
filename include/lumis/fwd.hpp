// Names of Lumis's types, for a host's headers that mention but do not use them: pointers, references, function parameters.
// Next to nothing to compile, and no GLM.
//
// Default template arguments belong to the definitions: with this header alone, write `lumis::EnvironmentMap<float>`. What
// is never spelt out but deduced is not here: Mixture, Reflected, Combination. lumis.hpp and qmc/ define all the rest.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/scalar.hpp"

#include <concepts>
#include <cstddef>

namespace lumis::LUMIS_ISA {

// core
namespace measure {
struct SolidAngle;
struct Area;
struct AreaSolidAngle;
struct Lebesgue;
struct Counting;
}  // namespace measure
template <class Point, Real Scalar>
struct Sample;
template <class Point, Real Scalar>
struct LightSample;
template <class Drawn, class Index>
struct IndexedSample;
template <Real R>
struct SurfacePoint;
template <class Point, Real Scalar>
struct SurfaceLightSample;
template <class Point, Real Scalar>
struct SurfaceAreaSample;
template <Real R>
struct LightHit;
template <Real T>
class Frame;
template <std::signed_integral Bits, std::size_t N>
class LaneMask;
template <std::floating_point T, std::size_t N>
class Lanes;
template <class Urbg, FloatOrDouble T>
class Uniforms;
template <FloatOrDouble T, class F>
class UniformsFrom;
struct delta_t;

// tables
template <std::floating_point T>
class AliasTable;
template <std::floating_point T>
class AliasTableView;
class FineAliasTable;
class FineAliasTableView;
template <std::floating_point T>
class DiscreteTable;
template <std::floating_point T>
class DiscreteTableView;
template <std::floating_point T>
struct RemappedIndex;
template <std::floating_point T>
class PiecewiseConstant1D;
template <std::floating_point T>
class PiecewiseConstant1DView;
template <std::floating_point T>
class PiecewiseConstant2D;
template <std::floating_point T>
class PiecewiseConstant2DView;

// directions
template <Real T>
struct CosineHemisphere;
template <Real T>
class HenyeyGreenstein;
template <Real T>
class UniformCone;
template <Real T>
struct UniformHemisphere;
template <Real T>
struct UniformSphere;

// microfacets
template <Real T>
class Ggx;
template <Real T>
class GgxNdf;
template <Real T>
struct GgxVndf;
template <Real T>
struct GgxReflection;
template <Real T>
struct GgxBoundedReflection;
template <Real T>
class PerfectReflection;
template <Real R>
struct FresnelShares;
enum class TransportMode;
template <Real T>
class GgxDielectric;
template <Real T>
class SmoothDielectric;

// lights
template <Real T>
struct Triangle;
template <Real T>
struct Parallelogram;
template <Real T>
struct Disk;
template <Real T>
struct Sphere;
struct ByArea;
struct BySolidAngle;
struct ByCosine;
enum class Sides;
template <class S, class Sampling>
class AreaLight;
template <class S, class Sampling>
class SurfaceLight;
template <std::floating_point T>
class ImageLight;
template <class S>
class SurfaceArea;
template <class S>
class SurfaceEmission;
template <Real R>
struct SurfaceRay;
template <Real R>
struct SurfaceSample;
template <Real R>
struct SurfaceHit;
template <Real T>
class PointLight;
template <Real T>
class DirectionalLight;
template <Real T>
class Sun;
enum class Interpolation;
struct EnvironmentOptions;
template <class Point, Real Scalar>
struct MapSample;
template <std::floating_point T>
class EnvironmentMap;
template <std::floating_point T>
class EnvironmentMapView;
template <std::floating_point T>
class AliasEnvironmentMap;
template <std::floating_point T>
class AliasEnvironmentMapView;
template <class Lights, class Table>
class LightSet;
template <class Point>
struct ToLight;
template <class Set>
class SelectedLight;
template <class One, class S, class Meet>
class MetLight;
template <std::floating_point T>
struct LightBounds;
template <std::floating_point T>
class LightTree;
template <std::floating_point T>
class LightTreeView;
template <std::floating_point T, int Uniforms>
class LightTreeFrom;
template <Real R>
class LightTreeFromLanes;

// combine
struct BalanceHeuristic;
struct PowerHeuristic;
struct MaximumHeuristic;
struct CutoffHeuristic;
struct EqualWeights;
template <class Owner>
struct PartitionWeights;
template <std::size_t N>
struct BalanceWithFactors;
struct PairwiseWeights;
template <class S>
struct Take;
template <class S>
struct Choose;
template <class HeldStrategy>
class InFrame;
template <class Variant>
class VariantStrategy;
template <class T>
struct zero;
template <class H, class... S>
class MultiSample;
template <class H, class... S>
class OneSample;
template <class Wide, std::size_t K>
struct Round;
template <class Value, std::size_t K>
class CrossFitted;
template <class... S>
class MultiSampleRounds;
template <class... S>
class OneSampleRounds;
struct OptimalWeights;
struct Luminance;
template <class H, class... S>
class Allocation;
template <bool... is_delta>
class Forecast;
template <std::size_t N>
struct SamplingCosts;
template <std::size_t N>
struct AllocationLimits;
template <class Drawn, Real R>
struct Resampled;
template <class Item, Real R>
class Reservoir;

// qmc
template <Real R>
class Sobol;

// statistics
template <std::floating_point T>
class RunningMoments;

}  // namespace lumis::LUMIS_ISA
