#include <libmesh/arrange/edge_stars.hpp>
#include <libmesh/arrange/face_side.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using arrange::face_of;
using arrange::face_side;
using arrange::is_behind;

constexpr std::size_t star_grain = std::size_t{1} << 9;  // points a chunk
constexpr std::size_t ahead = 4;                         // stars whose memory is under way

/// What one chunk of points finds.
struct chunk_edges {
    std::vector<unbalanced_edge> unbalanced;
    std::vector<std::uint32_t> not_manifold;  ///< a face at each edge of another kind
};

/// Looks at one star after the other; every edge is read at its lower end.
class edge_reader {
  public:
    edge_reader(std::span<const face> faces, std::span<const std::uint32_t> operand_of_face,
                base::union_find& pieces, chunk_edges& found)
        : faces_(faces), operand_of_face_(operand_of_face), pieces_(pieces), found_(found) {}

    void prefetch(std::span<const std::uint32_t> star) const {
        for (const std::uint32_t f : star.first(std::min<std::size_t>(star.size(), 16))) {
            __builtin_prefetch(&faces_[f]);
            pieces_.prefetch(f);
        }
    }

    void read(std::uint32_t a, std::span<const std::uint32_t> star) {
        uses_.clear();
        for (const std::uint32_t id : star) {
            const face& f = faces_[id];
            const std::size_t i = f[0] == a ? 0 : f[1] == a ? 1 : 2;
            const std::uint64_t next = f[(i + 1) % 3];
            const std::uint64_t last = f[(i + 2) % 3];
            if (next > a) uses_.push_back(next << 32 | arrange::front_of(id));
            if (last > a) uses_.push_back(last << 32 | arrange::behind(id));
        }
        std::sort(uses_.begin(), uses_.end());
        for (std::size_t begin = 0, end = 0; begin < uses_.size(); begin = end) {
            const auto b = static_cast<std::uint32_t>(uses_[begin] >> 32);
            while (end < uses_.size() && uses_[end] >> 32 == b) ++end;
            read_edge({a, b}, std::span(uses_).subspan(begin, end - begin));
        }
    }

  private:
    [[nodiscard]] std::uint32_t operand_of(std::uint64_t use) const {
        return operand_of_face_[face_of(static_cast<face_side>(use))];
    }

    /// Uses ascend by face, and so by operand.
    void read_edge(const std::array<std::uint32_t, 2>& ends, std::span<const std::uint64_t> uses) {
        for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
            const auto first = static_cast<face_side>(uses[begin]);
            std::int64_t net = 0;
            for (; end < uses.size() && operand_of(uses[end]) == operand_of(uses[begin]); ++end) {
                const auto side = static_cast<face_side>(uses[end]);
                net += is_behind(side) ? -1 : 1;
                if (end > begin) pieces_.join(face_of(first), face_of(side));
            }
            if (end - begin == 2 && net == 0) continue;  // by far the most
            found_.not_manifold.push_back(face_of(first));
            if (net != 0)
                found_.unbalanced.push_back({operand_of(uses[begin]), ends, face_of(first), net});
        }
    }

    std::span<const face> faces_;
    std::span<const std::uint32_t> operand_of_face_;
    base::union_find& pieces_;
    chunk_edges& found_;
    std::vector<std::uint64_t> uses_;  ///< the other end and the side of a face, ascending
};

}  // namespace

operand_edges find_operand_edges(mesh_view joined, std::span<const std::uint32_t> operand_of_face) {
    base::union_find pieces(joined.faces.size());
    std::vector<chunk_edges> found;
    {
        const arrange::edge_stars stars(joined.points.size(), joined.faces);
        found.resize(chunk_count(stars.size(), star_grain));
        for_chunks(stars.size(), star_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t c) {
                       chunk_edges part;
                       edge_reader reader(joined.faces, operand_of_face, pieces, part);
                       for (std::size_t v = begin; v < end; ++v) {
                           if (v + ahead < end) reader.prefetch(stars[v + ahead]);
                           reader.read(static_cast<std::uint32_t>(v), stars[v]);
                       }
                       found[c] = std::move(part);
                   });
    }
    operand_edges result{arrange::number_sets(std::move(pieces)), {}, {}};
    result.is_manifold.assign(result.piece.count(), 1);
    for (const chunk_edges& part : found) {
        for (const std::uint32_t f : part.not_manifold) result.is_manifold[result.piece[f]] = 0;
        result.unbalanced.insert(result.unbalanced.end(), part.unbalanced.begin(),
                                 part.unbalanced.end());
    }
    return result;
}

}  // namespace treeform::detail::boolean
