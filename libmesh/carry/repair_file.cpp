#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/carry/carried.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform {
namespace {

using detail::carry::solid_part;

void add(repair_statistics& sum, const repair_statistics& part) {
    using s = repair_statistics;
    for (const auto count : {&s::tetrahedra,
                             &s::degenerate,
                             &s::repeated,
                             &s::closed_edges,
                             &s::split_edges,
                             &s::flipped,
                             &s::turned_outward,
                             &s::strays,
                             &s::holes,
                             &s::hole_edges,
                             &s::filled,
                             &s::open_edges,
                             &s::pairs,
                             &s::removed,
                             &s::labeled_cells,
                             &s::split_vertices,
                             &s::detached,
                             &s::touching,
                             &s::vanished_components,
                             &s::dropped_shells,
                             &s::unfilled_rims})
        sum.*count += part.*count;
    for (const auto amount : {&s::dropped_area, &s::flipped_area, &s::volume_before,
                              &s::volume_after, &s::area_before, &s::area_after, &s::area_lost})
        sum.*amount += part.*amount;
    sum.gap_limit = std::max(sum.gap_limit, part.gap_limit);
    sum.widest_closed = std::max(sum.widest_closed, part.widest_closed);
    sum.resolved = sum.resolved || part.resolved;
}

bool is_as_asked(const certificate& known) {
    return known.status == status::ok || known.status == status::sheet;
}

/// A repair of parts, one after the other, as one of the whole.
class repair_of_parts {
  public:
    explicit repair_of_parts(const attribute_source& input) : input_(input) {
        done_.is_kept.assign(input.file->mesh.faces.size(), 0);
    }

    void take(repair_result made, const solid_part& of) {
        const auto first_face = static_cast<std::uint32_t>(done_.file.mesh.faces.size());
        const auto faces = static_cast<std::uint32_t>(made.mesh.faces.size());
        append(std::move(made.mesh));
        for (const std::uint32_t f : made.face_source)
            face_source_.push_back(in_whole(f, of.faces));
        for (const std::uint32_t v : made.vertex_source)
            vertex_source_.push_back(in_whole(v, of.points));
        for (std::uint32_t f = 0; f < made.is_kept.size(); ++f)
            done_.is_kept[in_whole(f, of.faces)] = made.is_kept[f];
        certificate& known = made.certificate;
        for (auto& [f, g] : known.meeting) {
            f += first_face;
            g += first_face;
        }
        for (operand_element& e : known.open_faces) e.index = stored(in_whole(e.index, of.faces));
        add(done_.statistics, made.statistics);
        join(known);
        done_.parts.push_back({of.name, first_face, faces, std::move(known), made.statistics});
    }

    repaired_file finish() {
        for (const std::uint32_t f : face_source_) done_.face_source.push_back(stored(f));
        done_.file.stored_faces = done_.file.mesh.faces.size();
        done_.file.stored_as = done_.certificate.precision;
        done_.file.format = input_.file->format;
        attribute_sources(input_).transfer(done_.file, face_source_, vertex_source_);
        return std::move(done_);
    }

  private:
    void append(mesh part) {
        mesh& all = done_.file.mesh;
        if (all.faces.empty()) {
            all = std::move(part);
            return;
        }
        const auto first_point = static_cast<std::uint32_t>(all.points.size());
        all.points.insert(all.points.end(), part.points.begin(), part.points.end());
        for (const auto& [a, b, c] : part.faces)
            all.faces.push_back({first_point + a, first_point + b, first_point + c});
    }

    static std::uint32_t in_whole(std::uint32_t number, const std::vector<std::uint32_t>& whole) {
        return number == repair_result::none || whole.empty() ? number : whole[number];
    }

    [[nodiscard]] std::uint32_t stored(std::uint32_t f) const {
        return f == repair_result::none ? f : input_.face_in_file(f);
    }

    void join(const certificate& part) {
        certificate& all = done_.certificate;
        const double farthest = std::max(all.max_displacement, part.max_displacement);
        const bool is_first = done_.parts.empty();
        if (is_first || (is_as_asked(all) && part.status != status::ok)) all = part;
        all.max_displacement = farthest;
    }

    const attribute_source& input_;
    repaired_file done_{};
    std::vector<std::uint32_t> face_source_{};
    std::vector<std::uint32_t> vertex_source_{};
};

/// Whether merging faces may mix values.
class mixing {
  public:
    explicit mixing(const attribute_source& input)
        : of_vertices_(attribute_sources(input).has_vertex_values()),
          group_of_(attribute_sources(input).face_groups(true, false)) {}

    [[nodiscard]] bool is_in(const std::vector<std::uint32_t>& faces) const {
        return of_vertices_ ||
               (!group_of_.empty() && std::ranges::any_of(faces, [&](std::uint32_t f) {
                   return group_of_[f] != group_of_[faces.front()];
               }));
    }

  private:
    bool of_vertices_;
    std::vector<std::uint32_t> group_of_;  ///< [F], or empty: all are in one
};

/// Progress over parts, by their faces.
class faces_done {
  public:
    faces_done(const progress_callback& callback, std::size_t all)
        : callback_(callback), all_(static_cast<double>(all)) {}

    [[nodiscard]] progress_callback next(std::size_t faces) {
        const double begin = done_ / all_;
        done_ += static_cast<double>(faces);
        return detail::base::part_of(callback_, begin, done_ / all_);
    }

  private:
    const progress_callback& callback_;
    double all_;
    double done_ = 0.0;
};

}  // namespace

repaired_file repair_file(const attribute_source& input, const repair_options& options) {
    std::vector<solid_part> parts;
    if (!options.as_one) parts = detail::carry::solid_parts(input);
    repair_of_parts all(input);
    repair_options how = options;
    if (parts.empty()) {
        how.keep_cuts = options.keep_cuts || attribute_sources(input).merging_mixes_values();
        all.take(repair(input.file->mesh, how), {});
        repaired_file done = all.finish();
        done.parts.clear();
        return done;
    }
    const mixing mixes(input);
    faces_done progress(options.progress, input.file->mesh.faces.size());
    for (const solid_part& part : parts) {
        how.progress = progress.next(part.faces.size());
        how.keep_cuts = options.keep_cuts || mixes.is_in(part.faces);
        repair_result made = repair(part.mesh, how);
        const bool is_cancelled = made.certificate.status == status::cancelled;
        all.take(std::move(made), part);
        if (is_cancelled) break;
    }
    return all.finish();
}

solid_defects find_solid_defects(const attribute_source& input, const progress_callback& progress) {
    const std::vector<solid_part> parts = detail::carry::solid_parts(input);
    if (parts.empty()) return find_solid_defects(input.file->mesh, progress);
    faces_done part_of(progress, input.file->mesh.faces.size());
    using d = solid_defects;
    solid_defects all;
    all.nonfinite_vertices = find_invalid_faces(input.file->mesh).nonfinite_points.size();
    for (const solid_part& part : parts) {
        const solid_defects found = find_solid_defects(part.mesh, part_of.next(part.faces.size()));
        for (const auto count : {&d::unusable_faces, &d::tetrahedra, &d::degenerate, &d::repeated,
                                 &d::boundary_edges, &d::nonmanifold_edges, &d::misoriented_edges,
                                 &d::nonmanifold_vertices, &d::meeting_pairs, &d::inverted})
            all.*count += found.*count;
        all.wrongly_nested = all.wrongly_nested || found.wrongly_nested;
        all.status = found.status;
        if (found.status == treeform::status::cancelled) break;
    }
    return all;
}

}  // namespace treeform
