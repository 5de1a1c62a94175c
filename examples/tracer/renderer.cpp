#include "renderer.hpp"

#include "paths/transport.hpp"

namespace tracer {

std::span<const std::string_view> integrator_names() {
    static constexpr auto names = [] {
        std::array<std::string_view, integrators.size()> result;
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = integrators[i].name;
        return result;
    }();
    return names;
}

}  // namespace tracer
