#include <libmesh/io/point_rows.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/rows_in_turn.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

namespace treeform::detail::stream {
namespace {

/// Few enough that shares are alike.
std::size_t rows_at_once(const mesh_file& header, const communicator& all) {
    constexpr std::uint64_t blocks_a_share = 32;
    constexpr std::uint64_t most = std::uint64_t{1} << 15;
    std::uint64_t rows = 0;
    for (const element& e : header.attributes.elements) rows += e.rows;
    return static_cast<std::size_t>(std::min(rows / (blocks_a_share * all.size()) + 1, most));
}

/// Byte of the file, whose rows begin at `begin`; the last one reads to the end.
std::uint64_t end_of_share(const std::filesystem::path& path, std::uint64_t begin,
                           const communicator& all) {
    std::error_code unknown;
    const std::uint64_t bytes = std::filesystem::file_size(path, unknown);
    if (unknown) return std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t end = all.end_of_turn(bytes - begin);
    return end == std::numeric_limits<std::uint64_t>::max() ? end : begin + end;
}

void store_text(const std::optional<io::record_index>& text, state_writer& state) {
    state.number(text.has_value());
    if (!text) return;
    state.numbers(text->records, text->even, text->hexadecimal, text->columns.size());
    for (const io::text_column& c : text->columns) {
        state.numbers(c.whole, c.beyond, c.unsigned_only, c.gaps);
        state.real(c.min);
        state.real(c.max);
    }
    state.number(text->marks.size());
    for (const io::record_index::mark& m : text->marks) state.numbers(m.record, m.byte);
}

std::optional<io::record_index> load_text(state_reader& state) {
    if (state.number() == 0) return std::nullopt;
    io::record_index text{.records = state.number()};
    text.even = state.number() != 0;
    text.hexadecimal = state.number() != 0;
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left)
        text.columns.push_back({state.number() != 0, state.number() != 0, state.number() != 0,
                                state.number(), state.real(), state.real()});
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left)
        text.marks.push_back({state.number(), state.number()});
    return text;
}

using parts_of_file = std::vector<std::optional<io::record_index>>;

/// How many parts from the first one on are as one that knows what is ahead has seen them: those up
/// to the first line that is uneven. Behind it less of a line is looked at.
std::size_t seen_as_one(const parts_of_file& parts) {
    const auto uneven =
        std::ranges::find_if(parts, [](const auto& part) { return !part || !part->even; });
    return std::min(parts.size(), static_cast<std::size_t>(uneven - parts.begin()) + 1);
}

/// Whether parts behind an uneven line may have been taken for what they are not.
bool is_misread(const parts_of_file& parts) {
    const std::size_t seen = seen_as_one(parts);
    return parts[seen - 1] &&
           std::any_of(parts.begin() + static_cast<std::ptrdiff_t>(seen), parts.end(),
                       [](const auto& part) { return !part || part->hexadecimal; });
}

std::optional<io::record_index> joined_text(const parts_of_file& parts) {
    io::record_index all;
    for (const auto& part : parts) {
        if (!part) return std::nullopt;
        all.add(*part);
    }
    return all;
}

/// Points with lists: each rank in turn reads on where the one before has ended.
std::optional<io::record_index> survey_in_turn(const std::filesystem::path& path,
                                               const communicator& all, std::size_t marks) {
    parts_of_file parts;
    io::row_place next;
    bool good = true;
    all.sequential(
        [&](state_writer& mine) {
            io::listed_points seen;
            try {
                const io::source in = io::source::open(path);
                if (good)
                    seen = io::scan_listed_points(in, next, all.end_of_turn(in.size()), marks);
            } catch (const io_error&) {  // it is said where the point is read
                good = false;
            }
            store_text(good ? std::optional(std::move(seen.found)) : std::nullopt, mine);
            mine.numbers(seen.next.row, seen.next.byte);
        },
        [&](state_reader received) {
            parts.push_back(load_text(received));
            good = good && parts.back();
            next = {received.number(), received.number()};
        });
    return joined_text(parts);
}

}  // namespace

std::vector<io::row_place> rows_in_turn(const communicator& all, const file_of_rows& of,
                                        const std::function<void(const row_block&)>& take,
                                        const std::function<void(const io::point_blocks&)>& done) {
    std::vector<io::row_place> places;  // where the shares so far begin
    io::row_place next;                 // and where the last of them ends
    const auto read_share = [&]() -> std::array<io::row_place, 2> {
        io::point_blocks reader(of.path, {.format = std::string(of.format)}, 0, of.use, of.known);
        if (!places.empty()) reader.go_to(next);
        const io::row_place first = reader.next_row();
        io::row_place last = first;
        const std::uint64_t end =
            end_of_share(of.path, places.empty() ? first.byte : places.front().byte, all);
        const std::size_t most = rows_at_once(reader.header(), all);
        for (row_block block; last.byte < end && reader.read(block, most);) {
            take(block);
            last = reader.next_row();
        }
        if (done) done(reader);
        return {first, last};
    };
    all.sequential(
        [&](state_writer& mine) {
            std::array<io::row_place, 2> read;
            std::string failure;
            try {
                read = read_share();
            } catch (const io_error& error) {
                if (is_of_tiles(error)) throw;
                failure = error.what();
            }
            mine.text(failure);
            for (const io::row_place& place : read) mine.numbers(place.row, place.byte);
        },
        [&](state_reader received) {
            if (const std::string failure = received.text(); !failure.empty())
                throw io_error(failure);
            places.push_back({received.number(), received.number()});
            next = {received.number(), received.number()};
        });
    places.push_back(next);
    return places;
}

std::vector<std::optional<io::record_index>> survey_records(
    const std::vector<std::filesystem::path>& paths, const io::reading& how,
    const communicator& all) {
    const std::size_t marks =
        std::clamp<std::size_t>(4 * io::most_marks / paths.size(), 2, io::most_marks);
    const io::file_part part{all.rank(), all.size()};
    std::vector<parts_of_file> texts(paths.size());
    const auto share = [&](const auto& scan) {
        state_writer mine;
        for (std::size_t i = 0; i < paths.size(); ++i) store_text(scan(i), mine);
        texts.assign(paths.size(), {});
        for (state_reader& one : all.exchange(mine))
            for (parts_of_file& parts : texts) parts.push_back(load_text(one));
    };
    share([&](std::size_t i) { return io::scan_points(paths[i], how, part, marks); });
    if (std::ranges::any_of(texts, is_misread))
        share([&](std::size_t i) {
            const bool again = is_misread(texts[i]) && all.rank() >= seen_as_one(texts[i]);
            return again ? io::scan_points(paths[i], how, part, marks, false)
                         : texts[i][all.rank()];
        });
    std::vector<std::optional<io::record_index>> joined;
    for (std::size_t i = 0; i < paths.size(); ++i)
        joined.push_back(!all.is_alone() && io::has_listed_points_at(paths[i], how)
                             ? survey_in_turn(paths[i], all, marks)
                             : joined_text(texts[i]));
    return joined;
}

}  // namespace treeform::detail::stream
