#include <libmesh/base/compact.hpp>
#include <libmesh/boolean/merged_cuts.hpp>
#include <libmesh/boolean/merged_faces.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace treeform::detail::boolean {
namespace {

/// The faces that were cut, and those with an edge between points of these.
std::vector<std::uint32_t> faces_at_cuts(const exact_surface& surface) {
    std::vector<std::uint8_t> is_end(surface.given.size() + surface.constructed.size(), 0);
    for_chunks(surface.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f)
                       if (surface.sound[f] == 0)
                           for (const std::uint32_t p : surface.faces[f])
                               std::atomic_ref(is_end[p]).store(1, std::memory_order_relaxed);
               });
    std::vector<std::uint32_t> found;
    base::compact(
        surface.faces.size(),
        [&](std::size_t f) {
            const auto& [p, q, r] = surface.faces[f];
            return is_end[p] + is_end[q] + is_end[r] >= 2;
        },
        [&](std::size_t count) { found.resize(count); },
        [&](std::size_t f, std::size_t place) { found[place] = static_cast<std::uint32_t>(f); });
    return found;
}

/// Some faces of a surface, with points of their own. Takes the constructed ones, and gives them
/// back when it is destroyed.
class part_of_surface {
  public:
    part_of_surface(exact_surface& whole, const std::vector<std::uint32_t>& faces) : whole_(whole) {
        for (const std::uint32_t f : faces)
            for (const std::uint32_t p : whole.faces[f])
                if (p < whole.given.size()) point_of_.push_back(p);
        std::sort(point_of_.begin(), point_of_.end());
        point_of_.erase(std::unique(point_of_.begin(), point_of_.end()), point_of_.end());
        for (const std::uint32_t p : point_of_) part_.given.push_back(whole.given[p]);
        for (const std::uint32_t f : faces) {
            part_.faces.push_back(whole.faces[f]);
            for (std::uint32_t& p : part_.faces.back()) p = to_part(p);
            part_.sound.push_back(whole.sound[f]);
        }
        part_.constructed = std::move(whole.constructed);
    }
    part_of_surface(const part_of_surface&) = delete;
    part_of_surface& operator=(const part_of_surface&) = delete;
    ~part_of_surface() { whole_.constructed = std::move(part_.constructed); }

    [[nodiscard]] const exact_surface& surface() const { return part_; }
    [[nodiscard]] face to_whole(const face& f) const {
        face result = f;
        for (std::uint32_t& p : result)
            p = p < point_of_.size()
                    ? point_of_[p]
                    : static_cast<std::uint32_t>(p - point_of_.size() + whole_.given.size());
        return result;
    }

  private:
    [[nodiscard]] std::uint32_t to_part(std::uint32_t p) const {
        if (p >= whole_.given.size())
            return static_cast<std::uint32_t>(p - whole_.given.size() + point_of_.size());
        return static_cast<std::uint32_t>(std::lower_bound(point_of_.begin(), point_of_.end(), p) -
                                          point_of_.begin());
    }

    exact_surface& whole_;
    exact_surface part_{};
    std::vector<std::uint32_t> point_of_{};  ///< given ones, ascending
};

/// All but `of_face`: where the faces of before went, of which those `listed` were merged.
void tell(face_origins& origins, const std::vector<std::uint32_t>& source_of,
          const std::vector<std::uint32_t>& listed, const merged_faces& merged) {
    origins.source = source_of;
    origins.merged_into.resize(source_of.size());
    std::iota(origins.merged_into.begin(), origins.merged_into.end(), 0U);
    for (std::size_t i = 0; i < listed.size(); ++i)
        origins.merged_into[listed[i]] = listed[merged.merged_into[i]];
}

}  // namespace

std::vector<std::uint32_t> groups_of(const boolean_options& options,
                                     std::span<const std::uint32_t> number_of_face,
                                     std::size_t count) {
    const std::span<const std::uint32_t> given = options.face_groups;
    if (given.empty() || !merges_faces(options)) return {};
    if (given.size() != count)
        throw std::invalid_argument("treeform::boolean: not as many face groups as faces");
    if (number_of_face.empty()) return {given.begin(), given.end()};
    std::vector<std::uint32_t> groups;
    groups.reserve(number_of_face.size());
    for (const std::uint32_t f : number_of_face) groups.push_back(given[f]);
    return groups;
}

std::vector<std::uint32_t> merge_cuts(exact_surface& surface, std::vector<std::uint32_t>& source_of,
                                      std::span<const face> input,
                                      std::span<const std::uint32_t> group_of,
                                      const boolean_options& options, face_origins* origins) {
    if (!merges_faces(options)) return {};
    std::vector<std::uint32_t> listed;
    if (options.simplify) {
        listed.resize(surface.faces.size());
        std::iota(listed.begin(), listed.end(), 0U);
    } else {
        listed = faces_at_cuts(surface);
    }
    std::vector<std::uint32_t> source_of_point(surface.constructed.size(), operand_element::none);
    for (std::size_t i = listed.size(); i-- > 0;)
        for (const std::uint32_t p : surface.faces[listed[i]])
            if (p >= surface.given.size())
                source_of_point[p - surface.given.size()] = source_of[listed[i]];
    std::vector<std::uint32_t> plane_of;
    plane_of.reserve(listed.size());
    for (const std::uint32_t f : listed) plane_of.push_back(source_of[f]);
    merged_faces merged;
    {
        const part_of_surface part(surface, listed);
        const std::vector<std::uint8_t>& sound = part.surface().sound;
        merged = merge_coplanar(
            part.surface(), {.mesh = {surface.given, input},
                             .plane_of = plane_of,
                             .group_of = group_of,
                             .stays = options.simplify ? std::span<const std::uint8_t>() : sound});
        for (face& f : merged.faces) f = part.to_whole(f);
    }
    if (origins != nullptr) tell(*origins, source_of, listed, merged);
    std::vector<face> faces;
    std::vector<std::uint8_t> sound;
    std::vector<std::uint32_t> source;
    const std::size_t count = surface.faces.size() - listed.size() + merged.faces.size();
    faces.reserve(count);
    sound.reserve(count);
    source.reserve(count);
    const auto put = [&](const face& corners, std::size_t f, bool is_new) {
        faces.push_back(corners);
        sound.push_back(is_new ? std::uint8_t{0} : surface.sound[f]);
        source.push_back(source_of[f]);
        if (origins != nullptr) origins->of_face.push_back(static_cast<std::uint32_t>(f));
    };
    for (std::size_t f = 0, part = 0, next = 0; f < surface.faces.size(); ++f) {
        if (part == listed.size() || listed[part] != f) {
            put(surface.faces[f], f, false);
            continue;
        }
        for (; next < merged.faces.size() && merged.face_of[next] == part; ++next)
            put(merged.faces[next], f, merged.is_new[next] != 0);
        ++part;
    }
    surface.faces = std::move(faces);
    surface.sound = std::move(sound);
    source_of = std::move(source);
    return source_of_point;
}

}  // namespace treeform::detail::boolean
