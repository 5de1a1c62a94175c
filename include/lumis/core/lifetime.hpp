// Marks a parameter that a result refers to, so that clang++ warns where the result outlives it: an estimator over a local
// EnvironmentMap that is returned from its function, for instance. Other compilers have no such attribute.
#pragma once

#if defined(__has_cpp_attribute) && __has_cpp_attribute(clang::lifetimebound)
#define LUMIS_LIFETIME_BOUND [[clang::lifetimebound]]
#else
#define LUMIS_LIFETIME_BOUND
#endif
