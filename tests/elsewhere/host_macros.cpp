// Macros as hosts have them, of windows.h and of older renderers, before the first include. <lumis/lumis.hpp>,
// <lumis/batch/batch.hpp> and <lumis/qmc/sobol.hpp> set aside those that are names in them, and bring them back.
#if defined(OBJECTS)
#define min MINIMUM
#define max MAXIMUM
#define near
#define far
#define small char
#define real double
#define Real float
#define D 3
#elif defined(FUNCTIONS)
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define near(a) (a)
#define far(a) (a)
#define small(a) (a)
#define real(z) (z)[0]
#define Real(x) double(x)
#define D(x) (x)
#endif

#include <lumis/lumis.hpp>
#ifdef BATCH  // the single header holds them
#include <lumis/batch/batch.hpp>
#include <lumis/qmc/sobol.hpp>
#endif

#if defined(OBJECTS)
real near x = D;
Real far y = 2;
small c = 'c';
#elif defined(FUNCTIONS)
const double z[2] = {1, 2};
const double x = real(z) + Real(D(1)) + near(0) + far(0) + small(0);
#endif
