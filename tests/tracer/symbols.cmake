# What a scene does not use is not in its object file. OBJECTS are compiled without optimisation, so that nothing is
# missing merely because it was inlined; the scenes that do use a strategy show that it would have been found.
foreach(object IN LISTS OBJECTS)
    cmake_path(GET object STEM LAST_ONLY scene)  # scene_sky.cpp.o
    cmake_path(GET scene STEM LAST_ONLY scene)
    execute_process(COMMAND ${NM} --demangle --defined-only ${object} OUTPUT_VARIABLE symbols_of_${scene}
        COMMAND_ERROR_IS_FATAL ANY)
endforeach()

# lumis::Name stands for a name in whatever namespace of Lumis.
function(expect scene contains pattern)
    string(REPLACE "lumis::" "lumis::([a-z0-9_]+::)*" pattern ${pattern})
    string(REGEX MATCHALL "${pattern}" found "${symbols_of_${scene}}")
    list(LENGTH found count)
    message(STATUS "${scene}: ${pattern} occurs ${count} times")
    if((contains AND count EQUAL 0) OR (NOT contains AND count GREATER 0) OR symbols_of_${scene} STREQUAL "")
        message(FATAL_ERROR "That should not be so.")
    endif()
endfunction()

#      scene         contains
expect(scene_sky     TRUE  lumis::[a-zA-Z]*EnvironmentMap)
expect(scene_sky     TRUE  lumis::GgxReflection)
expect(scene_sky     TRUE  tracer::Mirror)
expect(scene_sky     FALSE lumis::AreaLight)
expect(scene_sky     FALSE lumis::Mixture)
expect(scene_sky     FALSE "tracer::(Coated|Compensated|Blend|RoughGlass|SmoothGlass|FewLights)")
expect(scene_veach   TRUE  lumis::SphereView)
expect(scene_veach   TRUE  lumis::GgxReflection)
expect(scene_veach   TRUE  tracer::Coated)
expect(scene_veach   FALSE lumis::[a-zA-Z]*EnvironmentMap)
expect(scene_veach   FALSE lumis::FlatView)
expect(scene_veach   FALSE lumis::PerfectReflection)
expect(scene_veach   FALSE "tracer::(Mirror|Compensated|Blend|RoughGlass|SmoothGlass|Environment)")
expect(scene_cornell TRUE  lumis::FlatView)
expect(scene_cornell TRUE  lumis::Mixture)
expect(scene_cornell FALSE lumis::[a-zA-Z]*EnvironmentMap)
expect(scene_cornell FALSE lumis::SphereView)
expect(scene_cornell FALSE lumis::PerfectReflection)
expect(scene_cornell FALSE "tracer::(Metal|Mirror|Compensated|Blend|RoughGlass|SmoothGlass|Environment)")
expect(diffuse_room  TRUE  lumis::FlatView)
expect(diffuse_room  TRUE  tracer::Diffuse)
expect(diffuse_room  FALSE lumis::[a-zA-Z]*EnvironmentMap)
expect(diffuse_room  FALSE lumis::Ggx)
expect(diffuse_room  FALSE lumis::SphereView)
expect(diffuse_room  FALSE lumis::Mixture)
expect(diffuse_room  FALSE lumis::PerfectReflection)
expect(diffuse_room  FALSE "tracer::(Coated|Metal|Mirror|Compensated|Blend|RoughGlass|SmoothGlass|Environment)")

# These have few lights, or a sky: no light tree chooses.
foreach(scene IN ITEMS scene_sky scene_veach scene_cornell diffuse_room)
    expect(${scene} FALSE "(ManyLights|LightTree)")
endforeach()
