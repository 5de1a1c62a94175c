# Installs the headers, a package that find_package(lumis) finds, and lumis.pc for pkg-config: nothing in them depends on the
# architecture, and all of it may be moved. The component lumis, so that a project that has Lumis in a subfolder may leave it out.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/lumis)
set(pkgconfig_dir ${CMAKE_INSTALL_DATADIR}/pkgconfig)

configure_package_config_file(cmake/lumis-config.cmake.in lumis-config.cmake
    INSTALL_DESTINATION ${package_dir}
    NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may break its users, so 0.2 does not stand in for 0.1.
write_basic_package_version_file(lumis-config-version.cmake
    COMPATIBILITY SameMinorVersion
    ARCH_INDEPENDENT)

# lumis.pc names the headers by where it is itself. It asks for glm.pc only where GLM comes with one.
set(root /prefix)  # of paths that are relative
cmake_path(ABSOLUTE_PATH pkgconfig_dir BASE_DIRECTORY ${root} OUTPUT_VARIABLE pc_dir)
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_INCLUDEDIR BASE_DIRECTORY ${root} OUTPUT_VARIABLE lumis_pc_include)
cmake_path(RELATIVE_PATH lumis_pc_include BASE_DIRECTORY ${pc_dir})
set(lumis_pc_requires)
find_program(LUMIS_PKG_CONFIG pkg-config DOC "Says whether GLM has a glm.pc")
mark_as_advanced(LUMIS_PKG_CONFIG)
if(LUMIS_PKG_CONFIG)
    execute_process(COMMAND ${LUMIS_PKG_CONFIG} --exists glm RESULT_VARIABLE status)
    if(status EQUAL 0)
        set(lumis_pc_requires "\nRequires: glm")
    endif()
endif()
configure_file(cmake/lumis.pc.in lumis.pc @ONLY)

install(DIRECTORY include/lumis TYPE INCLUDE COMPONENT lumis FILES_MATCHING PATTERN "*.hpp")
install(TARGETS lumis EXPORT lumis COMPONENT lumis)
# A host that exports a library from its own build folder needs Lumis exported from there as well.
export(EXPORT lumis NAMESPACE lumis:: FILE lumis-targets.cmake)
configure_file(cmake/lumis-glm.cmake lumis-glm.cmake COPYONLY)
install(EXPORT lumis NAMESPACE lumis:: FILE lumis-targets.cmake DESTINATION ${package_dir} COMPONENT lumis)
install(FILES
    ${PROJECT_BINARY_DIR}/lumis-config.cmake
    ${PROJECT_BINARY_DIR}/lumis-config-version.cmake
    cmake/lumis-glm.cmake
    DESTINATION ${package_dir} COMPONENT lumis)
install(FILES ${PROJECT_BINARY_DIR}/lumis.pc DESTINATION ${pkgconfig_dir} COMPONENT lumis)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lumis COMPONENT lumis)
