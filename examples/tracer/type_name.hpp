// The name of a type as its author wrote it, to show what an estimator consists of.
#pragma once

#include <boost/core/demangle.hpp>

#include <regex>
#include <string>
#include <typeinfo>

namespace tracer {

// Without namespaces and scalar arguments: Mixture<CosineHemisphere, GgxReflection>.
template <class T>
[[nodiscard]] std::string type_name() {
    const std::string full = boost::core::demangle(typeid(T).name());
    const std::string short_names =
        std::regex_replace(full, std::regex{"lumis::([a-z0-9_]+::)*|tracer::|<float>|float, | const|&"}, "");
    return std::regex_replace(short_names, std::regex{" +>"}, ">");
}

}  // namespace tracer
