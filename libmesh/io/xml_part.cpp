#include <libmesh/io/number.hpp>
#include <libmesh/io/text.hpp>
#include <libmesh/io/xml_part.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <utility>

namespace treeform::detail::io {

namespace {

/// A value without the blanks around it, which XML says mean nothing in numbers.
[[nodiscard]] std::string_view trimmed(const char* value) {
    std::string_view text(value);
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

/// Attributes of an element that may declare namespaces. It is asked for many elements within, so
/// that a hundred thousand would take hours.
constexpr int most_declarations = 100;

[[nodiscard]] std::string named(const char* attribute, std::string_view value) {
    return std::string(attribute) + "=" + quoted(value.data(), value.data() + value.size());
}

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

xml_part::xml_part(const source& in, std::string_view name, std::string text)
    : in_(in), name_(name), text_(std::move(text)) {
    constexpr unsigned what =
        pugi::parse_escapes | pugi::parse_wconv_attribute | pugi::parse_doctype;
    const pugi::xml_parse_result result =
        document_.load_buffer_inplace(text_.data(), text_.size(), what);
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!result)
        fail("byte " + std::to_string(result.offset) + ": invalid XML: " + result.description());
    for (const pugi::xml_node node : document_.children())
        if (node.type() == pugi::node_doctype)
            fail("a document type declaration is not allowed, since it may define entities");
}

const char* xml_part::required(pugi::xml_node element, const char* attribute) const {
    const pugi::xml_attribute found = element.attribute(attribute);
    if (!found) fail(element, "has no " + std::string(attribute));
    return found.value();
}

double xml_part::number(pugi::xml_node element, const char* attribute) const {
    const std::string_view value = trimmed(required(element, attribute));
    const char* const end = value.data() + value.size();
    const parsed<double> number = parse_number(value.data(), end);
    if (number.end != end || number.hexadecimal)  // which the format does not know
        fail(element, named(attribute, value) + " is not a number");
    if (!std::isfinite(number.value)) fail(element, named(attribute, value) + " is not finite");
    return number.value;
}

std::uint32_t xml_part::integer(pugi::xml_node element, const char* attribute) const {
    const std::string_view value = trimmed(required(element, attribute));
    const char* const end = value.data() + value.size();
    const parsed<std::int64_t> number = parse_integer(value.data(), end);
    if (number.end != end || number.value < 0 || number.value > 0x7fffffff)
        fail(element, named(attribute, value) + " is not an integer from 0 to 2147483647");
    return static_cast<std::uint32_t>(number.value);
}

std::optional<std::uint32_t> xml_part::optional_integer(pugi::xml_node element,
                                                        const char* attribute) const {
    if (!element.attribute(attribute)) return std::nullopt;
    return integer(element, attribute);
}

void xml_part::fail(pugi::xml_node at, std::string_view reason) const {
    const std::string_view name = at.name();
    fail("byte " + std::to_string(at.offset_debug()) + ": <" + std::string(name.substr(0, 40)) +
         "> " + std::string(reason));
}

void xml_part::fail(std::string_view reason) const { in_.fail(name_ + ": " + std::string(reason)); }

std::string_view local_name(std::string_view name) { return name.substr(prefix_of(name).size()); }

std::string_view prefix_of(std::string_view name) {
    const std::size_t colon = name.find(':');
    return colon == name.npos ? std::string_view() : name.substr(0, colon + 1);
}

std::string_view namespace_of(pugi::xml_node element, std::string_view prefix) {
    const std::string declaration =
        prefix.empty() ? "xmlns" : "xmlns:" + std::string(prefix.substr(0, prefix.size() - 1));
    for (pugi::xml_node node = element; node; node = node.parent()) {
        int seen = 0;
        for (const pugi::xml_attribute a : node.attributes()) {
            if (declaration == a.name()) return a.value();
            if (++seen == most_declarations) break;
        }
    }
    return {};
}

std::string xml_text(std::string_view text) {
    constexpr std::string_view special = "\n\r\t&<>\"";
    constexpr std::string_view instead[] = {" ", " ", " ", "&amp;", "&lt;", "&gt;", "&quot;"};
    std::string safe;
    while (!text.empty()) {
        const character c = first_character(text);
        const std::string_view bytes = text.substr(0, c.length > 0 ? c.length : 1);
        text.remove_prefix(bytes.size());
        const std::size_t at =
            c.code < 0x80 ? special.find(static_cast<char>(c.code)) : special.npos;
        if (at != special.npos)
            safe += instead[at];
        else if (xml_holds(c))
            safe += bytes;
        else
            safe += "\xef\xbf\xbd";
    }
    return safe;
}

}  // namespace treeform::detail::io
