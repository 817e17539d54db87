#pragma once
/// \file
/// What the library returns, in reports and in sentences.

#include "tools/picture/json.hpp"
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace tools {

/// As a report has it: indented, but what is in a list and has no more than lists of numbers in it,
/// such as a row, a point or a contact, in one line. What is not UTF-8 becomes U+FFFD.
[[nodiscard]] std::string report_text(const json& report);

/// `value`, or null where there is nothing to say.
template <class T>
[[nodiscard]] json or_null(bool given, const T& value) {
    return given ? json(value) : json(nullptr);
}

/// "(0, 0, 1.5)"
[[nodiscard]] std::string in_words(const tf::point3& p);

/// "float" or "double", as in reports and options.
[[nodiscard]] const char* name_of(tf::precision precision);
/// "float32" or "double", for sentences.
[[nodiscard]] const char* numbers_of(tf::precision precision);

/// The number in the file of a face that was computed with.
using face_numbers = std::function<std::uint32_t(std::uint32_t)>;

/// Where the surface ends.
[[nodiscard]] json open_entry(const tf::certificate& known, const face_numbers& face_in_file);
/// The faces that meet.
[[nodiscard]] json meeting_entry(const tf::certificate& known);
/// What was lost, where that is more than is allowed; else null.
[[nodiscard]] json loss_entry(const tf::certificate& known);
/// What each step has done; null of one that was left out.
[[nodiscard]] json steps_entry(const tf::repair_statistics& did, const tf::repair_options& steps);
/// The message of the counts, or "nothing to repair".
[[nodiscard]] std::string repair_summary(const tf::repair_statistics& did);
/// Its message, with the face by its number in the file.
[[nodiscard]] std::string message_of(tf::certificate known, const face_numbers& face_in_file);

}  // namespace tools
