#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/far_faces.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::size_t lot = 64;  ///< faces, two levels of a tree
constexpr std::size_t lots_a_chunk = light_grain / lot;
constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();

std::size_t lots_of(std::size_t faces) { return (faces + lot - 1) / lot; }

/// Several threads may do so at the same time.
void lower(std::uint32_t& number, std::uint32_t to) {
    const std::atomic_ref at(number);
    std::uint32_t now = at.load(std::memory_order_relaxed);
    while (now > to && !at.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
    }
}

/// Finds the clusters of one lot after the other.
class lot_reader {
  public:
    /// The clusters of the faces at places from `begin`, from 0 on by their first places.
    std::size_t read(std::span<const face> faces, std::span<const std::uint32_t> face_at,
                     std::uint32_t* cluster) {
        const std::size_t count = face_at.size();
        slots_.fill({no_number, 0});
        std::iota(above_.begin(), above_.end(), std::uint8_t{0});
        for (std::size_t i = 0; i < count; ++i)
            for (const std::uint32_t p : faces[face_at[i]]) {
                slot& s = slot_of(p);
                if (s.point == no_number)
                    s = {p, static_cast<std::uint8_t>(i)};
                else
                    join(s.face, static_cast<std::uint8_t>(i));
            }
        std::uint32_t found = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint8_t root = root_of(static_cast<std::uint8_t>(i));
            cluster[i] = root == i ? found++ : cluster[root];
        }
        return found;
    }

  private:
    struct slot {
        std::uint32_t point;
        std::uint8_t face;
    };
    slot& slot_of(std::uint32_t p) {
        for (std::size_t i = p * 2654435761U >> 23U;; i = (i + 1) % slots_.size())
            if (slots_[i].point == p || slots_[i].point == no_number) return slots_[i];
    }
    std::uint8_t root_of(std::uint8_t i) {
        while (above_[i] != i) i = above_[i] = above_[above_[i]];
        return i;
    }
    void join(std::uint8_t i, std::uint8_t j) {  // the lowest is the root
        i = root_of(i);
        j = root_of(j);
        above_[std::max(i, j)] = std::min(i, j);
    }

    std::array<slot, 512> slots_{};  // for 192 corners
    std::array<std::uint8_t, lot> above_{};
};

face_clusters find_clusters(const prepared_mesh& mesh) {
    const std::span<const face> faces = mesh.indexed_view().faces;
    const auto face_at = build_face_tree(mesh).ids();
    face_clusters result;
    result.of_place.resize(faces.size());
    const std::size_t lots = lots_of(faces.size());
    const auto places = [&](std::size_t l) {
        return std::pair(l * lot, std::min((l + 1) * lot, faces.size()));
    };
    std::vector<std::uint32_t> first(lots + 1, 0);
    for_chunks(lots, lots_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        lot_reader reader;
        for (std::size_t l = begin; l < end; ++l) {
            const auto [from, to] = places(l);
            first[l + 1] = static_cast<std::uint32_t>(
                reader.read(faces, face_at.subspan(from, to - from), &result.of_place[from]));
        }
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    result.first_place.resize(first.back());
    buffer<std::uint32_t> lowest(mesh.indexed_view().points.size());  // cluster at each point
    for_chunks(lowest.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::fill(lowest.data() + begin, lowest.data() + end, no_number);
    });
    for_chunks(lots, lots_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t l = begin; l < end; ++l) {
            const auto [from, to] = places(l);
            for (std::size_t i = to; i-- > from;) {
                const std::uint32_t c = result.of_place[i] += first[l];
                result.first_place[c] = static_cast<std::uint32_t>(i);
                for (const std::uint32_t p : faces[face_at[i]]) lower(lowest[p], c);
            }
        }
    });
    std::vector<std::vector<std::array<std::uint32_t, 2>>> links(chunk_count(lots, lots_a_chunk));
    for_chunks(lots, lots_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        auto& mine = links[chunk];
        for (std::size_t l = begin; l < end; ++l) {
            const auto [from, to] = places(l);
            const auto own = static_cast<std::ptrdiff_t>(mine.size());
            for (std::size_t i = from; i < to; ++i)
                for (const std::uint32_t p : faces[face_at[i]])
                    if (lowest[p] != result.of_place[i])
                        mine.push_back({lowest[p], result.of_place[i]});
            std::sort(mine.begin() + own, mine.end());
            mine.erase(std::unique(mine.begin() + own, mine.end()), mine.end());
        }
    });
    result.linked = base::flattened(std::move(links));
    return result;
}

}  // namespace

const face_clusters& clusters_of(const prepared_mesh& mesh) {
    constexpr base::slot<face_clusters> slot{base::slot_name::face_clusters};
    return base::prepared_slots::get(mesh, slot, [&] { return find_clusters(mesh); });
}

far_faces::far_faces(const prepared_mesh& mesh, std::span<const std::uint8_t> is_near)
    : face_at_(build_face_tree(mesh).ids()),
      mesh_(mesh.indexed_view()),
      clusters_(clusters_of(mesh)),
      is_near_(is_near),
      is_mixed_(clusters_.first_place.size(), 0) {
    const std::size_t clusters = is_mixed_.size(), faces = face_at_.size();
    const auto element = [&](std::size_t place) {
        return static_cast<std::uint32_t>(clusters + mesh_.faces[face_at_[place]][0]);
    };
    for_chunks(faces, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            if (is_near_[i] != 0)
                std::atomic_ref(is_mixed_[clusters_.of_place[i]])
                    .store(1, std::memory_order_relaxed);
    });
    base::union_find alike(clusters + mesh_.points.size());
    std::vector<std::uint8_t> is_beside(clusters, 0);  // one that is mixed
    const auto is_beside_mixed = [&](std::uint32_t c) {
        std::atomic_ref(is_beside[c]).store(1, std::memory_order_relaxed);
    };
    for_chunks(clusters_.linked.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i) {
                       const auto [a, b] = clusters_.linked[i];
                       if (is_mixed_[a] == 0 && is_mixed_[b] == 0) {
                           alike.join(a, b);
                       } else {
                           is_beside_mixed(a);
                           is_beside_mixed(b);
                       }
                   }
               });
    // Calls `visit(place)` for the faces that are not near of mixed clusters and those beside them.
    const auto for_faces = [&](const auto& visit) {
        for_chunks(lots_of(faces), lots_a_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = lot * begin; i < std::min(lot * end, faces); ++i) {
                           const std::uint32_t c = clusters_.of_place[i];
                           if ((is_mixed_[c] | is_beside[c]) != 0 && is_near_[i] == 0) visit(i, c);
                       }
                   });
    };
    std::vector<std::uint8_t> is_met(mesh_.points.size(), 0);  // by a mixed cluster
    for_faces([&](std::size_t i, std::uint32_t c) {
        if (is_mixed_[c] == 0) return;
        for (const std::uint32_t p : mesh_.faces[face_at_[i]]) {
            std::atomic_ref(is_met[p]).store(1, std::memory_order_relaxed);
            alike.join(element(i), static_cast<std::uint32_t>(clusters + p));
        }
    });
    for_faces([&](std::size_t i, std::uint32_t c) {
        if (is_mixed_[c] != 0) return;
        for (const std::uint32_t p : mesh_.faces[face_at_[i]])
            if (is_met[p] != 0) alike.join(c, static_cast<std::uint32_t>(clusters + p));
    });
    set_ = alike.take_roots();
    number_sets();
}

/// Roots, the lowest of each set, become numbers of sets.
void far_faces::number_sets() {
    const std::size_t clusters = is_mixed_.size(), faces = face_at_.size();
    buffer<std::uint32_t> number(
        set_.size());  // the lowest place that stands for a set, then its number
    for_chunks(number.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::fill(number.data() + begin, number.data() + end, no_number);
    });
    for_chunks(clusters, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t c = begin; c < end; ++c)
            if (is_mixed_[c] == 0) lower(number[set_[c]], clusters_.first_place[c]);
    });
    for_chunks(faces, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            if (is_mixed_[clusters_.of_place[i]] != 0 && is_near_[i] == 0)
                lower(number[set_[clusters + mesh_.faces[face_at_[i]][0]]],
                      static_cast<std::uint32_t>(i));
    });
    base::compact(
        number.size(), [&](std::size_t root) { return number[root] != no_number; },
        [&](std::size_t count) { faces_.resize(count); },
        [&](std::size_t root, std::size_t place) {
            faces_[place] = face_at_[number[root]];
            number[root] = static_cast<std::uint32_t>(place);
        });
    for_chunks(set_.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) set_[i] = number[set_[i]];
    });
}

}  // namespace treeform::detail::boolean
