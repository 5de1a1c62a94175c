# cpack -G DEB, in the build folder: a package of what is installed, for all architectures.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the Lumis authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_PACKAGE_NAME liblumis-dev)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libglm-dev)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS libboost-math-dev)  # for lumis/testing
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
include(CPack)
