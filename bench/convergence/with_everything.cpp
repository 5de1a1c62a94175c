#include "with_everything.hpp"

#include "left_out.hpp"
#include "scene_cornell.hpp"
#include "scene_sky.hpp"
#include "scene_veach.hpp"

#include <stdexcept>

namespace convergence {

std::unique_ptr<tracer::Renderer> make_with_everything(const std::string& scene, const tracer::SceneOptions& options) {
    if (scene == "veach") return with_everything(tracer::Veach{}, options);
    if (scene == "sky") return with_everything(tracer::Sky{options.environment}, options);
    if (scene == "cornell") return with_everything(tracer::Cornell{}, options);
    throw std::invalid_argument("no scene " + scene + " with everything in");
}

}  // namespace convergence
