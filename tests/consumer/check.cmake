# cmake -D ROUTE=<route> -D BINARY_DIR=<folder of its own>
#       [-D GENERATOR=<generator>] [-D CXX_COMPILER=<compiler>] [-D CXX_FLAGS=<flags>] [-D glm_DIR=<GLM's package>]
#       [-D GLM_FOLDER=<folder that contains glm/>] [-D PYTHON=<python3>] -P check.cmake
# Builds and runs a project of another's from nothing, so that no header of an earlier install is found. The routes:
# - add_subdirectory, single_header: the project beside this file
# - find_package: the same, and the first example by pkg-config from an unpacked .deb, where there are pkg-config and dpkg-deb
# - exported: host/ has Lumis by FetchContent and exports a library that links it; user/ uses that library
# - glm: the ways in which a host has GLM
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH tests)
cmake_path(GET tests PARENT_PATH lumis)

set(options)
if(GENERATOR)
    list(APPEND options -G ${GENERATOR})
endif()
if(CXX_COMPILER)
    list(APPEND options -D CMAKE_CXX_COMPILER=${CXX_COMPILER})
endif()
if(CXX_FLAGS)
    list(APPEND options -D CMAKE_CXX_FLAGS=${CXX_FLAGS})
endif()
if(glm_DIR AND NOT ROUTE STREQUAL "exported")
    list(APPEND options -D glm_DIR=${glm_DIR})
endif()

function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The project beside this file, built and run; further arguments are its options.
function(check_consumer)
    run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${BINARY_DIR}/consumer ${options} ${ARGV})
    run(${CMAKE_COMMAND} --build ${BINARY_DIR}/consumer)
    check_first_estimate(${BINARY_DIR}/consumer/consumer)
endfunction()
function(check_first_estimate program)
    run(${CMAKE_COMMAND}
        -D PROGRAM=${program}
        -D EXPECTED=${lumis}/examples/01_first_estimate.txt
        -P ${lumis}/cmake/compare_output.cmake)
endfunction()

# Installs Lumis, and moves what is installed to BINARY_DIR/prefix.
function(install_lumis)
    run(${CMAKE_COMMAND} -S ${lumis} -B ${BINARY_DIR}/lumis ${options})
    run(${CMAKE_COMMAND} --install ${BINARY_DIR}/lumis --prefix ${BINARY_DIR}/first)
    file(RENAME ${BINARY_DIR}/first ${BINARY_DIR}/prefix)
endfunction()

# Makes a .deb of the Lumis that install_lumis has configured, unpacks it, and compiles and runs the first example with what
# pkg-config says of it there.
function(check_package)
    find_program(pkg_config pkg-config)
    find_program(dpkg_deb dpkg-deb)
    if(NOT pkg_config OR NOT dpkg_deb)
        return()
    endif()
    cmake_path(GET CMAKE_COMMAND PARENT_PATH programs)
    run(${programs}/cpack --config ${BINARY_DIR}/lumis/CPackConfig.cmake -B ${BINARY_DIR}/deb)
    file(GLOB package ${BINARY_DIR}/deb/liblumis-dev_*_all.deb)
    run(${dpkg_deb} -x ${package} ${BINARY_DIR}/unpacked)

    set(ENV{PKG_CONFIG_PATH} ${BINARY_DIR}/unpacked/usr/share/pkgconfig)
    execute_process(COMMAND ${pkg_config} --cflags lumis
        OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    separate_arguments(flags UNIX_COMMAND "${flags}")
    set(program ${BINARY_DIR}/by_pkg_config)
    run(${CXX_COMPILER} -std=c++20 ${flags} ${lumis}/examples/01_first_estimate.cpp -o ${program})
    check_first_estimate(${program})
endfunction()

# A folder that holds GLM and nothing else.
function(make_glm_folder)
    file(MAKE_DIRECTORY ${BINARY_DIR}/external)
    file(CREATE_LINK ${GLM_FOLDER}/glm ${BINARY_DIR}/external/glm SYMBOLIC)
endfunction()

file(REMOVE_RECURSE ${BINARY_DIR})
if(ROUTE STREQUAL "add_subdirectory")
    check_consumer(-D LUMIS_SOURCE_DIR=${lumis})
elseif(ROUTE STREQUAL "find_package")
    install_lumis()
    check_consumer(-D CMAKE_PREFIX_PATH=${BINARY_DIR}/prefix)
    check_package()
elseif(ROUTE STREQUAL "single_header")
    run(${PYTHON} ${lumis}/cmake/single_header.py ${BINARY_DIR}/single/lumis/lumis.hpp)
    check_consumer(-D LUMIS_SINGLE_HEADER_DIR=${BINARY_DIR}/single)
elseif(ROUTE STREQUAL "exported")
    make_glm_folder()
    # A repository of what stands here now, committed or not.
    set(repository ${BINARY_DIR}/repository)
    file(COPY ${lumis}/CMakeLists.txt ${lumis}/LICENSE ${lumis}/cmake ${lumis}/include DESTINATION ${repository})
    find_program(git git REQUIRED)
    run(${git} init --quiet --initial-branch main ${repository})
    run(${git} -C ${repository} add .)
    run(${git} -C ${repository} -c user.name=lumis -c user.email=lumis commit --quiet --message "Lumis")

    set(host ${BINARY_DIR}/host)
    list(APPEND options -D CMAKE_DISABLE_FIND_PACKAGE_glm=ON -D CMAKE_PREFIX_PATH=${BINARY_DIR}/prefix)
    run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/host -B ${host} ${options}
        -D LUMIS_REPOSITORY=file://${repository} -D GLM_FOLDER=${BINARY_DIR}/external)
    run(${CMAKE_COMMAND} --build ${host})
    run(${CMAKE_COMMAND} --install ${host} --prefix ${BINARY_DIR}/prefix)
    run(${CMAKE_COMMAND} -D INSTALLED_TOO=ON ${host})

    run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/user -B ${BINARY_DIR}/user ${options}
        -D LUMIS_SOURCE_DIR=${repository} -D LUMIS_GLM_DIR=${BINARY_DIR}/external)
    run(${CMAKE_COMMAND} --build ${BINARY_DIR}/user)
    run(${BINARY_DIR}/user/user)
elseif(ROUTE STREQUAL "glm")
    make_glm_folder()
    run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/glm -B ${BINARY_DIR}/glm
        -D LUMIS_SOURCE_DIR=${lumis} -D GLM_FOLDER=${BINARY_DIR}/external)
else()
    message(FATAL_ERROR "ROUTE is ${ROUTE}: it must be one of those that check.cmake names")
endif()
