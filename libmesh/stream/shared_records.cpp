#include <libmesh/io/point_rows.hpp>
#include <libmesh/stream/shared_records.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace treeform::detail::stream {
namespace {

void store_text(const std::optional<io::record_index>& text, state_writer& state) {
    state.number(text ? 1 : 0);
    if (!text) return;
    for (const std::uint64_t n :
         {text->records, std::uint64_t{text->even}, std::uint64_t{text->hexadecimal}})
        state.number(n);
    state.number(text->columns.size());
    for (const io::text_column& c : text->columns) {
        for (const std::uint64_t n : {std::uint64_t{c.whole}, std::uint64_t{c.beyond},
                                      std::uint64_t{c.unsigned_only}, c.gaps})
            state.number(n);
        state.real(c.least);
        state.real(c.greatest);
    }
    state.number(text->marks.size());
    for (const io::record_index::mark& m : text->marks) {
        state.number(m.record);
        state.number(m.byte);
    }
}

std::optional<io::record_index> load_text(state_reader& state) {
    if (state.number() == 0) return std::nullopt;
    io::record_index text{.records = state.number()};
    text.even = state.number() != 0;
    text.hexadecimal = state.number() != 0;
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left) {
        io::text_column c{.whole = state.number() != 0};
        c.beyond = state.number() != 0;
        c.unsigned_only = state.number() != 0;
        c.gaps = state.number();
        c.least = state.real();
        c.greatest = state.real();
        text.columns.push_back(c);
    }
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left) {
        const std::uint64_t record = state.number();
        text.marks.push_back({record, state.number()});
    }
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
            for (const std::uint64_t n : {seen.next.row, seen.next.byte}) mine.number(n);
        },
        [&](state_reader received) {
            parts.push_back(load_text(received));
            good = good && parts.back();
            next.row = received.number();
            next.byte = received.number();
        });
    return joined_text(parts);
}

}  // namespace

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
