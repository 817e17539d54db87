#include "tools/common/texture_files.hpp"

#include "tools/common/console.hpp"
#include <treeform/tf.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>

namespace tools {
namespace {

constexpr const char* number_name = "texnumber";
constexpr std::int32_t no_texture = -1;

class renumberer {
  public:
    /// Whether faces have to say which texture is theirs.
    [[nodiscard]] bool enter(const tf::mesh_file& file) {
        const tf::attributes& all = file.attributes;
        for (const std::string& name : all.texture_files)
            if (place_of_.try_emplace(name, static_cast<std::int32_t>(names_.size())).second)
                names_.push_back(name);
        return texture_numbers(file) != nullptr ||
               (all.texture_files.empty() && !all.corners.texture_of_corner.empty());
    }

    void renumber(tf::mesh_file& file, const std::string& name) {
        std::vector<std::int32_t> places;
        for (const std::string& own : file.attributes.texture_files)
            places.push_back(place_of_.at(own));
        std::vector<std::int32_t> numbers(file.stored_faces,
                                          places.empty() ? no_texture : places.front());
        const tf::column* const given = texture_numbers(file);
        std::uint64_t wrong = 0;
        for (std::size_t f = 0; given != nullptr && f < numbers.size(); ++f) {
            const double n = tf::number_at(*given, f);
            const bool names_one =
                n >= 0.0 && n < static_cast<double>(places.size()) && n == std::floor(n);
            numbers[f] = names_one ? places[static_cast<std::size_t>(n)] : no_texture;
            if (!names_one && n != no_texture) ++wrong;
        }
        if (wrong > 0)
            warn(name, counted(wrong, "face has a", "faces have a") + " " + number_name +
                           " that names no texture file; -1 there");
        const bool was_there = given != nullptr;
        tf::element& faces = tf::obtain_element(file.attributes, "face", file.stored_faces);
        if (tf::set_column(faces, tf::make_column<std::int32_t>(number_name, numbers)) &&
            !was_there)
            warn(name, std::string("lists ") + number_name + " of faces are replaced by numbers");
    }

    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] std::vector<tf::io_warning>& warnings() { return warnings_; }

  private:
    void warn(const std::string& name, const std::string& text) {
        warnings_.push_back({"textures", name + ": " + text});
    }

    std::map<std::string, std::int32_t> place_of_{};
    std::vector<std::string> names_{};
    std::vector<tf::io_warning> warnings_{};
};

}  // namespace

const tf::column* texture_numbers(const tf::mesh_file& file) {
    const tf::element* faces = tf::find_element(file.attributes, "face");
    const tf::column* c = faces == nullptr ? nullptr : tf::find_column(*faces, number_name);
    return c == nullptr || c->role != tf::column_role::data || c->list_length ? nullptr : c;
}

std::vector<tf::io_warning> unite_textures(std::span<tf::mesh_file* const> files,
                                           std::span<const std::string> names) {
    if (files.size() < 2) return {};
    renumberer all;
    bool numbered = false;
    for (const tf::mesh_file* file : files) numbered |= all.enter(*file);
    if (all.names().empty()) return {};
    numbered = numbered || all.names().size() > 1;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (numbered && files[i]->stored_faces > 0) all.renumber(*files[i], names[i]);
        files[i]->attributes.texture_files = all.names();
    }
    return std::move(all.warnings());
}

}  // namespace tools
