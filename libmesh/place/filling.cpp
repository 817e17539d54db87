#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/filling.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace treeform::detail::place {
namespace {

/// Turned parts with their trees are kept up to so many faces in all: some 50 bytes each.
constexpr std::size_t most_faces_kept = 8'000'000;

/// Number of 15 degree steps of the turns to try.
std::vector<unsigned> turns_of(unsigned count) {
    std::vector<unsigned> turns;
    for (unsigned turn = 0; turn < 24; turn += 24 / count) turns.push_back(turn);
    return turns;
}

/// As fine as the smallest part asks for, within limits.
double cell_length(std::span<const prepared_mesh> parts, const pack_options& o) {
    double longest = std::max(o.size.x, o.size.y);
    if (o.stack) longest = std::max(longest, o.size.z);
    double cell = longest / (o.stack ? 96 : 512);
    for (const prepared_mesh& part : parts) {
        if (part.indexed_view().faces.empty()) continue;
        const turned_part as_is(part.indexed_view(), 0);
        const point3& size = as_is.size();
        const double least = std::min(size.x, size.y);
        cell = std::min(cell, o.stack ? std::min(least, size.z) / 3 : least / 4);
    }
    return std::max(cell, longest / (o.stack ? 192 : 2048));
}

std::vector<std::uint32_t> first_of_equals(std::span<const prepared_mesh> parts) {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::uint32_t>> seen;
    std::vector<std::uint32_t> first;
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const mesh_view mesh = parts[i].indexed_view();
        std::vector<std::uint32_t>& alike = seen[{mesh.points.size(), mesh.faces.size()}];
        const auto same = [&](std::uint32_t j) {
            const mesh_view other = parts[j].indexed_view();
            return std::equal(mesh.faces.begin(), mesh.faces.end(), other.faces.begin()) &&
                   std::equal(mesh.points.begin(), mesh.points.end(), other.points.begin());
        };
        const auto found = std::find_if(alike.begin(), alike.end(), same);
        first.push_back(found == alike.end() ? i : *found);
        if (found == alike.end()) alike.push_back(i);
    }
    return first;
}

/// Whether a turn covers other cells than those before, as one of a box by 180 degrees does not.
bool is_new(const part_shape& s, const candidate& c) {
    return std::none_of(s.candidates.begin(), s.candidates.end(),
                        [&](const candidate& other) { return other.cells == c.cells; });
}

constexpr unsigned most_places_tried = 24;

}  // namespace

pack_shapes::pack_shapes(std::span<const prepared_mesh> parts, const pack_options& o,
                         const progress_callback& progress)
    : parts_(parts), distinct_(first_of_equals(parts)), shapes_(parts.size()) {
    cell_ = cell_length(parts, o);
    const std::vector<unsigned> turns = turns_of(o.turns);
    std::vector<candidate> all(parts.size() * turns.size());
    base::work_progress work(progress);
    std::atomic<std::size_t> begun{0};
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(all.size(), 1));
    const cell_grid grid{{}, cell_, o.stack};
    for_chunks(all.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t number = i / turns.size();
            const mesh_view part = parts[number].indexed_view();
            if (!work.reach(static_cast<double>(begun++) * share)) return;
            if (part.faces.empty() || distinct_[number] != number) continue;
            const turned_part there(part, turns[i % turns.size()]);
            const point3& size = there.size();
            if (!(size.x <= o.size.x && size.y <= o.size.y && size.z <= o.size.z)) continue;
            if (cell_ > 0.0)
                all[i] = {there.turn(), size, telling_first(cells_covered(there.mesh(), grid)), 0};
        }
    });
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].cells.cells != 0 && is_new(shapes_[i / turns.size()], all[i]))
            shapes_[i / turns.size()].candidates.push_back(std::move(all[i]));
    for (part_shape& s : shapes_) {
        if (s.candidates.empty()) continue;
        const candidate& first = s.candidates[0];
        s.room = static_cast<double>(first.cells.cells) * cell_ * cell_ * (o.stack ? cell_ : 1.0);
        s.longest = std::max({first.size.x, first.size.y, o.stack ? first.size.z : 0.0});
    }
    number_kinds();
}

void pack_shapes::number_kinds() {
    std::map<footprint, std::uint32_t> numbers;
    std::size_t faces = 0;
    for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
        faces += parts_[i].indexed_view().faces.size() * shapes_[i].candidates.size();
        for (candidate& c : shapes_[i].candidates)
            c.kind =
                numbers.emplace(c.cells, static_cast<std::uint32_t>(numbers.size())).first->second;
    }
    kinds_ = numbers.size();
    if (faces > most_faces_kept) return;
    for (const part_shape& s : shapes_)
        slots_.push_back(std::make_unique<slot[]>(s.candidates.size()));
}

std::shared_ptr<const turned> pack_shapes::in_turn(std::uint32_t part, std::size_t c) const {
    const std::uint32_t first = distinct_[part];
    const auto make = [&] {
        return std::make_shared<const turned>(parts_[first].indexed_view(),
                                              shapes_[first].candidates[c].turn);
    };
    if (slots_.empty()) return make();
    slot& kept = slots_[first][c];
    kept.made.call([&] { kept.part = make(); });
    return kept.part;
}

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
    base::for_numbers(searches.size(), 1, [&](std::size_t i) { find(searches[i]); });
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
        const mesh_view mesh = shapes_.part(i).indexed_view();
        parts[i].placed = mesh.faces.empty();
        parts[i].points.assign(mesh.points.begin(), mesh.points.end());
    }
    plates_.clear();
    return parts;
}

}  // namespace treeform::detail::place
