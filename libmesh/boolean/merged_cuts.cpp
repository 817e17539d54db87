#include <libmesh/base/compact.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/boolean/merged_cuts.hpp>
#include <libmesh/boolean/merged_faces.hpp>
#include <treeform/tree/detail/buffer.hpp>
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
                       if (surface.certified[f] == 0)
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

/// Calls `visit(i, number)` for all numbers.
template <class Visit>
void for_listed(const std::vector<std::uint32_t>& numbers, const Visit& visit) {
    for_chunks(numbers.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) visit(i, numbers[i]);
    });
}

/// Some faces of a surface, with points of their own. Takes the constructed ones, and gives them
/// back when it is destroyed.
class part_of_surface {
  public:
    part_of_surface(exact_surface& whole, const std::vector<std::uint32_t>& faces) : whole_(whole) {
        const std::size_t given = whole.given.size();
        base::resize_all(faces.size(), part_.faces, part_.certified);
        for_listed(faces, [&](std::size_t i, std::uint32_t f) {
            part_.faces[i] = whole.faces[f];
            part_.certified[i] = whole.certified[f];
        });
        point_of_ = base::used_points(given + whole.constructed.size(), part_.faces);
        point_of_.resize(static_cast<std::size_t>(std::ranges::lower_bound(point_of_, given) -
                                                  point_of_.begin()));
        buffer<std::uint32_t> number(given);
        part_.given.resize(point_of_.size());
        for_listed(point_of_, [&](std::size_t i, std::uint32_t p) {
            number[p] = static_cast<std::uint32_t>(i);
            part_.given[i] = whole.given[p];
        });
        for_listed(faces, [&](std::size_t i, std::uint32_t) {
            for (std::uint32_t& p : part_.faces[i])
                p = p < given ? number[p]
                              : static_cast<std::uint32_t>(p - given + point_of_.size());
        });
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
    exact_surface& whole_;
    exact_surface part_{};
    std::vector<std::uint32_t> point_of_{};  ///< given ones, ascending
};

/// All but `of_face`: where the faces of before went, of which those `listed` were merged.
void report(face_origins& origins, const std::vector<std::uint32_t>& source_of,
            const std::vector<std::uint32_t>& listed, const merged_faces& merged) {
    origins.source = source_of;
    origins.merged_into.resize(source_of.size());
    std::iota(origins.merged_into.begin(), origins.merged_into.end(), 0U);
    for (std::size_t i = 0; i < listed.size(); ++i)
        origins.merged_into[listed[i]] = listed[merged.merged_into[i]];
}

/// Those `listed` among the faces of the surface become what they were merged into.
void put_merged(exact_surface& surface, std::vector<std::uint32_t>& source_of,
                const std::vector<std::uint32_t>& listed, const merged_faces& merged,
                face_origins* origins) {
    std::vector<face> faces;
    std::vector<std::uint8_t> certified;
    std::vector<std::uint32_t> source;
    const std::size_t count = surface.faces.size() - listed.size() + merged.faces.size();
    base::resize_all(count, faces, certified, source);
    if (origins != nullptr) base::resize_all(count, origins->of_face);
    for_chunks(
        surface.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            const auto before = [](const std::vector<std::uint32_t>& all, std::size_t f) {
                return static_cast<std::size_t>(std::ranges::lower_bound(all, f) - all.begin());
            };
            std::size_t part = before(listed, begin), next = before(merged.face_of, part);
            std::size_t place = begin - part + next;
            const auto put = [&](const face& corners, std::size_t f, bool is_new) {
                faces[place] = corners;
                certified[place] = is_new ? std::uint8_t{0} : surface.certified[f];
                source[place] = source_of[f];
                if (origins != nullptr) origins->of_face[place] = static_cast<std::uint32_t>(f);
                ++place;
            };
            for (std::size_t f = begin; f < end; ++f) {
                if (part == listed.size() || listed[part] != f) {
                    put(surface.faces[f], f, false);
                    continue;
                }
                for (; next < merged.faces.size() && merged.face_of[next] == part; ++next)
                    put(merged.faces[next], f, merged.is_new[next] != 0);
                ++part;
            }
        });
    surface.faces = std::move(faces);
    surface.certified = std::move(certified);
    source_of = std::move(source);
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
    const std::vector<std::uint32_t> listed =
        options.merge_coplanar ? base::numbers_below(surface.faces.size()) : faces_at_cuts(surface);
    // Sources ascend, so that the lowest is that of the first face.
    std::vector<std::uint32_t> source_of_point(surface.constructed.size(), operand_element::none);
    std::vector<std::uint32_t> plane_of(listed.size());
    for_listed(listed, [&](std::size_t i, std::uint32_t f) {
        plane_of[i] = source_of[f];
        for (const std::uint32_t p : surface.faces[f]) {
            if (p < surface.given.size()) continue;
            const std::atomic_ref at(source_of_point[p - surface.given.size()]);
            std::uint32_t now = at.load(std::memory_order_relaxed);
            while (now > source_of[f] &&
                   !at.compare_exchange_weak(now, source_of[f], std::memory_order_relaxed)) {
            }
        }
    });
    merged_faces merged;
    {
        const part_of_surface part(surface, listed);
        const std::vector<std::uint8_t>& certified = part.surface().certified;
        merged = merge_coplanar(
            part.surface(),
            {.mesh = {surface.given, input},
             .plane_of = plane_of,
             .group_of = group_of,
             .stays = options.merge_coplanar ? std::span<const std::uint8_t>() : certified});
        for_chunks(merged.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t f = begin; f < end; ++f)
                           merged.faces[f] = part.to_whole(merged.faces[f]);
                   });
    }
    if (origins != nullptr) report(*origins, source_of, listed, merged);
    put_merged(surface, source_of, listed, merged, origins);
    return source_of_point;
}

}  // namespace treeform::detail::boolean
