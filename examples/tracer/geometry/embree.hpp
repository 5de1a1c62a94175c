// Embree's rays in lanes: its structures and functions for one ray and for packets of 4, 8 and 16, under one name each.
#pragma once

#include "paths/packet.hpp"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <cstddef>
#include <cstring>

namespace tracer {

template <std::size_t Lanes>
struct EmbreeTypes;
template <>
struct EmbreeTypes<1> {
    using Ray = RTCRay;
    using RayHit = RTCRayHit;
    static constexpr auto intersect = rtcIntersect1;
    static constexpr auto occlude = rtcOccluded1;
};
template <>
struct EmbreeTypes<4> {
    using Ray = RTCRay4;
    using RayHit = RTCRayHit4;
    static constexpr auto intersect = rtcIntersect4;
    static constexpr auto occlude = rtcOccluded4;
};
template <>
struct EmbreeTypes<8> {
    using Ray = RTCRay8;
    using RayHit = RTCRayHit8;
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occlude = rtcOccluded8;
};
template <>
struct EmbreeTypes<16> {
    using Ray = RTCRay16;
    using RayHit = RTCRayHit16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occlude = rtcOccluded16;
};
template <lumis::Real R>
using EmbreeRay = typename EmbreeTypes<lanes<R>>::Ray;
template <lumis::Real R>
using EmbreeRayHit = typename EmbreeTypes<lanes<R>>::RayHit;

// A field is a number, or an array of as many as there are lanes.
void put(const auto& x, auto& field) {
    static_assert(sizeof x == sizeof field);
    std::memcpy(&field, &x, sizeof x);
}
template <class X>
[[nodiscard]] X taken(const auto& field) {
    static_assert(sizeof(X) == sizeof field);
    X x;
    std::memcpy(static_cast<void*>(&x), &field, sizeof x);
    return x;
}

// Asks Embree in some lanes. Rays that go the same way are faster if it knows.
template <lumis::Real R>
void ask(RTCScene scene, const Mask<R>& asked, bool are_alike, auto& query) {
    constexpr bool for_hit = requires {
        query.hit;
    };
    const auto call = [&](auto function, auto* how) {
        if constexpr (lanes<R> == 1) {
            if (!any(asked)) return;
#if RTC_VERSION_MAJOR >= 4
            function(scene, &query, how);
#else
            function(scene, how, &query);
#endif
        } else {
            alignas(64) const auto valid = asked.vector();  // all bits of a lane, or none
#if RTC_VERSION_MAJOR >= 4
            function(reinterpret_cast<const int*>(&valid), scene, &query, how);
#else
            function(reinterpret_cast<const int*>(&valid), scene, how, &query);
#endif
        }
    };
#if RTC_VERSION_MAJOR >= 4
    if constexpr (for_hit) {
        RTCIntersectArguments how;
        rtcInitIntersectArguments(&how);
        how.flags = are_alike ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
        call(EmbreeTypes<lanes<R>>::intersect, &how);
    } else {
        RTCOccludedArguments how;
        rtcInitOccludedArguments(&how);
        how.flags = are_alike ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
        call(EmbreeTypes<lanes<R>>::occlude, &how);
    }
#else
    RTCIntersectContext how;
    rtcInitIntersectContext(&how);
    how.flags = are_alike ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    if constexpr (for_hit) {
        call(EmbreeTypes<lanes<R>>::intersect, &how);
    } else {
        call(EmbreeTypes<lanes<R>>::occlude, &how);
    }
#endif
}

}  // namespace tracer
