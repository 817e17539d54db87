#include <libmesh/io/xml_text.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::detail::io {

namespace {

/// A character, and how many bytes it takes; a length of zero for what is no UTF-8.
struct character {
    std::uint32_t code = 0;
    std::size_t length = 0;
};

[[nodiscard]] character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
    std::uint32_t code = lead & (0x7fU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0U) != 0x80U) return {};
        code = code << 6 | (byte(i) & 0x3fU);
    }
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    if (code < least[length] || code > 0x10ffff || surrogate) return {};
    return {code, length};
}

[[nodiscard]] bool xml_holds(const character& c) {
    return c.length > 0 && c.code >= ' ' && c.code != 0xfffe && c.code != 0xffff;
}

}  // namespace

std::string xml_text(std::string_view text) {
    std::string safe;
    while (!text.empty()) {
        const character c = first_character(text);
        const std::string_view bytes = text.substr(0, c.length > 0 ? c.length : 1);
        text.remove_prefix(bytes.size());
        if (c.code == '\n' || c.code == '\r' || c.code == '\t')
            safe += ' ';
        else if (c.code == '&')
            safe += "&amp;";
        else if (c.code == '<')
            safe += "&lt;";
        else if (c.code == '>')
            safe += "&gt;";
        else if (c.code == '"')
            safe += "&quot;";
        else if (xml_holds(c))
            safe += bytes;
        else
            safe += "\xef\xbf\xbd";
    }
    return safe;
}

}  // namespace treeform::detail::io
