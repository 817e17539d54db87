#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/rows_in_turn.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

namespace treeform::detail::stream {
namespace {

struct row_range {
    io::row_place first{};
    io::row_place last{};  ///< and one more
};

class turns {
  public:
    turns(const communicator& all, const file_of_rows& of) : all_(all), of_(of) {}

    [[nodiscard]] std::vector<io::row_place> take(
        const std::function<void(const io::row_block&)>& take_block,
        const std::function<void(const io::point_blocks&)>& done) {
        row_range last;
        all_.sequential([&](state_writer& mine) { send(mine, last.last, take_block, done); },
                        [&](state_reader received) {
                            last = hear(received);
                            places_.push_back(last.first);
                        });
        places_.push_back(last.last);
        return std::move(places_);
    }

  private:
    void send(state_writer& mine, const io::row_place& first,
              const std::function<void(const io::row_block&)>& take_block,
              const std::function<void(const io::point_blocks&)>& done) const {
        row_range read;
        std::string failure;
        try {
            read = read_share(first, take_block, done);
        } catch (const io_error& error) {
            if (is_of_tiles(error)) throw;
            failure = error.what();
        }
        mine.text(failure);
        for (const io::row_place& place : {read.first, read.last}) {
            mine.number(place.row);
            mine.number(place.byte);
        }
    }

    [[nodiscard]] static row_range hear(state_reader& one) {
        if (const std::string failure = one.text(); !failure.empty()) throw io_error(failure);
        row_range received;
        for (io::row_place* place : {&received.first, &received.last}) {
            place->row = one.number();
            place->byte = one.number();
        }
        return received;
    }

    [[nodiscard]] row_range read_share(
        const io::row_place& first, const std::function<void(const io::row_block&)>& take_block,
        const std::function<void(const io::point_blocks&)>& done) const {
        io::point_blocks reader(of_.path, {.format = std::string(of_.format)}, 0, of_.use,
                                of_.known);
        if (!places_.empty()) reader.go_to(first);
        row_range read{.first = reader.next_row()};
        read.last = read.first;
        const std::uint64_t end = end_of_share(read.first.byte);
        const std::size_t most = rows_at_once(reader.header());
        for (io::row_block block; read.last.byte < end && reader.read(block, most);) {
            take_block(block);
            read.last = reader.next_row();
        }
        if (done) done(reader);
        return read;
    }

    /// Byte of the file; the last one reads to the end.
    [[nodiscard]] std::uint64_t end_of_share(std::uint64_t first) const {
        std::error_code unknown;
        const std::uint64_t bytes = std::filesystem::file_size(of_.path, unknown);
        if (unknown) return std::numeric_limits<std::uint64_t>::max();
        const std::uint64_t begin = places_.empty() ? first : places_.front().byte;
        const std::uint64_t end = all_.end_of_turn(bytes - begin);
        return end == std::numeric_limits<std::uint64_t>::max() ? end : begin + end;
    }

    /// Few enough that shares are alike.
    [[nodiscard]] std::size_t rows_at_once(const mesh_file& header) const {
        constexpr std::uint64_t blocks_a_share = 32;
        constexpr std::uint64_t most = std::uint64_t{1} << 15;
        std::uint64_t rows = 0;
        for (const element& e : header.attributes.elements) rows += e.rows;
        return static_cast<std::size_t>(std::min(rows / (blocks_a_share * all_.size()) + 1, most));
    }

    const communicator& all_;
    const file_of_rows& of_;
    std::vector<io::row_place> places_{};  ///< where the shares so far begin
};

}  // namespace

std::vector<io::row_place> rows_in_turn(const communicator& all, const file_of_rows& of,
                                        const std::function<void(const io::row_block&)>& take,
                                        const std::function<void(const io::point_blocks&)>& done) {
    return turns(all, of).take(take, done);
}

}  // namespace treeform::detail::stream
