#include <libmesh/place/plate_raster.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace treeform::detail::place {
namespace {

/// In cells: what a part may stick out of the cells that it is said to cover, in each direction.
constexpr double slack = 5e-7;

/// A grid of bits that grows by no one: cells to be covered.
struct bit_grid {
    std::size_t words;
    std::vector<std::uint64_t> bits;

    bit_grid(std::int64_t width, std::int64_t height)
        : words(static_cast<std::size_t>(width) / 64 + 1),
          bits(words * static_cast<std::size_t>(height)) {}

    std::span<std::uint64_t> row(std::int64_t r) {
        return std::span(bits).subspan(static_cast<std::size_t>(r) * words, words);
    }
};

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

struct flat_point {
    double x, y;
};

/// The range of x that a triangle has between two values of y.
std::array<double, 2> range_between(const std::array<flat_point, 3>& t, double low, double high) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    const auto include = [&](double x) {
        least = std::min(least, x);
        most = std::max(most, x);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const flat_point &a = t[i], &b = t[(i + 1) % 3];
        if (low <= a.y && a.y <= high) include(a.x);
        for (const double y : {low, high})
            if ((a.y < y) != (b.y < y)) {
                const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
                include(std::clamp(x, std::min(a.x, b.x), std::max(a.x, b.x)));
            }
    }
    return {least, most};
}

void cover(bit_grid& grid, std::int64_t width, std::int64_t height,
           const std::array<flat_point, 3>& t) {
    const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
    const span_of_cells rows = cells_of(y0, y1, height);
    for (std::int64_t r = rows.first; r <= rows.last; ++r) {
        std::array<double, 2> range{x0, x1};
        if (rows.first != rows.last) {
            range = range_between(t, static_cast<double>(r) - slack,
                                  static_cast<double>(r + 1) + slack);
            if (range[0] > range[1]) continue;
        }
        const span_of_cells columns = cells_of(range[0], range[1], width);
        set_bits(grid.row(r), static_cast<std::size_t>(columns.first),
                 static_cast<std::size_t>(columns.last) + 1);
    }
}

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

footprint runs_of(bit_grid& grid, std::int64_t height) {
    footprint part;
    const std::size_t end = grid.words * 64;
    for (std::int64_t r = 0; r < height; ++r) {
        const std::span<const std::uint64_t> row = grid.row(r);
        for (std::size_t at = next_bit(row, 0, end, true); at < end;) {
            const std::size_t stop = next_bit(row, at, end, false);
            part.runs.push_back({static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(at),
                                 static_cast<std::uint32_t>(stop)});
            part.cells += stop - at;
            at = next_bit(row, stop, end, true);
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

footprint cells_covered(mesh_view mesh, double corner_x, double corner_y, double cell) {
    const auto at = [&](std::uint32_t i) {
        const point3& p = mesh.points[i];
        return flat_point{(p.x - corner_x) / cell, (p.y - corner_y) / cell};
    };
    double right = 0.0, top = 0.0;
    for (const face& f : mesh.faces)
        for (const std::uint32_t i : f) {
            right = std::max(right, at(i).x);
            top = std::max(top, at(i).y);
        }
    const std::int64_t width = cells_of(0.0, right, std::int64_t{1} << 31).last + 1;
    const std::int64_t height = cells_of(0.0, top, std::int64_t{1} << 31).last + 1;
    bit_grid grid(width, height);
    for (const face& f : mesh.faces) cover(grid, width, height, {at(f[0]), at(f[1]), at(f[2])});
    return runs_of(grid, height);
}

plate_raster::plate_raster(std::uint32_t width, std::uint32_t height, double spacing, bool square)
    : height_(height),
      words_(std::size_t{width} / 64 + 1),
      taken_(words_ * height),
      touched_(height) {
    // Cells d apart have d - 1 others between them. Both parts may stick out of their cells.
    const double least = spacing + 8.0 * slack;
    const auto gap = [](std::int64_t cells) {
        return static_cast<double>(std::max<std::int64_t>(cells - 1, 0));
    };
    for (std::int64_t row = 0; gap(row) < least; ++row) {
        const double rest = square ? least : std::sqrt(least * least - gap(row) * gap(row));
        reach_.push_back(static_cast<std::int64_t>(std::ceil(rest)));
    }
}

void plate_raster::take(const footprint& part) {
    const auto end = static_cast<std::int64_t>(words_ * 64);
    const auto rows_away = static_cast<std::int64_t>(reach_.size()) - 1;
    for (const cell_run& run : part.runs)
        for (std::int64_t away = -rows_away; away <= rows_away; ++away) {
            const std::int64_t row = std::int64_t{run.row} + away;
            if (row < 0 || row >= std::int64_t{height_}) continue;
            const std::int64_t reach = reach_[static_cast<std::size_t>(std::abs(away))];
            const std::int64_t first = std::max<std::int64_t>(std::int64_t{run.begin} - reach, 0);
            const std::int64_t last = std::min(std::int64_t{run.end} + reach, end);
            if (first >= last) continue;
            const auto at = static_cast<std::size_t>(row);
            set_bits(std::span(taken_).subspan(at * words_, words_),
                     static_cast<std::size_t>(first), static_cast<std::size_t>(last));
            touched_[at] = true;
        }
}

void plate_raster::mark_blocked(const footprint& part, std::uint32_t row,
                                std::span<std::uint64_t> blocked) const {
    std::vector<std::uint64_t> any(words_), shifted(words_);
    for (const cell_run& run : part.runs) {
        const std::size_t at = std::size_t{row} + run.row;
        if (at >= height_ || !touched_[at]) continue;
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
    std::vector<std::uint64_t> blocked(columns / 64 + 1);
    for (std::uint32_t row = from.row; row <= last.row; ++row) {
        std::fill(blocked.begin(), blocked.end(), 0);
        set_bits(blocked, columns, blocked.size() * 64);
        mark_blocked(part, row, blocked);
        const std::size_t start = row == from.row ? from.column : 0;
        const std::size_t free = next_bit(blocked, start, columns, false);
        if (free < columns) return cell_place{row, static_cast<std::uint32_t>(free)};
    }
    return std::nullopt;
}

}  // namespace treeform::detail::place
