# Writes the commit that SOURCE is at into HEADER, and whether files differ from it; nothing where there is no git.
execute_process(COMMAND git describe --always --dirty=\ with\ changes --exclude=* --abbrev=12
    WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT ${HEADER} CONTENT [[
// Made by bench/convergence/revision.cmake.
#pragma once

namespace convergence {

inline constexpr const char* revision = "${revision}";

}  // namespace convergence
]])
