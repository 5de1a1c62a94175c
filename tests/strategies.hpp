// The list of strategies over which all laws run. A new strategy adds one line here, and a struct among the subjects
// whose make<T>() yields its instances.
#pragma once

#include "light_subjects.hpp"
#include "scattering_subjects.hpp"

#include <tuple>

using Strategies = std::tuple<subjects::CosineHemisphere,      //
                              subjects::UniformHemisphere,     //
                              subjects::GgxVndf,               //
                              subjects::GgxReflection,         //
                              subjects::ReflectedCosine,       //
                              subjects::GgxReflectionInFrame,  //
                              subjects::CoatedDiffuse,         //
                              subjects::TriangleByArea,        //
                              subjects::ParallelogramByArea,   //
                              subjects::SphereByArea,          //
                              subjects::SphereBySolidAngle,    //
                              subjects::EnvironmentMap>;
