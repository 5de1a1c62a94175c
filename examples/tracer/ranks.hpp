// The processes that render one image together: MPI starts them, on one machine or many, and carries what they tell each other.
// A program that is built without MPI has one rank.
#pragma once

#include "film/film.hpp"
#include "render_options.hpp"

namespace tracer {

// One object, which outlives all else that a rank does. Rank 0 is the root; the others hear from it alone.
class Ranks {
  public:
    // Takes the arguments meant for MPI away.
    Ranks(int& argc, char**& argv);
    // Tells all other ranks that their work is done, if this is the root.
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    [[nodiscard]] int rank() const { return rank_; }
    [[nodiscard]] int count() const { return count_; }

    // Called at the root. A task is the samples of a pass; one without samples ends the rank's work. A rank takes its next task
    // after it has sent the pass of the last one.
    void send_task(int rank, const SampleRange& task) const;
    // Whether the pass of a rank's task has been rendered, so that receive_pass need not wait.
    [[nodiscard]] bool has_pass(int rank) const;
    // Fills a film of the same size with that pass; returns the CPU seconds spent on it.
    double receive_pass(int rank, Film& film) const;

    // Called at the others.
    [[nodiscard]] SampleRange receive_task() const;
    void send_pass(const Film& film, double cpu_seconds) const;

    // Ends the processes of all ranks at once.
    [[noreturn]] void abort(int exit_code) const;

  private:
    int rank_ = 0, count_ = 1;
};

}  // namespace tracer
