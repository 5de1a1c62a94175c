// The one rank of a program that is built without MPI: the root, who has nobody to talk to.
#include "ranks.hpp"

#include <cstdlib>

namespace tracer {

Ranks::Ranks(int&, char**&) {}
Ranks::~Ranks() = default;

void Ranks::abort(int exit_code) const {
    std::exit(exit_code);
}

// There is no rank to call these.
void Ranks::send_task(int, const SampleRange&) const {
    abort(1);
}
bool Ranks::has_pass(int) const {
    abort(1);
}
double Ranks::receive_pass(int, Film&) const {
    abort(1);
}
SampleRange Ranks::receive_task() const {
    abort(1);
}
void Ranks::send_pass(const Film&, double) const {
    abort(1);
}

}  // namespace tracer
