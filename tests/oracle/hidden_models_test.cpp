/// \file
/// Chains of real models in fixed random positions: what is left out as hidden changes no solid,
/// and neither do threads or preparation a byte. Surfaces are compared before rounding, as rational
/// numbers. Without TREEFORM_MODELS_DIR nothing is checked.
///
/// Each closed model of TRUTH.csv with at most TREEFORM_STRESS_FACES faces (default 5000) begins
/// TREEFORM_STRESS_TIMES chains (default 1) of 3 to 5.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/both_ways.hpp>
#include <support/exact_chain.hpp>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/settings.hpp>
#include <support/soups.hpp>
#include <support/truth.hpp>
#include <support/was_mended.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace {

struct named_mesh {
    std::string name;
    tf::mesh mesh;
};

/// The model with the middle of its box at the origin, and a box of size 1 at most.
tf::mesh centered(tf::mesh mesh) {
    const tf::box3 box = tf::bounding_box(mesh.points).value();
    tf::point3 middle;
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        middle[k] = -0.5 * (box.min[k] + box.max[k]);
        size = std::max(size, box.max[k] - box.min[k]);
    }
    return test::scaled(test::moved(std::move(mesh), middle), 1.0 / size);
}

std::vector<named_mesh> closed_models(const std::filesystem::path& folder) {
    // Larger ones take a while as rational numbers.
    const auto most_triangles =
        static_cast<std::int64_t>(test::setting("TREEFORM_STRESS_FACES", 5'000));
    std::vector<named_mesh> models;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH.csv")) {
        if (row.text("precision") == "f32" || row.text("status") != "ok" ||
            row.text("closed") != "yes" || row.number("triangles") > most_triangles)
            continue;
        const std::string file = row.text("file");
        models.push_back({file, centered(tf::join_equal_points(tf::read(folder / file).mesh))});
    }
    return models;
}

/// Each next to the one before, or through it, or in it.
std::vector<tf::mesh> chain_of(const std::vector<named_mesh>& models, std::size_t first,
                               test::random& source, std::string& names) {
    std::vector<tf::mesh> chain;
    tf::point3 at;
    const std::size_t count = 3 + source.below(3);
    for (std::size_t k = 0; k < count; ++k) {
        const named_mesh& model = models[k == 0 ? first : source.below(models.size())];
        names += " " + model.name;
        const double size = source.below(3) == 0 ? source.in(0.1, 0.4) : source.in(0.7, 1.3);
        tf::mesh placed =
            test::turned(test::scaled(model.mesh, size), {source.in(-1, 1), source.in(-1, 1), 1.0},
                         source.in(0, 6.3));
        chain.push_back(test::moved(std::move(placed), at));
        for (std::size_t i = 0; i < 3; ++i) at[i] += source.in(-0.3, 0.3);
        if (source.below(8) == 0) chain.back() = test::inside_out(chain.back());
    }
    return chain;
}

std::string formula_of(std::size_t operands, test::random& source) {
    constexpr std::array<const char*, 4> kinds{"+", "-", "+-", "+-*^"};
    const std::string operations = kinds[source.below(kinds.size())];
    std::string result = "a";
    for (std::size_t k = 1; k < operands; ++k) {
        result = "(" + result + ")";
        result += operations[source.below(operations.size())];
        result += static_cast<char>('a' + k);
    }
    return result;
}

void check_same_bytes(const tf::boolean_result& result, const tf::boolean_result& again) {
    CHECK(again.mesh == result.mesh);
    CHECK(again.face_source == result.face_source);
    CHECK(again.vertex_source == result.vertex_source);
    CHECK(again.certificate.status == result.certificate.status);
}

struct chain_counts {
    int chains = 0, open = 0, shortened = 0;
    std::size_t left_out = 0;
};

void check_chain(const std::vector<tf::mesh>& chain, test::random& source, chain_counts& sums) {
    const std::string formula = formula_of(chain.size(), source);
    CAPTURE(formula);
    const tf::boolean_expression expression(formula, chain.size());
    const auto rule = static_cast<tf::fill_rule>(source.below(3));
    const std::vector<tf::mesh_view> views(chain.begin(), chain.end());
    const tf::boolean_result result = tf::boolean(views, expression, {.fill_rule = rule});
    ++sums.chains;
    if (result.certificate.status == tf::status::open_input) {
        ++sums.open;
        return;
    }
    sums.shortened += result.statistics.skipped_faces > 0 ? 1 : 0;
    for (const unsigned threads : {1U, 5U}) {
        const tf::thread_scope some(threads);
        check_same_bytes(result, tf::boolean(views, expression, {.fill_rule = rule}));
    }
    std::vector<tf::prepared_mesh> prepared;
    for (const tf::mesh& mesh : chain) prepared.push_back(tf::prepared_mesh::borrow(mesh));
    const std::vector<tf::mesh_ref> operands(prepared.begin(), prepared.end());
    check_same_bytes(result, tf::boolean(operands, expression, {.fill_rule = rule}));

    test::exact_numbers numbers;
    const test::exact_chain all = test::surface_of_all(chain, expression, rule, numbers);
    tf::detail::boolean::division_limits fine;
    fine.faces_not_halved = 2;
    fine.few_components = 0;
    for (const auto& limits : {tf::detail::boolean::division_limits{}, fine}) {
        const auto some = test::surface_of_undecided(chain, expression, rule, limits, numbers);
        CHECK(test::is_same_surface(all, some.chain, numbers));
        sums.left_out += some.left_out;
    }
    if (result.certificate && result.certificate.max_displacement == 0.0 &&
        !test::was_mended(result.statistics))
        CHECK(test::is_same_surface(all, test::chain_of(result.mesh, numbers), numbers));
}

}  // namespace

TEST_CASE("hidden models: chains of real models are the same solids with hidden faces left out") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    const std::vector<named_mesh> models = closed_models(folder);
    REQUIRE(models.size() > 10);
    test::random seeds(test::stress_seed());
    chain_counts sums;
    for (std::size_t first = 0; first < models.size(); ++first)
        for (std::uint64_t i = 0; i < test::stress_count(1); ++i) {
            test::random source(seeds.bits());
            std::string names;
            const std::vector<tf::mesh> chain = chain_of(models, first, source, names);
            CAPTURE(names);
            check_chain(chain, source, sums);
        }
    MESSAGE(sums.chains << " chains, " << sums.open << " of them open; by boolean with faces left "
                        << "out " << sums.shortened << "; faces left out " << sums.left_out);
    CHECK(sums.open < sums.chains / 10);
    CHECK(sums.left_out > 0);
}
