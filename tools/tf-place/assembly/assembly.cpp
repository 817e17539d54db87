#include "tools/tf-place/assembly/assembly.hpp"

#include "tools/shell/console.hpp"

#include <set>
#include <string_view>

namespace tools {

extern const std::string_view assembly_help;  ///< help.txt of this folder

namespace {

void add_shared_options(command_line& line, assembly_settings& s) {
    line.group("Options");
    line.option(s.clearance, {"--clearance", "DIST",
                              "least distance of parts; \"0.1%\" is a share of the\n"
                              "diagonal of all parts together",
                              "0"});
    line.repeatable_option(s.ignored, {"--ignore", "A:B",
                                       "do not test A against B (repeatable); * stands for\n"
                                       "any characters, ? for one"});
}

void add_clash_options(command_line& line, assembly_settings& s, common_options& o) {
    add_shared_options(line, s);
    line.flag(s.no_depth, {"--no-depth", "", "skip the depths, the slowest part"});
    line.group("Output");
    line.output(o.output, {"-o, --output", "FILE",
                           "all parts; in PLY and GLB, faces that penetrate others\n"
                           "are red, touching ones yellow"});
}

void add_check_options(command_line& line, assembly_settings& s) {
    add_shared_options(line, s);
    line.option(s.poses, {"--poses", "FILE", "the poses; see below"});
    line.flag(s.first_only, {"--first", "", "report only the first clash of each pose"});
    line.repeatable_option(s.package_folders,
                           {"--package-dir", "DIR",
                            "folder for package://... in a URDF file (repeatable);\n"
                            "default: the file's folder and those above it"});
    line.group("Output");
    line.output(s.results, {"--results", "FILE",
                            "the clashes of each pose, a line of JSON for each;\n"
                            "\"-\" = stdout"});
}

/// "bolts" of "dir/bolts.stl", and a part's name behind it.
std::string part_name(const tf::body_set& set, std::size_t body, bool several_files) {
    const std::string& part = set.part_name(body);
    const std::string& file = set.file_of(body).name;
    if (part.empty()) return file;
    return several_files ? file + "/" + part : part;
}

}  // namespace

assembly_command::assembly_command(const std::string& mode)
    : mode_(mode),
      clash_(mode == "clash"),
      line_("tf-place",
            clash_ ? "clash [OPTIONS] INPUT..." : "check --poses FILE [OPTIONS] INPUT...",
            clash_ ? "Find which parts of an assembly penetrate each other, touch, or are "
                     "too\nclose: all pairs, by name."
                   : "Find in which of many poses parts of an assembly, or links of a "
                     "robot,\npenetrate each other or are too close.") {
    options_.joined = true;
    options_.takes_points = !clash_;
    line_.word("MODE", [](std::string_view) {});
    line_.inputs(options_.inputs,
                 clash_ ? mesh_inputs : "STL OBJ PLY OFF GLB/glTF 3MF files, or one URDF file");
    if (clash_)
        add_clash_options(line_, settings_, options_);
    else
        add_check_options(line_, settings_);
    line_.group("Common options");
    common_features features;
    features.one_result = true;
    features.page = clash_;
    if (clash_) features.output_formats = {"ply", "obj", "stl", "off", "glb", "3mf"};
    add_common_options(line_, options_, features);
    for (const char* name : {"--html", "--png", "--view", "--png-size"})
        if (!clash_)
            line_.refuse(name, true, "is not for check, which tests many poses and shows none");
    line_.epilogue(sections_of(assembly_help)[clash_ ? 0 : 1].second);
}

int assembly_command::run(int argc, const char* const* argv) {
    return tools::run(
        line_, options_, {"read", "prepare", "search", "write"}, argc, argv,
        [this] {
            if (!clash_ && settings_.poses.empty()) refuse("check needs --poses");
            if (!settings_.poses.empty()) options_.also_read.push_back(settings_.poses);
        },
        [this](job& work) {
            return clash_ ? clash_all(work, settings_) : check_all(work, settings_);
        });
}

named_assembly read_assembly(job& work) {
    named_assembly all;
    std::uint64_t non_finite = 0;
    for (const std::string& path : work.options.inputs) {
        json about{{"input", path}};
        tf::mesh_file file = work.read(path, about);
        work.warn(file.warnings, name_of_input(path) + ": ");
        const auto timing = work.time("prepare");
        const tf::body_file& added =
            all.set.add_named_parts(std::move(file), name_of_input(path), stem_of(path));
        about["faces"] = added.content.stored_faces;
        non_finite += added.non_finite;
        work.warn_of_non_finite(added.non_finite, added.cloud ? "point" : "face",
                                added.cloud ? "points" : "faces", added.label + ": ");
        work.entry["inputs"].push_back(std::move(about));
    }
    work.entry["skipped"]["non_finite"] = non_finite;
    if (all.set.shapes.empty())
        throw failure(bad_input, "no-triangles", work.name + ": no part with finite coordinates");
    for (std::size_t i = 0; i < all.set.shapes.size(); ++i)
        all.names.push_back(part_name(all.set, i, all.set.files.size() > 1));
    return all;
}

std::vector<tf::part_pair> ignored_pairs(job& work, const assembly_settings& settings,
                                         const std::vector<std::string>& names) {
    std::set<tf::part_pair> pairs;
    for (const std::string& one : settings.ignored) {
        // Names may have colons: that one divides which makes pairs.
        std::vector<tf::part_pair> found;
        for (std::size_t at = one.find(':'); at != std::string::npos && found.empty();
             at = one.find(':', at + 1))
            found = tf::pairs_named(names, std::string_view(one).substr(0, at),
                                    std::string_view(one).substr(at + 1));
        if (one.find(':') == std::string::npos)
            refuse("--ignore " + one + ": expected two names, A:B");
        if (found.empty()) work.warn("ignore", "--ignore " + one + ": no pair of parts matches");
        pairs.insert(found.begin(), found.end());
    }
    return {pairs.begin(), pairs.end()};
}

}  // namespace tools
