// Renders an OBJ file under a sky.
#include "adaptors.hpp"
#include "images/image.hpp"
#include "render.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>

int main(int argc, char** argv) {
    std::string obj = LUMIS_EXAMPLES_DATA "/room.obj", sky = LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr";
    std::string output = "embree_host.png";
    host::View view = host::room_view;
    int samples = 64, bounces = 8;
    CLI::App app{"A renderer that samples by Lumis."};
    app.add_option("--obj", obj, "The scene")->check(CLI::ExistingFile)->capture_default_str();
    app.add_option("--sky", sky, "Its latitude-longitude map")->check(CLI::ExistingFile)->capture_default_str();
    app.add_option("--output", output, "A .png or .exr")->capture_default_str();
    app.add_option("--width", view.width, "In pixels")->check(CLI::Range(1, 16384))->capture_default_str();
    app.add_option("--height", view.height, "In pixels")->check(CLI::Range(1, 16384))->capture_default_str();
    app.add_option("--samples", samples, "Paths a pixel")->check(CLI::Range(1, 1 << 20))->capture_default_str();
    app.add_option("--bounces", bounces, "1 is direct light")->check(CLI::Range(0, 10000))->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        const host::Scene scene{obj, host::read_sky(sky)};
        tracer::Image image{view.width, view.height, {}};
        for (const host::Vec& pixel : render(scene, host::LumisParts{scene}, view, samples, bounces, 0)) {
            image.pixels.push_back(host::to_lumis(pixel));
        }
        tracer::write_image(output, image);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "embree_host: %s\n", error.what());
        return 1;
    }
}
