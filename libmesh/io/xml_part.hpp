#pragma once
/// \file
/// An XML part of a package: its elements, and errors that name the part and the byte.

#include <libmesh/io/source.hpp>

#include <pugixml.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace treeform::detail::io {

class xml_part {
  public:
    /// `name` is the name of the part in its archive, `text` its content. `in` must outlive the
    /// part.
    ///
    /// \throws io_error for text that is not XML, or that has a document type, whose entities can
    ///         expand without limit
    xml_part(const source& in, std::string_view name, std::string text);
    xml_part(const xml_part&) = delete;
    xml_part& operator=(const xml_part&) = delete;
    ~xml_part() = default;

    [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }

    /// The value of an attribute. \throws io_error if it is missing
    [[nodiscard]] const char* required(pugi::xml_node element, const char* attribute) const;
    /// A finite number, rounded once to the nearest double. \throws io_error
    [[nodiscard]] double number(pugi::xml_node element, const char* attribute) const;
    /// A nonnegative integer below 2^31, the limit of the format. \throws io_error
    [[nodiscard]] std::uint32_t integer(pugi::xml_node element, const char* attribute) const;
    /// The same for an attribute that may be missing.
    [[nodiscard]] std::optional<std::uint32_t> optional_integer(pugi::xml_node element,
                                                                const char* attribute) const;

    /// Throws io_error "file: part: byte N: <element>: reason".
    [[noreturn]] void fail(pugi::xml_node at, std::string_view reason) const;
    /// Throws io_error "file: part: reason".
    [[noreturn]] void fail(std::string_view reason) const;

  private:
    const source& in_;
    std::string name_;
    std::string text_;  ///< modified by the parser, whose strings point into it
    pugi::xml_document document_{};
};

/// The name of an element without the prefix of its namespace.
[[nodiscard]] std::string_view local_name(std::string_view name);

/// "m:" of "m:color"; empty for a name without a prefix.
[[nodiscard]] std::string_view prefix_of(std::string_view name);

/// The namespace of `prefix`, which includes its colon or is empty, in `element`; empty if there is
/// none. Only the first hundred attributes of an element are searched for declarations.
[[nodiscard]] std::string_view namespace_of(pugi::xml_node element, std::string_view prefix);

/// Valid UTF-8 for an attribute, escaped: blanks for newlines and tabs; U+FFFD for bytes that are
/// not UTF-8, and for characters that XML does not allow.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace treeform::detail::io
