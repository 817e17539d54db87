#include <libmesh/stream/joined_parts.hpp>
#include <libmesh/stream/record_file.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::stream {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t bytes_at_once = std::size_t{1} << 20;

}  // namespace

fs::path part_path(const fs::path& to, const communicator* all, const fs::path& part) {
    return all == nullptr || all->is_root() ? fs::path(to.string() + ".unfinished") : part;
}

void copy_bytes(const fs::path& from, std::uint64_t first, const fs::path& to, std::uint64_t at,
                std::uint64_t count) {
    std::vector<std::byte> some(bytes_at_once);
    for (std::uint64_t done = 0; done < count;) {
        const std::span<std::byte> block = std::span(some).first(
            static_cast<std::size_t>(std::min<std::uint64_t>(bytes_at_once, count - done)));
        if (read_from(from, first + done, block) != block.size()) fail_damaged(from);
        write_to(to, at + done, block);
        done += block.size();
    }
}

text_out::text_out(fs::path to, const communicator* all, const fs::path& part)
    : target_(std::move(to)), path_(part_path(target_, all, part)), all_(all) {
    fs::remove(path_);
}

void text_out::write(std::string_view text) {
    held_ += text;
    if (held_.size() >= bytes_at_once) flush();
}

void text_out::flush() {
    try {
        append_to(path_, std::as_bytes(std::span(held_)));
    } catch (const io_error& error) {
        throw io_error(target_.string() + std::string(error.what()).substr(path_.string().size()));
    }
    written_ += held_.size();
    held_.clear();
}

void text_out::commit() {
    flush();
    if (all_ != nullptr) {
        state_writer mine;
        mine.text(path_.string());
        mine.number(written_);
        std::vector<state_reader> received = all_->exchange(mine);
        const fs::path whole = received.front().text();
        std::uint64_t at = received.front().number();
        for (std::size_t r = 1; r < all_->rank(); ++r) {
            static_cast<void>(received[r].text());
            at += received[r].number();
        }
        if (!all_->is_root()) copy_bytes(path_, 0, whole, at, written_);
        all_->barrier();
    }
    if (all_ == nullptr || all_->is_root())
        fs::rename(path_, target_);
    else
        fs::remove(path_);
}

}  // namespace treeform::detail::stream
