#include "tools/shown/shown.hpp"

#include "tools/common/output_file.hpp"
#include "tools/page/page.hpp"
#include "tools/picture/png.hpp"
#include "tools/picture/sheet.hpp"
#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

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

void write_page(const job& work, const scene& shown) {
    const common_options& o = work.options;
    write_file(o.html, o.force, work.keeper, [&](output_file& file) { file.write(html(shown)); });
    write_file(o.png, o.force, work.keeper,
               [&](output_file& file) { file.write(png(draw(shown, o.picture))); });
}

}  // namespace tools
