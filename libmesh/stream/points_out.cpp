#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/stream/joined_parts.hpp>
#include <libmesh/stream/points_out.hpp>
#include <libmesh/stream/record_file.hpp>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::uint64_t held_bytes = std::uint64_t{1} << 22;

/// Points that are to be filled in.
io::point_block block_like(const mesh_file& header, std::size_t points) {
    io::point_block block;
    block.points.resize(points);
    if (const element* const vertices = header.attributes.find("vertex"))
        block.properties = *vertices;
    io::resize_columns(block.properties, points);
    return block;
}

}  // namespace

leading_points::leading_points(const work_folder& folder, const communicator& all,
                               const std::string& name, const mesh_file& header, std::uint64_t mine,
                               std::uint64_t together)
    : header_(header), packed_(header), exchanged_(folder, all, name, packed_.width(), held_bytes) {
    state_writer sent;
    sent.number(mine);
    std::vector<std::uint64_t> parts;  // where they begin
    std::uint64_t before = 0;
    std::uint64_t first = 0;
    for (state_reader& one : all.exchange(sent)) {
        if (parts.size() == all.rank()) first = before;
        parts.push_back((before + together - 1) / together * together);
        before += one.number();
    }
    left_ = std::min(parts[all.rank()] - first, mine);
    to_ = static_cast<std::size_t>(std::upper_bound(parts.begin(), parts.end(), first) -
                                   parts.begin() - 1);
}

void leading_points::take_off(io::point_block& block) {
    const auto some =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(left_, block.points.size()));
    if (some == 0) return;
    for (std::uint32_t i = 0; i < some; ++i) {
        row_.clear();
        packed_.pack(block, i, row_);
        exchanged_.put(to_, row_);
    }
    left_ -= some;
    std::vector<std::uint32_t> rest(block.points.size() - some);
    std::iota(rest.begin(), rest.end(), some);
    block.points.erase(block.points.begin(), block.points.begin() + some);
    block.properties = block.properties.gathered(rest);
}

void leading_points::give(const std::function<void(const io::point_block&)>& write) {
    exchanged_.send();
    for (row_reader& from : exchanged_.received())
        while (!from.empty()) {
            std::vector<std::uint64_t> rows;
            const std::size_t most = points_a_block * packed_.width();
            for (; !from.empty() && rows.size() < most; from.pop())
                rows.insert(rows.end(), from.front().begin(), from.front().end());
            io::point_block block = block_like(header_, rows.size() / packed_.width());
            for (std::size_t i = 0; i < block.points.size(); ++i)
                packed_.unpack(numbers(rows).subspan(i * packed_.width(), packed_.width()), block,
                               i);
            write(block);
        }
    exchanged_.remove_received();
}

namespace fs = std::filesystem;

points_out::points_out(const output_path& to, const mesh_file& header, std::uint64_t count,
                       const communicator* all, const fs::path& part, std::size_t most_corners)
    : target_(to.first),
      path_(all == nullptr ? to.first : part_path(to.first, all, part)),
      all_(all),
      writer_(path_, header, count, options_of(to), most_corners) {}

write_options points_out::options_of(const output_path& to) {
    write_options options = to.second;
    const std::string extension = to.first.extension().string();
    if (options.format.empty() && !extension.empty()) options.format = extension.substr(1);
    return options;
}

void points_out::write(const io::point_block& block, const std::vector<std::uint32_t>& rows) {
    if (rows.empty()) return;
    some_.points.clear();
    for (const std::uint32_t row : rows) some_.points.push_back(block.points[row]);
    some_.properties = block.properties.gathered(rows);
    if (leading_) leading_->take_off(some_);
    write_to_file(some_);
}

void points_out::write(const io::point_block& block) {
    if (!leading_) return write_to_file(block);
    some_ = block;
    leading_->take_off(some_);
    write_to_file(some_);
}

void points_out::start_part(const work_folder& folder, const mesh_file& header,
                            const std::string& name, std::uint64_t mine) {
    if (all_ == nullptr) return;
    const std::uint64_t together = writer_.part_granularity();
    if (together > 1) leading_.emplace(folder, *all_, "leading." + name, header, mine, together);
    if (writer_.has_shared_values()) share_values(folder.file("values." + name), mine);
}

void points_out::share_values(const fs::path& file, std::uint64_t mine) {
    values_.emplace(*all_);
    values_->add(file);
    writer_.share_values(
        {.first_point = all_->sum_before(mine),
         .part = all_->rank(),
         .parts = all_->size(),
         .put = [file](std::uint64_t at, auto bytes) { write_to(file, at, bytes); },
         .get =
             [file](std::uint64_t at, auto bytes) {
                 if (read_from(file, at, bytes) != bytes.size()) fail_damaged(file);
             }});
}

void points_out::write(tile_faces& faces, bool all) {
    if (all_ != nullptr) {
        const std::uint64_t mine = writer_.end_part();
        const std::uint64_t points = all_->sum(mine);
        // That of the first one becomes the whole: the points of others are ahead of its rows.
        if (all_->is_root()) writer_.skip_bytes(points - mine);
    }
    faces.give(writer_, all, all_ == nullptr);
}

write_result points_out::commit() {
    if (all_ == nullptr) return writer_.commit();
    if (leading_) leading_->give([&](const io::point_block& block) { write_to_file(block); });
    state_writer chunks;
    chunks.text(writer_.part_summary());
    std::vector<std::string> parts;
    for (state_reader& one : all_->exchange(chunks)) parts.push_back(one.text());
    write_result result;
    const detail::io::written_part part = writer_.commit_part(result, parts);
    const std::string head = head_of_part(part);
    const bool is_last = all_->rank() + 1 == all_->size();
    const std::uint64_t rows = is_last ? fs::file_size(path_) - part.head - part.points : part.rows;
    state_writer mine;
    mine.numbers(part.points, rows);
    mine.real(result.max_displacement);
    mine.text(path_.string());
    mine.text(head);
    std::vector<state_reader> received = all_->exchange(mine);
    std::uint64_t at = part.head;
    std::uint64_t rows_at = part.head;
    fs::path whole;
    std::vector<std::string> heads;
    for (std::size_t r = 0; r < received.size(); ++r) {
        const std::uint64_t bytes = received[r].number();
        const std::uint64_t rows_of_one = received[r].number();
        rows_at += bytes;
        if (r < all_->rank()) {
            at += bytes;
            rows_at += rows_of_one;
        }
        result.max_displacement = std::max(result.max_displacement, received[r].real());
        const std::string path = received[r].text();
        if (r == 0) whole = path;
        if (bytes > 0) heads.push_back(received[r].text());
    }
    if (heads.empty()) heads.push_back(head);
    if (!all_->is_root()) {
        copy_bytes(path_, part.head, whole, at, part.points);
        copy_bytes(path_, part.head + part.points, whole, rows_at, rows);
    }
    if (all_->is_root()) {
        const std::string joined = point_writer::join_heads(heads);
        write_to(whole, 0, std::as_bytes(std::span(joined)));
    }
    all_->barrier();
    if (all_->is_root())
        fs::rename(whole, target_);
    else
        fs::remove(path_);
    return result;
}

std::string points_out::head_of_part(const detail::io::written_part& part) const {
    std::string head(static_cast<std::size_t>(part.head), '\0');
    if (read_from(path_, 0, std::as_writable_bytes(std::span(head))) != head.size())
        fail_damaged(path_);
    return head;
}

}  // namespace treeform::detail::stream
