#include <libmesh/io/record_index.hpp>

#include <utility>

namespace treeform::detail::io {

record_index scan_rows(const source& in, const char* body, const file_part& part,
                       std::size_t most) {
    text rows(in);
    rows.at = body;
    text_scan scan(rows, part, most);
    bool hexadecimal = false;
    for (rows.skip_spaces(); !rows.done() && scan.is_in_part(); rows.skip_spaces()) {
        scan.add();
        for (; !rows.done() && !is_newline(*rows.at); ++rows.at)
            hexadecimal = hexadecimal || to_lower(*rows.at) == 'x';  // as 0x1.8p1
        in.release_before(rows.at);
    }
    record_index found = std::move(scan).found();
    found.hexadecimal = hexadecimal;
    return found;
}

}  // namespace treeform::detail::io
