#pragma once
/// \file
/// A part of a package that is XML: its elements, and errors that name the part and the byte.

#include <libmesh/io/source.hpp>

#include <pugixml.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace treeform::detail::io {

class xml_part {
  public:
    /// `name` is that of the part in its archive, `text` what it holds. `in` must outlive the part.
    ///
    /// \throws io_error for text that is no XML or that has a document type: with entities of its
    ///         own, little text can stand for much
    xml_part(const source& in, std::string_view name, std::string text);
    xml_part(const xml_part&) = delete;
    xml_part& operator=(const xml_part&) = delete;
    ~xml_part() = default;

    [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
    [[nodiscard]] const std::string& name() const { return name_; }

    /// The value of an attribute. \throws io_error when it is missing
    [[nodiscard]] const char* required(pugi::xml_node element, const char* attribute) const;
    /// A finite number, rounded once to the nearest double. \throws io_error
    [[nodiscard]] double number(pugi::xml_node element, const char* attribute) const;
    /// A whole number from 0 on, less than 2^31 as in the format. \throws io_error
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
    std::string text_;  ///< changed by the parser, whose strings lie in it
    pugi::xml_document document_{};
};

/// The name of an element without the prefix of its namespace.
[[nodiscard]] std::string_view local_name(std::string_view name);

/// "m:" of "m:color"; empty for a name without a prefix.
[[nodiscard]] std::string_view prefix_of(std::string_view name);

/// The namespace that names with `prefix`, which has its colon or is empty, have in `element`;
/// empty when it has none. Declarations stand among the first hundred attributes of their element.
[[nodiscard]] std::string_view namespace_of(pugi::xml_node element, std::string_view prefix);

}  // namespace treeform::detail::io
