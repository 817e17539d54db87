#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/pack_shapes.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
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
        if (part.view().faces.empty()) continue;
        const turned_part as_is(part.view(), 0);
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
        const mesh_view mesh = parts[i].view();
        std::vector<std::uint32_t>& alike = seen[{mesh.points.size(), mesh.faces.size()}];
        const auto same = [&](std::uint32_t j) {
            const mesh_view other = parts[j].view();
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
            const mesh_view part = parts[number].view();
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
        faces += parts_[i].view().faces.size() * shapes_[i].candidates.size();
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
        return std::make_shared<const turned>(parts_[first].view(),
                                              shapes_[first].candidates[c].turn);
    };
    if (slots_.empty()) return make();
    slot& kept = slots_[first][c];
    kept.made.call([&] { kept.part = make(); });
    return kept.part;
}

}  // namespace treeform::detail::place
