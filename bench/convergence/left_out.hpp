// What a scene's estimator does not contain, and what that saves.
#pragma once

#include "reference_image.hpp"
#include "study.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace convergence {

// The scene with everything in, see with_everything.hpp; nullptr for one that is not measured so.
[[nodiscard]] std::unique_ptr<tracer::Renderer> make_with_everything(const std::string& scene,
                                                                     const tracer::SceneOptions& options);

// Both ways of rendering the scene by power, in turns; seconds: CPU time of each run. Nothing where there is but one.
[[nodiscard]] std::optional<LeftOut> left_out(const std::string& scene, const tracer::Renderer& composed,
                                              const tracer::SceneOptions& options, const ReferenceImage& reference,
                                              const std::vector<std::uint64_t>& seeds, double seconds,
                                              const Progress& progress);

// What `convergence --instructions` runs under callgrind: one variant, "composed" or "everything", for some samples.
void render_for_instructions(const std::string& scene, const std::string& variant, int samples);

}  // namespace convergence
