#include <libmesh/io/detail/byte_order.hpp>
#include <libmesh/io/detail/json_depth.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace tf::detail {

namespace {

constexpr std::size_t deepest = 500;

/// Of binary glTF, of both versions, the first chunk; its length is four bytes at 12.
[[nodiscard]] std::string_view json_of(const source& in) {
    const std::string_view all(in.begin(), in.size());
    constexpr std::size_t head = 20;
    if (!all.starts_with("glTF")) return all;
    if (all.size() < head) return {};
    return all.substr(head, load<std::uint32_t, std::endian::little>(in.begin() + 12));
}

/// The quote that ends the string which starts before `at`, or `end`.
[[nodiscard]] const char* end_of_string(const char* at, const char* end) {
    while (at != end && *at != '"') at += *at == '\\' && end - at > 1 ? 2 : 1;
    return at;
}

}  // namespace

void refuse_deep_json(const source& gltf) {
    const std::string_view json = json_of(gltf);
    const char* const end = json.data() + json.size();
    std::size_t depth = 0;
    for (const char* at = json.data(); at != end; ++at) {
        if (*at == '"') {
            at = end_of_string(at + 1, end);
            if (at == end) return;
        } else if (*at == '[' || *at == '{') {
            if (++depth > deepest)
                gltf.fail_byte(at,
                               "JSON nested more than " + std::to_string(deepest) + " levels deep");
        } else if (*at == ']' || *at == '}') {
            if (depth == 0) return;
            --depth;
        }
    }
}

}  // namespace tf::detail
