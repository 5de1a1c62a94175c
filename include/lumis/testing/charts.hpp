// Charts: the unit square laid over the points that a strategy draws, dense where its density is. Quadrature and
// histograms work in the square, so that a lobe of 1e-4 rad and a hemisphere look alike to them. In double.
#pragma once

#include "lumis/core/frame.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/testing/points.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

template <class Point>
struct Chart {
    struct Place {
        Point point;
        double measure;  // of the strategy's points, per unit of area of the square
    };
    std::function<Place(double s, double t)> at;
    std::function<glm::dvec2(const Point&)> coordinates;  // the inverse, in [0, 1]^2
    // Lines of the square across which a density may jump. Other edges of the support are searched for along s.
    std::vector<double> s_edges{0, 1}, t_edges{0, 1};
    // Along how many of the square's axes the points vary between two edges; histograms divide no others.
    int dimensions = 2;
};

using DirectionChart = Chart<glm::dvec3>;

namespace detail {

// The edges of n equal cells of [0, 1].
[[nodiscard]] inline std::vector<double> equal_cells(std::size_t n) {
    std::vector<double> edges;
    for (std::size_t i = 0; i <= n; ++i) edges.push_back(static_cast<double>(i) / static_cast<double>(n));
    return edges;
}

}  // namespace detail

// All directions, about the frame's normal: half of the square holds those within the widths (chords, that is about
// radians) along the frame's tangent and bitangent. In r = |w - normal| the sphere's area is r dr dphi. Along each
// meridian the chart is even for a density proportional to 1 / (1 + (r / width)^2)^2, which is GGX's profile.
[[nodiscard]] inline DirectionChart lobe_chart(const Frame<double>& frame, glm::dvec2 widths) {
    DirectionChart chart;
    chart.at = [=](double s, double t) -> DirectionChart::Place {
        const double psi = 2 * std::numbers::pi * t;
        const double x = widths.x * std::cos(psi), y = widths.y * std::sin(psi);
        const double width_squared = x * x + y * y;
        const double whole = 4 / (4 + width_squared), k = s * whole;
        const double chord_squared = width_squared * k / (1 - k), versine = chord_squared / 2;
        const double across = std::sqrt(std::fmax(versine * (2 - versine), 0) / width_squared);
        const double measure = std::numbers::pi * widths.x * widths.y * whole / ((1 - k) * (1 - k));
        return {frame.to_world({across * x, across * y, 1 - versine}), measure};
    };
    chart.coordinates = [=](const glm::dvec3& w) -> glm::dvec2 {
        const glm::dvec3 local = frame.to_local(glm::normalize(w));
        const double psi = std::atan2(local.y / widths.y, local.x / widths.x);
        const double x = widths.x * std::cos(psi), y = widths.y * std::sin(psi);
        const double width_squared = x * x + y * y, turn = psi / (2 * std::numbers::pi);
        const glm::dvec3 from_axis = local - glm::dvec3{0, 0, 1};
        const double chord_squared = glm::dot(from_axis, from_axis);
        const double s = chord_squared / (chord_squared + width_squared) * (4 + width_squared) / 4;
        return {s, turn < 0 ? turn + 1 : turn};
    };
    return chart;
}

// All directions about an axis, for what lies mostly within a width (about radians) of it.
[[nodiscard]] inline DirectionChart lobe_chart(const glm::dvec3& axis, double width) {
    return lobe_chart(Frame<double>{glm::normalize(axis)}, {width, width});
}

// All directions, nearly evenly, about +z.
[[nodiscard]] inline DirectionChart sphere_chart() {
    return lobe_chart(glm::dvec3{0, 0, 1}, 2);
}

// A chart of microfacet normals as a chart of the directions into which they mirror wo (unit).
[[nodiscard]] inline DirectionChart reflected_chart(const glm::dvec3& wo, const DirectionChart& normals) {
    DirectionChart chart = normals;
    chart.at = [wo, at = normals.at](double s, double t) -> DirectionChart::Place {
        const auto [wm, measure] = at(s, t);
        const double cosine = glm::dot(wo, wm);
        return {2 * cosine * wm - wo, 4 * std::fmax(cosine, 0) * measure};
    };
    chart.coordinates = [wo, coordinates = normals.coordinates](const glm::dvec3& wi) {
        return coordinates(glm::normalize(wo + glm::normalize(wi)));
    };
    return chart;
}

// A chart carried from a frame's local directions to the world.
[[nodiscard]] inline DirectionChart framed_chart(const Frame<double>& frame, const DirectionChart& local) {
    DirectionChart chart = local;
    chart.at = [frame, at = local.at](double s, double t) -> DirectionChart::Place {
        const auto place = at(s, t);
        return {frame.to_world(place.point), place.measure};
    };
    chart.coordinates = [frame, coordinates = local.coordinates](const glm::dvec3& w) {
        return coordinates(frame.to_local(w));
    };
    return chart;
}

// All directions evenly, with edges along the texels of a latitude-longitude map: row 0 at s = 0, which is +y; column 0
// at t = 0, which is -x, turning over -z to +x.
[[nodiscard]] inline DirectionChart latlong_chart(std::size_t width, std::size_t height) {
    DirectionChart chart;
    chart.at = [](double s, double t) -> DirectionChart::Place {
        const double phi = 2 * std::numbers::pi * (t - 0.5), sine = 2 * std::sqrt(s * (1 - s));
        return {{sine * std::cos(phi), 1 - 2 * s, sine * std::sin(phi)}, 4 * std::numbers::pi};
    };
    chart.coordinates = [](const glm::dvec3& w) -> glm::dvec2 {
        const double half_theta = std::atan2(std::hypot(w.x, w.z), w.y) / 2;
        const double t = std::atan2(w.z, w.x) / (2 * std::numbers::pi) + 0.5;
        return {std::sin(half_theta) * std::sin(half_theta), t < 1 ? t : 0};
    };
    chart.s_edges.clear();
    for (std::size_t y = 0; y <= height; ++y) {
        const double sine = std::sin(std::numbers::pi / 2 * static_cast<double>(y) / static_cast<double>(height));
        chart.s_edges.push_back(y == height ? 1.0 : sine * sine);
    }
    chart.t_edges = detail::equal_cells(width);
    return chart;
}

// [0, 1] along s, with edges along n equal cells; t is idle.
[[nodiscard]] inline Chart<double> interval_chart(std::size_t n) {
    Chart<double> chart;
    chart.at = [](double s, double) -> Chart<double>::Place { return {s, 1}; };
    chart.coordinates = [](double x) -> glm::dvec2 { return {x, 0.5}; };
    chart.s_edges = detail::equal_cells(n);
    chart.dimensions = 1;
    return chart;
}

// [0, 1]^2, with edges along width x height equal cells: x is t and y is s.
[[nodiscard]] inline Chart<glm::dvec2> square_chart(std::size_t width, std::size_t height) {
    Chart<glm::dvec2> chart;
    chart.at = [](double s, double t) -> Chart<glm::dvec2>::Place { return {{t, s}, 1}; };
    chart.coordinates = [](const glm::dvec2& x) -> glm::dvec2 { return {x.y, x.x}; };
    chart.s_edges = detail::equal_cells(height);
    chart.t_edges = detail::equal_cells(width);
    return chart;
}

// The indices below n, each of which has its part of s; t is idle.
[[nodiscard]] inline Chart<std::size_t> index_chart(std::size_t n) {
    const double size = static_cast<double>(n);
    Chart<std::size_t> chart;
    chart.at = [n, size](double s, double) -> Chart<std::size_t>::Place {
        return {(std::min)(static_cast<std::size_t>(s * size), n - 1), size};
    };
    // An index beyond n lands in no part.
    chart.coordinates = [n, size](std::size_t i) -> glm::dvec2 {
        return {i < n ? (static_cast<double>(i) + 0.5) / size : std::numeric_limits<double>::quiet_NaN(), 0.5};
    };
    chart.s_edges = detail::equal_cells(n);
    chart.dimensions = 0;
    return chart;
}

// A density as a law sees it: any callable over points in double.
template <class Point>
using Density = std::function<double(const Point&)>;

// The density of a strategy, asked in its own precision. The strategy must outlive it.
template <Strategy S>
[[nodiscard]] auto density_of(const S& strategy) {
    using Point = InDouble<typename S::Point>;
    return Density<Point>{
        [&strategy](const Point& x) { return static_cast<double>(strategy.pdf(static_cast<typename S::Point>(x))); }};
}

}  // namespace lumis::LUMIS_ISA::testing
