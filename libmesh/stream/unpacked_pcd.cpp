#include <libmesh/io/lzf.hpp>
#include <libmesh/io/pcd_header.hpp>
#include <libmesh/io/source.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/unpacked_pcd.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::stream {
namespace {

namespace fs = std::filesystem;

void send(const io::lzf_place& at, bool good, state_writer& to) {
    to.number(good ? 1 : 0);
    to.number(at.packed);
    to.number(at.unpacked);
    to.text(at.last);
}

}  // namespace

std::uint64_t unpack_in_turn(const fs::path& pcd, const fs::path& to, const communicator& all,
                             cancellable_progress& pace) {
    const io::source in = io::source::open(pcd, io::scratch_place::file);
    const io::packed_pcd packed = io::find_packed_pcd(in, io::read_pcd_header(in));
    io::lzf_place at;
    const auto put = [&](std::string_view bytes) {
        write_to(to, at.unpacked, std::as_bytes(std::span(bytes)));
        in.release_before(packed.bytes.data() + at.packed);
        pace.check();
    };
    all.sequential(
        [&](state_writer& mine) {
            // What is read and made: where little is packed, much is made.
            const std::uint64_t end = all.end_of_turn(packed.bytes.size() + packed.size);
            const bool good = io::lzf_unpack_on(packed.bytes, at, static_cast<std::size_t>(end),
                                                packed.size, put);
            send(at, good, mine);
        },
        [&](state_reader received) {
            if (received.number() == 0) packed.fail_damaged(in);
            at.packed = static_cast<std::size_t>(received.number());
            at.unpacked = static_cast<std::size_t>(received.number());
            at.last = received.text();
        });
    if (at.packed != packed.bytes.size() || at.unpacked != packed.size) packed.fail_damaged(in);
    return packed.size;
}

unpacked_inputs::unpacked_inputs(const work_folder& folder, const communicator& all,
                                 const cloud_inputs& inputs, joined_points& source,
                                 cancellable_progress& pace)
    : files_(all) {
    std::vector<fs::path> unpacked(inputs.paths.size());
    for (std::size_t i = 0; i < unpacked.size(); ++i) {
        if (source.format(i) != io::name_of(io::pcd_encoding::compressed)) continue;
        unpacked[i] = folder.file("unpacked." + std::to_string(i));
        files_.add(unpacked[i]);
        bytes_ += unpack_in_turn(inputs.paths[i], unpacked[i], all, pace);
    }
    source.read_unpacked(std::move(unpacked));
}

}  // namespace treeform::detail::stream
