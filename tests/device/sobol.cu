// Sobol points are the same on a CUDA device as on the host.
#include "compare.cuh"
#include <lumis/lumis.hpp>
#include <lumis/qmc/sobol.hpp>

namespace {

// Two sets, and one that follows a start.
struct Points {
    static constexpr int size = 9;

    LUMIS_HD void operator()(unsigned index, float* out) const {
        lumis::Sobol<float> points{index % 7, index * 0x01234567u};
        const auto a = points.next<3>(), b = points.next<3>();
        points.start(index, index);
        const auto c = points.next<3>();
        for (int i = 0; i < 3; ++i) {
            out[i] = a[i];
            out[3 + i] = b[i];
            out[6 + i] = c[i];
        }
    }
};

}  // namespace

int main() {
    if (!device::is_present()) return device::skipped;
    return device::agrees("sobol points", Points{}, Points{}) ? 0 : 1;
}
