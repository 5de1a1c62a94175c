// What every fuzzer shares: a check that ends the program, and numbers taken from the fuzzer's bytes.
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <span>

#define CHECK(condition) \
    (static_cast<bool>(condition) ? static_cast<void>(0) : fuzz::failed(#condition, __FILE__, __LINE__))

namespace fuzz {

[[noreturn]] inline void failed(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: failed: %s\n", file, line, condition);
    std::abort();
}

template <std::floating_point T>
[[nodiscard]] bool is_density(T pdf) {
    return pdf >= 0 && pdf <= std::numeric_limits<T>::max();
}

// Takes values off the front of the input; where it ends, zeros.
class Input {
  public:
    Input(const std::uint8_t* data, std::size_t size) : rest_{data, size} {}

    [[nodiscard]] std::size_t left() const { return rest_.size(); }

    // Any bits: NaN, infinity and denormals included.
    template <class T>
    [[nodiscard]] T bits() {
        T value{};
        const std::size_t size = rest_.size() < sizeof(T) ? rest_.size() : sizeof(T);
        if (size > 0) std::memcpy(&value, rest_.data(), size);
        rest_ = rest_.subspan(size);
        return value;
    }

    // A number of any magnitude, in two thirds of the cases one that a scene could hold. Spends 5 bytes on it.
    template <std::floating_point T>
    [[nodiscard]] T number() {
        const auto kind = bits<std::uint8_t>();
        const auto value = bits<std::uint32_t>();
        constexpr T odd[] = {T(0),
                             -T(0),
                             T(1),
                             T(-1),
                             std::numeric_limits<T>::denorm_min(),
                             std::numeric_limits<T>::min(),
                             std::numeric_limits<T>::max(),
                             std::numeric_limits<T>::lowest(),
                             std::numeric_limits<T>::infinity(),
                             -std::numeric_limits<T>::infinity(),
                             std::numeric_limits<T>::quiet_NaN()};
        const T signed_unit = static_cast<T>(static_cast<std::int32_t>(value)) / T(2147483648.0);
        switch (kind % 6) {
            case 0:
                return odd[value % std::size(odd)];
            case 1:
                return std::scalbn(signed_unit, static_cast<int>(kind) - 128);
            case 2: {
                // The exponent's whole range, the same way in both precisions.
                constexpr int range = 2 * std::numeric_limits<T>::max_exponent;
                const int exponent = static_cast<int>(value >> 8) % range - range / 2;
                return std::scalbn(signed_unit, exponent);
            }
            default:
                return signed_unit;
        }
    }

    // In [0, 1], both ends included.
    template <std::floating_point T>
    [[nodiscard]] T uniform() {
        const auto kind = bits<std::uint8_t>();
        const T u = static_cast<T>(bits<std::uint32_t>()) / T(4294967296.0);
        constexpr T below_one = T(1) - std::numeric_limits<T>::epsilon() / 2;
        constexpr T odd[] = {T(0), T(1), below_one, std::numeric_limits<T>::epsilon() / 2, T(0.5)};
        return kind % 4 == 0 ? odd[kind / 4 % std::size(odd)] : u;
    }

    template <class V>
    [[nodiscard]] V numbers() {
        V v;
        for (int i = 0; i < V::length(); ++i) v[i] = number<typename V::value_type>();
        return v;
    }

    template <class V>
    [[nodiscard]] V uniforms() {
        V v;
        for (int i = 0; i < V::length(); ++i) v[i] = uniform<typename V::value_type>();
        return v;
    }

  private:
    std::span<const std::uint8_t> rest_;
};

}  // namespace fuzz
