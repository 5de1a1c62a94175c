// Images as statistics: means over blocks of pixels, and their spread over independent images.
#pragma once

#include "catch.hpp"
#include "images/image.hpp"
#include <lumis/statistics/running_moments.hpp>
#include <lumis/testing/result.hpp>

#include <boost/math/distributions/normal.hpp>

#include <cmath>
#include <string>
#include <vector>

// Moments over images of each block's mean luminance, and last of all that of the whole image.
class BlockMoments {
  public:
    static constexpr int block = 8;  // pixels along each side, of which width and height are multiples

    BlockMoments(int width, int height)
        : width_{width}, height_{height}, moments_(static_cast<std::size_t>(across() * (height / block)) + 1) {}

    void add(const tracer::Image& image) {
        std::vector<double> sums(moments_.size());
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                const double value = tracer::luminance(image.pixels[static_cast<std::size_t>(y * width_ + x)]);
                sums[static_cast<std::size_t>(y / block * across() + x / block)] += value / (block * block);
                sums.back() += value / (width_ * height_);
            }
        }
        for (std::size_t b = 0; b < sums.size(); ++b) moments_[b].add(sums[b]);
    }

    [[nodiscard]] std::size_t size() const { return moments_.size(); }
    [[nodiscard]] const lumis::RunningMoments<>& operator[](std::size_t i) const { return moments_[i]; }
    [[nodiscard]] const lumis::RunningMoments<>& whole() const { return moments_.back(); }

  private:
    [[nodiscard]] int across() const { return width_ / block; }

    int width_, height_;
    std::vector<lumis::RunningMoments<>> moments_;
};

// Every block has the same mean in both, up to chance: 1e-4 over all blocks, and over as many such comparisons. The image as a
// whole is known so well that the test would see a bias of it, as a share of b.
inline void require_same_means(const BlockMoments& a, const BlockMoments& b, std::size_t comparisons,
                               const std::string& what, double bias = 0.005) {
    const lumis::testing::Significance significance{1e-4, comparisons * a.size()};
    const double limit = quantile(complement(boost::math::normal_distribution<double>{}, significance.threshold() / 2));
    for (std::size_t i = 0; i < a.size(); ++i) {
        INFO(what << ", block " << i << ": " << a[i].mean() << " +- " << a[i].standard_error() << " against "
                  << b[i].mean() << " +- " << b[i].standard_error());
        const double error = std::hypot(a[i].standard_error(), b[i].standard_error());
        // What all see alike (the sky itself) has no error but rounding.
        CHECK(std::abs(a[i].mean() - b[i].mean()) <= limit * error + 1e-6 * b[i].mean());
        CHECK(a[i].rejected() + b[i].rejected() == 0);
    }
    CHECK(limit * b.whole().standard_error() <= bias * b.whole().mean());
}
