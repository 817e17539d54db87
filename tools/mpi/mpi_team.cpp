/// \file
/// The team of mpirun by MPI: one collective call, of a few messages a run.

#include "tools/mpi/team_calls.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace {

/// Lengths first, then all bytes.
std::vector<std::string> exchange(const std::string& sent) {
    int size = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    const auto count = static_cast<std::size_t>(size);
    const std::uint64_t length = sent.size();
    std::vector<std::uint64_t> lengths(count);
    MPI_Allgather(&length, 1, MPI_UINT64_T, lengths.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
    std::vector<std::string> all(count);
    // MPI counts with 31 bits: one after the other, each in pieces.
    constexpr std::uint64_t most = std::uint64_t{1} << 30;
    for (std::size_t rank = 0; rank < count; ++rank) {
        std::string& one = all[rank];
        if (one = sent; lengths[rank] != sent.size()) one.assign(lengths[rank], '\0');
        for (std::uint64_t at = 0; at < lengths[rank]; at += most)
            MPI_Bcast(one.data() + at, static_cast<int>(std::min(most, lengths[rank] - at)),
                      MPI_BYTE, static_cast<int>(rank), MPI_COMM_WORLD);
    }
    return all;
}

void leave() { MPI_Finalize(); }

void abort_all(int status) {
    std::fflush(nullptr);
    MPI_Abort(MPI_COMM_WORLD, status);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const tools::team_calls* treeform_communicator() {
    static tools::team_calls calls{0, 1, &exchange, &leave, &abort_all};
    int given = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS ||
        given < MPI_THREAD_FUNNELED)
        return nullptr;
    int rank = 0;
    int size = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    calls.rank = static_cast<std::size_t>(rank);
    calls.size = static_cast<std::size_t>(size);
    return &calls;
}
