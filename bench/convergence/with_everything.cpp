#include "with_everything.hpp"

#include "left_out.hpp"
#include "scenes/scene_cornell.hpp"
#include "scenes/scene_sky.hpp"
#include "scenes/scene_veach.hpp"

namespace convergence {

std::unique_ptr<tracer::Renderer> make_with_everything(const std::string& scene, const tracer::SceneOptions& options) {
    if (scene == "veach")
        return render_with_everything(tracer::Veach<tracer::Coated<float>>{tracer::coated_plate}, options);
    if (scene == "sky") return render_with_everything(tracer::Sky{options.environment}, options);
    if (scene == "cornell") return render_with_everything(tracer::Cornell{}, options);
    return nullptr;
}

}  // namespace convergence
