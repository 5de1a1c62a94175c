// A chart's square divided into cells, and how much of a density each holds.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

template <class Point>
class Cells {
  public:
    // At least s_cells x t_cells of them, along axes where points vary; none crosses one of the chart's edges.
    Cells(Chart<Point> chart, std::size_t s_cells, std::size_t t_cells)
        : chart_{std::move(chart)},
          s_{divided(chart_.s_edges, chart_.dimensions > 0 ? s_cells : 1)},
          t_{divided(chart_.t_edges, chart_.dimensions > 1 ? t_cells : 1)} {}

    [[nodiscard]] std::size_t size() const noexcept { return (s_.size() - 1) * (t_.size() - 1); }

    // The cell that holds a point; size() if its coordinates are NaN.
    [[nodiscard]] std::size_t find(const Point& x) const {
        const glm::dvec2 place = chart_.coordinates(x);
        if (std::isnan(place.x) || std::isnan(place.y)) return size();
        return line(s_, place.x) * (t_.size() - 1) + line(t_, place.y);
    }

    // Which of at most parts x parts blocks of neighbouring cells holds a cell; blocks are numbered below parts^2.
    [[nodiscard]] std::size_t block(std::size_t cell, std::size_t parts) const noexcept {
        const std::size_t rows = s_.size() - 1, columns = t_.size() - 1;
        const std::size_t i = cell / columns * (std::min)(parts, rows) / rows;
        return i * parts + cell % columns * (std::min)(parts, columns) / columns;
    }

    [[nodiscard]] Point centre(std::size_t cell) const {
        const std::size_t i = cell / (t_.size() - 1), j = cell % (t_.size() - 1);
        return chart_.at((s_[i] + s_[i + 1]) / 2, (t_[j] + t_[j + 1]) / 2).point;
    }

    // The integral of the density over each cell.
    [[nodiscard]] std::vector<Integral> masses(const Density<Point>& density, Accuracy accuracy) const {
        std::vector<Integral> result;
        for (std::size_t cell = 0; cell < size(); ++cell) result.push_back(mass(cell, density, accuracy));
        return result;
    }

    // The integral of the density over one of them.
    [[nodiscard]] Integral mass(std::size_t cell, const Density<Point>& density, Accuracy accuracy) const {
        const std::size_t i = cell / (t_.size() - 1), j = cell % (t_.size() - 1);
        return integrate(per_area_of_square(density), std::span{s_}.subspan(i, 2), t_[j], t_[j + 1], accuracy);
    }

    // The integral of the density over all cells; whole lines along s are taken at once, which leaves fewer corners.
    [[nodiscard]] Integral mass(const Density<Point>& density, Accuracy accuracy) const {
        const auto f = per_area_of_square(density);
        Integral sum;
        for (std::size_t j = 0; j + 1 < t_.size(); ++j) sum += integrate(f, s_, t_[j], t_[j + 1], accuracy);
        return sum;
    }

  private:
    [[nodiscard]] auto per_area_of_square(const Density<Point>& density) const {
        return [this, &density](double s, double t) {
            const auto place = chart_.at(s, t);
            return place.measure > 0 ? density(place.point) * place.measure : 0.0;
        };
    }

    static std::vector<double> divided(const std::vector<double>& edges, std::size_t cells) {
        const std::size_t panels = edges.size() - 1, parts = (cells + panels - 1) / panels;
        std::vector<double> lines;
        for (std::size_t panel = 0; panel < panels; ++panel) {
            for (std::size_t part = 0; part < parts; ++part) {
                const double fraction = static_cast<double>(part) / static_cast<double>(parts);
                lines.push_back(std::lerp(edges[panel], edges[panel + 1], fraction));
            }
        }
        lines.push_back(edges.back());
        return lines;
    }

    static std::size_t line(const std::vector<double>& lines, double x) {
        const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, x);
        return static_cast<std::size_t>(above - lines.begin()) - 1;
    }

    Chart<Point> chart_;
    std::vector<double> s_, t_;
};

}  // namespace lumis::LUMIS_ISA::testing
