#include <libmesh/place/plate.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace treeform::detail::place {
namespace {

/// In cells: what a part may stick out of the cells that it is said to cover, in each direction.
constexpr double slack = 5e-7;

/// Sets the bits [begin, end).
void set_bits(std::span<std::uint64_t> row, std::size_t begin, std::size_t end) {
    while (begin < end) {
        const std::size_t word = begin / 64, from = begin % 64;
        const std::size_t count = std::min(end - begin, 64 - from);
        const std::uint64_t mask =
            count == 64 ? ~std::uint64_t{0} : ((std::uint64_t{1} << count) - 1) << from;
        row[word] |= mask;
        begin += count;
    }
}

struct span_of_cells {
    std::int64_t first, last;
};

/// The cells that hold [low, high]: of an interval on a line between two cells the lower one.
span_of_cells cells_of(double low, double high, std::int64_t count) {
    const auto first = static_cast<std::int64_t>(std::floor(low + slack));
    const auto last = static_cast<std::int64_t>(std::floor(high - slack));
    const std::int64_t end = std::clamp<std::int64_t>(last, 0, count - 1);
    return {std::clamp<std::int64_t>(first, 0, end), end};
}

/// A convex polygon: a triangle, cut by planes.
struct polygon {
    std::array<point3, 9> corners;
    std::size_t count = 0;

    void add(const point3& p) { corners[count++] = p; }
};

/// What is left of it between `low` and `high` along an axis.
polygon cut(const polygon& whole, std::size_t axis, double low, double high) {
    polygon part = whole;
    for (const auto& [limit, sign] : {std::pair(low, 1.0), std::pair(high, -1.0)}) {
        const polygon before = part;
        part.count = 0;
        for (std::size_t i = 0; i < before.count; ++i) {
            const point3 &a = before.corners[i], &b = before.corners[(i + 1) % before.count];
            const double from = sign * (a[axis] - limit), to = sign * (b[axis] - limit);
            if (from >= 0.0) part.add(a);
            if ((from < 0.0) == (to < 0.0)) continue;
            point3 p;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = std::clamp(a[k] + (b[k] - a[k]) * (from / (from - to)), std::min(a[k], b[k]),
                                  std::max(a[k], b[k]));
            part.add(p);
        }
    }
    return part;
}

std::array<double, 2> range_of(const polygon& p, std::size_t axis) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < p.count; ++i) {
        least = std::min(least, p.corners[i][axis]);
        most = std::max(most, p.corners[i][axis]);
    }
    return {least, most};
}

/// A part's own piece of the grid: bits of its cells, from its lowest ones on.
class part_cells {
  public:
    part_cells(mesh_view mesh, const cell_grid& grid) : mesh_(mesh), grid_(grid) {
        std::array<double, 3> low, high{};
        low.fill(std::numeric_limits<double>::infinity());
        for (const face& f : mesh.faces)
            for (const std::uint32_t i : f) {
                const point3 p = at(i);
                for (std::size_t k = 0; k < 3; ++k) {
                    low[k] = std::min(low[k], p[k]);
                    high[k] = std::max(high[k], p[k]);
                }
            }
        constexpr std::int64_t most = std::int64_t{1} << 31;
        for (std::size_t k = 0; k < 3; ++k) {
            const span_of_cells cells = cells_of(low[k], high[k], most);
            first_[k] = cells.first;
            count_[k] = cells.last - cells.first + 1;
        }
        words_ = static_cast<std::size_t>(count_[0]) / 64 + 1;
        bits_.resize(words_ * static_cast<std::size_t>(count_[1] * count_[2]));
    }

    /// The cells of a face.
    void cover(const face& f) {
        polygon whole;
        for (const std::uint32_t i : f) {
            point3 p = at(i);
            for (std::size_t k = 0; k < 3; ++k) p[k] -= static_cast<double>(first_[k]);
            whole.add(p);
        }
        each_slice(whole, 2, [&](std::int64_t layer, const polygon& slab) {
            each_slice(slab, 1, [&](std::int64_t r, const polygon& strip) {
                const auto [low, high] = range_of(strip, 0);
                const span_of_cells columns = cells_of(low, high, count_[0]);
                set_bits(row(layer, r), static_cast<std::size_t>(columns.first),
                         static_cast<std::size_t>(columns.last) + 1);
            });
        });
    }

    void fill_voids();
    [[nodiscard]] footprint runs() const;

  private:
    [[nodiscard]] point3 at(std::uint32_t i) const {
        const point3& p = mesh_.points[i];
        point3 q{(p.x - grid_.corner.x) / grid_.cell, (p.y - grid_.corner.y) / grid_.cell, 0.0};
        if (grid_.layered) q.z = (p.z - grid_.corner.z) / grid_.cell;
        return q;
    }
    /// Calls `use` for each layer or row that the polygon reaches, with what of it is there.
    template <class Use>
    void each_slice(const polygon& whole, std::size_t axis, const Use& use) const {
        const auto [low, high] = range_of(whole, axis);
        const span_of_cells cells = cells_of(low, high, count_[axis]);
        if (cells.first == cells.last) return use(cells.first, whole);
        for (std::int64_t c = cells.first; c <= cells.last; ++c) {
            const polygon part = cut(whole, axis, static_cast<double>(c) - slack,
                                     static_cast<double>(c + 1) + slack);
            if (part.count > 0) use(c, part);
        }
    }
    [[nodiscard]] std::size_t word(std::int64_t layer, std::int64_t r) const {
        return words_ * static_cast<std::size_t>(layer * count_[1] + r);
    }
    std::span<std::uint64_t> row(std::int64_t layer, std::int64_t r) {
        return std::span(bits_).subspan(word(layer, r), words_);
    }

    mesh_view mesh_;
    cell_grid grid_;
    std::array<std::int64_t, 3> first_{}, count_{};  ///< columns, rows, layers
    std::size_t words_ = 0;
    std::vector<std::uint64_t> bits_;
};

/// The first bit from `from` on that is `value`; `end` when there is none.
std::size_t next_bit(std::span<const std::uint64_t> row, std::size_t from, std::size_t end,
                     bool value) {
    while (from < end) {
        const std::uint64_t word = (value ? row[from / 64] : ~row[from / 64]) >> (from % 64);
        if (word != 0)
            return std::min(end, from + static_cast<std::size_t>(std::countr_zero(word)));
        from = (from / 64 + 1) * 64;
    }
    return end;
}

/// Takes the cells that cannot be reached from outside through free ones, from side to side.
void part_cells::fill_voids() {
    // Not a structured binding: clang 14 lets no lambda capture one.
    const std::int64_t columns = count_[0], rows = count_[1], layers = count_[2];
    std::vector<std::uint64_t> free(bits_.size());  // reached
    std::vector<std::array<std::int64_t, 3>> open;
    const auto reach = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        if (x < 0 || y < 0 || z < 0 || x >= columns || y >= rows || z >= layers) return;
        const std::size_t at = word(z, y) + static_cast<std::size_t>(x) / 64;
        const std::uint64_t bit = std::uint64_t{1} << (static_cast<std::size_t>(x) % 64);
        if (((bits_[at] | free[at]) & bit) != 0) return;
        free[at] |= bit;
        open.push_back({x, y, z});
    };
    for (std::int64_t z = 0; z < layers; ++z)
        for (std::int64_t y = 0; y < rows; ++y) {
            const bool rim = z == 0 || y == 0 || z == layers - 1 || y == rows - 1;
            for (std::int64_t x = 0; x < columns;
                 x += rim ? 1 : std::max<std::int64_t>(columns - 1, 1))
                reach(x, y, z);
        }
    while (!open.empty()) {
        const auto [x, y, z] = open.back();
        open.pop_back();
        for (const std::int64_t by : {-1, 1}) {
            reach(x + by, y, z);
            reach(x, y + by, z);
            reach(x, y, z + by);
        }
    }
    const std::size_t last = static_cast<std::size_t>(columns) % 64;
    for (std::size_t i = 0; i < bits_.size(); ++i) {
        bits_[i] = ~free[i];
        if (i % words_ == words_ - 1) bits_[i] &= (std::uint64_t{1} << last) - 1;
    }
}

footprint part_cells::runs() const {
    footprint part;
    const std::size_t end = words_ * 64;
    const auto number = [](std::int64_t n) { return static_cast<std::uint32_t>(n); };
    for (std::int64_t layer = 0; layer < count_[2]; ++layer)
        for (std::int64_t r = 0; r < count_[1]; ++r) {
            const auto bits = std::span(bits_).subspan(word(layer, r), words_);
            for (std::size_t begin = next_bit(bits, 0, end, true); begin < end;) {
                const std::size_t stop = next_bit(bits, begin, end, false);
                const auto x = static_cast<std::size_t>(first_[0]);
                part.runs.push_back({number(first_[2] + layer), number(first_[1] + r),
                                     static_cast<std::uint32_t>(x + begin),
                                     static_cast<std::uint32_t>(x + stop)});
                part.cells += stop - begin;
                begin = next_bit(bits, stop, end, true);
            }
        }
    return part;
}

/// `to` gets the bits of `from`, each `by` places lower.
void shift_down(std::span<const std::uint64_t> from, std::size_t by, std::span<std::uint64_t> to) {
    const std::size_t words = by / 64, bits = by % 64;
    for (std::size_t i = 0; i < to.size(); ++i) {
        const std::uint64_t low = i + words < from.size() ? from[i + words] : 0;
        const std::uint64_t high = i + words + 1 < from.size() ? from[i + words + 1] : 0;
        to[i] = bits == 0 ? low : low >> bits | high << (64 - bits);
    }
}

}  // namespace

footprint telling_first(footprint part) {
    const auto rank = [](const cell_run& run) {
        const unsigned tier = run.row % 8 == 3 ? 0 : run.row % 4 == 1 ? 1 : 2;
        return std::pair(tier, std::int64_t{run.begin} - std::int64_t{run.end});
    };
    std::stable_sort(part.runs.begin(), part.runs.end(),
                     [&](const cell_run& a, const cell_run& b) { return rank(a) < rank(b); });
    return part;
}

footprint cells_covered(mesh_view mesh, const cell_grid& grid) {
    part_cells cells(mesh, grid);
    for (const face& f : mesh.faces) cells.cover(f);
    if (grid.layered) cells.fill_voids();
    return cells.runs();
}

plate_raster::plate_raster(const raster_size& size, double spacing, bool square)
    : size_(size),
      words_(std::size_t{size.columns} / 64 + 1),
      taken_(words_ * size.rows * size.layers),
      touched_(std::size_t{size.rows} * size.layers) {
    // Cells d apart have d - 1 others between them. Both parts may stick out of their cells.
    const double least = spacing + 8.0 * slack;
    const auto gap = [](std::int64_t cells) {
        return static_cast<double>(std::max<std::int64_t>(std::abs(cells) - 1, 0));
    };
    std::int64_t away = 0;
    while (gap(away + 1) < least) ++away;
    const std::int64_t layers = size.layers > 1 ? away : 0;
    for (std::int64_t layer = -layers; layer <= layers; ++layer)
        for (std::int64_t row = -away; row <= away; ++row) {
            const double rest = least * least - gap(layer) * gap(layer) - gap(row) * gap(row);
            if (!square && rest <= 0.0) continue;
            const double columns = square ? least : std::sqrt(rest);
            reach_.push_back({layer, row, static_cast<std::int64_t>(std::ceil(columns))});
        }
}

void plate_raster::take(const footprint& part) {
    const auto end = static_cast<std::int64_t>(words_ * 64);
    for (const cell_run& run : part.runs)
        for (const reach_of_row& reach : reach_) {
            const std::int64_t layer = std::int64_t{run.layer} + reach.layers;
            const std::int64_t row = std::int64_t{run.row} + reach.rows;
            if (layer < 0 || layer >= std::int64_t{size_.layers}) continue;
            if (row < 0 || row >= std::int64_t{size_.rows}) continue;
            const std::int64_t first =
                std::max<std::int64_t>(std::int64_t{run.begin} - reach.columns, 0);
            const std::int64_t last = std::min(std::int64_t{run.end} + reach.columns, end);
            if (first >= last) continue;
            const std::size_t at =
                index_of(static_cast<std::size_t>(layer), static_cast<std::size_t>(row));
            set_bits(std::span(taken_).subspan(at * words_, words_),
                     static_cast<std::size_t>(first), static_cast<std::size_t>(last));
            touched_[at] = true;
        }
}

void plate_raster::mark_blocked(const footprint& part, const cell_place& place,
                                row_space& space) const {
    auto& [blocked, any, shifted] = space;
    for (const cell_run& run : part.runs) {
        const std::size_t layer = std::size_t{place.layer} + run.layer;
        const std::size_t row = std::size_t{place.row} + run.row;
        if (layer >= size_.layers || row >= size_.rows) continue;
        const std::size_t at = index_of(layer, row);
        if (!touched_[at]) continue;
        // Bit x of `any` says whether one of `length` cells from x on is taken, for growing
        // lengths.
        const auto taken = std::span(taken_).subspan(at * words_, words_);
        std::copy(taken.begin(), taken.end(), any.begin());
        const std::size_t wanted = run.end - run.begin;
        for (std::size_t length = 1; length < wanted;) {
            const std::size_t more = std::min(length, wanted - length);
            shift_down(any, more, shifted);
            for (std::size_t i = 0; i < words_; ++i) any[i] |= shifted[i];
            length += more;
        }
        shift_down(any, run.begin, shifted);
        bool full = true;
        for (std::size_t i = 0; i < blocked.size(); ++i) {
            if (i < words_) blocked[i] |= shifted[i];
            full = full && blocked[i] == ~std::uint64_t{0};
        }
        if (full) return;
    }
}

std::optional<cell_place> plate_raster::first_free(const footprint& part, cell_place from,
                                                   cell_place last) const {
    const std::size_t columns = std::min<std::size_t>(std::size_t{last.column} + 1, words_ * 64);
    row_space space{std::vector<std::uint64_t>(columns / 64 + 1),
                    std::vector<std::uint64_t>(words_), std::vector<std::uint64_t>(words_)};
    std::vector<std::uint64_t>& blocked = space.blocked;
    for (cell_place at = from; at.layer <= last.layer; ++at.layer, at.row = 0)
        for (; at.row <= last.row; ++at.row) {
            std::fill(blocked.begin(), blocked.end(), 0);
            set_bits(blocked, columns, blocked.size() * 64);
            mark_blocked(part, at, space);
            const bool first = at.layer == from.layer && at.row == from.row;
            const std::size_t free = next_bit(blocked, first ? from.column : 0, columns, false);
            if (free < columns)
                return cell_place{at.layer, at.row, static_cast<std::uint32_t>(free)};
        }
    return std::nullopt;
}

}  // namespace treeform::detail::place
