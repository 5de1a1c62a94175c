// Means and variances of long, offset and broken streams.
#include "cases.hpp"

namespace stability {

template <class T>
Measured accumulation_of_many(Effort effort) {
    Measured measured;
    const std::int64_t n = effort.of(100'000'000);
    const T low = T(0.1), high = T(0.3);
    lumis::RunningMoments<T> moments;
    T sum = 0;
    for (std::int64_t i = 0; i < n; ++i) {
        const T x = 2 * i < n ? low : high;
        moments.add(x);
        sum += x;
    }
    const std::int64_t lows = (n + 1) / 2;
    const Quad mean = (Quad{low} * lows + Quad{high} * (n - lows)) / n;
    measured.compare(moments.mean(), mean);
    measured.usual(sum / static_cast<T>(n), mean);
    measured.expect(moments.count() == static_cast<std::uint64_t>(n) && moments.rejected() == 0);
    return measured;
}

template <class T>
Measured accumulation_with_offset(Effort effort) {
    Measured measured;
    const std::int64_t n = effort.of(300'000);
    sweep(1, std::same_as<T, float> ? 1e6 : 1e9, 6, [&](double decade) {
        const T offset = static_cast<T>(std::round(decade));
        lumis::RunningMoments<T> moments, halves[2];
        Quad sum = 0, squares = 0;
        T usual_sum = 0, usual_squares = 0;
        for (std::int64_t i = 0; i < n; ++i) {
            const T x = offset + T(i * 7919 % 16) / 16;
            moments.add(x);
            halves[i % 2].add(x);
            sum += Quad{x};
            squares += Quad{x} * Quad{x};
            usual_sum += x;
            usual_squares += x * x;
        }
        halves[0].merge(halves[1]);
        const Quad mean = sum / n, variance = (squares - sum * mean) / (n - 1);
        for (const auto& m : {moments, halves[0]}) {
            measured.compare(m.mean(), mean);
            measured.compare(m.variance(), variance);
        }
        const T usual_mean = usual_sum / static_cast<T>(n);
        measured.usual((usual_squares - usual_sum * usual_mean) / static_cast<T>(n - 1), variance);
    });
    return measured;
}

template <class T>
Measured accumulation_not_finite(Effort) {
    Measured measured;
    constexpr T nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    for (const T broken : {nan, infinity, -infinity}) {
        if (measured.leaves_out<T>(broken)) continue;
        lumis::RunningMoments<T> moments, others;
        for (int i = 0; i < 1000; ++i) {
            moments.add(i % 100 == 0 ? broken : T(i % 2));
            others.add(T(i % 2));
        }
        moments.merge(others);
        measured.expect(moments.rejected() == 10 && moments.count() == 1990);
        measured.compare(moments.mean(), Quad{1000} / 1990);
    }
    // One value beyond all others is no reason to lose them.
    lumis::RunningMoments<T> moments;
    moments.add(T(1e30));
    for (int i = 0; i < 1000; ++i) moments.add(T(1));
    measured.compare(moments.mean(), (Quad{T(1e30)} + 1000) / 1001);
    measured.expect(is_finite(moments.variance()) && moments.rejected() == 0);
    return measured;
}

template Measured accumulation_of_many<float>(Effort);
template Measured accumulation_of_many<double>(Effort);
template Measured accumulation_with_offset<float>(Effort);
template Measured accumulation_with_offset<double>(Effort);
template Measured accumulation_not_finite<float>(Effort);
template Measured accumulation_not_finite<double>(Effort);

}  // namespace stability
