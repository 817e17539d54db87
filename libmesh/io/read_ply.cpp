#include <libmesh/io/face_sink.hpp>
#include <libmesh/io/fixed_rows.hpp>
#include <libmesh/io/ply_body.hpp>
#include <libmesh/io/ply_header.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/scratch.hpp>

#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

template <class Values>
class body_reader {
  public:
    /// The elements of `file` are those of the header.
    body_reader(const source& in, Values values, mesh_file& file)
        : in_(in), values_(std::move(values)), file_(file), faces_(file) {}

    void read() {
        check_header();
        for (element& e : file_.attributes.elements) {
            check_room(values_, e);
            start_columns(e, e.rows);
            if (e.name == "vertex")
                read_vertices(e);
            else if (e.name == "face")
                read_faces(e);
            else if (e.name == "tristrips")
                read_strips(e);
            else
                read_rows(e);
        }
        look_behind(values_, file_.warnings);
        faces_.remark(file_.warnings);
        if (from_strips_) store_strips();
        if (file_.mesh.faces.size() > most_numbers)
            in_.fail("more triangles than 32-bit numbers can name");
        take_face_texture(file_);
    }

  private:
    void check_header() {
        const element& vertices = vertices_of(in_, file_.attributes.elements);
        if (vertices.rows > most_numbers) in_.fail("more vertices than 32-bit numbers can name");
        vertex_count_ = static_cast<std::int64_t>(vertices.rows);
        const element* faces = file_.attributes.find("face");
        if (faces != nullptr && faces->rows > 0 &&
            with_role(*faces, column_role::corners) == nullptr)
            in_.fail("element 'face' has no list of vertex_indices");
        const element* strips = file_.attributes.find("tristrips");
        from_strips_ = strips != nullptr && strips->rows > 0;
        if (!from_strips_) return;
        if (with_role(*strips, column_role::corners) == nullptr)
            in_.fail("element 'tristrips' has no list of vertex_indices");
        if (faces != nullptr && faces->rows > 0)
            in_.fail("a file with both faces and triangle strips is not supported");
    }

    void read_rows(element& e) {
        for (std::size_t row = 0; row < e.rows && !e.columns.empty(); ++row)
            (void)read_row(values_, e, [](const column&) { return true; });
    }

    void read_vertices(element& e) {
        reserve_large(file_.mesh.points, e.rows);
        append_vertices(values_, e, file_.mesh.points, e.rows);
    }

    void read_faces(element& e) {
        reserve_large(file_.mesh.faces, e.rows);
        std::size_t kept = 0;
        for (std::size_t row = 0; row < e.rows; ++row) {
            if (read_row(values_, e, [&](const column& c) { return read_corners(c); }))
                ++kept;
            else
                drop_last_row(e);
        }
        e.rows = kept;
    }

    /// False for fewer than three.
    [[nodiscard]] bool read_corners(const column& c) {
        faces_.begin();
        for (std::size_t left = values_.length(c); left > 0; --left)
            faces_.add(vertex(values_.index(c)));
        return faces_.finish();
    }

    [[nodiscard]] std::uint32_t vertex(std::int64_t index) const {
        if (index < 0 || index >= vertex_count_)
            values_.fail("vertex index " + std::to_string(index) + " is out of range");
        return static_cast<std::uint32_t>(index);
    }

    void read_strips(element& e) {
        for (std::size_t row = 0; row < e.rows; ++row)
            (void)read_row(values_, e, [&](const column& c) { return read_strip_list(c); });
    }

    /// Each vertex from the third on is that of a triangle with the two before it; every second
    /// triangle is turned over. -1 ends a strip. Triangles that repeat a vertex, by which strips
    /// are joined, stay: other readers number the faces so, too.
    bool read_strip_list(const column& c) {
        std::uint32_t a = 0, b = 0;  // the two before
        std::size_t place = 0;       // in its strip
        for (std::size_t left = values_.length(c); left > 0; --left) {
            const std::int64_t index = values_.index(c);
            if (index == -1) {
                place = 0;
                continue;
            }
            const std::uint32_t v = vertex(index);
            if (place >= 2) faces_.add_triangle(place % 2 == 0 ? face{a, b, v} : face{b, a, v});
            a = b;
            b = v;
            ++place;
        }
        return true;
    }

    /// What is written of them are faces.
    void store_strips() {
        std::erase_if(file_.attributes.elements,
                      [](const element& e) { return e.name == "tristrips" || e.name == "face"; });
        file_.warnings.push_back({"triangle-strips", "the faces were read from triangle strips"});
    }

    const source& in_;
    Values values_;
    mesh_file& file_;
    face_sink faces_;
    std::int64_t vertex_count_ = 0;
    bool from_strips_ = false;
};

}  // namespace

mesh_file read_ply(const source& in) {
    ply_header header = read_ply_header(in);
    mesh_file file;
    take_remarks(header, file);
    with_reader(in, header, [&](const char* format, auto values) {
        file.format = format;
        file.attributes.elements = std::move(header.elements);
        body_reader<decltype(values)>(in, std::move(values), file).read();
    });
    file.stored_as = fits_float32(file.mesh.points) ? precision::float32 : precision::float64;
    return file;
}

}  // namespace treeform::detail::io
