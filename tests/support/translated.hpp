#pragma once
/// \file
/// Files written in one format and read from another, and what is said of that.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>

#include <support/las_bytes.hpp>
#include <support/own_folder.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace test {

namespace tf = treeform;

using sentences = std::vector<std::string>;

inline tf::mesh_file read_translated(const std::string& bytes, const std::string& format,
                                     const tf::read_options& options = {}) {
    return tf::read(std::as_bytes(std::span(bytes)), "memory." + format, format, options);
}

/// A file as bytes, and what was said of it.
struct translated_file {
    std::string bytes{};
    sentences warnings{};
};

inline translated_file put_translated(const tf::mesh_file& file, const std::string& format,
                                      tf::write_options how = {}) {
    const test::own_folder folder("io_translation");
    const auto path = folder.path / ("file." + format);
    how.format = format;
    translated_file made;
    for (const tf::io_warning& w : tf::write(path, file, how).warnings)
        made.warnings.push_back(w.code + ": " + w.text);
    made.bytes = test::bytes_of(path);
    return made;
}

inline tf::mesh_file passed_through(const tf::mesh_file& file, const std::string& format) {
    return read_translated(put_translated(file, format).bytes, format);
}

inline const tf::column* translated_column(const tf::mesh_file& file, std::string_view name) {
    const tf::element* const e = file.attributes.find("vertex");
    return e == nullptr ? nullptr : e->find(name);
}

inline std::vector<double> translated_numbers(const tf::mesh_file& file, std::string_view name) {
    std::vector<double> values;
    if (const tf::column* const c = translated_column(file, name))
        for (std::size_t i = 0; i < c->size(); ++i) values.push_back(c->number(i));
    return values;
}

template <class T>
void add_translated(tf::mesh_file& file, const char* name, std::vector<T> values) {
    file.attributes.find_or_add("vertex", file.mesh.points.size())
        .columns.push_back(tf::column::of<T>(name, values));
}

inline bool is_named_in(const sentences& warnings, const std::string& property) {
    return std::ranges::any_of(warnings, [&](const std::string& w) {
        return (" " + w).find(" " + property) != std::string::npos;
    });
}

}  // namespace test
