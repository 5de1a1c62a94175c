// The scenes, one in a file of its own each.
#pragma once

#include "renderer.hpp"

#include <memory>

namespace tracer {

[[nodiscard]] std::unique_ptr<Renderer> make_veach(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_veach_metal(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_sky(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_cornell(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_box(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_furnace(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_glass(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_slab(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_many_lights(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_sundial(const SceneOptions& options);
[[nodiscard]] std::unique_ptr<Renderer> make_mesh(const SceneOptions& options);

}  // namespace tracer
