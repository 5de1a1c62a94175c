// tinyexr compiled once more, so that the fuzzer sees into it; the library that the tracer links has no sanitizers.
#define TINYEXR_IMPLEMENTATION
#include <tinyexr.h>
