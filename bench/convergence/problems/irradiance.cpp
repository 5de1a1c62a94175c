// The irradiance of each shape of light at three distances: nearer than its size, as near, and far; and of rectangles that stand
// on the receiver's plane, or through it.
#include "irradiance.hpp"

#include <array>
#include <cstdio>
#include <string>
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

// Rectangles that stand on the plane, or through it, or lie aside: edge_u is level. What is below the plane is cut off for the
// answer.
struct Aside {
    Aside(const std::string& name, const char* title, const char* description, const dvec3& corner, const dvec3& edge_u,
          const dvec3& edge_v) {
        const dvec3 start = corner + (corner.z < 0 ? -corner.z / edge_v.z : 0.0) * edge_v, end = corner + edge_v;
        const std::array corners{start, start + edge_u, end + edge_u, end};
        Registered{"irradiance-" + name, [=] {
                       return irradiance("irradiance", title, description, lumis::Parallelogram{corner, edge_u, edge_v},
                                         irradiance_of_polygon(corners));
                   }};
    }
};
const Aside wall{"wall",          "Square, upright", "A 2 x 2 square that stands on the plane, 1 away.",
                 dvec3{1, -1, 0}, dvec3{0, 2, 0},    dvec3{0, 0, 2}};
const Aside wall_close_by{"wall-close-by",
                          "Square, upright and close by",
                          "A 2 x 2 square that stands on the plane, 0.1 away.",
                          dvec3{0.1, -1, 0},
                          dvec3{0, 2, 0},
                          dvec3{0, 0, 2}};
const Aside wall_through{"wall-through-the-plane",
                         "Square, half below the horizon",
                         "A 2 x 2 square, 1 away, that stands half above the plane and half below.",
                         dvec3{1, -1, -1},
                         dvec3{0, 2, 0},
                         dvec3{0, 0, 2}};
const Aside strip{"strip",           "Strip, aside", "A 4 x 2 rectangle that lies 0.5 above the plane, 2 to 6 away.",
                  dvec3{2, -1, 0.5}, dvec3{4, 0, 0}, dvec3{0, 2, 0}};

}  // namespace
