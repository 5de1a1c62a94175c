// Densities on the line of which optimal weights are known, and numbers that fill the cube evenly.
#pragma once

#include <lumis/core/strategy.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

// Density k x^(k - 1) over [0, 1].
struct Monomial {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    int k;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        const double x = std::pow(u.x, 1.0 / k);
        return {x, pdf(x)};
    }
    [[nodiscard]] double pdf(double x) const noexcept { return x >= 0 && x <= 1 ? k * std::pow(x, k - 1) : 0; }
};

// Density 2 (1 - x) over [0, 1].
struct Falling {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        const double x = 1 - std::sqrt(1 - u.x);
        return {x, pdf(x)};
    }
    [[nodiscard]] double pdf(double x) const noexcept { return x >= 0 && x <= 1 ? 2 * (1 - x) : 0; }
};

// Evenly over [0, 1/2) with probability 1/2, else nothing.
struct HalfTheTime {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        return u.x < 0.5 ? lumis::Sample<double, double>{u.x, 1} : lumis::Sample<double, double>{0, 0};
    }
    [[nodiscard]] double pdf(double x) const noexcept { return x >= 0 && x < 0.5 ? 1 : 0; }
};

// Draws in proportion to a positive function over [low, high], inverted by bisection of its integral (Simpson's rule).
template <class Shape>
struct Numeric {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    Shape shape;
    double low, high;
    double total = integral(high);

    [[nodiscard]] double integral(double to) const noexcept {
        constexpr int intervals = 8;
        const double h = (to - low) / intervals;
        double sum = shape(low) + shape(to);
        for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4 : 2) * shape(low + i * h);
        return sum * h / 3;
    }
    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        double a = low, b = high;
        while (b - a > 1e-9) {
            const double middle = (a + b) / 2;
            (integral(middle) < u.x * total ? a : b) = middle;
        }
        return {a, pdf(a)};
    }
    [[nodiscard]] double pdf(double x) const noexcept { return x >= low && x <= high ? shape(x) / total : 0; }
};
template <class Shape>
Numeric(Shape, double, double) -> Numeric<Shape>;

// Points that fill the cube evenly: Kronecker's sequence of generalised golden ratios (Roberts 2018). Each round takes one.
class Lattice {
  public:
    explicit Lattice(std::size_t dimensions) {
        double ratio = 1;
        for (int i = 0; i < 60; ++i) ratio = std::pow(1 + ratio, 1 / static_cast<double>(dimensions + 1));
        double power = 1;
        for (std::size_t i = 0; i < dimensions; ++i) steps_.push_back(power /= ratio);
    }

    void next_point() {
        component_ = 0;
        ++point_;
    }

    template <int N>
    [[nodiscard]] glm::vec<N, double> next() {
        glm::vec<N, double> u;
        for (int i = 0; i < N; ++i) {
            double whole;
            u[i] = std::modf(0.5 + static_cast<double>(point_) * steps_.at(component_++), &whole);
        }
        return u;
    }

  private:
    std::vector<double> steps_;
    std::size_t component_ = 0, point_ = 0;
};

// A round of each of `points` points.
template <class Best, class F>
void add_evenly(Best& best, const F& f, int points) {
    Lattice uniforms{best.techniques().uniforms_per_estimate()};
    for (int i = 0; i < points; ++i) {
        best.add(f, uniforms);
        uniforms.next_point();
    }
}
