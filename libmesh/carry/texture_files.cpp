#include <libmesh/carry/texture_files.hpp>
#include <treeform/mesh/carry.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace treeform {

using detail::carry::texture_numbers;

namespace {

constexpr const char* number_name = "texnumber";
constexpr std::int32_t no_texture = -1;

class renumberer {
  public:
    /// Whether faces have to say which texture is theirs.
    [[nodiscard]] bool enter(const mesh_file& file) {
        const attributes& all = file.attributes;
        for (const std::string& name : all.texture_files)
            if (place_of_.try_emplace(name, static_cast<std::int32_t>(names_.size())).second)
                names_.push_back(name);
        return texture_numbers(file) != nullptr ||
               (all.texture_files.empty() && !all.corners.texture_of_corner.empty());
    }

    void renumber(mesh_file& file, const std::string& name) {
        std::vector<std::int32_t> places;
        for (const std::string& own : file.attributes.texture_files)
            places.push_back(place_of_.at(own));
        std::vector<std::int32_t> numbers(file.stored_faces,
                                          places.empty() ? no_texture : places.front());
        const column* const given = texture_numbers(file);
        std::uint64_t wrong = 0;
        for (std::size_t f = 0; given != nullptr && f < numbers.size(); ++f) {
            const double n = given->number(f);
            const bool names_one =
                n >= 0.0 && n < static_cast<double>(places.size()) && n == std::floor(n);
            numbers[f] = names_one ? places[static_cast<std::size_t>(n)] : no_texture;
            if (!names_one && n != no_texture) ++wrong;
        }
        if (wrong > 0)
            warn(name, std::to_string(wrong) + (wrong == 1 ? " face has a" : " faces have a") +
                           " " + number_name + " without a texture file; replaced by -1");
        const bool was_there = given != nullptr;
        element& faces = file.attributes.find_or_add("face", file.stored_faces);
        if (faces.set(column::of<std::int32_t>(number_name, numbers)) && !was_there)
            warn(name, std::string("lists ") + number_name + " of faces are replaced by numbers");
    }

    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] std::vector<io_warning>& warnings() { return warnings_; }

  private:
    void warn(const std::string& name, const std::string& text) {
        warnings_.push_back({"textures", name + ": " + text});
    }

    std::map<std::string, std::int32_t> place_of_{};
    std::vector<std::string> names_{};
    std::vector<io_warning> warnings_{};
};

}  // namespace

const column* detail::carry::texture_numbers(const mesh_file& file) {
    const element* faces = file.attributes.find("face");
    const column* c = faces == nullptr ? nullptr : faces->find(number_name);
    return c == nullptr || c->role != column_role::data || c->list_length ? nullptr : c;
}

std::vector<io_warning> unite_textures(std::span<mesh_file* const> files,
                                       std::span<const std::string> names) {
    if (files.size() < 2) return {};
    renumberer all;
    bool numbered = false;
    for (const mesh_file* file : files) numbered |= all.enter(*file);
    if (all.names().empty()) return {};
    numbered = numbered || all.names().size() > 1;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (numbered && files[i]->stored_faces > 0) all.renumber(*files[i], names[i]);
        files[i]->attributes.texture_files = all.names();
    }
    return std::move(all.warnings());
}

}  // namespace treeform
