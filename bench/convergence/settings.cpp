#include "settings.hpp"

#include <sstream>

namespace convergence {

std::string Settings::arguments() const {
    std::ostringstream text;
    text << "--seeds " << seeds.size() << " --seconds " << seconds << " --width " << width << " --reference-samples "
         << reference_samples << " --threads " << threads;
    if (!environment.empty()) text << " --env " << std::filesystem::path{environment}.filename().string();
    for (const std::string& problem : problems) text << " --problem " << problem;
    return text.str();
}

}  // namespace convergence
