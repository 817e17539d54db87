#include <libmesh/io/lzf.hpp>
#include <libmesh/io/pcd_header.hpp>
#include <libmesh/io/source.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/stream/joined_points.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/rows_in_turn.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/write.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::stream {
namespace {

/// `points` as a file like `header`.
mesh_file file_of(const mesh_file& header, io::point_block points) {
    mesh_file file = header;
    file.warnings.clear();
    file.mesh.points = std::move(points.points);
    if (!points.properties.columns.empty())
        file.attributes.find_or_add("vertex", 0) = std::move(points.properties);
    return file;
}

bool same_columns(const mesh_file& a, const mesh_file& b) {
    const element none;
    const element* const x = a.attributes.find("vertex");
    const element* const y = b.attributes.find("vertex");
    return std::ranges::equal((x == nullptr ? none : *x).columns,
                              (y == nullptr ? none : *y).columns,
                              [](const column& c, const column& d) {
                                  return c.name == d.name && c.type == d.type &&
                                         c.list_length == d.list_length && c.role == d.role;
                              });
}

void clear_rows(mesh_file& file) {
    file.mesh.points.clear();
    for (element& e : file.attributes.elements) {
        const element before = std::move(e);
        io::restart(e, before);
    }
}

namespace fs = std::filesystem;

void send(const io::lzf_place& at, bool good, state_writer& to) {
    to.numbers(good, at.packed, at.unpacked);
    to.text(at.last);
}

}  // namespace

joined_points::joined_points(const cloud_inputs& inputs, bool as_las, const communicator& all)
    : inputs_(inputs), as_las_(as_las), known_(survey_records(inputs.paths, how(), all)) {
    std::vector<mesh_file> firsts;
    for (std::size_t i = 0; i < inputs.paths.size(); ++i) {
        open(i);
        formats_.push_back(reader_->header().format);
        counts_.push_back(reader_->count());
        count_ += counts_.back();
        if (inputs.paths.size() == 1) {
            head_ = reader_->header();
            return;
        }
        // With a point, where there is one: of files without any, no property is missed.
        firsts.push_back(file_of(reader_->header(), read_first(counts_.back())));
    }
    std::vector<std::string> names = inputs.names;
    head_ = concatenate_files(std::move(firsts), names, inputs.mixed);
    of_join_ = std::exchange(head_.warnings, {});
    clear_rows(head_);
    head_.ranges.clear();
    rewind();
}

/// Of a file that is not unpacked yet, zeros in its place: what it is does not matter.
io::point_block joined_points::read_first(std::uint64_t count) {
    io::point_block first;
    const element* const vertices = reader_->header().attributes.find("vertex");
    if (vertices == nullptr || formats_.back() != io::name_of(io::pcd_encoding::compressed)) {
        reader_->read(first, 1);
        return first;
    }
    first.points.resize(std::min<std::uint64_t>(count, 1));
    first.properties = *vertices;
    io::resize_columns(first.properties, first.points.size());
    return first;
}

void joined_points::open(std::size_t file, std::uint64_t first) {
    reader_.reset();
    const bool is_alone = inputs_.paths.size() == 1;
    io::byte_getter unpacked;
    if (!unpacked_.empty() && !unpacked_[file].empty())
        unpacked = [from = std::make_shared<open_file>(unpacked_[file])](std::uint64_t at,
                                                                         auto some) {
            if (from->read(at, some) != some.size()) fail_damaged(from->path());
        };
    reader_.emplace(inputs_.paths[file], how(), first,
                    is_alone ? io::row_use::copied : io::row_use::none, known(file),
                    unpacked ? &unpacked : nullptr);
    file_ = file;
    if (inputs_.paths.size() > 1) fits_ = same_columns(head_, reader_->header());
}

void joined_points::rewind(const share& some) {
    warnings_.clear();
    left_ = some.size();
    ended_ = left_ == 0;
    if (ended_) return;
    std::uint64_t first = some.first;
    std::size_t file = 0;
    while (first > 0 && first >= counts_[file]) first -= counts_[file++];
    open(file, first);
}

bool joined_points::read_some(io::point_block& block, std::size_t most) {
    while (!reader_->read(block, most)) {
        take_warnings();
        if (file_ + 1 == inputs_.paths.size()) return false;
        open(file_ + 1);
    }
    return true;
}

bool joined_points::read(io::point_block& block, std::size_t most) {
    if (ended_) return false;
    // What comes after the share shows whether that is the end of a file, which has warnings.
    const std::uint64_t some = left_ == 0 ? 1 : std::min<std::uint64_t>(most, left_);
    ended_ = !read_some(block, static_cast<std::size_t>(some)) || left_ == 0;
    if (ended_) return false;
    left_ -= block.points.size();
    fit(block);
    return true;
}

void joined_points::take_warnings() {
    const bool alone = inputs_.paths.size() == 1;
    for (const io_warning& w : reader_->header().warnings)
        warnings_.push_back({w.code, alone ? w.text : inputs_.names[file_] + ": " + w.text});
    if (file_ + 1 == inputs_.paths.size())
        warnings_.insert(warnings_.end(), of_join_.begin(), of_join_.end());
}

void joined_points::fit(io::point_block& block) {
    if (!fits_) {
        std::vector<mesh_file> both{head_, file_of(reader_->header(), std::move(block))};
        const std::vector<std::string> names(2);
        mesh_file file = concatenate_files(std::move(both), names, true);
        block.points = std::move(file.mesh.points);
        block.properties = std::move(file.attributes.find_or_add("vertex", 0));
    }
    if (!is_rounded()) return;
    single_ = fits_float32(block.points);
    mesh_file file;
    file.las = las_header{.scale = head_.las->scale, .offset = head_.las->offset};
    file.mesh.points = std::move(block.points);
    moved_ = std::max(moved_, round_to_las(file));
    block.points = std::move(file.mesh.points);
}

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
