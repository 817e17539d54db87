#include <libmesh/arrange/edge_stars.hpp>
#include <libmesh/arrange/operand_sums.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/base/union_find.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform::detail::arrange {
namespace {

constexpr std::size_t star_grain = std::size_t{1} << 7;  // points a chunk
constexpr std::size_t ahead = 4;                         // stars whose memory is under way
constexpr std::size_t most_listed = 100;                 // open edges

/// Operands that a byte can tell; of others, and of faces with several covers, those are looked up.
using short_operand = std::uint8_t;
constexpr auto not_told = std::numeric_limits<short_operand>::max();

/// [F'] the operand of the one input face that covers each face, or `not_told`.
buffer<short_operand> sole_operands(const mesh_arrangement& cut,
                                    std::span<const std::uint32_t> operand_of_face) {
    buffer<short_operand> sole(cut.faces.size());
    for_chunks(cut.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f) {
            const auto covers = cut.covers_of(f);
            const std::uint32_t operand =
                covers.size() == 1 ? operand_of_face[covers[0].face] : not_told;
            sole[f] = static_cast<short_operand>(std::min<std::uint32_t>(operand, not_told));
        }
    });
    return sole;
}

/// What one chunk of points finds.
struct chunk_edges {
    junction_list junctions;
    std::vector<open_arrangement_edge> open;
    std::uint64_t open_count = 0;
};

/// Looks at one star after the other; every edge is read at its lower end.
class edge_reader {
  public:
    edge_reader(const mesh_arrangement& cut, std::span<const std::uint32_t> operand_of_face,
                const edge_judge* judge, const buffer<short_operand>& sole,
                base::union_find& patches, chunk_edges& found)
        : cut_(cut),
          operand_of_face_(operand_of_face),
          judge_(judge),
          sole_(sole),
          patches_(patches),
          found_(found) {}

    void prefetch(std::span<const std::uint32_t> star) const {
        for (const std::uint32_t face : star.first(std::min<std::size_t>(star.size(), 16))) {
            __builtin_prefetch(&cut_.faces[face]);
            patches_.prefetch(face);
        }
    }

    void read(std::uint32_t a, std::span<const std::uint32_t> star) {
        collect_uses(a, star);
        for (std::size_t begin = 0, end = 0; begin < uses_.size(); begin = end) {
            const auto b = static_cast<std::uint32_t>(uses_[begin] >> 32);
            sides_.clear();
            for (; end < uses_.size() && uses_[end] >> 32 == b; ++end)
                sides_.push_back(static_cast<face_side>(uses_[end]));
            read_edge(a, b);
        }
    }

  private:
    /// The other end of an edge from `a` and the face's side at it, for edges to higher points.
    void collect_uses(std::uint32_t a, std::span<const std::uint32_t> star) {
        uses_.clear();
        for (const std::uint32_t id : star) {
            const face& f = cut_.faces[id];
            const std::size_t i = f[0] == a ? 0 : f[1] == a ? 1 : 2;
            const std::uint64_t next = f[(i + 1) % 3];
            const std::uint64_t last = f[(i + 2) % 3];
            if (next > a) uses_.push_back(next << 32 | front_of(id));
            if (last > a) uses_.push_back(last << 32 | behind(id));
        }
        std::sort(uses_.begin(), uses_.end());
    }

    void read_edge(std::uint32_t a, std::uint32_t b) {
        const edge_use use = judge_ == nullptr ? edge_use::all : (*judge_)({a, b}, sides_);
        if (use == edge_use::nothing) return;
        const bool plain = use == edge_use::all && sides_.size() == 2 &&
                           is_behind(sides_[0]) != is_behind(sides_[1]);
        if (plain) {
            const std::uint32_t f = face_of(sides_[0]);
            const std::uint32_t g = face_of(sides_[1]);
            patches_.join(f, g);
            if (sole_[f] == sole_[g] && sole_[f] != not_told) return;  // by far the most
        } else {
            found_.junctions.edges.push_back({{a, b}, found_.junctions.sides.size()});
            found_.junctions.sides.insert(found_.junctions.sides.end(), sides_.begin(),
                                          sides_.end());
        }
        if (!is_plainly_closed()) find_open(a, b);
    }

    /// Whether one input face covers each of the faces, and these cancel out; decided without
    /// looking at covers, which lie elsewhere in memory.
    bool is_plainly_closed() {
        counted_.clear();
        for (const face_side side : sides_) {
            const std::uint32_t operand = sole_[face_of(side)];
            if (operand == not_told) return false;
            counted_.push_back({operand, 0, is_behind(side) ? -1 : 1});
        }
        return cancel_out(counted_);
    }

    /// What covers the faces at the edge must run from a to b as often as from b to a, operand by
    /// operand.
    void find_open(std::uint32_t a, std::uint32_t b) {
        counted_.clear();
        for (const face_side side : sides_)
            for (const auto& [face, opposite] : cut_.covers_of(face_of(side)))
                counted_.push_back(
                    {operand_of_face_[face], face, is_behind(side) != opposite ? -1 : 1});
        for_each_remaining(counted_, [&](const counted_face& lowest) {
            ++found_.open_count;
            if (found_.open.size() < most_listed)
                found_.open.push_back({lowest.operand, {a, b}, lowest.face});
        });
    }

    const mesh_arrangement& cut_;
    std::span<const std::uint32_t> operand_of_face_;
    const edge_judge* judge_;  ///< none where no face is missing
    const buffer<short_operand>& sole_;
    base::union_find& patches_;
    chunk_edges& found_;
    std::vector<std::uint64_t> uses_;
    std::vector<face_side> sides_;
    std::vector<counted_face> counted_;
};

surface_patches find_patches_of(const mesh_arrangement& cut,
                                std::span<const std::uint32_t> operand_of_face,
                                const edge_judge* judge) {
    const edge_stars stars(cut.given_points.size() + cut.constructed.size(), cut.faces);
    const auto sole = sole_operands(cut, operand_of_face);
    base::union_find patches(cut.faces.size());
    std::vector<chunk_edges> found(chunk_count(stars.size(), star_grain));
    for_chunks(stars.size(), star_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        chunk_edges part;
        edge_reader reader(cut, operand_of_face, judge, sole, patches, part);
        for (std::size_t v = begin; v < end; ++v) {
            if (v + ahead < end) reader.prefetch(stars[v + ahead]);
            reader.read(static_cast<std::uint32_t>(v), stars[v]);
        }
        found[c] = std::move(part);
    });

    surface_patches result;
    result.patch = number_sets(std::move(patches));
    for (chunk_edges& part : found) {
        result.junctions.push_back(std::move(part.junctions));
        result.open_count += part.open_count;
        const std::size_t room = most_listed - result.open.size();
        result.open.insert(
            result.open.end(), part.open.begin(),
            part.open.begin() + static_cast<std::ptrdiff_t>(std::min(room, part.open.size())));
    }
    return result;
}

}  // namespace

surface_patches find_patches(const mesh_arrangement& cut,
                             std::span<const std::uint32_t> operand_of_face) {
    return find_patches_of(cut, operand_of_face, nullptr);
}

surface_patches find_patches(const mesh_arrangement& cut,
                             std::span<const std::uint32_t> operand_of_face, edge_judge judge) {
    return find_patches_of(cut, operand_of_face, &judge);
}

surface_patches find_closed_patches(const mesh_arrangement& cut,
                                    std::span<const std::uint32_t> operand_of_face,
                                    edge_judge judge) {
    surface_patches patches = find_patches(cut, operand_of_face, judge);
    if (patches.open_count > 0)
        throw std::logic_error("treeform: faces are missing at the edge between points " +
                               std::to_string(patches.open[0].points[0]) + " and " +
                               std::to_string(patches.open[0].points[1]));
    return patches;
}

}  // namespace treeform::detail::arrange
