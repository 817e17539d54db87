#include "bench/models.hpp"

#include "bench/subdivide.hpp"
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace treeform::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* bunny = "open/bunny_69k.obj";
constexpr std::size_t bunny_triangles = 69'700;
/// Where the base model lies; empty when nowhere.
fs::path find(const setting& setting, const std::string& base) {
    std::vector<fs::path> places;
    if (!setting.models_dir.empty()) places.emplace_back(fs::path(setting.models_dir) / base);
    if (base == bunny) {
        places.emplace_back(TREEFORM_SOURCE_DIR "/data/real/bunny.obj");
        places.emplace_back("/usr/share/glmark2/models/bunny.obj");
    }
    for (const fs::path& place : places)
        if (fs::exists(place)) return place;
    return {};
}

/// Where the base of the model lies, or what stands in for it; empty for the sphere.
fs::path base_of(const setting& setting, const model& model) {
    fs::path path = find(setting, model.base);
    if (path.empty() && model.triangles >= bunny_triangles) path = find(setting, bunny);
    return path;
}

mesh read_joined(const fs::path& path) { return join_equal_points(read(path).mesh); }

/// The bunny of one package has two pairs of faces that meet, that of another none.
mesh without_meeting_faces(mesh mesh) {
    std::vector<bool> meets(mesh.faces.size(), false);
    for (const face_pair& pair :
         self_intersections(mesh, {.vertices = vertex_identity::by_index}).pairs)
        meets[pair.a] = meets[pair.b] = true;
    std::size_t kept = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        if (!meets[f]) mesh.faces[kept++] = mesh.faces[f];
    mesh.faces.resize(kept);
    return mesh;
}

/// About 2,000 triangles on a sphere with dents; computed with correctly rounded operations only.
mesh bumpy_sphere() {
    mesh sphere{.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                .faces = {{0, 2, 4},
                          {2, 1, 4},
                          {1, 3, 4},
                          {3, 0, 4},
                          {2, 0, 5},
                          {1, 2, 5},
                          {3, 1, 5},
                          {0, 3, 5}}};
    sphere = refined(sphere, 8 * 256, 1);
    for (point3& p : sphere.points) {
        const double radius =
            (1 + 4 * p.x * p.y * p.z + 0.2 * p.z) / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        p = {radius * p.x, radius * p.y, radius * p.z};
    }
    return sphere;
}

struct closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using file_handle = std::unique_ptr<std::FILE, closer>;

struct header {
    std::uint64_t points = 0;
    std::uint64_t faces = 0;
};

/// Plain arrays, read straight into place, so that loading leaves no trace in peak memory.
std::shared_ptr<mesh> read_plain(const fs::path& path) {
    const file_handle file(std::fopen(path.c_str(), "rb"));
    header head;
    if (!file || std::fread(&head, sizeof head, 1, file.get()) != 1) return {};
    auto result = std::make_shared<mesh>();
    result->points.resize(head.points);
    result->faces.resize(head.faces);
    if (std::fread(result->points.data(), sizeof(point3), head.points, file.get()) != head.points ||
        std::fread(result->faces.data(), sizeof(face), head.faces, file.get()) != head.faces)
        return {};
    return result;
}

void write_plain(const fs::path& path, const mesh& mesh) {
    const fs::path part = path.string() + ".part" + std::to_string(::getpid());
    file_handle file(std::fopen(part.c_str(), "wb"));
    const header head{.points = mesh.points.size(), .faces = mesh.faces.size()};
    const bool written =
        file && std::fwrite(&head, sizeof head, 1, file.get()) == 1 &&
        std::fwrite(mesh.points.data(), sizeof(point3), head.points, file.get()) == head.points &&
        std::fwrite(mesh.faces.data(), sizeof(face), head.faces, file.get()) == head.faces &&
        std::fflush(file.get()) == 0;
    file.reset();
    if (!written) throw std::runtime_error("cannot write " + part.string());
    fs::rename(part, path);
}

}  // namespace

std::vector<model> clean_models(const setting& setting) {
    const char* armadillo = "clean/armadillo_29k.obj";
    const char* blade = "clean/turbineblade_199k.ply";
    switch (setting.effort) {
        case effort::tiny:
            return {{"", "2k", 2'000}};
        case effort::quick:
            return {{armadillo, "50k", 50'000}, {blade, "200k", 199'000}};
        case effort::full:
            break;
    }
    return {{armadillo, "50k", 50'000}, {bunny, "70k", 70'000},   {blade, "200k", 199'000},
            {bunny, "280k", 280'000},   {blade, "1M", 1'000'000}, {bunny, "1.09M", 1'090'000}};
}

std::string name_of(const setting& setting, const model& model) {
    const fs::path path = base_of(setting, model);
    const std::string stem = path.empty() ? "sphere" : path.stem().string();
    return stem.substr(0, stem.find('_')) + "_" + model.size;
}

shared_mesh load(const setting& setting, const model& model) {
    return cached(setting, name_of(setting, model), [&] {
        const fs::path path = base_of(setting, model);
        return refined(path.empty() ? bumpy_sphere() : without_meeting_faces(read_joined(path)),
                       model.triangles, 1);
    });
}

shared_mesh load_real(const setting& setting, const std::string& path) {
    const fs::path place = find(setting, path);
    if (place.empty()) return {};
    return cached(setting, "real_" + place.stem().string(), [&] { return read_joined(place); });
}

shared_mesh cached(const setting& setting, const std::string& name,
                   const std::function<mesh()>& make) {
    static std::map<std::string, std::weak_ptr<const mesh>> in_use;
    if (shared_mesh known = in_use[name].lock()) return known;
    const fs::path path = fs::path(setting.cache_dir) / (name + ".arrays");
    std::shared_ptr<mesh> result = read_plain(path);
    if (!result) {
        result = std::make_shared<mesh>(make());
        write_plain(path, *result);
    }
    in_use[name] = result;
    return result;
}

}  // namespace treeform::bench
