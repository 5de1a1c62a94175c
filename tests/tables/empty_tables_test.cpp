// What a host's structs hold: types declared ahead of their definition, and default-constructed tables and maps, which are
// without weights, harmless, and assignable.
#include <lumis/fwd.hpp>

namespace {

// A host's header, which includes no more than that.
class Renderer {
  public:
    Renderer(const lumis::EnvironmentMap<float>& sky, const lumis::DiscreteTable<float>* powers)
        : sky_{sky}, powers_{powers} {}
    [[nodiscard]] float chance(const lumis::Frame<float>& frame, lumis::GgxReflection<float> bsdf) const;

  private:
    const lumis::EnvironmentMap<float>& sky_;
    const lumis::DiscreteTable<float>* powers_;
};

}  // namespace

#include "catch.hpp"
#include "copies.hpp"
#include "exceptions.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace {

struct Scene {  // what a host has
    lumis::EnvironmentMap<float> sky;
    lumis::AliasTable<float> powers;
};

template <class Table>
void check_nothing_drawn(const Table& table) {
    using T = typename Table::Scalar;
    CHECK(table.empty());
    if constexpr (requires { table.size(); }) {
        CHECK(table.size() == 0);
    } else {
        CHECK((table.width() == 0 && table.height() == 0));
    }
    CHECK(lumis::testing::draws_nothing(table));
    if constexpr (std::same_as<typename Table::Point, std::size_t>) {
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}, ~std::size_t{0}}) CHECK(table.pdf(i) == 0);
    } else if constexpr (std::floating_point<typename Table::Point>) {
        for (const T x : {T(-1), T(0), T(0.5), T(1), std::numeric_limits<T>::quiet_NaN()}) CHECK(table.pdf(x) == 0);
    } else {
        const auto x = table.sample(lumis::UniformsOf<Table>{T(0.3)}).value;
        CHECK(table.pdf(x) == 0);
    }
}

template <class Table>
Table made_of_six() {
    using T = std::conditional_t<std::same_as<Table, lumis::FineAliasTable>, float, typename Table::Scalar>;
    const std::vector<T> weights{1, 2, 3, 4, 5, 6};
    if constexpr (requires { Table{3, 2, weights}; }) {
        return Table{3, 2, weights};
    } else {
        return Table{weights};
    }
}

}  // namespace

TEMPLATE_TEST_CASE("a default-constructed table draws nothing, has no size, and may be assigned", "[tables]",
                   lumis::AliasTable<float>, lumis::AliasTable<double>, lumis::FineAliasTable,
                   lumis::DiscreteTable<float>, lumis::DiscreteTable<double>, lumis::PiecewiseConstant1D<float>,
                   lumis::PiecewiseConstant1D<double>, lumis::PiecewiseConstant2D<float>,
                   lumis::PiecewiseConstant2D<double>, lumis::EnvironmentMap<float>, lumis::EnvironmentMap<double>,
                   lumis::AliasEnvironmentMap<float>, lumis::AliasEnvironmentMap<double>) {
    TestType table;
    check_nothing_drawn(table);
    check_nothing_drawn(table.view());
    {
        const TestType copy = table;
        Copies copies;
        check_nothing_drawn(copy.view(copies));
    }
    const TestType full = made_of_six<TestType>();
    table = full;
    CHECK_FALSE(table.empty());
    const lumis::UniformsOf<TestType> u(typename TestType::Scalar(0.7));
    CHECK(table.sample(u).value == full.sample(u).value);
    CHECK(table.sample(u).pdf > 0);
    table = {};
    check_nothing_drawn(table);
    TestType moved = std::move(table);
    check_nothing_drawn(moved);
}

TEST_CASE("a default-constructed table raises no floating-point exceptions", "[exceptions]") {
    CHECK(exceptions_raised_by([] {
              const Scene scene;
              const lumis::PiecewiseConstant1D<float> line;
              const lumis::PiecewiseConstant2D<float> plane;
              for (const float u : {0.0f, 0.4f, 1.0f}) {
                  keep(scene.sky.sample({unknown(u), unknown(u)}));
                  keep(scene.sky.pdf(glm::vec3{unknown(0.6f), unknown(0.0f), unknown(0.8f)}));
                  keep(scene.sky.invert(glm::vec3{unknown(0.6f), unknown(0.0f), unknown(0.8f)}));
                  keep(scene.powers.sample(glm::vec1{unknown(u)}));
                  keep(line.sample(glm::vec1{unknown(u)}));
                  keep(line.invert(unknown(u)));
                  keep(plane.sample({unknown(u), unknown(u)}));
                  keep(plane.invert({unknown(u), unknown(u)}));
              }
          }) == 0);
}

float Renderer::chance(const lumis::Frame<float>& frame, lumis::GgxReflection<float> bsdf) const {
    return powers_->pdf(0) * sky_.pdf(frame.to_world(bsdf.sample({0.5f, 0.5f}).value));
}

TEST_CASE("types that a host's header declares are those that its source uses", "[fwd]") {
    const lumis::EnvironmentMap sky{2, 1, std::vector<float>{1, 1}};
    const lumis::DiscreteTable powers{std::vector<float>{1, 3}};
    const Renderer renderer{sky, &powers};
    const glm::vec3 wo{0, 0.6f, 0.8f};
    CHECK(renderer.chance(lumis::Frame{glm::vec3{0, 0, 1}}, {wo, 0.3f}) == Approx(0.25 / (4 * 3.14159265)));
}

TEST_CASE("a set of no lights takes a default-constructed table", "[light_set]") {
    using Light = lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle>;
    const lumis::AliasTable<float> none;
    const lumis::LightSet set{std::vector<Light>{}, none};
    CHECK(set.empty());
    CHECK(lumis::testing::draws_nothing(set));
    CHECK_THROWS((lumis::LightSet{std::vector<Light>{{{{0, 0, 2}, 1}, {0, 0, 0}}}, none}));
}
