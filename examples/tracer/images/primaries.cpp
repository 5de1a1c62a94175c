#include "images/primaries.hpp"

#include "images/image.hpp"

#include <ImfChromaticities.h>

#include <cmath>
#include <stdexcept>

namespace tracer {

namespace {

Imf::Chromaticities chromaticities(const Primaries& p) {
    return {{p.red.x, p.red.y}, {p.green.x, p.green.y}, {p.blue.x, p.blue.y}, {p.white.x, p.white.y}};
}

// Imath multiplies a row by a matrix, whose rows therefore are GLM's columns.
void transform(Image& image, const Imath::M44f& matrix) {
    glm::mat3 columns;
    for (int i = 0; i < 3; ++i) columns[i] = {matrix[i][0], matrix[i][1], matrix[i][2]};
    for (glm::vec3& pixel : image.pixels) pixel = columns * pixel;
}

bool nearly_equal(const Primaries& a, const Primaries& b) {
    const auto near = [](const glm::vec2& p, const glm::vec2& q) {
        constexpr float rounding = 5e-4f;  // files give three or four digits
        return std::abs(p.x - q.x) <= rounding && std::abs(p.y - q.y) <= rounding;
    };
    return near(a.red, b.red) && near(a.green, b.green) && near(a.blue, b.blue) && near(a.white, b.white);
}

}  // namespace

void convert_to_rec709(Image& image, const Primaries& primaries) {
    if (nearly_equal(primaries, rec709)) return;
    const Imath::M44f to_xyz = Imf::RGBtoXYZ(chromaticities(primaries), 1);
    if (!(std::abs(to_xyz.determinant()) > 0)) throw std::invalid_argument("its primaries span no colour space");
    transform(image, to_xyz * Imf::XYZtoRGB(chromaticities(rec709), 1));
}

void convert_xyz_to_rec709(Image& image) {
    transform(image, Imf::XYZtoRGB(chromaticities(rec709), 1));
}

}  // namespace tracer
