#include <libmesh/io/point_blocks.hpp>
#include <libmesh/stream/shared_text.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::stream {
namespace {

void store_text(const std::optional<io::text_index>& text, state_writer& state) {
    state.number(text ? 1 : 0);
    if (!text) return;
    for (const std::uint64_t n :
         {text->records, std::uint64_t{text->even}, std::uint64_t{text->hexadecimal}})
        state.number(n);
    state.number(text->marks.size());
    for (const io::text_index::mark& m : text->marks) {
        state.number(m.record);
        state.number(m.byte);
    }
}

std::optional<io::text_index> load_text(state_reader& state) {
    if (state.number() == 0) return std::nullopt;
    io::text_index text{.records = state.number()};
    text.even = state.number() != 0;
    text.hexadecimal = state.number() != 0;
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left) {
        const std::uint64_t record = state.number();
        text.marks.push_back({record, state.number()});
    }
    return text;
}

using parts_of_text = std::vector<std::optional<io::text_index>>;

/// How many parts from the first one on are as one that knows what is ahead has seen them: those up to
/// the first line that is uneven. Behind it less of a line is looked at.
std::size_t seen_as_one(const parts_of_text& parts) {
    const auto uneven =
        std::ranges::find_if(parts, [](const auto& part) { return !part || !part->even; });
    return std::min(parts.size(), static_cast<std::size_t>(uneven - parts.begin()) + 1);
}

/// Whether parts behind an uneven line may have been taken for what they are not.
bool is_misread(const parts_of_text& parts) {
    const std::size_t seen = seen_as_one(parts);
    return parts[seen - 1] &&
           std::any_of(parts.begin() + static_cast<std::ptrdiff_t>(seen), parts.end(),
                       [](const auto& part) { return !part || part->hexadecimal; });
}

std::optional<io::text_index> joined_text(const parts_of_text& parts) {
    io::text_index all;
    for (const auto& part : parts) {
        if (!part) return std::nullopt;
        all.add(*part);
    }
    return all;
}

}  // namespace

std::vector<std::optional<io::text_index>> look_at_texts(
    const std::vector<std::filesystem::path>& paths, std::string_view format, const team& all) {
    const std::size_t marks =
        std::clamp<std::size_t>(4 * io::most_marks / paths.size(), 2, io::most_marks);
    const io::file_part part{all.rank(), all.size()};
    std::vector<parts_of_text> texts(paths.size());
    const auto share = [&](const auto& scan) {
        state_writer mine;
        for (std::size_t i = 0; i < paths.size(); ++i) store_text(scan(i), mine);
        texts.assign(paths.size(), {});
        for (state_reader& one : all.exchange(mine))
            for (parts_of_text& parts : texts) parts.push_back(load_text(one));
    };
    share([&](std::size_t i) { return io::scan_points(paths[i], format, part, marks); });
    if (std::ranges::any_of(texts, is_misread))
        share([&](std::size_t i) {
            const bool again = is_misread(texts[i]) && all.rank() >= seen_as_one(texts[i]);
            return again ? io::scan_points(paths[i], format, part, marks, false)
                         : texts[i][all.rank()];
        });
    std::vector<std::optional<io::text_index>> joined;
    for (const parts_of_text& parts : texts) joined.push_back(joined_text(parts));
    return joined;
}

}  // namespace treeform::detail::stream
