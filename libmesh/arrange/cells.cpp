#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/cells_of.hpp>
#include <libmesh/arrange/operand_sums.hpp>
#include <libmesh/arrange/parts.hpp>
#include <libmesh/arrange/patch_regions.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/arrange/region_patches.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/union_find.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

using detail::arrange::face_side;
using detail::arrange::numbered_sets;
using detail::arrange::patch_regions;
using detail::arrange::region_patches;
using detail::arrange::surface_patches;
using detail::base::first_bad;

[[noreturn]] void refuse(const std::string& why) {
    throw std::invalid_argument("treeform::find_cells: " + why);
}

void check(mesh_view mesh, const mesh_arrangement& cut,
           std::span<const std::uint32_t> operand_of_face, std::size_t operand_count) {
    if (cut.given_points.size() != mesh.points.size() ||
        cut.cover_begin.size() != cut.faces.size() + 1)
        refuse("not an arrangement of this mesh");
    if (cut.faces.size() > std::numeric_limits<std::uint32_t>::max() / 2)
        refuse("more than 2^31 - 1 faces");
    detail::base::check_faces("find_cells", cut.given_points.size() + cut.constructed.size(),
                              cut.faces);
    const std::size_t bad_face = first_bad(cut.faces.size(), [&](std::size_t f) {
        return cut.cover_begin[f] >= cut.cover_begin[f + 1] ||
               cut.cover_begin[f + 1] > cut.covers.size();
    });
    if (bad_face != cut.faces.size())
        refuse("face " + std::to_string(bad_face) + " of the arrangement has no cover");
    const std::size_t bad_cover = first_bad(
        cut.covers.size(), [&](std::size_t i) { return cut.covers[i].face >= mesh.faces.size(); });
    if (bad_cover != cut.covers.size())
        refuse("a cover is not a face: " + std::to_string(cut.covers[bad_cover].face));
    if (operand_of_face.size() != mesh.faces.size())
        refuse("expected one operand number for each face");
    const std::size_t bad_operand = first_bad(
        operand_of_face.size(), [&](std::size_t f) { return operand_of_face[f] >= operand_count; });
    if (bad_operand != operand_of_face.size())
        refuse("face " + std::to_string(bad_operand) + " has an operand out of range");
}

/// What crossing the surface from front to behind adds to the windings.
class labels {
  public:
    labels(const mesh_arrangement& cut, std::span<const std::uint32_t> operand_of_face)
        : cut_(cut), operand_of_face_(operand_of_face) {}

    template <class Add>
    void for_each(std::uint32_t face, const Add& add) const {
        for (const covering_face& cover : cut_.covers_of(face))
            add(operand_of_face_[cover.face], cover.opposite ? -1 : 1);
    }

    /// Whether what covers the face cancels out, operand by operand.
    [[nodiscard]] bool cancel(std::uint32_t face) const {
        if (cut_.covers_of(face).size() == 1) return false;
        std::vector<detail::arrange::counted_face> counted;
        for_each(face, [&](std::uint32_t operand, int sign) {
            counted.push_back({operand, 0, sign});
        });
        return detail::arrange::cancel_out(counted);
    }

  private:
    const mesh_arrangement& cut_;
    std::span<const std::uint32_t> operand_of_face_;
};

/// The part of each patch: patches are linked by edges.
numbered_sets find_parts(const surface_patches& patches) {
    detail::base::union_find linked(patches.count());
    for (const detail::arrange::junction_list& list : patches.junctions)
        for (std::size_t e = 0; e < list.edges.size(); ++e) {
            const auto sides = list.sides_of(e);
            for (const face_side side : sides)
                linked.join(patches.patch[detail::arrange::face_of(sides[0])],
                            patches.patch[detail::arrange::face_of(side)]);
        }
    return detail::arrange::number_sets(std::move(linked));
}

/// The cells on both sides of each patch, and windings that spread from cell to cell.
class winding_flood {
  public:
    winding_flood(const surface_patches& patches, const numbered_sets& cells, const labels& labels,
                  std::size_t operands)
        : patches_(patches),
          labels_(labels),
          operands_(operands),
          winding_(cells.count() * operands),
          seen_(cells.count()),
          around_(cells, patches.count()) {}

    /// [C][k] windings, 0 in cell 0.
    /// \throws std::logic_error where two ways to a cell give two windings
    [[nodiscard]] std::vector<std::int32_t> run() {
        std::vector<std::uint32_t> open{0};
        seen_[0] = 1;
        while (!open.empty()) {
            const std::uint32_t cell = open.back();
            open.pop_back();
            for (const std::uint32_t p : around_.around(cell)) {
                const std::uint32_t next = around_.beyond(p, cell);
                if (seen_[next] != 0) continue;
                seen_[next] = 1;
                cross(p, cell, next);
                open.push_back(next);
            }
        }
        check();
        return std::move(winding_);
    }

  private:
    [[nodiscard]] std::int32_t* row(std::uint32_t cell) {
        return winding_.data() + cell * operands_;
    }

    /// The windings of `next`, which is beyond patch p from `cell`.
    void cross(std::uint32_t p, std::uint32_t cell, std::uint32_t next) {
        std::copy_n(row(cell), operands_, row(next));
        const int way = around_.front(p) == cell ? 1 : -1;
        labels_.for_each(patches_.first_face(p), [&](std::uint32_t operand, int sign) {
            row(next)[operand] += way * sign;
        });
    }

    void check() {
        std::vector<std::int32_t> beyond(operands_);
        for (std::uint32_t p = 0; p < patches_.count(); ++p) {
            std::copy_n(row(around_.front(p)), operands_, beyond.data());
            labels_.for_each(patches_.first_face(p),
                             [&](std::uint32_t operand, int sign) { beyond[operand] += sign; });
            if (seen_[around_.front(p)] == 0 || seen_[around_.behind(p)] == 0 ||
                !std::equal(beyond.begin(), beyond.end(), row(around_.behind(p))))
                throw std::logic_error(
                    "treeform::find_cells: windings contradict each other at face " +
                    std::to_string(patches_.first_face(p)));
        }
    }

    const surface_patches& patches_;
    const labels& labels_;
    std::size_t operands_;
    std::vector<std::int32_t> winding_;
    std::vector<unsigned char> seen_;
    region_patches around_;
};

/// What looks into one region is one cell; `joined` is known to so far.
numbered_sets number_cells(mesh_view mesh, const mesh_arrangement& cut,
                           const surface_patches& patches, patch_regions& joined) {
    joined.join_about_edges(mesh, cut);
    for (const auto& [outer, beyond] :
         detail::arrange::place_parts(mesh, cut, patches, find_parts(patches)))
        if (beyond)
            joined.join(outer, *beyond);
        else
            joined.join_infinity(outer);
    return joined.number();
}

}  // namespace

arrangement_cells find_cells(mesh_view mesh, const mesh_arrangement& cut,
                             std::span<const std::uint32_t> operand_of_face,
                             std::size_t operand_count) {
    check(mesh, cut, operand_of_face, operand_count);
    return detail::arrange::cells_of(mesh, cut, operand_of_face, operand_count);
}

numbered_sets detail::arrange::cells_between(mesh_view mesh, const mesh_arrangement& cut,
                                             std::span<const std::uint32_t> operand_of_face,
                                             const surface_patches& patches) {
    const labels labels(cut, operand_of_face);
    patch_regions joined(patches);
    for (std::uint32_t p = 0; p < patches.count(); ++p)
        if (const std::uint32_t f = patches.first_face(p); labels.cancel(f))
            joined.join(detail::arrange::front_of(f), detail::arrange::behind(f));
    return number_cells(mesh, cut, patches, joined);
}

std::vector<std::array<std::uint32_t, 2>> detail::arrange::cells_beside_faces(
    const mesh_arrangement& cut, const surface_patches& patches, const numbered_sets& cells) {
    std::vector<std::array<std::uint32_t, 2>> cell_of_side(cut.faces.size());
    for_chunks(cut.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f) {
            const std::size_t p = patches.patch[f];
            cell_of_side[f] = {cells[2 * p + 1], cells[2 * p + 2]};
        }
    });
    return cell_of_side;
}

arrangement_cells detail::arrange::cells_of(mesh_view mesh, const mesh_arrangement& cut,
                                            std::span<const std::uint32_t> operand_of_face,
                                            std::size_t operand_count) {
    surface_patches patches = detail::arrange::find_patches(cut, operand_of_face);
    arrangement_cells result;
    result.operands = operand_count;
    if (patches.open_count > 0) {
        result.open = std::move(patches.open);
        result.open_count = patches.open_count;
        return result;
    }
    const numbered_sets cells = cells_between(mesh, cut, operand_of_face, patches);
    const labels labels(cut, operand_of_face);
    result.winding = winding_flood(patches, cells, labels, operand_count).run();
    result.cell_of_side = cells_beside_faces(cut, patches, cells);
    return result;
}

detail::arrange::open_cells detail::arrange::open_cells_of(mesh_view mesh,
                                                           const mesh_arrangement& cut) {
    const std::vector<std::uint32_t> one_operand(mesh.faces.size(), 0);
    const surface_patches patches = find_patches(cut, one_operand);
    patch_regions joined(patches);
    const numbered_sets cells = number_cells(mesh, cut, patches, joined);
    open_cells result{cells.count(), {}};
    result.cells.cell_of_side = cells_beside_faces(cut, patches, cells);
    return result;
}

}  // namespace treeform
