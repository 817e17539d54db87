#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/boolean/clip_sheet.hpp>
#include <libmesh/boolean/finish_surface.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/sheet_faces.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <libmesh/boolean/way_out.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

constexpr std::size_t lines_a_chunk = 16;

/// The faces of the sheet and those whose boxes overlap one of theirs, ascending.
std::vector<std::uint32_t> faces_at_sheet(const joined_operands& joined, std::uint32_t sheet) {
    const std::span<const face> faces = joined.all.faces;
    const std::uint32_t begin = joined.first_face[sheet], end = joined.first_face[sheet + 1];
    const tree<3> tree = build_face_tree({joined.all.points, faces.subspan(begin, end - begin)});
    const auto box_of = base::face_boxes(joined.all.points);
    std::vector<std::uint8_t> is_near(faces.size(), 0);
    for_chunks(faces.size(), light_grain, [&](std::size_t from, std::size_t to, std::size_t) {
        for (std::size_t f = from; f < to; ++f)
            if ((f >= begin && f < end) ||
                search_any(tree, box_of(faces[f]), [](std::uint32_t) { return true; }))
                is_near[f] = 1;
    });
    std::vector<std::uint32_t> near;
    for (std::uint32_t f = 0; f < is_near.size(); ++f)
        if (is_near[f] != 0) near.push_back(f);
    return near;
}

/// Whether the expression keeps a face of the sheet. A piece is in a solid when one of its sides is.
class sheet_judge {
  public:
    sheet_judge(const surface_components& solids, mesh_view mesh, const mesh_arrangement& cut,
                std::uint32_t sheet, std::size_t operands, const boolean_expression& expression,
                fill_rule rule)
        : solids_(solids),
          mesh_(mesh),
          cut_(cut),
          sheet_(sheet),
          operands_(operands),
          expression_(expression),
          rule_(rule) {}

    [[nodiscard]] bool keeps(std::size_t f) const {
        const auto in = std::make_unique<bool[]>(operands_);
        in[sheet_] = true;
        const way_out out = find_way_out(mesh_, cut_, f, solids_.box());
        for (const bool ahead : {false, true})
            for (const auto& [operand, winding] : solids_.windings_beside(out.line, ahead))
                if (operand != sheet_ && is_inside(rule_, winding)) in[operand] = true;
        return expression_({in.get(), operands_});
    }

  private:
    const surface_components& solids_;
    mesh_view mesh_;
    const mesh_arrangement& cut_;
    std::uint32_t sheet_;
    std::size_t operands_;
    const boolean_expression& expression_;
    fill_rule rule_;
};

}  // namespace

boolean_result clip_sheet(joined_operands& joined, const operand_edges& edges, std::uint32_t sheet,
                          const boolean_expression& expression, const boolean_options& options) {
    const std::size_t all = joined.all.faces.size(), count = joined.first_face.size() - 1;
    const std::vector<std::uint32_t> operand_of_all = joined.operand_of_face();
    const surface_components solids(joined.all, operand_of_all, edges, false);
    std::vector<std::uint32_t> number = faces_at_sheet(joined, sheet);
    std::vector<face> faces;
    std::vector<std::uint32_t> operand;
    for (const std::uint32_t f : number) {
        faces.push_back(joined.all.faces[f]);
        operand.push_back(operand_of_all[f]);
    }
    const mesh_view near{joined.all.points, faces};
    arrange_faces_result arranged = arrange::arrange_wanted(
        near,
        [&](const face_pair& pair) { return operand[pair.a] == sheet || operand[pair.b] == sheet; },
        {.progress = base::part_of(options.progress, 0.0, 0.5)});
    boolean_result made = with_counts(arranged);
    made.statistics.skipped_faces = all - faces.size();
    if (arranged.cancelled) return made;
    mesh_arrangement& cut = arranged.cut;
    cut.given_points = joined.all.points;

    const std::vector<std::uint8_t> way = sheet_faces(cut, operand, sheet);
    const arrange::surface_patches patches = arrange::find_patches(cut, operand);
    std::vector<std::uint32_t> asked;  // the first face of the sheet in each patch
    std::vector<std::uint8_t> is_asked(patches.count(), 0), keeps(patches.count(), 0);
    for (std::uint32_t f = 0; f < way.size(); ++f)
        if (way[f] != 0 && std::exchange(is_asked[patches.patch[f]], 1) == 0) asked.push_back(f);
    const sheet_judge judge(solids, near, cut, sheet, count, expression, options.inside);
    for_chunks(asked.size(), lines_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            keeps[patches.patch[asked[i]]] = judge.keeps(asked[i]) ? 1 : 0;
    });
    std::vector<std::uint8_t> keep(cut.faces.size(), 0);
    for (std::size_t f = 0; f < keep.size(); ++f) keep[f] = keeps[patches.patch[f]];
    round::solid_faces chosen = kept_of_sheet(cut, operand, way, keep, sheet);
    joined.all.faces = std::move(faces);
    joined.number_of_face = std::move(number);
    finish_surface(made, cut, std::move(chosen), joined, false, options);
    return made;
}

}  // namespace treeform::detail::boolean
