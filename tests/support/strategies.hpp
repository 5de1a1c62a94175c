// The list of strategies over which all laws run. A new strategy adds one line here, and a struct among the subjects
// whose make<T>() yields its instances.
#pragma once

#include "combined_subjects.hpp"
#include "cosine_subjects.hpp"
#include "dielectric_subjects.hpp"
#include "light_subjects.hpp"
#include "scattering_subjects.hpp"
#include "solid_angle_subjects.hpp"

#include <tuple>

using Strategies = std::tuple<subjects::CosineHemisphere,           //
                              subjects::UniformHemisphere,          //
                              subjects::UniformSphere,              //
                              subjects::UniformCone,                //
                              subjects::HenyeyGreenstein,           //
                              subjects::GgxNdf,                     //
                              subjects::GgxVndf,                    //
                              subjects::GgxReflection,              //
                              subjects::GgxBoundedReflection,       //
                              subjects::ReflectedGgxNdf,            //
                              subjects::ReflectedCosine,            //
                              subjects::GgxReflectionInFrame,       //
                              subjects::CoatedDiffuse,              //
                              subjects::GgxDielectric,              //
                              subjects::TriangleByArea,             //
                              subjects::ParallelogramByArea,        //
                              subjects::DiskByArea,                 //
                              subjects::SphereByArea,               //
                              subjects::TriangleBySolidAngle,       //
                              subjects::ParallelogramBySolidAngle,  //
                              subjects::SphereBySolidAngle,         //
                              subjects::TriangleByCosine,           //
                              subjects::ParallelogramByCosine,      //
                              subjects::ImageLight,                 //
                              subjects::Sun,                        //
                              subjects::EnvironmentMap,             //
                              subjects::CompensatedEnvironmentMap,  //
                              subjects::AliasEnvironmentMap,        //
                              subjects::PiecewiseConstant1D,        //
                              subjects::PiecewiseConstant2D,        //
                              subjects::AliasTable,                 //
                              subjects::LightSet,                   //
                              subjects::Mixture,                    //
                              subjects::VariantStrategy>;
