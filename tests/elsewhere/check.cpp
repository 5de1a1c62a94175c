// A program that needs no framework, for machines that have none: strategies keep two laws, tables refuse what they must.
// Prints what fails, and how many checks passed.
#include <lumis/batch/batch.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/batch.hpp>
#include <lumis/testing/laws.hpp>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

int passed = 0, failed = 0;

void check(bool holds, const std::string& what) {
    holds ? ++passed : ++failed;
    if (!holds) std::printf("failed: %s\n", what.c_str());
}

template <class S>
void check_strategy(const S& strategy, const char* name) {
    const auto agreement = lumis::testing::agreement(strategy);
    check(agreement.passed, std::string(name) + ": " + agreement.message);
    // In units in the last place: products are fused into sums in single calls and not in lanes, or the other way round.
    const auto batch = lumis::testing::batch_agrees(strategy, {}, 6);
    check(batch.passed, std::string(name) + ": " + batch.message);
}

template <class T>
void check_strategies() {
    using Vector = glm::vec<3, T>;
    const Vector wo{T(0.6), T(0), T(0.8)}, point{0};
    check_strategy(lumis::UniformSphere<T>{}, "sphere");
    check_strategy(lumis::CosineHemisphere<T>{}, "cosine");
    check_strategy(lumis::GgxReflection<T>{wo, glm::vec<2, T>{T(0.3), T(0.2)}}, "GGX");
    check_strategy(lumis::AreaLight<lumis::Parallelogram<T>>{{{-1, -1, 2}, {1, 0, 0}, {0, 1, 0}}, point}, "square");
    check_strategy(lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{{{1, 1, 3}, T(0.5)}, point}, "sphere light");
    check_strategy(lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>{{{1, 1, 3}, {2, 1, 3}, {1, 2, 3}}, point},
                   "triangle");
    std::vector<T> luminance(32 * 16);
    for (std::size_t i = 0; i < luminance.size(); ++i) luminance[i] = static_cast<T>(i % 7);
    check_strategy(lumis::EnvironmentMap<T>{32, 16, luminance}, "environment map");
}

#ifdef LUMIS_HAS_EXCEPTIONS
template <class Make>
void check_refused(Make make, const char* what) {
    bool refused = false;
    try {
        make();
    } catch (const std::invalid_argument&) {
        refused = true;
    }
    check(refused, what);
}

void check_refusals() {
    check_refused([] { lumis::AliasTable<float>{std::vector<float>{1, -1}}; }, "a negative weight");
    // In 32 bits 65536 x 65536 is 0, the number of values that there are.
    check_refused([] { lumis::EnvironmentMap<float>{65536, 65536, {}}; }, "a map larger than memory");
    check_refused([] { lumis::PiecewiseConstant2D<double>{1 << 17, 1 << 15, {}}; }, "a table larger than memory");
}
#endif

}  // namespace

int main() {
    check_strategies<float>();
    check_strategies<double>();
#ifdef LUMIS_HAS_EXCEPTIONS
    check_refusals();
#endif
    std::printf("%d passed, %d failed; %u lanes of float\n", passed, failed,
                static_cast<unsigned>(lumis::NativeLanes<float>::size));
    return failed == 0 ? 0 : 1;
}
