#include <libmesh/io/json_depth.hpp>

#include <cstddef>
#include <string>

namespace treeform::detail::io {

namespace {

constexpr std::size_t deepest_json = 500;

/// The quote that ends the string which starts before `at`, or `end`.
[[nodiscard]] const char* end_of_string(const char* at, const char* end) {
    while (at != end && *at != '"') at += *at == '\\' && end - at > 1 ? 2 : 1;
    return at;
}

}  // namespace

void refuse_deep_json(const source& in, std::string_view json) {
    const char* const end = json.data() + json.size();
    std::size_t depth = 0;
    for (const char* at = json.data(); at != end; ++at) {
        if (*at == '"') {
            at = end_of_string(at + 1, end);
            if (at == end) return;
        } else if (*at == '[' || *at == '{') {
            if (++depth > deepest_json)
                in.fail_byte(
                    at, "JSON nested more than " + std::to_string(deepest_json) + " levels deep");
        } else if (*at == ']' || *at == '}') {
            if (depth == 0) return;
            --depth;
        }
    }
}

}  // namespace treeform::detail::io
