// Renders a small room in several passes with eight threads, and once more with one: the bits are the same. With the thread
// sanitizer it shows that tasks share nothing; every scene runs the same loops.
#include "renderer.hpp"

#include <oneapi/tbb/global_control.h>

#include <cstdio>

namespace tracer {

std::unique_ptr<Renderer> make_diffuse_room(const SceneOptions& options);

}  // namespace tracer

namespace {

using namespace tracer;

Film render(const Renderer& renderer, std::size_t threads) {
    const oneapi::tbb::global_control limit{oneapi::tbb::global_control::max_allowed_parallelism, threads};
    Film film{40, 30};
    for (std::uint32_t first = 0; first < 64; first += 16)
        renderer.add_pass(film, "power", RenderOptions{}, {first, 16}, 1);
    return film;
}

}  // namespace

int main() {
    const auto renderer = make_diffuse_room({40, 30, {}, {}});
    const Film one = render(*renderer, 1), eight = render(*renderer, 8);
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        if (one.pixels[i].sum == eight.pixels[i].sum && one.pixels[i].squares == eight.pixels[i].squares) continue;
        std::printf("pixel %zu depends on the threads\n", i);
        return 1;
    }
    return 0;
}
