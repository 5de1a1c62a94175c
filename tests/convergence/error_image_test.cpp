// The levels of grey that stand for errors.
#include "error_image.hpp"

#include "catch.hpp"

#include <cmath>
#include <limits>
#include <vector>

using namespace convergence;

namespace {

// A row of pixels of this brightness.
ReferenceImage flat(float brightness, double floor) {
    ReferenceImage reference{};
    reference.image = {3, 1, {3, glm::vec3{brightness}}};
    reference.floor = floor;
    return reference;
}

double error_of(unsigned char level) {
    return ErrorScale::low * std::pow(ErrorScale::high / ErrorScale::low, level / 255.0);
}

}  // namespace

TEST_CASE("a level of grey is the relative error of a pixel") {
    const tracer::Image image{3, 1, {{2, 2, 2}, {2.2f, 2.2f, 2.2f}, {2, 2.6f, 2}}};
    const auto levels = error_levels(image, flat(2, 0.1));
    REQUIRE(levels.size() == 3);
    CHECK(levels[0] == 0);
    CHECK(std::abs(error_of(levels[1]) / 0.1 - 1) <= 0.02);  // half of a level is 1.8 %
    CHECK(std::abs(error_of(levels[2]) / (0.3 / std::sqrt(3.0)) - 1) <= 0.02);
}

TEST_CASE("levels end where the scale does, and darkness has a floor") {
    const tracer::Image image{3, 1, {{1e-9f, 0, 0}, {1e9f, 0, 0}, {0.05f, 0.05f, 0.05f}}};
    const auto levels = error_levels(image, flat(0, 0.1));
    REQUIRE(levels.size() == 3);
    CHECK(levels[0] == 0);
    CHECK(levels[1] == 255);
    CHECK(std::abs(error_of(levels[2]) / 0.5 - 1) <= 0.02);
}

TEST_CASE("a pixel that is not finite is as wrong as the scale goes, and is counted") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const tracer::Image image{3, 1, {{2, nan, 2}, {2, 2, 2}, {2, 2, -infinity}}};
    CHECK(error_levels(image, flat(2, 0.1)) == std::vector<unsigned char>{255, 0, 255});
    CHECK(count_not_finite(image) == 2);
}

TEST_CASE("an image of which a pixel is not finite, or all are black, has no bias") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    ReferenceImage reference = flat(2, 0.1);
    reference.power = reference.balance = reference.image;
    const tracer::Image off{3, 1, {{2, 2, 2}, {2.2f, 2.2f, 2.2f}, {2, 2.6f, 2}}};
    CHECK(pool(off, reference).bias_z > 0);
    CHECK(pool(reference.image, reference).bias_z == 0);
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity}) {
        tracer::Image image = off;
        image.pixels[1].g = value;
        const Pooled pooled = pool(image, reference);
        CHECK(std::isnan(pooled.bias_z));
        CHECK(std::isnan(pooled.tail_share));
        CHECK_FALSE(pooled.no_hits);
    }
    CHECK(pool({3, 1, {3, glm::vec3{0}}}, reference).no_hits);
    CHECK_FALSE(pool(off, reference).no_hits);
}
