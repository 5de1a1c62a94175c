// Runs every kernel at the edges of its domain, and says how wrong it is there at worst.
#include "cases.hpp"
#include "row.hpp"

#include <CLI/CLI.hpp>
#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace stability;

struct InScalar {
    Measured (*run)(Effort);
    double error_limit;
};

struct Case {
    const char* kernel;
    const char* swept;
    const char* reference;
    InScalar in_float, in_double;
};

// An error limit of 0 means exactly, or that the case measures none.
const Case cases[] = {
    {"uniforms",
     "engines of 16 to 64 bits, all bits set; hosts that return 1",
     "1/2",
     {uniforms_below_one<float>, 0},
     {uniforms_below_one<double>, 0}},
    {"AliasTable",
     "weights {1, 1e-8, 1}, 10 decades, zeros, the largest number; all 2^24 float uniforms",
     "its own sum and frequencies",
     {alias_table<float>, 0},
     {alias_table<double>, 0}},
    {"DiscreteTable",
     "the same weights",
     "its own sum and frequencies",
     {discrete_table<float>, 0},
     {discrete_table<double>, 0}},
    {"PiecewiseConstant1D",
     "the same weights",
     "its own sum and frequencies",
     {piecewise_constant<float>, 1e-6},
     {piecewise_constant<double>, 5e-15}},
    {"tables of 1e7",
     "both tables, a third of the weights 0",
     "sum of 1",
     {huge_tables<float>, 1e-12},
     {huge_tables<double>, 1e-12}},
    {"hemispheres",
     "uniforms at all corners; below the horizon",
     "quad",
     {hemispheres<float>, 1e-6},
     {hemispheres<double>, 5e-15}},
    {"HenyeyGreenstein",
     "g from -1 to 1, to 1e-6 of either end and 1e-30 of 0",
     "quad",
     {phase_functions<float>, 1e-6},
     {phase_functions<double>, 5e-15}},
    {"Ggx",
     "D, Lambda, G1, G2: alpha 1e-6 to 1e4, an axis 0, cosines to 1e-6",
     "quad",
     {ggx_terms<float>, 1e-6},
     {ggx_terms<double>, 5e-15}},
    {"GgxNdf", "alpha 1e-6 to 1e4, an axis 0", "quad", {ggx_normals<float>, 1e-6}, {ggx_normals<double>, 5e-15}},
    {"GgxVndf",
     "the same, cosines of wo from 1 to 1e-6; error times what wo.wm leaves of its terms",
     "quad",
     {ggx_visible_normals<float>, 1e-6},
     {ggx_visible_normals<double>, 5e-15}},
    {"GgxReflection", "the same", "quad", {ggx_reflection<float>, 1e-6}, {ggx_reflection<double>, 5e-15}},
    {"GgxBoundedReflection",
     "the same",
     "quad",
     {ggx_bounded_reflection<float>, 1e-6},
     {ggx_bounded_reflection<double>, 5e-15}},
    {"Fresnel",
     "eta 1 + 1e-6 to 100, and 1 over it, cosines to 1e-6, the critical angle; error times what eta^2 cos_t^2 leaves",
     "quad",
     {fresnel<float>, 1e-6},
     {fresnel<double>, 5e-15}},
    {"GgxDielectric",
     "eta 1.5, 1 / 2.4, 1 + 1e-2, 1 + 1e-6, alpha 1e-4 to 1, cosines of wo to 1e-6 on both sides; error times what "
     "sums leave",
     "quad",
     {ggx_dielectric<float>, 2e-6},
     {ggx_dielectric<double>, 1e-14}},
    {"GGX, nothing to draw",
     "wo on and below the horizon, NaN; alpha negative, too large, NaN; glass of no index",
     "",
     {ggx_nothing_to_draw<float>, 0},
     {ggx_nothing_to_draw<double>, 0}},
    {"GGX albedo",
     "cosines from 1 to 1e-6 at alpha 1; what falls below the horizon",
     "",
     {ggx_albedo<float>, 0},
     {ggx_albedo<double>, 0}},
    {"mirror, small light",
     "alpha 1e-3, light of 1e-4 sr, from centred to beyond the rim; weights sum to 1",
     "1",
     {mirror_against_small_light<float>, 1e-6},
     {mirror_against_small_light<double>, 5e-15}},
    {"sphere, cone",
     "half-angle 0.001 to 89 degrees, distance 1e-6 to 1e6",
     "quad",
     {sphere_cone<float>, 1e-5},
     {sphere_cone<double>, 1e-13}},
    {"sphere, near its surface",
     "half-angle 89 to 89.99 degrees",
     "quad",
     {sphere_near_surface<float>, 1e-5},
     {sphere_near_surface<double>, 1e-11}},
    {"sphere, far away",
     "centre 1e3 to 1e6 radii away, radius 1e-3 to 1e3",
     "quad",
     {sphere_far_away<float>, 1e-6},
     {sphere_far_away<double>, 5e-15}},
    {"sphere, inside",
     "centre to surface; radius 0, negative, infinite, NaN",
     "quad",
     {sphere_inside<float>, 1e-6},
     {sphere_inside<double>, 5e-15}},
    {"sphere, irradiance", "half-angle 1e-5 to 0.5", "", {sphere_irradiance<float>, 0}, {sphere_irradiance<double>, 0}},
    {"flat lights, slivers",
     "triangle, parallelogram, disk of width 1e-6 to 1",
     "quad",
     {flat_slivers<float>, 1e-5},
     {flat_slivers<double>, 1e-14}},
    {"flat lights, scale",
     "the scene at 1e-12 to 1e12",
     "quad",
     {flat_scales<float>, 1e-5},
     {flat_scales<double>, 1e-14}},
    {"flat lights, edge-on",
     "height over the plane 1e-6 to 1; error times sine",
     "quad",
     {flat_edge_on<float>, 1e-5},
     {flat_edge_on<double>, 1e-14}},
    {"flat lights, nothing",
     "in the plane, at a vertex, no area, at scales 1e-12 to 1e12",
     "",
     {flat_nothing_to_draw<float>, 0},
     {flat_nothing_to_draw<double>, 0}},
    {"flat lights, far origin",
     "vertices at 1 to 1e6",
     "quad",
     {flat_far_from_origin<float>, 1e-5},
     {flat_far_from_origin<double>, 1e-14}},
    {"spherical triangle",
     "1e-8 to 6.28 sr",
     "quad",
     {spherical_triangle<float>, 1e-5},
     {spherical_triangle<double>, 1e-14}},
    {"spherical rectangle",
     "1e-8 to 6.28 sr, and parallelograms",
     "quad",
     {spherical_rectangle<float>, 1e-5},
     {spherical_rectangle<double>, 1e-14}},
    {"polygons, edge close by",
     "heights of 1 to 1e-6, widths of 1 to 1e-3; beside, on and beyond an edge",
     "quad",
     {polygon_edges_close_by<float>, 1e-5},
     {polygon_edges_close_by<double>, 1e-5}},
    {"polygons by cosine",
     "cut by the horizon within 1e-6 of an end; heights and widths of 1 to 1e-6; 1e-8 sr",
     "",
     {polygons_by_cosine<float>, 0},
     {polygons_by_cosine<double>, 0}},
    {"UniformCone, Sun",
     "half-angle 1e-9 to pi; 0, negative, NaN",
     "quad",
     {cones<float>, 1e-6},
     {cones<double>, 5e-15}},
    {"environment map",
     "1 x 1, 1 x N, N x 1, black rows, a hot texel or pole row of 1e6, black",
     "mass of 1",
     {environment_shapes<float>, 1e-6},
     {environment_shapes<double>, 1e-14}},
    {"environment, compensated",
     "constant maps of 1e-30 to 1e30; a hot texel",
     "mass of 1",
     {environment_compensation<float>, 1e-6},
     {environment_compensation<double>, 1e-14}},
    {"environment, 1024 x 512",
     "frequency of each texel in the worst row against its mass",
     "enumeration",
     {environment_1k<float>, 0},
     {environment_1k<double>, 0}},
    {"environment, 4096 x 2048",
     "frequency of each texel in the worst row against its mass",
     "enumeration",
     {environment_4k<float>, 0},
     {environment_4k<double>, 0}},
    {"environment, 8192 x 4096",
     "frequency of each texel in the worst row against its mass",
     "enumeration",
     {environment_8k<float>, 0},
     {environment_8k<double>, 0}},
    {"environment, bad texels",
     "NaN, infinite, negative texels and wrong sizes are refused by name",
     "",
     {environment_bad_texels<float>, 0},
     {environment_bad_texels<double>, 0}},
    {"MIS weights",
     "densities 1e-38 to 1e38, counts 1 and 1e6, exponents 1 to 3",
     "quad",
     {mis_weights<float>, 1e-6},
     {mis_weights<double>, 5e-15}},
    {"MIS weights, many",
     "3 to 1000 techniques, densities up to 74 decades apart",
     "quad",
     {mis_weights_of_many<float>, 1e-5},
     {mis_weights_of_many<double>, 1e-14}},
    {"MIS weights, policy",
     "0 against 0, infinite, NaN; all densities times 2^-100 and 2^100",
     "unscaled",
     {mis_weights_policy<float>, 1e-6},
     {mis_weights_policy<double>, 5e-15}},
    {"optimal weights",
     "three densities 1e-30 to 1e30 whose equations have a condition of 27,000",
     "quad",
     {optimal_weights<float>, 1e-7},
     {optimal_weights<double>, 1e-12}},
    {"delta strategies",
     "mirror and lamp, alone, together, beside a smooth lobe; distance 1e-6 to 1e6",
     "closed form",
     {delta_strategies<float>, 1e-6},
     {delta_strategies<double>, 5e-15}},
    {"mixtures",
     "selection probability 1e-6 to 1 - 1e-6, GGX alpha 1e-3 to 1; nothing selected",
     "quad",
     {mixtures<float>, 1e-6},
     {mixtures<double>, 5e-15}},
    {"light sets",
     "1 to 1e5 lights, half of them dark; none with power",
     "quad",
     {light_sets<float>, 1e-5},
     {light_sets<double>, 1e-14}},
    {"light trees",
     "1 to 1e3 lights, sizes 1e-15 to 1e15; seen from outside, amid, and upon a light",
     "1",
     {light_trees<float>, 0},
     {light_trees<double>, 0}},
    {"MIS weights, pairwise",
     "densities 1e-30 to 1e30, counts 1, 2 and 6",
     "quad",
     {pairwise_weights<float>, 1e-6},
     {pairwise_weights<double>, 5e-15}},
    {"Reservoir, many",
     "5e7 weights of 0.1, then 5e7 of 0.3",
     "quad",
     {reservoir_of_many<float>, 1e-6},
     {reservoir_of_many<double>, 1e-8}},
    {"Reservoir, unlike",
     "two weights of 1e-30 to 1e30, merged, u from 0 to 1; a third of 0",
     "quad",
     {reservoir_of_unlike<float>, 1e-6},
     {reservoir_of_unlike<double>, 5e-15}},
    {"RunningMoments, many",
     "5e7 times 0.1, then 5e7 times 0.3",
     "quad",
     {accumulation_of_many<float>, 1e-6},
     {accumulation_of_many<double>, 1e-12}},
    {"RunningMoments, offset",
     "mean and variance, offset 1 to 1e6 (float), 1e9 (double); merged",
     "quad",
     {accumulation_with_offset<float>, 1e-6},
     {accumulation_with_offset<double>, 1e-6}},
    {"RunningMoments, broken",
     "NaN and infinity in every hundredth sample; one of 1e30",
     "quad",
     {accumulation_not_finite<float>, 1e-6},
     {accumulation_not_finite<double>, 1e-14}},
};

// What a case leaves out because its build does not know it, as an addition to what it sweeps.
std::string left_out_by(const Measured& measured) {
    std::string what = measured.leaves_out_not_finite() ? "; without NaN and infinity" : "";
    if (measured.leaves_out_subnormal()) what += "; without subnormal numbers";
    return what;
}

// A row that is still to be measured.
struct Task {
    const Case& what;
    const char* scalar;
    const InScalar& in_scalar;
};

std::vector<Task> tasks(const std::string& only) {
    std::vector<Task> result;
    for (const Case& what : cases) {
        if (std::string{what.kernel}.find(only) == std::string::npos) continue;
        result.push_back({what, "float", what.in_float});
        result.push_back({what, "double", what.in_double});
    }
    return result;
}

// CPU time of the calling thread.
double thread_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Row measure(const Task& task, Effort effort) {
    const double start = thread_seconds();
    const Measured measured = task.in_scalar.run(effort);
    return {task.what.kernel,
            task.what.swept + left_out_by(measured),
            task.scalar,
            task.what.reference,
            task.in_scalar.error_limit,
            measured,
            thread_seconds() - start};
}

// Rows are measured on all cores, and shown in order.
std::vector<Row> run_cases(Effort effort, const std::string& only, bool show) {
    using oneapi::tbb::filter_mode, oneapi::tbb::make_filter;
    const std::vector<Task> all = tasks(only);
    std::vector<Row> rows;
    if (show) print_heading();
    std::size_t next = 0;
    const auto take = [&](oneapi::tbb::flow_control& control) {
        if (next == all.size()) control.stop();
        return next++;
    };
    const auto measure_one = [&](std::size_t i) { return measure(all[i], effort); };
    const auto add = [&](const Row& row) {
        rows.push_back(row);
        if (show) print(row);
    };
    oneapi::tbb::parallel_pipeline(all.size() + 1,
                                   make_filter<void, std::size_t>(filter_mode::serial_in_order, take) &
                                       make_filter<std::size_t, Row>(filter_mode::parallel, measure_one) &
                                       make_filter<Row, void>(filter_mode::serial_in_order, add));
    return rows;
}

}  // namespace

int main(int argc, char** argv) {
    std::filesystem::path output;
    std::string only;
    bool markdown = false, allow_failures = false;
    Effort effort;
    CLI::App app{"Runs every kernel at the edges of its domain. Ends with 1 if a row of the table fails."};
    app.add_option("--output", output, "Folder for stability.json");
    app.add_option("--only", only, "Run the kernels whose name contains this");
    app.add_flag("--markdown", markdown, "Print the table as Markdown");
    app.add_flag("--allow-failures", allow_failures, "End with 0 even then: for pages that show what failed");
    app.add_flag("--quick", effort.quick, "Fewer samples, no enumerations: for builds with sanitizers");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        const std::vector<Row> rows = run_cases(effort, only, !markdown);
        if (rows.empty()) {
            std::cerr << "stability: no kernel is called '" << only << "'\n";
            return 2;
        }
        if (markdown) print_markdown(rows);
        if (!output.empty()) {
            std::filesystem::create_directories(output);
            write_json(output / "stability.json", rows, effort.quick);
        }
        const auto failed = std::ranges::count_if(rows, [](const Row& row) { return !row.passed(); });
        std::cerr << rows.size() << " rows, " << failed << " failed\n";
        return failed > 0 && !allow_failures ? 1 : 0;
    } catch (const std::exception& error) {
        std::cerr << "stability: " << error.what() << '\n';
        return 1;
    }
}
