// Files that name the primary colours of their red, green and blue.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace tracer {

struct Image;

// Chromaticities (x, y), as CIE 1931 defines them.
struct Primaries {
    glm::vec2 red, green, blue, white;
};

inline constexpr Primaries rec709{{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}};

// Turns an image of these primaries into one of Rec. 709 with the same tristimulus values XYZ: a white that is not D65 keeps
// its tint. Throws std::invalid_argument if the primaries span no colour space.
void convert_to_rec709(Image& image, const Primaries& primaries);

// The same for an image of X, Y and Z.
void convert_xyz_to_rec709(Image& image);

}  // namespace tracer
