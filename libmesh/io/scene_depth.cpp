#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/scene_depth.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

namespace {

constexpr std::size_t deepest_scene = 1000;
constexpr std::size_t npos = std::string_view::npos;

/// `at` is where the thousand and first level begins.
[[noreturn]] void refuse_depth(const source& in, std::size_t at) {
    in.fail("byte " + std::to_string(at) + ": nested more than " + std::to_string(deepest_scene) +
            " levels deep");
}

/// Behind the next `end` from `at` on; the end of the text where there is none.
std::size_t behind(std::string_view text, std::string_view end, std::size_t at) {
    const std::size_t found = text.find(end, at);
    return found == npos ? text.size() : found + end.size();
}

/// Behind the tag that begins at `at`; a '>' in quotes is not its end.
std::size_t end_of_tag(std::string_view xml, std::size_t at) {
    while ((at = xml.find_first_of(">\"'", at)) != npos) {
        if (xml[at] == '>') return at + 1;
        at = behind(xml, xml.substr(at, 1), at + 1);
    }
    return xml.size();
}

void refuse_deep_tags(const source& in, std::string_view xml) {
    std::size_t depth = 0;
    for (std::size_t at = xml.find('<'); at != npos; at = xml.find('<', at)) {
        const std::string_view rest = xml.substr(at);
        if (rest.starts_with("<!--")) {
            at = behind(xml, "-->", at);
        } else if (rest.starts_with("<![CDATA[")) {
            at = behind(xml, "]]>", at);
        } else if (rest.starts_with("<?")) {
            at = behind(xml, "?>", at);
        } else if (rest.starts_with("</") || rest.starts_with("<!")) {
            depth -= rest[1] == '/' && depth > 0 ? 1 : 0;
            at = behind(xml, ">", at);
        } else {
            const std::size_t end = end_of_tag(xml, at);
            if (xml[end - 1] != '>' || xml[end - 2] != '/') ++depth;
            if (depth > deepest_scene) refuse_depth(in, at);
            at = end;
        }
    }
}

/// Braces, except for those in double quotes and, to the end of the line, behind a character of
/// `comment` or two slashes, if that has one.
void refuse_deep_braces(const source& in, std::string_view text, const std::string& comment) {
    std::size_t depth = 0;
    const std::string special = "{}\"" + comment;
    for (std::size_t at = text.find_first_of(special); at != npos;
         at = text.find_first_of(special, at)) {
        const char c = text[at++];
        const bool two = text.substr(at).starts_with('/');
        if (comment.find(c) != npos && (c != '/' || two)) at = behind(text, "\n", at);
        if (c == '"') at = behind(text, "\"", at);
        if (c == '{' && ++depth > deepest_scene) refuse_depth(in, at - 1);
        if (c == '}' && depth > 0) --depth;
    }
}

/// A record of binary FBX: where it ends, how many properties it has and how many bytes they are,
/// its name and they, and what it holds; a record of zeros ends a list of them.
template <class Size>
void refuse_deep_records(const source& in, std::string_view fbx) {
    constexpr std::size_t head = 3 * sizeof(Size) + 1;
    std::vector<std::uint64_t> ends{fbx.size()};
    std::size_t at = 27;
    while (fbx.size() - at >= head) {
        while (ends.size() > 1 && at >= ends.back()) ends.pop_back();
        const char* const record = fbx.data() + at;
        const std::uint64_t end = base::load<Size, std::endian::little>(record);
        const std::uint64_t bytes =
            base::load<Size, std::endian::little>(record + 2 * sizeof(Size));
        const std::uint64_t name = static_cast<unsigned char>(record[head - 1]);
        at += head;
        if (end == 0) continue;
        if (end < at || end > fbx.size() || bytes > end - at || name > end - at - bytes) return;
        at += bytes + name;
        if (at == end) continue;
        ends.push_back(end);
        if (ends.size() > deepest_scene) refuse_depth(in, at);
    }
}

}  // namespace

void refuse_deep_scene(const source& scene) {
    const std::string_view all(scene.begin(), scene.size());
    constexpr std::string_view fbx = "Kaydara FBX Binary";
    if (all.starts_with(fbx) && all.size() > 27) {
        const auto version = base::load<std::uint32_t, std::endian::little>(all.data() + 23);
        if (version >= 7500) return refuse_deep_records<std::uint64_t>(scene, all);
        return refuse_deep_records<std::uint32_t>(scene, all);
    }
    if (all.starts_with("xof ") && all.size() > 11 && all.substr(8, 3) == "txt")
        return refuse_deep_braces(scene, all, "#/");
    // In UTF-16 and UTF-32, what matters here is plain characters with zeros between them.
    const std::string_view start = all.substr(0, 512);
    std::string narrow;
    const bool wide = start.find('\0') != npos;
    std::copy_if(start.begin(), start.end(), std::back_inserter(narrow),
                 [](char c) { return c != '\0'; });
    const std::size_t first = narrow.find_first_not_of("\xEF\xBB\xBF\xFE\xFF \t\r\n");
    const char begin = first == npos ? '\0' : narrow[first];
    if ((begin == ';' || begin == 'F') && narrow.find("FBX") != npos)
        return refuse_deep_braces(scene, all, ";");
    if (begin != '<') return;
    if (!wide) return refuse_deep_tags(scene, all);
    std::string text;
    std::copy_if(all.begin(), all.end(), std::back_inserter(text),
                 [](char c) { return c != '\0'; });
    refuse_deep_tags(scene, text);
}

}  // namespace treeform::detail::io
