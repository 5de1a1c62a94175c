// What happens to arguments that no table can be built from. By default std::invalid_argument is thrown, with a message that
// names the index and the value; where exceptions are off, the message goes to stderr and the program is aborted.
//
// A host with a way of its own defines LUMIS_THROW(message) before the first include. `message` is a std::string; what is
// called must not return (throw, longjmp, end the thread or the program): if it does, the program is aborted.
//
//     [[noreturn]] void my_failure(const std::string& message);
//     #define LUMIS_THROW(message) my_failure(message)
//     #include <lumis/lumis.hpp>
#pragma once

#include "lumis/core/platform.hpp"

#include <cstdlib>
#include <string>

#ifndef LUMIS_THROW
#ifdef LUMIS_HAS_EXCEPTIONS
#include <stdexcept>
#define LUMIS_THROW(message) throw std::invalid_argument(message)
#else
#include <cstdio>
#define LUMIS_THROW(message) static_cast<void>(std::fprintf(stderr, "%s\n", (message).c_str()))
#endif
#endif

namespace lumis::LUMIS_ISA::detail {

// Every table's complaint goes through here.
[[noreturn]] inline void refuse(const std::string& message) {
    LUMIS_THROW(message);
    std::abort();
}

}  // namespace lumis::LUMIS_ISA::detail
