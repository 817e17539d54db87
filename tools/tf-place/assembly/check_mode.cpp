#include "tools/shell/console.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/output_file.hpp"
#include "tools/tf-place/assembly/assembly.hpp"
#include "tools/tf-place/assembly/measured.hpp"
#include "tools/tf-place/assembly/pose_file.hpp"
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/read.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

constexpr std::size_t poses_at_once = 4096;
constexpr std::size_t most_listed = 1000;

/// What moves.
struct movable {
    std::vector<tf::prepared_mesh> shapes{};
    std::vector<std::string> names{};
    std::vector<tf::part_pair> adjacent{};  ///< links that a joint connects
    std::optional<tf::urdf_robot> robot{};
    std::vector<std::uint32_t> links{};  ///< of the robot, that have meshes
};

/// The mesh in a file of a robot, which is an input, too.
tf::mesh read_part(job& work, const std::string& path) {
    json about{{"input", path}};
    tf::body_set set;
    const tf::body_file& file = set.add(work.read(path, about), path);
    about["faces"] = file.content.stored_faces;
    work.warn_of_non_finite(file.non_finite, "face", "faces", file.label + ": ");
    json& non_finite = work.entry["skipped"]["non_finite"];
    non_finite = non_finite.get<std::uint64_t>() + file.non_finite;
    work.entry["inputs"].push_back(std::move(about));
    if (set.shapes.empty()) return {};
    const auto [points, faces] = set.shapes[0].indexed_view();
    return {{points.begin(), points.end()}, {faces.begin(), faces.end()}};
}

movable read_robot(job& work, const assembly_settings& settings) {
    movable all;
    const std::vector<std::filesystem::path> folders(settings.package_folders.begin(),
                                                     settings.package_folders.end());
    all.robot = tf::read_urdf(work.path, folders);
    work.entry["inputs"].push_back({{"input", work.path},
                                    {"format", nullptr},
                                    {"sha256", nullptr},
                                    {"precision_in", nullptr},
                                    {"faces", nullptr}});
    for (const std::string& text : all.robot->approximated) work.warn("approximated", text);
    for (const std::string& text : all.robot->skipped) work.warn("no-mesh", text);
    std::vector<tf::urdf_mesh> found = all.robot->parts(
        [&](const std::filesystem::path& path) { return read_part(work, path.string()); });
    if (found.empty()) throw failure(bad_input, "no-triangles", work.name + ": no link has a mesh");
    all.adjacent = all.robot->adjacent(found);
    for (tf::urdf_mesh& part : found) {
        all.shapes.emplace_back(std::move(part.shape));
        all.names.push_back(all.robot->links[part.link]);
        all.links.push_back(part.link);
    }
    return all;
}

movable read_parts(job& work, const assembly_settings& settings) {
    const auto is_urdf = [](const std::string& path) { return extension_of(path) == "urdf"; };
    const auto& inputs = work.options.inputs;
    if (std::any_of(inputs.begin(), inputs.end(), is_urdf)) {
        if (inputs.size() > 1) refuse("a URDF file must be the only INPUT");
        return read_robot(work, settings);
    }
    if (!settings.package_folders.empty()) refuse("--package-dir is for URDF files");
    named_assembly assembly = read_assembly(work);
    return {.shapes = std::move(assembly.set.shapes), .names = std::move(assembly.names)};
}

json clashes_entry(const movable& all, const std::vector<tf::pose_clash>& clashes) {
    json list = json::array();
    for (const tf::pose_clash& one : clashes)
        list.push_back({{"a", all.names[one.a]},
                        {"b", all.names[one.b]},
                        {"status", name_of(one.relation)},
                        {"distance", one.distance}});
    return list;
}

/// All poses, some thousands at a time.
class pose_run {
  public:
    pose_run(job& work, const movable& all, tf::clash_options options)
        : work_(work), all_(all), options_(std::move(options)) {}

    void look_at(pose_file& poses, output_file* results) {
        std::vector<tf::transform<3>> some;
        while (poses.next(poses_at_once, some) > 0) {
            options_.progress = work_.progress("poses");
            tf::pose_result found;
            {
                const auto timing = work_.time("search");
                found = tf::check_poses(all_.shapes, some, options_);
            }
            work_.call_ended(found.status == tf::status::cancelled);
            clashing += found.clashing;
            boxes_apart += found.boxes_apart;
            for (std::size_t p = 0; p < found.poses.size(); ++p)
                enter(found.poses[p], found.in_collision[p], results);
            some.clear();
        }
        if (results) results->write(text_);
    }

    std::uint64_t count = 0, clashing = 0, boxes_apart = 0;
    std::optional<std::uint64_t> first{};

  private:
    void enter(const std::vector<tf::pose_clash>& clashes, bool clash, output_file* results) {
        const json list = clashes_entry(all_, clashes);
        const json entry{{"pose", count}, {"clash", clash}, {"pairs", list}};
        if (clash && !first) first = count;
        if (!clashes.empty() && work_.entry["poses"]["list"].size() < most_listed)
            work_.entry["poses"]["list"].push_back(entry);
        if (results) {
            text_ += entry.dump() + "\n";
            results->write_full_pieces(text_);
        }
        ++count;
    }

    job& work_;
    const movable& all_;
    tf::clash_options options_;
    std::string text_;
};

double diagonal_of(const movable& all) {
    std::vector<tf::point3> corners;
    for (const tf::prepared_mesh& one : all.shapes)
        if (const auto box = tf::bounding_box(one.indexed_view().points))
            corners.insert(corners.end(), {box->min, box->max});
    const auto box = tf::bounding_box(corners);
    return box ? box->diagonal() : 0.0;
}

}  // namespace

exit_status check_all(job& work, const assembly_settings& settings) {
    work.entry.update(
        {{"mode", "check"},
         {"inputs", json::array()},
         {"parts", nullptr},
         {"clearance", {{"given", settings.clearance.given}, {"used", nullptr}}},
         {"poses", {{"count", nullptr}, {"clashing", nullptr}, {"list", json::array()}}},
         {"skipped", {{"non_finite", 0}, {"pairs_culled_by_box", 0}}},
         {"results", or_null(!settings.results.empty(), settings.results.string())}});
    check_output(settings.results, work.options.force);
    const movable all = read_parts(work, settings);
    for (std::size_t i = 0; i < all.names.size(); ++i)
        warn_of_inside_out(work, all.shapes[i], all.names[i]);
    auto ignored = ignored_pairs(work, settings, all.names);
    ignored.insert(ignored.end(), all.adjacent.begin(), all.adjacent.end());
    tf::clash_options options;
    options.clearance = settings.clearance.used(diagonal_of(all));
    options.first_only = settings.first_only;
    options.ignored = ignored;
    pose_file poses = all.robot ? pose_file(settings.poses, *all.robot, all.links)
                                : pose_file(settings.poses, all.names);
    pose_run run(work, all, options);
    if (settings.results.empty())
        run.look_at(poses, nullptr);
    else
        write_file(settings.results, work.options.force,
                   [&](output_file& file) { run.look_at(poses, &file); });
    json& entry = work.entry;
    entry["parts"] = all.names.size();
    entry["clearance"]["used"] = options.clearance;
    entry["poses"]["count"] = run.count;
    entry["poses"]["clashing"] = run.clashing;
    entry["skipped"]["pairs_culled_by_box"] = run.boxes_apart;
    std::string text =
        counted(run.count, "pose", "poses") + " of " + counted(all.names.size(), "part", "parts") +
        ": " +
        (run.clashing == 0 ? std::string("no clash") : grouped(run.clashing) + " with a clash");
    if (run.first) text += ", the first is pose " + std::to_string(*run.first);
    work.out.result(work.name + ": " + text);
    return run.clashing > 0 ? found : done;
}

}  // namespace tools
