#include "bench/scaling_inputs.hpp"

#include "bench/near_pairs.hpp"
#include <treeform/mesh/write.hpp>

#include <support/soups.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <utility>

namespace treeform::bench {
namespace {

void write(const std::string& path, mesh m, precision stored_as = precision::float64) {
    mesh_file file;
    file.mesh = std::move(m);
    file.stored_as = stored_as;
    write(path, file);
}

}  // namespace

mesh ring(std::size_t faces) {
    const auto around = static_cast<std::uint32_t>(
        std::max(8.0, std::round(std::sqrt(static_cast<double>(faces) * 1.25))));
    const auto across = static_cast<std::uint32_t>(
        std::max(6.0, std::round(static_cast<double>(faces) / 2 / around)));
    mesh result;
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around;
            const double v = 2 * std::numbers::pi * j / across;
            const double r = 0.4 + 0.02 * std::sin(7 * u) * std::sin(5 * v);
            result.points.push_back({(1 + r * std::cos(v)) * std::cos(u),
                                     (1 + r * std::cos(v)) * std::sin(u), r * std::sin(v)});
            const auto at = [&](std::uint32_t x, std::uint32_t y) {
                return x % around * across + y % across;
            };
            result.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            result.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return result;
}

std::string scaling_files::output(const std::string& name) const {
    return folder.path() + "/" + name + ".out.ply";
}

std::shared_ptr<const scaling_files> files_of_size(const setting& setting, std::size_t n) {
    static std::weak_ptr<const scaling_files> last;
    static std::size_t last_size = 0;
    if (auto known = last.lock(); known && last_size == n) return known;
    const std::string folder = setting.cache_dir + "/scaling-" + std::to_string(::getpid());
    std::filesystem::create_directories(folder);
    const auto in_folder = [&](const char* name) { return folder + "/" + name; };
    const std::shared_ptr<const scaling_files> made(
        new scaling_files{.folder = scratch(folder),
                          .first = in_folder("first.ply"),
                          .second = in_folder("second.ply"),
                          .above = in_folder("above.ply"),
                          .both = in_folder("both.ply"),
                          .soup = in_folder("soup.stl"),
                          .cloud = in_folder("cloud.ply"),
                          .reach = 0.25 / std::cbrt(static_cast<double>(n))});
    const mesh first = ring(n / 2), second = test::moved(first, link);
    write(made->first, first);
    write(made->second, second);
    write(made->above, test::moved(first, {0, 0, 3}));
    write(made->both, test::together(first, second));
    write(made->soup, ring(n), precision::float32);
    write(made->cloud, {*cloud_with_copies(n, 30), {}});
    last = made;
    last_size = n;
    return made;
}

}  // namespace treeform::bench
