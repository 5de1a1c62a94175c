// The irradiance of each shape of light at three distances: nearer than its size, as near, and far.
#include "irradiance.hpp"

#include <array>
#include <cstdio>
#include <utility>

namespace {

using namespace convergence;
using glm::dvec3;

constexpr std::array<std::pair<double, const char*>, 3> distances{{{0.25, "near"}, {1, "middling"}, {8, "far"}}};

std::string described(double distance) {
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "The nearest point of the light is %g above a plane that faces it.",
                  distance);
    return text.data();
}

Problem triangle(double h) {
    const std::array corners{dvec3{0, 0, h}, dvec3{1, 0, h}, dvec3{0, 1, h}};
    return irradiance("irradiance", "Triangle", described(h), lumis::Triangle{corners[0], corners[1], corners[2]},
                      irradiance_of_polygon(corners));
}

Problem rectangle(double h) {
    const std::array corners{dvec3{-1, -1, h}, dvec3{1, -1, h}, dvec3{1, 1, h}, dvec3{-1, 1, h}};
    return irradiance("irradiance", "Square", described(h),
                      lumis::Parallelogram{corners[0], corners[1] - corners[0], corners[3] - corners[0]},
                      irradiance_of_polygon(corners));
}

Problem disk(double h) {
    return irradiance("irradiance", "Disk", described(h), lumis::Disk{dvec3{0, 0, h}, dvec3{0, 0, -1}, 1.0},
                      std::numbers::pi / (1 + h * h));
}

Problem sphere(double h) {
    return irradiance("irradiance", "Sphere", described(h), lumis::Sphere{dvec3{0, 0, 1 + h}, 1.0},
                      std::numbers::pi / ((1 + h) * (1 + h)));
}

// One of a shape at each distance.
struct Shape {
    Shape(const std::string& name, Problem (*make)(double)) {
        for (const auto& [distance, word] : distances) {
            const auto at_distance = [make, h = distance, where = std::string{word}] {
                Problem problem = make(h);
                problem.title += ", " + where;
                return problem;
            };
            Registered{"irradiance-" + name + "-" + word, at_distance};
        }
    }
};
const Shape triangles{"triangle", triangle}, rectangles{"rectangle", rectangle}, disks{"disk", disk},
    spheres{"sphere", sphere};

}  // namespace
