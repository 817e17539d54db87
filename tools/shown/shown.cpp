#include "tools/shown/shown.hpp"

#include "tools/common/output_file.hpp"
#include "tools/page/page.hpp"
#include "tools/picture/png.hpp"
#include "tools/picture/sheet.hpp"
#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
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

}  // namespace

scene scene_of(const job& work, const char* tool) {
    scene shown;
    shown.title = work.name;
    if (work.options.unit != "unknown") shown.unit = work.options.unit;
    const auto text_of = [&](const char* key) {
        const auto at = work.entry.find(key);
        return at != work.entry.end() && at->is_string() ? at->get<std::string>() : std::string();
    };
    const std::string format = text_of("format");
    shown.y_is_up = y_is_up_in(work.entry);
    shown.facts.emplace_back("file", work.name + (format.empty() ? "" : ", " + format));
    if (!text_of("sha256").empty()) shown.facts.emplace_back("sha256", text_of("sha256"));
    if (!text_of("precision_in").empty())
        shown.facts.emplace_back("coordinates",
                                 text_of("precision_in") + ", unit " + work.options.unit);
    shown.facts.emplace_back("program", std::string(tool) + " " + tf::version_string());
    return shown;
}

void write_page(job& work, const scene& shown) {
    const common_options& o = work.options;
    const auto add = [&](const std::filesystem::path& path, const auto& bytes) {
        if (path.empty()) return;
        auto file = std::make_unique<output_file>(path, o.force, work.keeper);
        file->write(bytes());
        file->finish();
        work.last_outputs.push_back(std::move(file));
    };
    add(o.html, [&] { return html(shown); });
    add(o.png, [&] { return png(draw(shown, o.picture)); });
}

}  // namespace tools
