#include "tools/shell/material_names.hpp"

#include <optional>
#include <string_view>
#include <system_error>

namespace tools {
namespace {

namespace fs = std::filesystem;

/// Without links; none where it cannot be found out.
std::optional<fs::path> known_folder_of(const fs::path& file) {
    std::error_code error;
    const fs::path whole = fs::absolute(file, error);
    if (error) return std::nullopt;
    fs::path folder = fs::weakly_canonical(whole.parent_path(), error);
    return error ? std::nullopt : std::optional(std::move(folder));
}

/// Also of another system: a name with a drive or a host, as "C:/a.mtl".
bool is_absolute(std::string_view name) {
    const bool has_drive = name.size() > 2 && name[1] == ':' && (name[2] == '/' || name[2] == '\\');
    return has_drive || name.starts_with("\\\\") || fs::path(name).is_absolute();
}

}  // namespace

std::vector<std::string> seen_from_output(std::vector<std::string> names, const fs::path& input,
                                          const fs::path& output) {
    if (names.empty() || input == "-" || output == "-") return names;
    const auto from = known_folder_of(input);
    const auto to = known_folder_of(output);
    if (!from || !to || *from == *to) return names;
    for (std::string& name : names) {
        if (is_absolute(name)) continue;
        const fs::path there = (*from / name).lexically_normal().lexically_relative(*to);
        if (!there.empty()) name = there.generic_string();
    }
    return names;
}

}  // namespace tools
