#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/json_depth.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

namespace {

constexpr std::size_t deepest_json = 500;
constexpr std::size_t deepest_node = 1000;

/// Of binary glTF, of both versions, the first chunk; its length is four bytes at 12.
[[nodiscard]] std::string_view json_of(const source& in) {
    const std::string_view all(in.begin(), in.size());
    constexpr std::size_t head = 20;
    if (!all.starts_with("glTF")) return all;
    if (all.size() < head) in.fail("cut short");
    const std::size_t size = base::load<std::uint32_t, std::endian::little>(in.begin() + 12);
    if (all.size() - head < size) in.fail("cut short");
    return all.substr(head, size);
}

/// The quote that ends the string which starts before `at`, or `end`.
[[nodiscard]] const char* end_of_string(const char* at, const char* end) {
    while (at != end && *at != '"') at += *at == '\\' && end - at > 1 ? 2 : 1;
    return at;
}

void refuse_deep_brackets(const source& gltf, std::string_view json) {
    const char* const end = json.data() + json.size();
    std::size_t depth = 0;
    for (const char* at = json.data(); at != end; ++at) {
        if (*at == '"') {
            at = end_of_string(at + 1, end);
            if (at == end) return;
        } else if (*at == '[' || *at == '{') {
            if (++depth > deepest_json)
                gltf.fail_byte(
                    at, "JSON nested more than " + std::to_string(deepest_json) + " levels deep");
        } else if (*at == ']' || *at == '}') {
            if (depth == 0) return;
            --depth;
        }
    }
}

using node_lists = std::vector<std::vector<std::size_t>>;

/// Whether there may be chains of nodes worth a parser of our own.
[[nodiscard]] bool many_parents(std::string_view json) {
    constexpr std::string_view key = "\"children\"";
    std::size_t parents = 0;
    for (std::size_t at = 0; (at = json.find(key, at)) != std::string_view::npos; ++at) ++parents;
    return parents >= deepest_node;
}

/// The children of each node, which glTF names by number.
[[nodiscard]] node_lists children_of(const source& gltf, std::string_view json) {
    json = json.substr(0, json.find_last_not_of('\0') + 1);
    const auto scene = nlohmann::ordered_json::parse(json, nullptr, false);
    if (scene.is_discarded()) gltf.fail("its JSON has errors");
    if (!scene.is_object() || !scene.contains("nodes") || !scene["nodes"].is_array()) return {};
    const auto& nodes = scene["nodes"];
    node_lists children(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (!nodes[n].is_object() || !nodes[n].contains("children")) continue;
        for (const auto& child : nodes[n]["children"])
            if (child.is_number_unsigned() && child.get<std::size_t>() < nodes.size())
                children[n].push_back(child.get<std::size_t>());
    }
    return children;
}

/// Nodes are loaded recursively, too. Parents before children: the depth of a node is known when
/// the last of its parents has been seen.
void refuse_deep_nodes(const source& gltf, const node_lists& children) {
    std::vector<std::size_t> parents_left(children.size());
    for (const auto& list : children)
        for (const std::size_t child : list) ++parents_left[child];
    std::vector<std::size_t> order;
    for (std::size_t n = 0; n < children.size(); ++n)
        if (parents_left[n] == 0) order.push_back(n);
    std::vector<std::size_t> depth(children.size(), 1);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t node = order[i];
        if (depth[node] > deepest_node)
            gltf.fail("node " + std::to_string(node) + " is more than " +
                      std::to_string(deepest_node) + " levels deep");
        for (const std::size_t child : children[node]) {
            depth[child] = std::max(depth[child], depth[node] + 1);
            if (--parents_left[child] == 0) order.push_back(child);
        }
    }
    if (order.size() < children.size()) gltf.fail("a node is its own descendant");
}

}  // namespace

void refuse_deep_json(const source& gltf) {
    const std::string_view json = json_of(gltf);
    refuse_deep_brackets(gltf, json);
    if (many_parents(json)) refuse_deep_nodes(gltf, children_of(gltf, json));
}

}  // namespace treeform::detail::io
