#include "tools/tf-weld/properties.hpp"

#include "tools/common/exit_status.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace tools {
namespace {

/// Names of columns that say one thing, in the spellings that files use.
struct column_group {
    std::string_view name;
    std::array<std::string_view, 7> columns;
};

constexpr column_group groups[] = {
    {"normal", {"nx", "ny", "nz", "normal_x", "normal_y", "normal_z"}},
    {"uv", {"u", "v", "s", "t", "texture_u", "texture_v"}},
    {"colour", {"red", "green", "blue", "alpha", "rgb", "rgba"}},
    {"color", {"red", "green", "blue", "alpha", "rgb", "rgba"}},
};

const column_group* find_group(std::string_view name) {
    const auto at = std::find_if(std::begin(groups), std::end(groups),
                                 [&](const column_group& g) { return g.name == name; });
    return at == std::end(groups) ? nullptr : at;
}

const tf::column* data_column(const tf::mesh_file& file, std::string_view name) {
    const tf::element* vertices = tf::find_element(file.attributes, "vertex");
    const tf::column* c = vertices == nullptr ? nullptr : tf::find_column(*vertices, name);
    return c == nullptr || c->role != tf::column_role::data ? nullptr : c;
}

bool is_axis(std::string_view name) { return name == "x" || name == "y" || name == "z"; }

/// The columns that `name` stands for; empty when there are none.
std::vector<std::string> columns_of(const tf::mesh_file& file, std::string_view name) {
    if (is_axis(name) || data_column(file, name) != nullptr) return {std::string(name)};
    std::vector<std::string> columns;
    if (const column_group* const group = find_group(name))
        for (const std::string_view column : group->columns)
            if (!column.empty() && data_column(file, column) != nullptr)
                columns.emplace_back(column);
    return columns;
}

[[noreturn]] void refuse(std::string_view option, std::string_view name, const std::string& why) {
    throw failure(bad_input, "property",
                  std::string(option) + " " + std::string(name) + ": " + why);
}

std::string known_properties(const tf::mesh_file& file) {
    std::string text;
    if (const tf::element* const vertices = tf::find_element(file.attributes, "vertex"))
        for (const tf::column& c : vertices->columns)
            if (c.role == tf::column_role::data) text += (text.empty() ? "" : ", ") + c.name;
    return text.empty() ? "the points have none but x, y, z" : "the points have " + text;
}

std::vector<std::string> required(const tf::mesh_file& file, std::string_view option,
                                  std::string_view name) {
    auto columns = columns_of(file, name);
    if (columns.empty()) refuse(option, name, "no such property; " + known_properties(file));
    for (const std::string& column : columns)
        if (!is_axis(column) && data_column(file, column)->list_length)
            refuse(option, name, "has lists of values");
    return columns;
}

std::vector<tf::weld_condition> seams_of(const tf::mesh_file& file,
                                         const std::vector<std::string>& across) {
    std::vector<tf::weld_condition> seams;
    if (!file.mesh.faces.empty()) seams = tf::seam_conditions(file.attributes);
    for (const std::string& name : across) {
        const auto let_go =
            find_group(name) != nullptr ? columns_of(file, name) : required(file, "--across", name);
        std::erase_if(seams, [&](const tf::weld_condition& c) {
            return std::find(let_go.begin(), let_go.end(), c.property) != let_go.end();
        });
    }
    return seams;
}

}  // namespace

std::vector<tf::weld_condition> conditions_of(const tf::mesh_file& file,
                                              const weld_settings& settings) {
    std::vector<tf::weld_condition> conditions;
    for (const auto& asked : settings.same)
        for (auto& column : required(file, "--same", asked.property))
            conditions.push_back({std::move(column), asked.tolerance});
    const std::size_t asked = conditions.size();
    for (auto& seam : seams_of(file, settings.across))
        if (std::none_of(conditions.begin(),
                         conditions.begin() + static_cast<std::ptrdiff_t>(asked),
                         [&](const auto& c) { return c.property == seam.property; }))
            conditions.push_back(std::move(seam));
    return conditions;
}

void check_keep(const tf::mesh_file& file, const weld_settings& settings) {
    if (settings.keep_by.empty()) return;
    if (required(file, "--keep", settings.keep_by).size() > 1)
        refuse("--keep", settings.keep_by, "is more than one property");
}

}  // namespace tools
