/// \file
/// B8: reading and writing large files, from the page cache.

#include "bench/models.hpp"
#include "bench/peers/assimp_files.hpp"
#include "bench/peers/cgal_files.hpp"
#include "bench/peers/versions.hpp"
#include "bench/workload.hpp"
#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>

namespace treeform::bench {
namespace {

namespace fs = std::filesystem;

const std::vector<file_kind>& kinds() {
    static const std::vector<file_kind> all{{"stl_binary", "stl", "stlb", false},
                                            {"stl_ascii", "stl", "stl", true},
                                            {"obj", "obj", "objnomtl", true},
                                            {"ply_binary", "ply", "plyb", false},
                                            {"ply_ascii", "ply", "ply", true}};
    return all;
}

/// What the files hold: 1M triangles, or few, since some readers are slow.
model file_model(const setting& setting) {
    const std::vector<model> models = clean_models(setting);
    return setting.effort == effort::full ? models.back() : models.front();
}

/// The nearest number of seven decimal digits.
double with_seven_digits(double x) {
    const std::string text = fmt::format("{:.7g}", x);
    double rounded = 0;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    return rounded;
}

/// The largest model with coordinates as most files of that kind have them: those that float32
/// holds where they are binary, those with few digits where they are text.
shared_mesh load_for(const setting& setting, const file_kind& kind) {
    const auto rounded = kind.ascii ? with_seven_digits : detail::base::nearest_float;
    const std::string prefix = kind.ascii ? "seven_digits_" : "single_";
    return cached(setting, prefix + name_of(setting, file_model(setting)), [&] {
        mesh mesh = *load(setting, file_model(setting));
        for (point3& p : mesh.points) p = {rounded(p.x), rounded(p.y), rounded(p.z)};
        return mesh;
    });
}

mesh_file file_of(const mesh& mesh, const file_kind& kind) {
    mesh_file file{.mesh = mesh};
    file.stored_faces = mesh.faces.size();
    file.stored_as = kind.ascii ? precision::float64 : precision::float32;
    return file;
}

write_options options_for(const file_kind& kind) {
    return {.format = kind.extension, .ascii = kind.ascii};
}

/// The file of that kind that all readers read; made by treeform when it is not there.
std::string given_file(const setting& setting, const file_kind& kind) {
    const std::string path = setting.cache_dir + "/" + name_of(setting, file_model(setting)) + "_" +
                             kind.name + "." + kind.extension;
    if (!fs::exists(path)) write(path, file_of(*load_for(setting, kind), kind), options_for(kind));
    return path;
}

/// Largest distance along an axis between a corner of `mesh` and the same one of `truth`; infinite
/// when it has another number of triangles.
double largest_error(const mesh& mesh, const tf::mesh& truth) {
    if (mesh.faces.size() != truth.faces.size()) return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                largest = std::max(largest, std::abs(mesh.points[mesh.faces[f][i]][k] -
                                                     truth.points[truth.faces[f][i]][k]));
    return largest;
}

using tf::bench::mesh_of;  // of what the peers read
mesh mesh_of(const mesh_file& file) { return file.mesh; }

/// A job that reads what all read, whatever its reader calls a mesh.
template <class Read>
contestant reader(const setting& setting, const file_kind& kind, const std::string& who,
                  Read read) {
    return {who, 1, [=] {
                const std::string path = given_file(setting, kind);
                return make_job([=] { return read(path); },
                                [=](const auto& answer) {
                                    return largest_error(mesh_of(answer), *load_for(setting, kind));
                                });
            }};
}

/// A job that writes to a file of its own; `prepare` turns the mesh into a function that writes it.
template <class Prepare>
contestant writer(const setting& setting, const file_kind& kind, const std::string& who,
                  Prepare prepare) {
    return {who, 1, [=] {
                const auto path = std::make_shared<const std::string>(
                    fs::path(setting.cache_dir) /
                    ("written_" + std::to_string(::getpid()) + "." + kind.extension));
                const auto write = prepare(*load_for(setting, kind), *path);
                return job{.run = write,
                           .discard = [path] { fs::remove(*path); },
                           .error = [=]() -> std::optional<double> {
                               return largest_error(read(*path).mesh, *load_for(setting, kind));
                           }};
            }};
}

contest contest_of(const setting& setting, const file_kind& kind, const std::string& what) {
    const double bytes = static_cast<double>(fs::file_size(given_file(setting, kind)));
    return {.name = name_of(setting, file_model(setting)) + "/" + kind.name + "_" + what,
            .size = [=] { return load_for(setting, kind)->faces.size(); },
            .unit = {.name = "MB/s", .scale = bytes / 1e6, .is_rate = true}};
}

}  // namespace

void files(const setting& setting, const contest_visitor& visit) {
    for (const file_kind& kind : kinds()) {
        contest reading = contest_of(setting, kind, "read");
        reading.contestants = {
            reader(setting, kind, "treeform", [](const auto& path) { return read(path); }),
            reader(setting, kind, assimp_name(), assimp_read),
            reader(setting, kind, cgal_name(), cgal_read)};
        visit(reading);
    }
    for (const file_kind& kind : kinds()) {
        contest writing = contest_of(setting, kind, "write");
        const auto ours = [kind](const mesh& mesh, const std::string& path) {
            return [file = std::make_shared<const mesh_file>(file_of(mesh, kind)), path, kind] {
                write(path, *file, options_for(kind));
            };
        };
        const auto assimp = [kind](const mesh& mesh, const std::string& path) {
            return assimp_writer(mesh, path, kind);
        };
        const auto cgal = [kind](const mesh& mesh, const std::string& path) {
            return cgal_writer(mesh, path, kind);
        };
        writing.contestants = {writer(setting, kind, "treeform", ours),
                               writer(setting, kind, assimp_name(), assimp),
                               writer(setting, kind, cgal_name(), cgal)};
        visit(writing);
    }
}

}  // namespace treeform::bench
