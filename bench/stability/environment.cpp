// Environment maps of awkward shapes and with awkward texels.
#include "cases.hpp"
#include "picture.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace stability {

namespace {

// The density integrates to 1, is positive exactly where there is light, and agrees with what is drawn.
template <class T>
void check_mass(Measured& measured, const Picture<T>& picture, const lumis::EnvironmentMap<T>& map, auto lit) {
    Quad mass = 0;
    for (std::size_t y = 0; y < picture.height; ++y) {
        Quad row = 0;
        for (std::size_t x = 0; x < picture.width; ++x) {
            const T pdf = map.pdf(centre_of<T>(x, y, picture.width, picture.height));
            measured.density(pdf);
            measured.expect((pdf > 0) == lit(x, y));
            row += Quad{pdf};
        }
        mass += row * texel_solid_angle(y, picture.width, picture.height);
    }
    measured.error(static_cast<double>(abs(mass - 1)));
    for_each_uniform<T>(1000, [&](const auto& u) {
        const auto sample = map.sample(u);
        const T pdf = map.pdf(sample.value);
        measured.sample<T>(sample, pdf);
        measured.expect(sample.pdf > 0 && pdf == sample.pdf);
    });
}

// The irradiance of the map on a receiver, by all its texels in double: radiance times the projected solid angle, with
// every texel cut into many.
template <class T>
double irradiance_of(const Picture<T>& picture, const glm::dvec3& normal) {
    const std::size_t x_cuts = 256 / picture.width, y_cuts = 256 / picture.height;
    double sum = 0;
    const std::size_t w = picture.width * x_cuts, h = picture.height * y_cuts;
    for (std::size_t y = 0; y < h; ++y) {
        const double solid_angle = static_cast<double>(texel_solid_angle(y, w, h));
        for (std::size_t x = 0; x < w; ++x) {
            const double cosine = glm::dot(centre_of<double>(x, y, w, h), normal);
            sum += double{picture.texels[y / y_cuts * picture.width + x / x_cuts]} * std::fmax(cosine, 0) * solid_angle;
        }
    }
    return sum;
}

template <class T>
T radiance_at(const Picture<T>& picture, const lumis::Direction<T>& w) {
    const auto uv = lumis::latlong_from_direction(w);
    const auto x = static_cast<std::size_t>(uv.x * static_cast<T>(picture.width));
    const auto y = static_cast<std::size_t>(uv.y * static_cast<T>(picture.height));
    return picture.texels[std::min(y, picture.height - 1) * picture.width + std::min(x, picture.width - 1)];
}

template <class T>
void check_irradiance(Measured& measured, const Picture<T>& picture, std::int64_t samples) {
    const auto map = picture.map();
    for (const glm::dvec3 normal : {glm::dvec3{0, 1, 0}, {0, -1, 0}, {0.6, 0, 0.8}}) {
        const double answer = irradiance_of(picture, normal);
        // A receiver that looks away from nearly all light would take too many samples.
        if (!(answer > 0.1 * irradiance_of(picture, -normal))) continue;
        const glm::vec<3, T> n{normal};
        const auto f = [&](const auto& w) { return radiance_at(picture, w) * std::max(glm::dot(w, n), T(0)); };
        const auto estimator = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, map));
        const auto moments = moments_of<T>(samples, [&](auto& source) { return estimator.estimate(f, source); });
        measured.bias(moments, answer, 3e-4);  // of the cuts
    }
}

}  // namespace

template <class T>
Measured environment_shapes(Effort effort) {
    Measured measured;
    const auto white = [](std::size_t, std::size_t) { return 1.0; };
    const auto uneven = [](std::size_t x, std::size_t y) { return 1.0 + static_cast<double>((3 * x + 7 * y) % 5); };
    const auto everywhere = [](std::size_t, std::size_t) { return true; };
    const auto check = [&](const Picture<T>& picture, auto lit) {
        for (const auto interpolation : {lumis::Interpolation::Nearest, lumis::Interpolation::Bilinear}) {
            const bool nearest = interpolation == lumis::Interpolation::Nearest;
            if (nearest || lit(0, 0)) check_mass(measured, picture, picture.map({interpolation}), lit);
        }
        check_irradiance(measured, picture, effort.of(30'000));
    };
    for (const std::size_t n : {1u, 2u, 7u, 64u}) {
        for (const auto& [w, h] : {std::pair{n, n}, {n, std::size_t{1}}, {std::size_t{1}, n}}) {
            check(Picture<T>{w, h, white}, everywhere);
            check(Picture<T>{w, h, uneven}, everywhere);
        }
    }
    const auto odd_rows = [](std::size_t, std::size_t y) { return y % 2 == 1; };
    check(Picture<T>{16, 9, [](std::size_t, std::size_t y) { return y % 2 == 1 ? 1.0 : 0.0; }}, odd_rows);
    // One texel in a million, in the middle and at either pole; a pole's row.
    for (const std::size_t hot : {0u, 20u, 31u}) {
        check(Picture<T>{64, 32, [=](std::size_t x, std::size_t y) { return x == 5 && y == hot ? 1e6 : 1.0; }},
              everywhere);
        check(Picture<T>{64, 32, [=](std::size_t, std::size_t y) { return y == hot ? 1e6 : 1.0; }}, everywhere);
    }
    const auto black = Picture<T>{8, 4, [](std::size_t, std::size_t) { return 0.0; }}.map();
    for_each_uniform<T>(20, [&](const auto& u) {
        const auto sample = black.sample(u);
        measured.sample<T>(sample, black.pdf(sample.value));
        measured.expect(black.empty() && sample.pdf == 0 && black.pdf(sample.value) == 0);
    });
    return measured;
}

template <class T>
Measured environment_compensation(Effort) {
    Measured measured;
    constexpr lumis::EnvironmentOptions options{lumis::Interpolation::Nearest, true};
    const auto everywhere = [](std::size_t, std::size_t) { return true; };
    for (const double value : {1e-30, 1.0, 1e30}) {
        for (const std::size_t n : {1u, 2u, 33u, 256u}) {
            const Picture<T> constant{n, n, [=](std::size_t, std::size_t) { return value; }};
            check_mass(measured, constant, constant.map(options), everywhere);
        }
    }
    // With contrast, what lies below the mean is left out.
    const Picture<T> hot{64, 32, [](std::size_t x, std::size_t y) { return x == 5 && y == 9 ? 1e6 : 1.0; }};
    check_mass(measured, hot, hot.map(options), [](std::size_t x, std::size_t y) { return x == 5 && y == 9; });
    return measured;
}

template <class T>
Measured environment_bad_texels(Effort) {
    Measured measured;
    const auto refused = [&](std::size_t width, std::size_t height, const std::vector<T>& texels, std::string named) {
        try {
            const lumis::EnvironmentMap<T> map{width, height, texels};
            measured.expect(false);
        } catch (const std::invalid_argument& error) {
            measured.expect(std::string{error.what()}.find(named) != std::string::npos);
        }
    };
    for (const T bad : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity(), T(-1)}) {
        if (measured.leaves_out<T>(bad)) continue;
        for (const std::size_t i : {0u, 5u, 31u}) {
            std::vector<T> texels(32, T(1));
            texels[i] = bad;
            refused(8, 4, texels, "weight " + std::to_string(i));
            refused(8, 4, texels, std::to_string(bad));
        }
    }
    refused(0, 4, {}, "width");
    refused(4, 0, {}, "height");
    refused(8, 4, std::vector<T>(31, T(1)), "31");
    return measured;
}

template Measured environment_shapes<float>(Effort);
template Measured environment_shapes<double>(Effort);
template Measured environment_compensation<float>(Effort);
template Measured environment_compensation<double>(Effort);
template Measured environment_bad_texels<float>(Effort);
template Measured environment_bad_texels<double>(Effort);

}  // namespace stability
