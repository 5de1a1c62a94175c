// Ranks that are processes of MPI. An error within MPI ends all of them with MPI's own message.
#include "ranks.hpp"

#include <mpi.h>

#include <chrono>
#include <cstdlib>
#include <thread>
#include <type_traits>

namespace tracer {

namespace {

// What a message holds.
enum Tag { of_task, of_cpu_seconds, of_pixels };

static_assert(std::is_trivially_copyable_v<SampleRange> && std::is_trivially_copyable_v<Pixel>);

bool has_message(int rank, Tag tag) {
    int is_there = 0;
    MPI_Iprobe(rank, tag, MPI_COMM_WORLD, &is_there, MPI_STATUS_IGNORE);
    return is_there != 0;
}

// MPI itself would wait in a loop that keeps a core busy.
void await(int rank, Tag tag) {
    while (!has_message(rank, tag)) std::this_thread::sleep_for(std::chrono::microseconds{200});
}

// A pixel as it is in memory; a count of bytes would not fit an int.
class PixelType {
  public:
    PixelType() {
        MPI_Type_contiguous(sizeof(Pixel), MPI_BYTE, &type_);
        MPI_Type_commit(&type_);
    }
    PixelType(const PixelType&) = delete;
    PixelType& operator=(const PixelType&) = delete;
    ~PixelType() { MPI_Type_free(&type_); }
    [[nodiscard]] MPI_Datatype get() const { return type_; }

  private:
    MPI_Datatype type_{};
};

}  // namespace

Ranks::Ranks(int& argc, char**& argv) {
    int given = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Ranks::~Ranks() {
    for (int rank = 1; rank_ == 0 && rank < count_; ++rank) send_task(rank, {});
    MPI_Finalize();
}

void Ranks::send_task(int rank, const SampleRange& task) const {
    MPI_Send(&task, sizeof(task), MPI_BYTE, rank, of_task, MPI_COMM_WORLD);
}

SampleRange Ranks::receive_task() const {
    SampleRange task{};
    await(0, of_task);
    MPI_Recv(&task, sizeof(task), MPI_BYTE, 0, of_task, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return task;
}

void Ranks::send_pass(const Film& film, double cpu_seconds) const {
    const PixelType pixel;
    MPI_Send(&cpu_seconds, 1, MPI_DOUBLE, 0, of_cpu_seconds, MPI_COMM_WORLD);
    MPI_Send(film.pixels.data(), static_cast<int>(film.pixels.size()), pixel.get(), 0, of_pixels, MPI_COMM_WORLD);
}

bool Ranks::has_pass(int rank) const {
    return has_message(rank, of_cpu_seconds);
}

double Ranks::receive_pass(int rank, Film& film) const {
    const PixelType pixel;
    double cpu_seconds = 0;
    await(rank, of_cpu_seconds);
    MPI_Recv(&cpu_seconds, 1, MPI_DOUBLE, rank, of_cpu_seconds, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    MPI_Recv(film.pixels.data(), static_cast<int>(film.pixels.size()), pixel.get(), rank, of_pixels, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return cpu_seconds;
}

void Ranks::abort(int exit_code) const {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();
}

}  // namespace tracer
