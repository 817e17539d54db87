#include <libmesh/stream/point_keys.hpp>
#include <libmesh/weld/vertex_values.hpp>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace treeform::detail::stream {
namespace {

/// Calls `look` with the properties of `block` as attributes.
template <class Look>
void with_properties(io::point_block& block, const Look& look) {
    attributes all;
    all.elements.push_back(std::move(block.properties));
    look(all);
    block.properties = std::move(all.elements.front());
}

bool is_whole(const attributes& properties, const std::string& name) {
    const element* const vertices = properties.find("vertex");
    const column* const c = vertices == nullptr ? nullptr : vertices->find(name);
    return c != nullptr && c->role == column_role::data &&
           (c->type == scalar_type::int64 || c->type == scalar_type::uint64);
}

void refuse_lists(const mesh_file& header) {
    if (const element* const vertices = header.attributes.find("vertex"))
        for (const column& c : vertices->columns)
            if (c.list_length)
                throw std::invalid_argument(
                    "treeform::weld_stream: in tiles, points with lists need weld_keep::first");
}

}  // namespace

point_keys::point_keys(const mesh_file& header, const weld_stream_options& o) {
    const weld_options asked{.same = o.same,
                             .keep_seams = o.keep_seams,
                             .ignored_seams = o.ignored_seams,
                             .keep = o.keep,
                             .keep_by = o.keep_by,
                             .order_by = o.order_by,
                             .highest_first = o.highest_first};
    weld::check_choices("weld_stream", o.keep, !o.keep_by.empty(), !o.order_by.empty(),
                        o.highest_first);
    const element* const faces = header.attributes.find("face");
    conditions_ = asked.conditions(header.attributes, faces != nullptr && faces->rows > 0);
    std::vector<weld::agreement::condition> all;
    for (const weld_condition& c : conditions_) {
        if (!(c.tolerance >= 0.0) || !std::isfinite(c.tolerance))
            throw std::invalid_argument("treeform::weld_stream: the tolerance of '" + c.property +
                                        "' must be finite and not negative");
        all.push_back({is_whole(header.attributes, c.property), c.tolerance});
    }
    agree_ = weld::agreement(std::move(all));
    if (!o.order_by.empty())
        order_ = {weld::column_to_order_by(header.attributes, asked), !o.highest_first};
    if (o.keep == weld_keep::lowest || o.keep == weld_keep::highest)
        choice_ = {weld::column_to_keep_by(header.attributes, asked), o.keep == weld_keep::lowest};
    if (o.keep != weld_keep::first) refuse_lists(header);
}

void point_keys::values_of(io::point_block& block, std::vector<std::uint64_t>& to) const {
    const std::size_t width = conditions_.size();
    to.resize(block.points.size() * width);
    if (width == 0) return;
    with_properties(block, [&](const attributes& properties) {
        for (std::size_t c = 0; c < width; ++c) {
            const weld::vertex_values values(block.points, properties, conditions_[c].property);
            for (std::size_t i = 0; i < block.points.size(); ++i)
                to[i * width + c] = values.ascending_key(i);
        }
    });
}

void point_keys::order_of(io::point_block& block, std::vector<std::uint64_t>& to) const {
    take(block, order_, to);
}

void point_keys::choice_of(io::point_block& block, std::vector<std::uint64_t>& to) const {
    take(block, choice_, to);
}

void point_keys::take(io::point_block& block, const key_column& p, std::vector<std::uint64_t>& to) {
    to.assign(block.points.size(), 0);
    if (p.property.empty()) return;
    with_properties(block, [&](const attributes& properties) {
        const weld::vertex_values values(block.points, properties, p.property);
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] = p.lowest ? values.ascending_key(i) : values.descending_key(i);
    });
}

}  // namespace treeform::detail::stream
