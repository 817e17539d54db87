/// \file
/// Booleans of pairs of real files against what an exact kernel found: the volumes of
/// TRUTH_PAIRS.csv. Without TREEFORM_MODELS_DIR nothing is checked.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <doctest/doctest.h>
#include <support/certified.hpp>
#include <support/models.hpp>
#include <support/solid_checks.hpp>
#include <support/truth.hpp>
#include <support/was_mended.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace {

tf::mesh read_moved(const std::filesystem::path& path, const tf::transform<3>& by) {
    tf::mesh mesh = tf::read(path).mesh;
    for (tf::point3& p : mesh.points) p = by(p);
    return mesh;
}

/// Whether the quick way is open to it; of a mesh whose volume is positive, part by part.
bool is_sound(const tf::mesh& mesh) {
    if (!test::is_clean_solid(mesh)) return false;
    const tf::boolean_result alone =
        tf::boolean(std::vector<tf::mesh_view>{mesh}, tf::boolean_expression::union_of(1),
                    {.fill_rule = tf::fill_rule::positive});
    return alone.mesh.faces == mesh.faces && alone.mesh.points == mesh.points;
}

}  // namespace

TEST_CASE("truth: every boolean of every pair of files has the volume of the exact kernel") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    struct question {
        const char* column;
        const char* formula;
    };
    constexpr std::array<question, 4> questions{{{"volume_union", "a+b"},
                                                 {"volume_intersection", "a*b"},
                                                 {"volume_a_minus_b", "a-b"},
                                                 {"volume_b_minus_a", "b-a"}}};
    int checked = 0, mended = 0, sound = 0;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH_PAIRS.csv")) {
        if (row.text("transform") == "exact") continue;  // of points that are no doubles
        if (row.text("volume_intersection").empty()) continue;
        CAPTURE(row.text("pair"));
        const tf::mesh a = read_moved(folder / row.text("file_a"), row.map("matrix_a"));
        const tf::mesh b = read_moved(folder / row.text("file_b"), row.map("matrix_b"));
        const tf::mesh nothing;  // a third operand, for the general way
        const std::vector<tf::mesh_view> operands{a, b, nothing};
        const bool are_sound = is_sound(a) && is_sound(b);
        const std::array prepared{tf::prepared_mesh::borrow(a), tf::prepared_mesh::borrow(b)};
        for (const question& q : questions) {
            CAPTURE(q.formula);
            const tf::boolean_result result = tf::boolean(operands, {q.formula, 3});
            if (are_sound) {
                const tf::boolean_result quick = tf::boolean(
                    {tf::mesh_ref(prepared[0]), tf::mesh_ref(prepared[1])}, {q.formula, 2});
                CHECK(quick.mesh == result.mesh);
                CHECK(quick.face_source == result.face_source);
                CHECK(quick.vertex_source == result.vertex_source);
                ++sound;
            }
            CHECK(result.certificate);
            CHECK(result.certificate.open_count == 0);
            CHECK(test::is_clean_solid(result.mesh));
            ++checked;
            mended += test::was_mended(result.statistics);
            const std::string truth = row.text(q.column);
            if (truth.empty() || truth == "nonmanifold") continue;
            // Moving the surface by m in each coordinate changes the volume by its area times
            // sqrt(3) m at most, except for terms of m^2; the truth itself is cut to double.
            const double volume = row.real(q.column);
            const double most =
                2.0 * result.certificate.max_displacement * test::area(result.mesh) +
                0x1p-50 * std::abs(volume);
            CHECK(std::abs(tf::signed_volume(result.mesh) - volume) <= most);
        }
    }
    CHECK(checked > 0);
    MESSAGE(checked << " booleans checked, " << mended << " of them mended after rounding, "
                    << sound << " found again among sound operands");
}
