# The warnings our own programs are built with. Linked privately, never through lumis::lumis: users choose their own.
# CMAKE_COMPILE_WARNING_AS_ERROR (the test presets set it) makes errors of them.
add_library(lumis_warnings INTERFACE)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(lumis_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow)
endif()
