/// \file
/// Repair of real files: every closed surface that passes through itself becomes the boundary of
/// what it winds around. Without TREEFORM_MODELS_DIR nothing is checked.
///
/// TREEFORM_STRESS_COUNT sets the points whose winding is compared for each file (default 500).

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/settings.hpp>
#include <support/solid_checks.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace {

std::size_t point_count() { return test::setting("TREEFORM_STRESS_COUNT", 500); }

/// Closed, finite, and not too large for a test.
bool can_be_asked(const tf::mesh& mesh) {
    constexpr std::size_t most_faces = 150'000;
    if (mesh.faces.empty() || mesh.faces.size() > most_faces) return false;
    const tf::invalid_faces defects = tf::find_invalid_faces(mesh);
    return defects.nonfinite_points.empty() && defects.out_of_range_faces.empty() &&
           !tf::find_open_edge(mesh);
}

/// Random points of the box that the repaired surface has on the wrong side.
std::size_t wrong_points(const tf::mesh& mesh, const tf::mesh& repaired) {
    test::random source(11);
    const tf::tree<3> tree = tf::build_face_tree(mesh),
                      repaired_tree = tf::build_face_tree(repaired);
    const tf::detail::intersect::point_locator before(mesh, tree), after(repaired, repaired_tree);
    const tf::box3 box = tf::bounding_box(mesh.points).value();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < point_count(); ++i) {
        const tf::point3 p{source.in(box.min.x, box.max.x), source.in(box.min.y, box.max.y),
                           source.in(box.min.z, box.max.z)};
        wrong += after.locate(p).winding != (before.locate(p).winding != 0 ? 1 : 0);
    }
    return wrong;
}

}  // namespace

TEST_CASE("models: the outer surface of whatever passes through itself") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    std::size_t asked = 0, certified = 0;
    for (const std::string& file : test::files_with_truth(folder)) {
        CAPTURE(file);
        tf::mesh mesh;
        try {
            mesh = tf::join_equal_points(tf::read(folder / file).mesh);
        } catch (const tf::io_error&) {
            continue;  // files that no reader should take
        }
        if (!can_be_asked(mesh) || tf::self_intersections(mesh).pairs.empty()) continue;
        ++asked;
        const auto result = tf::resolve_self_intersections(mesh);
        CHECK(result.certificate.open_count == 0);
        // Faces that cancel each other out bound nothing: that is known for certain, too.
        const bool nothing = result.certificate.status == tf::status::vanished;
        certified += result.certificate || nothing ? 1 : 0;
        if (nothing) continue;
        if (!result.certificate) {
            MESSAGE(file << " not certified: " << result.certificate.meeting_count
                         << " pairs remain");
            continue;
        }
        CHECK(test::is_clean_solid(result.mesh));
        CHECK(wrong_points(mesh, result.mesh) == 0);
    }
    CHECK(asked > 0);
    CHECK(static_cast<double>(certified) >= 0.995 * static_cast<double>(asked));
    MESSAGE(certified << " of " << asked << " models certified");
}
