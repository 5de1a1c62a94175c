# cmake -D ROUTE=<add_subdirectory, find_package or single_header> -D BINARY_DIR=<folder of its own>
#       [-D GENERATOR=<generator>] [-D CXX_COMPILER=<compiler>] [-D CXX_FLAGS=<flags>] [-D glm_DIR=<GLM's package>]
#       [-D PYTHON=<python3>] -P check.cmake
# Builds and runs the project beside this file from nothing, so that no header of an earlier install is found.
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
if(glm_DIR)
    list(APPEND options -D glm_DIR=${glm_DIR})
endif()

function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${BINARY_DIR})
if(ROUTE STREQUAL "add_subdirectory")
    set(where -D LUMIS_SOURCE_DIR=${lumis})
elseif(ROUTE STREQUAL "find_package")
    run(${CMAKE_COMMAND} -S ${lumis} -B ${BINARY_DIR}/lumis ${options})
    run(${CMAKE_COMMAND} --install ${BINARY_DIR}/lumis --prefix ${BINARY_DIR}/prefix)
    set(where -D CMAKE_PREFIX_PATH=${BINARY_DIR}/prefix)
elseif(ROUTE STREQUAL "single_header")
    run(${PYTHON} ${lumis}/cmake/single_header.py ${BINARY_DIR}/single/lumis/lumis.hpp)
    set(where -D LUMIS_SINGLE_HEADER_DIR=${BINARY_DIR}/single)
else()
    message(FATAL_ERROR "ROUTE is ${ROUTE}: it must be add_subdirectory, find_package or single_header")
endif()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${BINARY_DIR}/consumer ${options} ${where})
run(${CMAKE_COMMAND} --build ${BINARY_DIR}/consumer)
run(${CMAKE_COMMAND}
    -D PROGRAM=${BINARY_DIR}/consumer/consumer
    -D EXPECTED=${lumis}/examples/01_first_estimate.txt
    -P ${lumis}/cmake/compare_output.cmake)
