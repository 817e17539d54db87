#include "tools/shell/shown.hpp"

#include "tools/picture/page.hpp"
#include "tools/picture/sheet.hpp"
#include "tools/shell/output_file.hpp"
#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tools {
namespace {

/// As the formats of all inputs have it; z is up where they differ.
bool y_is_up_in(const json& entry) {
    std::vector<std::string> formats;
    const auto add = [&](const json& about) {
        const auto at = about.find("format");
        if (at != about.end() && at->is_string()) formats.push_back(at->get<std::string>());
    };
    add(entry);
    for (const char* inputs : {"inputs", "fixed"})
        if (const auto all = entry.find(inputs); all != entry.end() && all->is_array())
            std::for_each(all->begin(), all->end(), add);
    return !formats.empty() && std::ranges::all_of(formats, [](const std::string& format) {
        return format.starts_with("obj") || format.starts_with("gl");
    });
}

/// Paths of the job that have folders, and what to say instead: the name of the file, where no
/// other one has it. Long ones come first.
std::vector<std::array<std::string, 2>> file_names_of(const job& work) {
    std::map<std::string, std::set<std::string>> paths_of;
    for (const auto* list : {&work.options.inputs, &work.options.also_read})
        for (const std::string& path : *list)
            paths_of[std::filesystem::path(path).filename().string()].insert(path);
    std::vector<std::array<std::string, 2>> names;
    for (const auto& [name, paths] : paths_of)
        if (paths.size() == 1 && *paths.begin() != name && !name.empty())
            names.push_back({*paths.begin(), name});
    std::ranges::sort(names,
                      [](const auto& a, const auto& b) { return a[0].size() > b[0].size(); });
    return names;
}

/// Replaces paths that stand alone in a text.
void shorten(std::string& text, const std::vector<std::array<std::string, 2>>& names) {
    for (const auto& [path, name] : names)
        for (std::size_t at = 0; (at = text.find(path, at)) != std::string::npos;) {
            const bool starts = at == 0 || text[at - 1] == ' ';
            if (starts) text.replace(at, path.size(), name);
            at += starts ? name.size() : 1;
        }
}

/// Whoever looks at it wants no folders of whoever made it; the first of the facts names them.
void leave_folders_out(scene& shown, const job& work) {
    const auto names = file_names_of(work);
    if (names.empty()) return;
    shorten(shown.title, names);
    shorten(shown.verdict, names);
    for (scene_class& c : shown.classes) shorten(c.name, names);
    for (scene_mesh& m : shown.meshes) shorten(m.name, names);
    for (scene_label& l : shown.labels) shorten(l.text, names);
    for (scene_arrow& a : shown.arrows) shorten(a.text, names);
    for (scene_table& t : shown.tables)
        for (scene_row& row : t.rows)
            for (auto& cell : row.cells)
                if (cell.is_string()) shorten(cell.get_ref<std::string&>(), names);
}

}  // namespace

scene scene_of(const job& work, const char* tool) {
    scene shown;
    shown.title = work.name;
    shown.unit = work.unit();
    const auto text_of = [&](const char* key) {
        const auto at = work.entry.find(key);
        return at != work.entry.end() && at->is_string() ? at->get<std::string>() : std::string();
    };
    const std::string format = text_of("format");
    shown.y_is_up = y_is_up_in(work.entry);
    shown.facts.emplace_back("file", work.name + (format.empty() ? "" : ", " + format));
    if (!text_of("sha256").empty()) shown.facts.emplace_back("sha256", text_of("sha256"));
    if (!text_of("precision_in").empty())
        shown.facts.emplace_back("coordinates", text_of("precision_in") + ", unit " +
                                                    (shown.unit.empty() ? "unknown" : shown.unit));
    shown.facts.emplace_back("program", std::string(tool) + " " + tf::version_string());
    return shown;
}

void write_page(job& work, scene shown) {
    leave_folders_out(shown, work);
    const common_options& o = work.options;
    const auto add = [&](const std::filesystem::path& path, const auto& bytes) {
        if (path.empty()) return;
        auto file = std::make_unique<output_file>(path, o.force);
        file->write(bytes());
        file->finish();
        work.last_outputs.push_back(std::move(file));
    };
    add(o.html, [&] { return html(shown); });
    add(o.png, [&] { return png(draw(shown, o.picture)); });
}

}  // namespace tools
