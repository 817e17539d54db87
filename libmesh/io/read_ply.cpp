#include <libmesh/io/detail/face_sink.hpp>
#include <libmesh/io/detail/ply_header.hpp>
#include <libmesh/io/detail/ply_values.hpp>
#include <libmesh/io/detail/readers.hpp>
#include <libmesh/io/detail/reserve.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace tf::detail {

namespace {

[[nodiscard]] const column* with_role(const element& e, column_role role) {
    const auto at = std::find_if(e.columns.begin(), e.columns.end(),
                                 [&](const column& c) { return c.role == role; });
    return at == e.columns.end() ? nullptr : &*at;
}

template <class Values>
class body_reader {
  public:
    body_reader(const source& in, ply_header header, mesh_file& file)
        : in_(in), values_(in, header.body), file_(file), faces_(file) {
        file_.attributes.elements = std::move(header.elements);
    }

    void read() {
        check_header();
        for (element& e : file_.attributes.elements) {
            if (!Values::can_hold(values_.bytes_left(), e.rows, e))
                values_.fail("the file ends in element " + e.name + ": " + std::to_string(e.rows) +
                             " promised");
            reserve(e);
            if (e.name == "vertex")
                read_vertices(e);
            else if (e.name == "face")
                read_faces(e);
            else
                read_rows(e);
        }
        if (!values_.only_blanks_left())
            file_.warnings.push_back({"trailing-bytes", "there is more after the last element"});
        if (file_.mesh.faces.size() > std::numeric_limits<std::uint32_t>::max())
            in_.fail("more triangles than 32-bit numbers can name");
    }

  private:
    void check_header() {
        const element* vertices = find_element(file_.attributes, "vertex");
        if (vertices == nullptr) in_.fail("no element 'vertex' in the header");
        for (const auto role : {column_role::x, column_role::y, column_role::z})
            if (with_role(*vertices, role) == nullptr)
                in_.fail("element 'vertex' lacks one of x, y, z");
        if (vertices->rows > std::numeric_limits<std::uint32_t>::max())
            in_.fail("more vertices than 32-bit numbers can name");
        vertex_count_ = static_cast<std::int64_t>(vertices->rows);
        const element* faces = find_element(file_.attributes, "face");
        if (faces != nullptr && faces->rows > 0 &&
            with_role(*faces, column_role::corners) == nullptr)
            in_.fail("element 'face' has no list of vertex_indices");
        const element* strips = find_element(file_.attributes, "tristrips");
        if (strips != nullptr && strips->rows > 0) in_.fail("triangle strips are not read");
    }

    /// What `can_hold` has shown to be in proportion to the file.
    static void reserve(element& e) {
        for (column& c : e.columns) {
            if (c.role != column_role::data) continue;
            if (!c.list_length)
                c.values.reserve(e.rows * size_of(c.type));
            else
                c.list_begin.assign(1, 0);
        }
    }

    void read_data(column& c) {
        if (!c.list_length) return values_.scalar(c);
        for (std::size_t left = values_.length(c); left > 0; --left) values_.scalar(c);
        c.list_begin.push_back(value_count(c));
    }

    void read_rows(element& e) {
        if (e.columns.empty()) return;
        for (std::size_t row = 0; row < e.rows; ++row) {
            values_.begin_row();
            for (column& c : e.columns) read_data(c);
            values_.end_row();
        }
    }

    void read_vertices(element& e) {
        reserve_large(file_.mesh.points, e.rows);
        for (std::size_t row = 0; row < e.rows; ++row) {
            point3 p;
            values_.begin_row();
            for (column& c : e.columns) {
                switch (c.role) {
                    case column_role::x:
                        p.x = values_.coordinate(c);
                        break;
                    case column_role::y:
                        p.y = values_.coordinate(c);
                        break;
                    case column_role::z:
                        p.z = values_.coordinate(c);
                        break;
                    default:
                        read_data(c);
                }
            }
            values_.end_row();
            file_.mesh.points.push_back(p);
        }
    }

    void read_faces(element& e) {
        reserve_large(file_.mesh.faces, e.rows);
        for (std::size_t row = 0; row < e.rows; ++row) {
            values_.begin_row();
            for (column& c : e.columns) {
                if (c.role == column_role::corners)
                    read_corners(c);
                else
                    read_data(c);
            }
            values_.end_row();
        }
    }

    void read_corners(const column& c) {
        const std::size_t count = values_.length(c);
        if (count < 3) values_.fail("face with " + std::to_string(count) + " corners");
        faces_.begin();
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t vertex = values_.index(c);
            if (vertex < 0 || vertex >= vertex_count_)
                values_.fail("vertex index " + std::to_string(vertex) + " is out of range");
            faces_.add(static_cast<std::uint32_t>(vertex));
        }
        faces_.finish();
    }

    const source& in_;
    Values values_;
    mesh_file& file_;
    face_sink faces_;
    std::int64_t vertex_count_ = 0;
};

template <class Values>
void read_body(const source& in, ply_header header, mesh_file& file) {
    body_reader<Values>(in, std::move(header), file).read();
}

}  // namespace

mesh_file read_ply(const source& in) {
    ply_header header = read_ply_header(in);
    mesh_file file;
    file.attributes.comments = std::move(header.comments);
    file.attributes.obj_info = std::move(header.obj_info);
    switch (header.encoding) {
        case ply_encoding::ascii:
            file.format = "ply-ascii";
            read_body<ply_text_values>(in, std::move(header), file);
            break;
        case ply_encoding::little_endian:
            file.format = "ply-binary-le";
            read_body<ply_byte_values<std::endian::little>>(in, std::move(header), file);
            break;
        case ply_encoding::big_endian:
            file.format = "ply-binary-be";
            read_body<ply_byte_values<std::endian::big>>(in, std::move(header), file);
            break;
    }
    file.stored_as = fits_single(file.mesh.points) ? precision::single_ : precision::double_;
    return file;
}

}  // namespace tf::detail
