#include <libmesh/base/byte_order.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/io/fixed_rows.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/vertex_columns.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace treeform::detail::io {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t record_bytes = 50;
constexpr std::size_t block = 128;  // facets converted at a time; their points stay in cache

/// What the column of the bits behind facets is called.
const char* const bits_name = "stl_attribute";

template <class T>
T little(const char* at) {
    return base::load<T, std::endian::little>(at);
}

/// Header and size disagree. A size of whole facets is believed, for many programs write the count
/// before they know it; else the header, where its facets are there and bytes follow.
std::size_t facet_count(const source& in, std::size_t stated, std::vector<io_warning>& warnings) {
    const std::size_t body = in.size() - header_bytes;
    const std::size_t whole = body / record_bytes;
    const std::string says = "the header announces " + std::to_string(stated) +
                             " triangles, the file has " + std::to_string(whole);
    if (whole > 0 && body % record_bytes == 0) {
        warnings.push_back({"wrong-count", says + "; these were read"});
        return whole;
    }
    if (stated == 0 || whole < stated)
        in.fail_byte(in.begin() + 80, says + ": damaged or truncated");
    const std::size_t behind = body - stated * record_bytes;
    warnings.push_back({"trailing-bytes", std::to_string(behind) +
                                              (behind == 1 ? " byte" : " bytes") + " after the " +
                                              std::to_string(stated) +
                                              " triangles of the header not read"});
    return stated;
}

/// No more than the file holds; found before anything is allocated.
std::uint32_t facet_count(const source& in, std::vector<io_warning>& warnings) {
    if (in.size() < header_bytes)
        in.fail("neither an ASCII STL nor as long as the header of a binary STL, 84 bytes");
    std::size_t count = little<std::uint32_t>(in.begin() + 80);
    if (in.size() != header_bytes + count * record_bytes) count = facet_count(in, count, warnings);
    if (count > std::numeric_limits<std::uint32_t>::max() / 3)
        in.fail("more corners than 32-bit numbers can name");
    return static_cast<std::uint32_t>(count);
}

/// Everything but points and facets; of these, how many there are.
mesh_file stl_head(const source& in) {
    mesh_file head{.indexed = false, .stored_as = precision::float32, .format = "stl-binary"};
    head.stored_faces = facet_count(in, head.warnings);
    head.attributes.header.assign(in.begin(), 80);
    return head;
}

/// Where the corners of a facet are.
std::array<point3, 3> corners_of(const char* facet) {
    std::array<point3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
        const char* const xyz = facet + 12 + 12 * c;
        corners[c] = {little<float>(xyz), little<float>(xyz + 4), little<float>(xyz + 8)};
    }
    return corners;
}

}  // namespace

mesh_file read_stl_binary(const source& in) {
    mesh_file file = stl_head(in);
    const auto count = static_cast<std::uint32_t>(file.stored_faces);
    reserve_large(file.mesh.points, std::size_t{count} * 3);
    reserve_large(file.mesh.faces, count);
    std::array<point3, 3 * block> corners;
    std::vector<std::uint16_t> bits;  // behind each facet; empty as long as all are zero
    const char* at = in.begin() + header_bytes;
    for (std::uint32_t done = 0; done < count;) {
        const auto size = static_cast<std::uint32_t>(std::min<std::size_t>(block, count - done));
        for (std::size_t i = 0; i < size; ++i, at += record_bytes) {
            const std::array<point3, 3> places = corners_of(at);
            std::copy(places.begin(), places.end(), corners.begin() + std::ptrdiff_t{3} * i);
            const auto mine = little<std::uint16_t>(at + 48);
            if (mine != 0 && bits.empty()) bits.assign(done + i, 0);
            if (mine != 0 || !bits.empty()) bits.push_back(mine);
        }
        file.mesh.points.insert(file.mesh.points.end(), corners.begin(),
                                corners.begin() + std::ptrdiff_t{3} * size);
        for (std::uint32_t i = 0; i < size; ++i) {
            const std::uint32_t first = 3 * (done + i);
            file.mesh.faces.push_back({first, first + 1, first + 2});
        }
        done += size;
        in.release_before(at);
    }
    if (!bits.empty())
        file.attributes.find_or_add("face", file.stored_faces)
            .columns.push_back(column::of<std::uint16_t>(bits_name, bits));
    return file;
}

face_rows open_stl_faces(const source& in, const file_part& part) {
    face_rows rows{.head = stl_head(in)};
    const auto count = static_cast<std::uint32_t>(rows.head.stored_faces);
    rows.points = std::uint64_t{3} * count;
    rows.stored_faces = count;
    const char* const facets = in.begin() + header_bytes;
    // No multiple of three, so that all corners have their turn.
    const std::size_t step = (count / sample_size / 3) * 3 + 1;
    const auto first = static_cast<std::uint32_t>(part.first(count));
    const auto last = static_cast<std::uint32_t>(part.last(count));
    for (std::size_t i = (first + step - 1) / step * step; i < last; i += step) {
        const point3 corner = corners_of(facets + record_bytes * i)[i % 3];
        if (base::is_finite(corner)) rows.sample.push_back(corner);
        in.release_before(facets + record_bytes * i);
    }
    in.rewind();
    rows.append = [&in, facets, last, done = first](auto& triangles, std::size_t most,
                                                    auto&) mutable {
        const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(last, done + most));
        const bool some = done < end;
        for (; done < end; ++done)
            triangles.push_back({done,
                                 {3 * done, 3 * done + 1, 3 * done + 2},
                                 corners_of(facets + record_bytes * done)});
        in.release_before(facets + record_bytes * done);
        return some;
    };
    return rows;
}

point_rows open_stl_points(const source& in, std::uint64_t first) {
    point_rows rows{.head = stl_head(in)};
    const auto count = static_cast<std::uint32_t>(rows.head.stored_faces);
    element& faces = rows.head.attributes.find_or_add("face", count);
    faces.columns.push_back({.name = bits_name, .type = scalar_type::uint16});
    const element declared = faces;
    rows.count = std::uint64_t{3} * count;
    rows.left_out = first;
    const char* const facets = in.begin() + header_bytes;
    rows.append = [&in, facets, next = first, end = rows.count](auto& points, element&,
                                                                std::size_t most, auto&) mutable {
        const std::uint64_t some = std::min<std::uint64_t>(most, end - next);
        for (std::uint64_t i = 0; i < some; ++i, ++next)
            points.push_back(corners_of(facets + record_bytes * (next / 3))[next % 3]);
        in.release_before(facets + record_bytes * (next / 3));
        return static_cast<std::size_t>(some);
    };
    const auto at = std::make_shared<std::uint32_t>(0);  // the next facet
    const auto place_of = [&in, facets](std::uint64_t facet) {
        return row_place{
            .row = facet,
            .byte = static_cast<std::uint64_t>(facets - in.begin()) + record_bytes * facet};
    };
    rows.next_row = [place_of, at] { return place_of(*at); };
    rows.go_to = [at, count](const row_place& place) {
        *at = static_cast<std::uint32_t>(std::min<std::uint64_t>(place.row, count));
    };
    rows.row_parts = [place_of, count](std::size_t parts) {
        return parts_of_rows(place_of(0).byte, std::array{alike_rows{count, record_bytes}}, parts);
    };
    rows.behind = [&in, facets, declared, count, at](row_block& some, std::size_t most, auto&) {
        std::uint32_t& next = *at;
        restart(some.rows, declared);
        some.corners.clear();
        some.first_corner.assign(1, 0);
        if (next == 0) in.rewind();
        const auto end = static_cast<std::uint32_t>(std::min<std::uint64_t>(count, next + most));
        std::vector<std::uint16_t> bits;
        for (; next < end; ++next) {
            for (std::uint32_t k = 0; k < 3; ++k) some.corners.push_back(3 * next + k);
            some.first_corner.push_back(some.corners.size());
            bits.push_back(little<std::uint16_t>(facets + record_bytes * next + 48));
        }
        in.release_before(facets + record_bytes * next);
        some.rows.rows = bits.size();
        some.rows.columns.front() = column::of<std::uint16_t>(bits_name, bits);
        return !bits.empty();
    };
    return rows;
}

}  // namespace treeform::detail::io
