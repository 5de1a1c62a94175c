// A second translation unit with the same headers: one definition that is not inline, and the program does not link.
#include <lumis/lumis.hpp>

static_assert(LUMIS_VERSION == LUMIS_VERSION_MAJOR * 10000 + LUMIS_VERSION_MINOR * 100 + LUMIS_VERSION_PATCH);
