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

/// Where lines are uneven, only one that knows those ahead knows what of them is looked at: what is a
/// fault there, or hexadecimal, has to be found from the front. Then nothing is known.
std::optional<io::text_index> joined_text(std::vector<std::optional<io::text_index>>& parts) {
    io::text_index all;
    for (const auto& part : parts) {
        if (!part) return std::nullopt;
        all.add(*part);
    }
    if (parts.size() > 1 && !all.even && all.hexadecimal) return std::nullopt;
    return all;
}

}  // namespace

std::vector<std::optional<io::text_index>> look_at_texts(
    const std::vector<std::filesystem::path>& paths, std::string_view format, const team& all) {
    const std::size_t marks =
        std::clamp<std::size_t>(4 * io::most_marks / paths.size(), 2, io::most_marks);
    state_writer mine;
    for (const std::filesystem::path& path : paths)
        store_text(io::scan_points(path, format, {all.rank(), all.size()}, marks), mine);
    std::vector<state_reader> told = all.exchange(mine);
    std::vector<std::optional<io::text_index>> texts;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        std::vector<std::optional<io::text_index>> parts;
        for (state_reader& one : told) parts.push_back(load_text(one));
        texts.push_back(joined_text(parts));
    }
    return texts;
}

}  // namespace treeform::detail::stream
