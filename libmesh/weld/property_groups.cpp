#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/weld/vertex_values.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace treeform {
namespace {

using detail::attribute::column_use;

const column* data_column(const attributes& properties, std::string_view name) {
    const element* vertices = properties.find("vertex");
    const column* c = vertices == nullptr ? nullptr : vertices->find(name);
    return c == nullptr || c->role != column_role::data ? nullptr : c;
}

/// Values by which vertices at one place differ.
bool is_seam(std::string_view name) {
    using detail::attribute::is_use;
    return is_use(name, column_use::normal) || is_use(name, column_use::texture) ||
           is_use(name, column_use::color);
}

bool is_axis(std::string_view name) { return name == "x" || name == "y" || name == "z"; }

/// The columns that `name` stands for; empty when there are none.
std::vector<std::string> columns_of(const attributes& properties, std::string_view name) {
    if (is_axis(name)) return {std::string(name)};
    const element* const vertices = properties.find("vertex");
    return vertices == nullptr ? std::vector<std::string>{} : vertices->columns_called(name);
}

std::vector<std::string> required(const attributes& properties, const char* option,
                                  const std::string& name) {
    auto columns = columns_of(properties, name);
    if (columns.empty()) throw weld_property_error(option, name, "");
    for (const std::string& column : columns)
        if (const auto* const c = data_column(properties, column); c != nullptr && c->list_length)
            throw weld_property_error(option, name, "has lists of values");
    return columns;
}

std::string required_column(const attributes& properties, const char* option,
                            const std::string& name) {
    auto columns = required(properties, option, name);
    if (columns.size() > 1) throw weld_property_error(option, name, "is more than one property");
    return std::move(columns.front());
}

/// Equality of each column of normals (nx, ny, nz), texture coordinates (u, v, s, t, texture_u,
/// texture_v) and colors (red, green, blue, alpha) that "vertex" has, in the order of the columns.
std::vector<weld_condition> seam_conditions(const attributes& properties) {
    std::vector<weld_condition> found;
    const element* vertices = properties.find("vertex");
    if (vertices == nullptr) return found;
    for (const column& c : vertices->columns)
        if (c.role == column_role::data && !c.list_length && is_seam(c.name))
            found.push_back({c.name, 0.0});
    return found;
}

std::vector<weld_condition> kept_seams(const attributes& properties,
                                       const std::vector<std::string>& ignored_seams) {
    std::vector<weld_condition> seams = seam_conditions(properties);
    for (const std::string& name : ignored_seams) {
        const auto let_go = detail::attribute::use_called(name)
                                ? columns_of(properties, name)
                                : required(properties, "ignored_seams", name);
        std::erase_if(seams, [&](const weld_condition& c) {
            return std::find(let_go.begin(), let_go.end(), c.property) != let_go.end();
        });
    }
    return seams;
}

}  // namespace

weld_property_error::weld_property_error(std::string option, std::string name, std::string reason)
    : std::invalid_argument("treeform::weld: " +
                            (reason.empty() ? "no vertex property '" + name + "'"
                                            : "the vertex property '" + name + "' " + reason)),
      option_(std::move(option)),
      name_(std::move(name)),
      reason_(std::move(reason)) {}

std::vector<weld_condition> weld_options::conditions(const attributes& properties,
                                                     bool has_faces) const {
    std::vector<weld_condition> conditions;
    for (const weld_condition& asked : same)
        for (std::string& column : required(properties, "same", asked.property))
            conditions.push_back({std::move(column), asked.tolerance});
    if (!keep_seams) return conditions;
    const auto asked = static_cast<std::ptrdiff_t>(conditions.size());
    std::vector<weld_condition> seams = kept_seams(properties, ignored_seams);
    if (!has_faces) return conditions;
    for (weld_condition& seam : seams)
        if (std::none_of(conditions.begin(), conditions.begin() + asked,
                         [&](const weld_condition& c) { return c.property == seam.property; }))
            conditions.push_back(std::move(seam));
    return conditions;
}

void detail::weld::check_choices(const char* function, weld_keep keep, bool has_keep_by,
                                 bool has_order, bool highest_first) {
    const bool by_value = keep == weld_keep::lowest || keep == weld_keep::highest;
    const char* const why = by_value && !has_keep_by
                                ? "keep lowest or highest needs keep_by, a property"
                            : has_keep_by && !by_value ? "keep_by is for keep lowest or highest"
                            : has_order && keep != weld_keep::first ? "order_by needs keep first"
                            : highest_first && !has_order           ? "highest_first needs order_by"
                                                                    : nullptr;
    if (why) throw std::invalid_argument("treeform::" + std::string(function) + ": " + why);
}

std::string detail::weld::column_to_keep_by(const attributes& properties,
                                            const weld_options& options) {
    return required_column(properties, "keep_by", options.keep_by);
}

std::string detail::weld::column_to_order_by(const attributes& properties,
                                             const weld_options& options) {
    return required_column(properties, "order_by", options.order_by);
}

}  // namespace treeform
