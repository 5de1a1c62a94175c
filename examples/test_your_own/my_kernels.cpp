#include "moon.hpp"

#include <forms.hpp>

namespace {

const bool added = [] {
    add_strategy<float>("moon", ready(Moon{{0, 0, 1}, 0.9f, 1.5f}), nullptr);
    add_strategy<float>("cosine_hemisphere", ready(lumis::CosineHemisphere<float>{}), nullptr);
    return true;
}();

}  // namespace
