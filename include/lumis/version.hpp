// The version, said once: CMake reads it from here.
#pragma once

#define LUMIS_VERSION_MAJOR 0
#define LUMIS_VERSION_MINOR 1
#define LUMIS_VERSION_PATCH 0

// To compare: 1.2.3 is 10203.
#define LUMIS_VERSION (LUMIS_VERSION_MAJOR * 10000 + LUMIS_VERSION_MINOR * 100 + LUMIS_VERSION_PATCH)
