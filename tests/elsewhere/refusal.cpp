// A table that cannot be built, without exceptions: `refusal default` prints the message and aborts; built with
// -DOWN_HANDLER, the host's own function gets it and ends the program with 3.
#ifdef OWN_HANDLER
#include <string>
[[noreturn]] void my_failure(const std::string& message);
#define LUMIS_THROW(message) my_failure(message)
#endif

#include <lumis/lumis.hpp>

#include <cstdio>
#include <cstdlib>
#include <vector>

#ifdef OWN_HANDLER
void my_failure(const std::string& message) {
    std::printf("handled: %s\n", message.c_str());
    std::fflush(stdout);
    std::_Exit(3);
}
#endif

int main() {
    const std::vector<float> weights{1, 2, -3};
    const lumis::AliasTable<float> table{weights};
    std::printf("not refused: %g\n", static_cast<double>(table.pdf(2)));
}
