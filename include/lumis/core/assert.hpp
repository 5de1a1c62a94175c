// What the library checks in debug builds. Define LUMIS_ASSERT before the first include to route it into a host's own
// assertion; by default it is the standard assert and vanishes with NDEBUG.
#pragma once

#ifndef LUMIS_ASSERT
#include <cassert>
#define LUMIS_ASSERT(condition) assert(condition)
#endif
