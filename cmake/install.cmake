# Installs the headers and a package that find_package(lumis) finds: nothing in it depends on the architecture.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/lumis)

configure_package_config_file(cmake/lumis-config.cmake.in lumis-config.cmake
    INSTALL_DESTINATION ${package_dir}
    NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may break its users, so 0.2 does not stand in for 0.1.
write_basic_package_version_file(lumis-config-version.cmake
    COMPATIBILITY SameMinorVersion
    ARCH_INDEPENDENT)

install(DIRECTORY include/lumis TYPE INCLUDE FILES_MATCHING PATTERN "*.hpp")
install(TARGETS lumis EXPORT lumis)
install(EXPORT lumis NAMESPACE lumis:: FILE lumis-targets.cmake DESTINATION ${package_dir})
install(FILES
    ${PROJECT_BINARY_DIR}/lumis-config.cmake
    ${PROJECT_BINARY_DIR}/lumis-config-version.cmake
    DESTINATION ${package_dir})
install(FILES LICENSE TYPE DOC)
