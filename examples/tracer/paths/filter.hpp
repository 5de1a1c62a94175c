// How a pixel weighs what falls around its centre. Places are drawn in proportion to the filter, so that each sample belongs
// to one pixel and counts alike (filter importance sampling, Ernst, Stamminger and Greiner 2006).
#pragma once

#include "paths/packet.hpp"
#include "render_options.hpp"

namespace tracer {

// The offset from the pixel's centre, in pixels along one axis, for u in [0, 1). A box is one wide, a tent (linear
// interpolation) two.
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline R filter_offset(Filter filter, const R& u) {
    if (filter == Filter::Box) return u - 0.5f;
    const R v = 2.0f * u, w = 2.0f - v;
    return lumis::real::select(u < 0.5f, lumis::real::sqrt(v) - 1.0f, 1.0f - lumis::real::sqrt(w));
}

}  // namespace tracer
