#include <libmesh/place/filling.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace treeform::detail::place {
namespace {

constexpr unsigned most_places_tried = 24;

}  // namespace

plate_filling::plate_filling(const pack_shapes& shapes, const pack_options& options,
                             const filling_style& style)
    : shapes_(shapes),
      options_(options),
      style_(style),
      cell_(shapes.cell()),
      plate_(options, cell_, style.square),
      searched_(shapes.kinds()) {}

bool plate_filling::put(std::uint32_t part) {
    const std::vector<candidate>& turns = shapes_[part].candidates;
    const std::uint32_t only = style_.only_turn.empty() ? 0 : style_.only_turn[part];
    std::vector<search> searches;
    for (std::size_t c = 0; c < turns.size(); ++c)
        if (only == 0 || only % turns.size() == c) searches.push_back(begin(turns[c], c));
    for_chunks(searches.size(), 1, [&](std::size_t first, std::size_t end, std::size_t) {
        for (std::size_t i = first; i < end; ++i) find(searches[i]);
    });
    // Nothing that is taken gets free again: the next part of that shape starts from here.
    for (const search& s : searches)
        searched_[s.what->kind] = s.found.value_or(cell_place{s.last.layer + 1, 0, 0});
    for (unsigned tries = 0; tries < most_places_tried; ++tries) {
        search* best = nullptr;
        for (search& s : searches)
            if (s.found && (best == nullptr || reach(s) < reach(*best))) best = &s;
        if (best == nullptr) return false;
        const auto turned = shapes_.in_turn(part, best->number);
        if (plate_.put(part, shapes_.part(part), *turned, *best->found)) return true;
        next(*best);
    }
    return false;
}

plate_filling::search plate_filling::begin(const candidate& c, std::size_t number) const {
    const auto cells = [&](std::size_t axis, double more) {
        const double room = options_.size[axis] - c.size[axis];
        return static_cast<std::uint32_t>(std::floor(room / cell_ + 1e-6 + more));
    };
    const auto place = [&](double more) {
        return cell_place{options_.stack ? cells(2, more) : 0, cells(1, more), cells(0, more)};
    };
    return {&c, number, place(0.0), place(options_.tighten ? 3.0 : 0.0), searched_[c.kind]};
}

void plate_filling::find(search& s) const {
    while (true) {
        s.found = plate_.raster().first_free(s.what->cells, s.from, s.last);
        if (!s.found || !s.beyond() || s.at_end() || s.row() >= s.beyond_from) return;
        s.from = s.next_row();
    }
}

void plate_filling::next(search& s) const {
    s.from = {s.found->layer, s.found->row, s.found->column + 1};
    if (s.beyond()) {  // what cannot be moved in cannot a little further up, most likely
        s.from = s.next_row();
        s.beyond_from = s.row() + s.skip;
        s.skip *= 2;
    }
    find(s);
}

std::array<double, 3> plate_filling::reach(const search& s) const {
    const point3 to{s.found->column * cell_ + s.what->size.x, s.found->row * cell_ + s.what->size.y,
                    s.found->layer * cell_ + s.what->size.z};
    const double z = options_.stack ? to.z : 0.0;
    if (!style_.compact) return {z, to.y, to.x};
    const point3& before = plate_.reached();
    const double around = std::max(before.x, to.x) * std::max(before.y, to.y);
    return {options_.stack ? around * std::max(before.z, to.z) : around, to.y + z, to.x};
}

filling::filling(const pack_shapes& shapes, const pack_options& options, const filling_style& style)
    : shapes_(shapes), options_(options), style_(style) {
    // Held by reference: never to be moved.
    plate_options_.reserve(std::min<std::size_t>(options.plates, shapes.size()));
}

void filling::put(std::uint32_t part) {
    for (const auto& one : plates_)
        if (one->put(part)) return;
    if (plates_.size() < plate_options_.capacity()) {
        pack_options here = options_;
        for (std::size_t k = 0; k < 2; ++k)
            here.corner[k] += static_cast<double>(plates_.size()) * options_.plate_step[k];
        plate_options_.push_back(std::move(here));
        auto fresh = std::make_unique<plate_filling>(shapes_, plate_options_.back(), style_);
        if (fresh->put(part)) {
            plates_.push_back(std::move(fresh));
            return;
        }
        plate_options_.pop_back();
    }
    left_.push_back(part);
    room_left_ += shapes_[part].room;
}

std::uint64_t filling::pairs_measured() {
    std::uint64_t sum = 0;
    for (const auto& one : plates_) sum += one->result().pairs_measured();
    return sum;
}

std::vector<packed_part> filling::take_parts() {
    std::vector<packed_part> parts(shapes_.size());
    std::vector<packed_part> of_plate(shapes_.size());
    for (std::size_t p = 0; p < plates_.size(); ++p) {
        plates_[p]->result().take_parts(of_plate);
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (of_plate[i].placed) {
                parts[i] = std::exchange(of_plate[i], {});
                parts[i].plate = static_cast<unsigned>(p);
            }
    }
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        if (parts[i].placed) continue;
        const mesh_view mesh = shapes_.part(i).view();
        parts[i].placed = mesh.faces.empty();
        parts[i].points.assign(mesh.points.begin(), mesh.points.end());
    }
    plates_.clear();
    return parts;
}

}  // namespace treeform::detail::place
