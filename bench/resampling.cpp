// A stream of 1024 weights that a reservoir takes in, reservoir/stream/<form>/<scalar>, and whole estimates of the direct light of
// a square, resampled from a number of candidates: resample/square_<candidates>/<form>/<scalar>.
#include "textbook/resampling.hpp"

#include "forms.hpp"
#include "subjects.hpp"
#include "textbook/lights.hpp"
#include <lumis/combine/resample.hpp>
#include <lumis/lumis.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace {

template <class T, class Reservoir>
void add_stream(const std::string& form) {
    add_form<T>("reservoir/stream/" + form, ready(Reservoir{}), lazily([] { return Uniforms<T>{few}; }),
                [](const auto& empty, const Uniforms<T>& u, std::size_t, Results<T>& out) {
                    auto kept = empty;
                    for (std::size_t i = 0; i < batch; ++i) {
                        one_at_a_time(i);
                        kept.add(i, u.x[i], u.y[i]);
                    }
                    if constexpr (requires { kept.item(); }) {
                        out.x[kept.item()] = 1;
                    } else {
                        out.x[kept.item] = 1;
                    }
                });
}

template <class T>
void add_all() {
    add_stream<T, lumis::Reservoir<std::size_t, T>>("single");
    add_stream<T, textbook::Reservoir<std::size_t, T>>("textbook");

    const lumis::Parallelogram<T> square{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}};
    const lumis::AreaLight<lumis::Parallelogram<T>> light{square, glm::vec<3, T>(T(0))};
    const textbook::ParallelogramByArea<T> book{square, glm::vec<3, T>(T(0))};
    const auto target = [](const glm::vec<3, T>& w) { return w.z > 0 ? w.z : T(0); };
    const auto f = [](const glm::vec<3, T>& w) { return w.z > 0 ? w.z * (1 + w.x * w.x) : T(0); };
    for (const int candidates : {1, 8, 32}) {
        const std::string name = "resample/square_" + std::to_string(candidates);
        const auto estimates = [=](auto estimate) {
            return [=](const auto& strategy, const Uniforms<T>& u, std::size_t, Results<T>& out) {
                Prepared<T> uniforms{u.x};
                for (std::size_t i = 0; i < batch; ++i) {
                    one_at_a_time(i);
                    out.x[i] = estimate(strategy, uniforms);
                }
            };
        };
        const auto uniforms = lazily([] { return Uniforms<T>{few}; });
        add_form<T>(name + "/single", ready(light), uniforms, estimates([=](const auto& strategy, auto& source) {
                        return lumis::resample(target, lumis::take(candidates, strategy)).estimate(f, source);
                    }));
        add_form<T>(name + "/textbook", ready(book), uniforms, estimates([=](const auto& strategy, auto& source) {
                        return textbook::resampled<T>(candidates, strategy, target, f, source);
                    }));
    }
}

const bool added = (add_all<float>(), add_all<double>(), true);

}  // namespace
