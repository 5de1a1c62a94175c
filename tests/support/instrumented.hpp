// Strategies and sources that keep count of what is asked of them.
#pragma once

#include <lumis/core/strategy.hpp>
#include <lumis/core/uniforms.hpp>

#include <cstddef>
#include <random>
#include <span>
#include <utility>

struct Calls {
    int sample = 0, pdf = 0;
};

// Behaves as S.
template <lumis::Strategy S>
struct Instrumented {
    using Scalar = typename S::Scalar;
    using Point = typename S::Point;
    using Measure = typename S::Measure;
    static constexpr int dimensions = S::dimensions;
    static constexpr bool is_delta = lumis::DeltaStrategy<S>;

    S strategy;
    Calls* calls;

    [[nodiscard]] auto sample(lumis::UniformsOf<S> u) const noexcept {
        ++calls->sample;
        return strategy.sample(u);
    }
    [[nodiscard]] Scalar pdf(const Point& x) const noexcept {
        ++calls->pdf;
        return strategy.pdf(x);
    }
};

template <class S>
Instrumented(S, Calls*) -> Instrumented<S>;

// As a strategy that owns a table: it has a destructor, and it tells when it is copied or moved.
template <lumis::Strategy S>
struct Owning : S {
    struct Log {
        int copies = 0, moves = 0;
    };

    Owning(const S& strategy, Log& log_of_all) : S{strategy}, log{&log_of_all} {}
    Owning(const Owning& other) : S{other}, log{other.log} { ++log->copies; }
    Owning(Owning&& other) noexcept : S{std::move(other)}, log{other.log} { ++log->moves; }
    ~Owning() {}
    Owning& operator=(const Owning&) = delete;

    Log* log;
};

template <class T>
struct CountingUniforms {
    lumis::Uniforms<std::mt19937_64, T> source{std::mt19937_64{1}};
    int spent = 0;

    template <int N>
    [[nodiscard]] glm::vec<N, T> next() {
        spent += N;
        return source.template next<N>();
    }
};

// A heuristic that cannot be asked: it compiles only where no weight is needed.
struct Unasked {
    template <class T>
    T operator()(std::size_t own, std::span<const T> densities) const = delete;
};
