#pragma once
/// \file
/// Serializes rows of a file in parallel.

#include <libmesh/io/sink.hpp>
#include <libmesh/io/writers.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace treeform::detail::io {

/// Writes rows 0 to `rows` to the sink of `job`, in order. `put(piece, first, last)` writes some
/// rows to the sink of `piece`, which is `job` with another sink. Pieces are written while the next
/// ones are serialized.
///
/// \pre  `put` only changes the sink, since it is called from several threads
/// \same on any number of threads
template <class Put>
void put_by_pieces(const write_job& job, std::size_t rows, const Put& put) {
    constexpr std::size_t rows_of_piece = std::size_t{1} << 12;
    constexpr std::size_t pieces_at_once = 32;
    if (rows <= rows_of_piece) return put(job, std::size_t{0}, rows);
    std::array<std::vector<std::string>, 2> turns;  // one is made, the other one is written
    for (auto& texts : turns) texts.resize(pieces_at_once);
    const std::size_t pieces = chunk_count(rows, rows_of_piece);
    for (std::size_t done = 0, turn = 0; done < pieces; done += pieces_at_once, turn ^= 1) {
        const std::size_t some = std::min(pieces_at_once, pieces - done);
        for_chunks(some + 1, 1, [&](std::size_t task, auto, auto) {
            if (task == 0) {
                for (std::string& text : turns[turn ^ 1]) {
                    job.out.put(text);
                    text.clear();
                }
                return;
            }
            std::string& text = turns[turn][task - 1];
            sink out(text);
            const write_job piece{job.file, job.options, job.result, out};
            const std::size_t first = (done + task - 1) * rows_of_piece;
            put(piece, first, std::min(first + rows_of_piece, rows));
            out.flush();
        });
    }
    for (const auto& texts : turns)
        for (const std::string& text : texts) job.out.put(text);
}

}  // namespace treeform::detail::io
