#include "tools/shown/shown.hpp"

#include "tools/common/output_file.hpp"
#include "tools/page/page.hpp"
#include "tools/picture/png.hpp"
#include "tools/picture/sheet.hpp"
#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

#include <filesystem>
#include <memory>
#include <utility>

namespace tools {
scene scene_of(const job& work, const char* tool) {
    scene shown;
    shown.title = work.name;
    if (work.options.unit != "unknown") shown.unit = work.options.unit;
    const auto text_of = [&](const char* key) {
        const auto at = work.entry.find(key);
        return at != work.entry.end() && at->is_string() ? at->get<std::string>() : std::string();
    };
    const std::string format = text_of("format");
    shown.y_is_up = format.starts_with("obj") || format.starts_with("gl");
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
