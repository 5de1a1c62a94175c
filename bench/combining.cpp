// A weight of two techniques, weight/<heuristic>_2/<form>/<scalar>, or of many, weight/<heuristic>_<techniques>/single/...,
// and a whole estimate of direct light at a point, estimate/direct_<model>/single/<scalar>. Those of optimal weights are of a
// round, into sums for one integral (optimal), for a new one every 16 rounds (optimal_16), or with given weights (optimal_given).
#include "forms.hpp"
#include "subjects.hpp"
#include "textbook/weights.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/combine/optimal.hpp>
#include <lumis/lumis.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace {

// Over twelve decades, `techniques` of them for each item. The book's squares must not overflow.
template <class T>
std::vector<T> random_densities(std::size_t techniques) {
    std::vector<T> densities = Uniforms<T>{techniques}.x;
    for (T& q : densities) q = std::pow(T(10), 12 * q - 6);
    return densities;
}

template <class T>
struct Densities {
    std::vector<T> own = random_densities<T>(1), other = Densities::reversed(own);

    static std::vector<T> reversed(const std::vector<T>& v) { return {v.rbegin(), v.rend()}; }
};

template <class T, class Heuristic, class Textbook>
void add_pair(const std::string& name, const Heuristic& heuristic, const Textbook& textbook) {
    const auto densities = lazily([] { return Densities<T>{}; });
    const auto each = [](auto weight) {
        return [=](const auto& rule, const Densities<T>& q, std::size_t, Results<T>& out) {
            const auto held = rule;
            for (std::size_t i = 0; i < batch; ++i) {
                one_at_a_time(i);
                out.weight[i] = weight(held, q.own[i], q.other[i]);
            }
        };
    };
    const std::string full = "weight/" + name + "_2/";
    add_form<T>(full + "single", ready(heuristic), densities,
                each([](const auto& h, T own, T other) { return lumis::mis_weight(h, own, other); }));
    add_form<T>(full + "textbook", ready(textbook), densities,
                each([](const auto& h, T own, T other) { return h(own, other); }));
    add_form<T>(full + "batch", ready(heuristic), densities,
                [](const auto& h, const Densities<T>& q, std::size_t, Results<T>& out) {
                    mis_weight_n(h, std::span<const T>{q.own}, std::span<const T>{q.other}, std::span<T>{out.weight});
                });
}

template <class T, class Heuristic>
void add_many(const std::string& name, const Heuristic& heuristic, std::size_t techniques) {
    add_form<T>("weight/" + name + "_" + std::to_string(techniques) + "/single", ready(heuristic),
                lazily([=] { return random_densities<T>(techniques); }),
                [=](const auto& h, const std::vector<T>& densities, std::size_t, Results<T>& out) {
                    for (std::size_t i = 0; i < batch; ++i) {
                        const std::span<const T> q{densities.data() + i * techniques, techniques};
                        out.weight[i] = lumis::mis_weight(h, i % techniques, q);
                    }
                });
}

// Diffuse reflection of a sphere light.
template <class T>
struct Reflectance {
    lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> light;
    T operator()(const lumis::Direction<T>& w) const { return w.z > 0 && light.pdf(w) > 0 ? w.z : T(0); }
};

template <class T, class Best>
void add_optimal(const Best& fresh, const Reflectance<T>& f) {
    const auto uniforms = lazily([] { return Uniforms<T>{few}; });
    const std::string name = "estimate/direct_optimal";
    const auto add_every = [=](const std::string& full, std::size_t rounds) {
        add_form<T>(full + "/single", ready(fresh), uniforms,
                    [=](const Best& start, const Uniforms<T>& u, std::size_t, Results<T>& out) {
                        Prepared<T> source{u.x};
                        for (std::size_t i = 0; i < batch; i += rounds) {
                            Best best = start;
                            for (std::size_t round = 0; round < rounds; ++round) best.add(f, source);
                            out.x[i] = best.estimate();
                        }
                    });
    };
    add_every(name, batch);
    add_every(name + "_16", 16);
    add_form<T>(name + "_given/single", ready(fresh), uniforms,
                [=](const Best& start, const Uniforms<T>& u, std::size_t, Results<T>& out) {
                    Prepared<T> source{u.x};
                    const typename Best::Weights alpha{0.1, 0.2};
                    const auto& techniques = start.techniques();
                    for (T& result : out.x) result = static_cast<T>(techniques.round(f, source).estimate(alpha));
                });
}

template <class T>
void add_all() {
    add_pair<T>("balance", lumis::BalanceHeuristic{}, textbook::BalanceHeuristic{});
    add_pair<T>("power", lumis::PowerHeuristic{}, textbook::PowerHeuristic{});
    for (const std::size_t techniques : {8u, 256u}) {
        add_many<T>("balance", lumis::BalanceHeuristic{}, techniques);
        add_many<T>("power", lumis::PowerHeuristic{}, techniques);
    }

    const Scene<T> scene;
    const lumis::CosineHemisphere<T> bsdf;
    const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> light{scene.sphere, scene.origin};
    const auto add = [&](const std::string& model, const auto& estimator) {
        add_form<T>("estimate/direct_" + model + "/single", ready(estimator), lazily([] { return Uniforms<T>{few}; }),
                    [=](const auto& direct, const Uniforms<T>& u, std::size_t, Results<T>& out) {
                        Prepared<T> uniforms{u.x};
                        for (T& result : out.x) result = direct.estimate(Reflectance<T>{light}, uniforms);
                    });
    };
    using namespace lumis;
    add("light", multi_sample(PowerHeuristic{}, take(1, light)));
    add("average", multi_sample(EqualWeights{}, take(1, bsdf), take(1, light)));
    add("balance", multi_sample(BalanceHeuristic{}, take(1, bsdf), take(1, light)));
    add("power", multi_sample(PowerHeuristic{}, take(1, bsdf), take(1, light)));
    add("one_sample", one_sample(BalanceHeuristic{}, choose(0.5, bsdf), choose(0.5, light)));
    add_optimal<T>(optimal(take(1, bsdf), take(1, light)), Reflectance<T>{light});
}

const bool added = (add_all<float>(), add_all<double>(), true);

}  // namespace
