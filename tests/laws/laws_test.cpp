// Every law over every strategy, in float and double.
#include "catch.hpp"
#include "strategies.hpp"
#include <lumis/testing/batch.hpp>
#include <lumis/testing/laws.hpp>

#include <cstddef>
#include <type_traits>

namespace {

namespace laws = lumis::testing;

// A correct library fails one of the laws here with this probability. Seeds are fixed: it either does or does not.
// The family is larger than the number of subjects times scalars, and a test sees to that.
constexpr laws::Significance significance{0.01, 1500};

template <class... Lists>
std::size_t count(const std::tuple<Lists...>*) {
    return (Lists::template make<double>().size() + ...);
}

// A law over all subjects of a kind, in float and double.
template <class Subjects, class Law>
void check_each(Law law_of) {
    const auto check = [&](const auto& list) {
        for (const auto& subject : list) {
            const auto law = law_of(subject);
            INFO(subject.label << ": " << law.message);
            CHECK(law.passed);
        }
    };
    SECTION("float") {
        check(Subjects::template make<float>());
    }
    SECTION("double") {
        check(Subjects::template make<double>());
    }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("sample and pdf agree", "[laws]", Strategies) {
    check_each<TestType>([](const auto& subject) { return laws::agreement(subject.strategy, subject.agreement); });
}

TEMPLATE_LIST_TEST_CASE("the density covers the integrand", "[laws]", Strategies) {
    check_each<TestType>([](const auto& subject) {
        REQUIRE(subject.integrand);
        return laws::covers(subject.strategy, subject.integrand, subject.chart);
    });
}

TEMPLATE_LIST_TEST_CASE("a batch agrees with the single call", "[laws]", Strategies) {
    check_each<TestType>([](const auto& subject) {
        return laws::batch_agrees(subject.strategy, subject.agreement, subject.batch_distance);
    });
}

TEMPLATE_LIST_TEST_CASE("the density integrates to the probability that something is drawn", "[laws]", Strategies) {
    const auto check = [](const auto& list, double tolerance) {
        for (const auto& subject : list) {
            laws::IntegrationOptions options;
            options.probability = subject.probability;
            options.tolerance = tolerance + subject.blur;
            options.significance = significance;
            const auto law = laws::integrates(subject.strategy, subject.chart, options);
            INFO(subject.label << ": " << law.message);
            CHECK(law.passed);
        }
    };
    SECTION("float") {
        check(TestType::template make<float>(), laws::integration_tolerance<float>);
    }
    SECTION("double") {
        check(TestType::template make<double>(), laws::integration_tolerance<double>);
    }
}

// What is drawn in float is held against the density in double, whose support has sharper edges.
TEMPLATE_LIST_TEST_CASE("samples are distributed as the density says", "[laws]", Strategies) {
    const auto in_float = TestType::template make<float>();
    const auto in_double = TestType::template make<double>();
    for (std::size_t i = 0; i < in_double.size(); ++i) {
        const auto expected = laws::expectation(laws::density_of(in_double[i].strategy), in_double[i].chart);
        laws::ChiSquareOptions options;
        options.significance = significance;
        const auto check = [&](const auto& strategy, const char* scalar) {
            const auto law = laws::chi_square(strategy, expected, options);
            INFO(in_double[i].label << " in " << scalar << ": " << law.message);
            CHECK(law.passed);
        };
        check(in_float[i].strategy, "float");
        check(in_double[i].strategy, "double");
    }
}

TEST_CASE("the family of the statistical laws is as large as stated", "[laws]") {
    const std::size_t scalars = 2, statistical_laws = 2;
    CHECK(scalars * statistical_laws * count(static_cast<const Strategies*>(nullptr)) <= significance.family);
}
