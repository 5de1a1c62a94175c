// The levels of grey that stand for errors.
#include "error_image.hpp"

#include "catch.hpp"

#include <cmath>

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
