// All of Lumis except batch/, qmc/ and testing/, which are included by name: batch/ and testing/ cost compile time, and points of
// a sequence are for hosts without their own.
#pragma once

// nvcc compiles templates for host and device, and warns where what they are given is for the host only: an integrand, a
// source of uniforms, a strategy of the host's own (20011, 20014). What a kernel cannot call is an error all the same.
// 20012 is about GLM's annotations.
#ifdef __NVCC__
#pragma nv_diagnostic push
#pragma nv_diag_suppress 20011, 20012, 20014
#endif

// Macros of a host's that are names here are set aside up to the last line.
#pragma push_macro("D")
#pragma push_macro("Real")
#pragma push_macro("real")
#undef D
#undef Real
#undef real

#include "lumis/combine/allocate.hpp"
#include "lumis/combine/heuristics.hpp"
#include "lumis/combine/in_frame.hpp"
#include "lumis/combine/mixture.hpp"
#include "lumis/combine/multi_sample.hpp"
#include "lumis/combine/one_sample.hpp"
#include "lumis/combine/optimal.hpp"
#include "lumis/combine/pairwise_weights.hpp"
#include "lumis/combine/resample.hpp"
#include "lumis/combine/reservoir.hpp"
#include "lumis/combine/variant_strategy.hpp"
#include "lumis/core/frame.hpp"
#include "lumis/core/latlong.hpp"
#include "lumis/core/measure.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/surface_point.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/directions/cosine_hemisphere.hpp"
#include "lumis/directions/henyey_greenstein.hpp"
#include "lumis/directions/uniform_cone.hpp"
#include "lumis/directions/uniform_hemisphere.hpp"
#include "lumis/directions/uniform_sphere.hpp"
#include "lumis/fwd.hpp"
#include "lumis/lights/area_light.hpp"
#include "lumis/lights/area_light_by_cosine.hpp"
#include "lumis/lights/area_light_by_solid_angle.hpp"
#include "lumis/lights/directional_light.hpp"
#include "lumis/lights/environment_map.hpp"
#include "lumis/lights/image_light.hpp"
#include "lumis/lights/light_bounds.hpp"
#include "lumis/lights/light_set.hpp"
#include "lumis/lights/light_tree.hpp"
#include "lumis/lights/pdf_from_hit.hpp"
#include "lumis/lights/point_light.hpp"
#include "lumis/lights/selected_light.hpp"
#include "lumis/lights/sun.hpp"
#include "lumis/lights/surface_area.hpp"
#include "lumis/lights/surface_light.hpp"
#include "lumis/microfacets/fresnel.hpp"
#include "lumis/microfacets/ggx.hpp"
#include "lumis/microfacets/ggx_albedo.hpp"
#include "lumis/microfacets/ggx_bounded_reflection.hpp"
#include "lumis/microfacets/ggx_dielectric.hpp"
#include "lumis/microfacets/ggx_ndf.hpp"
#include "lumis/microfacets/ggx_reflection.hpp"
#include "lumis/microfacets/ggx_vndf.hpp"
#include "lumis/microfacets/perfect_reflection.hpp"
#include "lumis/microfacets/reflected.hpp"
#include "lumis/microfacets/smooth_dielectric.hpp"
#include "lumis/microfacets/transport_mode.hpp"
#include "lumis/statistics/error_metrics.hpp"
#include "lumis/statistics/running_moments.hpp"
#include "lumis/tables/alias_table.hpp"
#include "lumis/tables/discrete_table.hpp"
#include "lumis/tables/piecewise_constant.hpp"
#include "lumis/version.hpp"

#pragma pop_macro("D")
#pragma pop_macro("Real")
#pragma pop_macro("real")

#ifdef __NVCC__
#pragma nv_diagnostic pop
#endif
