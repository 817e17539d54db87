/// \file
/// Whether what is made of real files can be certified: repair of each in three ways, and four
/// set operations on each pair, in doubles and in floats; every result looked at again from
/// outside. Without TREEFORM_MODELS_DIR nothing is checked.
///
/// TREEFORM_STRESS_COUNT sets the faces of the largest file repaired (default 12000),
/// TREEFORM_STRESS_ONLY names a file or pair to look at alone.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <doctest/doctest.h>
#include <support/certified.hpp>
#include <support/models.hpp>
#include <support/settings.hpp>
#include <support/truth.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

bool is_asked(const std::string& name) {
    const char* only = std::getenv("TREEFORM_STRESS_ONLY");
    return only == nullptr || name.find(only) != std::string::npos;
}

std::size_t most_faces() { return test::setting("TREEFORM_STRESS_COUNT", 12'000); }

/// Equal corners joined; empty where no reader should take the file, or its numbers are none.
tf::mesh read_if_any(const std::filesystem::path& path, const tf::transform<3>& by = {}) {
    tf::mesh mesh;
    try {
        mesh = tf::join_equal_points(tf::read(path).mesh);
    } catch (const tf::io_error&) {
        return {};
    }
    const tf::invalid_faces defects = tf::find_invalid_faces(mesh);
    if (!defects.nonfinite_points.empty() || !defects.out_of_range_faces.empty()) return {};
    for (tf::point3& p : mesh.points) p = by(p);
    return mesh;
}

/// A result that is said to be good is; one that is not says where, and is right about it.
template <class Result>
void look_at(const Result& result, bool is_solid, bool to_float) {
    if (result.certificate) {
        CHECK(result.certificate.meeting_count == 0);
        CHECK(test::is_clean_complex(result.mesh));
        CHECK((!is_solid || test::is_clean_solid(result.mesh)));
        CHECK((!to_float || test::is_in_floats(result.mesh)));
    } else {
        CHECK(result.certificate.meeting_count <= test::count_meeting(result.mesh));
    }
}

/// Floats refuse nothing that doubles do not.
void count(const tf::certificate& known, bool to_float, bool& in_doubles, const std::string& what,
           test::certified_tally& tally) {
    const bool certified = test::is_certified(known);
    CHECK((!to_float || !in_doubles || certified));
    in_doubles = certified;
    tally.count(known, what + ", " + std::to_string(known.meeting_count));
}

void repair_in_all_ways(const tf::mesh& mesh, const std::string& file,
                        test::certified_tally& tally) {
    constexpr std::array<std::pair<tf::resolve_mode, const char*>, 3> modes{
        {{tf::resolve_mode::split, " split"},
         {tf::resolve_mode::outer, " outer"},
         {tf::resolve_mode::remove, " remove"}}};
    for (const auto& [mode, name] : modes) {
        bool in_doubles = false;
        for (const bool to_float : {false, true}) {
            const std::string what = file + name + (to_float ? " in floats" : " in doubles");
            CAPTURE(what);
            const auto result = tf::resolve_self_intersections(
                mesh, mode,
                {.precision = to_float ? tf::precision::float32 : tf::precision::float64,
                 .touching = true,
                 .max_loss = 1.0});
            if (result.certificate.open_count > 0) continue;  // bounds nothing, and is told so
            if (!std::isfinite(result.certificate.max_displacement))
                continue;  // beyond the range of float
            look_at(result, mode == tf::resolve_mode::outer, to_float);
            count(result.certificate, to_float, in_doubles, what, tally);
        }
    }
}

void repair_models(const std::filesystem::path& folder, test::certified_tally& all) {
    test::certified_tally tally("repairs");
    for (const std::string& file : test::files_with_truth(folder)) {
        if (!is_asked(file)) continue;
        const tf::mesh mesh = read_if_any(folder / file);
        if (!mesh.faces.empty() && mesh.faces.size() <= most_faces())
            repair_in_all_ways(mesh, file, tally);
    }
    MESSAGE(tally.summary());
    all.add(tally);
}

void combine_pairs(const std::filesystem::path& folder, test::certified_tally& all) {
    test::certified_tally tally("pairs");
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH_PAIRS.csv")) {
        if (row.text("transform") == "exact" || !is_asked(row.text("pair"))) continue;
        const std::vector<tf::mesh> operands{
            read_if_any(folder / row.text("file_a"), row.map("matrix_a")),
            read_if_any(folder / row.text("file_b"), row.map("matrix_b"))};
        const std::vector<tf::mesh_view> views(operands.begin(), operands.end());
        for (const char* formula : {"a+b", "a*b", "a-b", "a^b"}) {
            bool in_doubles = false;
            for (const bool to_float : {false, true}) {
                const std::string what =
                    row.text("pair") + " " + formula + (to_float ? " in floats" : " in doubles");
                CAPTURE(what);
                const auto result = tf::boolean(
                    views, {formula, 2},
                    {.precision = to_float ? tf::precision::float32 : tf::precision::float64});
                if (result.certificate.open_count > 0) break;  // bounds nothing, and is told so
                look_at(result, true, to_float);
                count(result.certificate, to_float, in_doubles, what, tally);
            }
        }
    }
    MESSAGE(tally.summary());
    all.add(tally);
}

}  // namespace

TEST_CASE("models: of all repairs and set operations, nearly all can be written") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    test::certified_tally all("models");
    repair_models(folder, all);
    combine_pairs(folder, all);
    CHECK(all.enough());
}
