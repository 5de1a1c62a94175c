include(CMakeFindDependencyMacro)
find_dependency(lumis)
include(${CMAKE_CURRENT_LIST_DIR}/renderer-targets.cmake)
