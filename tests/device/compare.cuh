// What is computed on the device is what the host computes, to a few units in the last place. Products are not fused into
// sums (nvcc -fmad=false): the host fuses none either.
#pragma once

#include <lumis/core/platform.hpp>

#include <cuda_runtime.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace device {

// What a test exits with where it cannot run.
inline constexpr int skipped = 77;

inline void require(cudaError_t status) {
    if (status == cudaSuccess) return;
    std::printf("CUDA: %s\n", cudaGetErrorString(status));
    std::exit(1);
}

inline bool is_present() {
    int devices = 0;
    const bool present = cudaGetDeviceCount(&devices) == cudaSuccess && devices > 0;
    if (!present) std::puts("There is no CUDA device: nothing is run, nor compared.");
    return present;
}

template <class T>
class Array {
  public:
    explicit Array(std::size_t size) : size_{size} {
        void* memory = nullptr;
        require(cudaMalloc(&memory, size * sizeof(T)));
        data_.reset(static_cast<T*>(memory));
    }

    [[nodiscard]] T* data() const { return data_.get(); }

    // Waits for what is being computed.
    [[nodiscard]] std::vector<T> values() const {
        std::vector<T> result(size_);
        require(cudaGetLastError());
        require(cudaMemcpy(result.data(), data_.get(), size_ * sizeof(T), cudaMemcpyDeviceToHost));
        return result;
    }

  private:
    struct Free {
        void operator()(T* memory) const { cudaFree(memory); }
    };
    std::size_t size_;
    std::unique_ptr<T, Free> data_;
};

// Where a table's view finds its arrays on the device: map.view(copies). They live as long as this.
class Copies {
  public:
    template <class T>
    std::span<const T> operator()(std::span<const T> array) {
        const Array<std::byte>& copy = arrays_.emplace_back(array.size_bytes());
        require(cudaMemcpy(copy.data(), array.data(), array.size_bytes(), cudaMemcpyHostToDevice));
        return {reinterpret_cast<const T*>(copy.data()), array.size()};
    }

  private:
    std::vector<Array<std::byte>> arrays_;
};

// Relative errors of up to this are rounding: CUDA's own functions (pow, exp) are off by a few units in the last place.
inline constexpr float tolerance = 32 * std::numeric_limits<float>::epsilon();

inline bool agree(const char* what, const std::vector<float>& host, const std::vector<float>& device) {
    std::size_t wrong = 0;
    float worst = 0;
    for (std::size_t i = 0; i < host.size(); ++i) {
        const float a = host[i], b = device[i];
        const float error = a == b ? 0 : std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-3f});
        worst = error <= worst ? worst : error;
        wrong += !(error <= tolerance);
    }
    std::printf("%-28s %6zu numbers, %4zu beyond tolerance, worst %.1f epsilon\n", what, host.size(), wrong,
                static_cast<double>(worst / std::numeric_limits<float>::epsilon()));
    return wrong == 0;
}

// A probe computes Probe::size numbers from an index, as a function of the host and of the device.
template <class Probe>
__global__ void run(Probe probe, float* out, unsigned count) {
    const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < count) probe(i, out + std::size_t{i} * Probe::size);
}

// What `here` computes with views of the host's tables is what `there` computes with views of copies.
template <class Probe>
bool agrees(const char* what, const Probe& here, const Probe& there) {
    static_assert(std::is_trivially_copyable_v<Probe>);
    constexpr unsigned count = 4096, block = 128;
    std::vector<float> on_host(count * Probe::size);
    for (unsigned i = 0; i < count; ++i) here(i, &on_host[i * Probe::size]);
    Array<float> on_device{on_host.size()};
    run<<<count / block, block>>>(there, on_device.data(), count);
    return agree(what, on_host, on_device.values());
}

}  // namespace device
