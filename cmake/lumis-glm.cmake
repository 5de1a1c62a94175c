# lumis_find_glm() defines lumis::glm, GLM as the host has it, or does not, where there is none. Both a Lumis in a subfolder and
# an installed one call it. The first of these that there is:
# - LUMIS_GLM_DIR, the folder that contains glm/vec3.hpp;
# - a target of the host's: glm::glm, GLM::GLM or glm;
# - GLM's package;
# - headers in a folder where CMake looks, or that the host names by include_directories or CPLUS_INCLUDE_PATH.
function(lumis_find_glm)
    if(TARGET lumis::glm)
        return()
    endif()
    if(NOT LUMIS_GLM_DIR)
        set(names glm::glm GLM::GLM glm)
        if(NOT (TARGET glm::glm OR TARGET GLM::GLM OR TARGET glm))
            find_package(glm QUIET)
        endif()
        foreach(name IN LISTS names)
            if(TARGET ${name})
                add_library(lumis::glm INTERFACE IMPORTED)
                target_link_libraries(lumis::glm INTERFACE ${name})
                return()
            endif()
        endforeach()
    endif()

    set(header glm/ext/vector_float1.hpp)  # older versions than 0.9.9 do not have it
    get_directory_property(of_host INCLUDE_DIRECTORIES)
    find_path(LUMIS_GLM_DIR ${header}
        HINTS ${GLM_INCLUDE_DIRS} ${GLM_INCLUDE_DIR} ${of_host} ENV CPLUS_INCLUDE_PATH
        DOC "The folder that contains glm/vec3.hpp, for Lumis; not needed where GLM has a package or a target")
    if(EXISTS ${LUMIS_GLM_DIR}/${header})
        add_library(lumis::glm INTERFACE IMPORTED)
        target_include_directories(lumis::glm SYSTEM INTERFACE ${LUMIS_GLM_DIR})
    endif()
endfunction()

set(LUMIS_NEEDS_GLM "Lumis needs GLM 0.9.9 or later. Install it (libglm-dev), say where it is by \
-D LUMIS_GLM_DIR=<the folder that contains glm/vec3.hpp>, or add it to the project before Lumis: a target glm::glm will do.")
