// A second translation unit with the same headers: one definition that is not inline, and the program does not link.
#include <lumis/lumis.hpp>
