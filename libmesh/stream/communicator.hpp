#pragma once
/// \file
/// The processes (ranks) that do one work together: what each sends to all, and which share is
/// whose. Progress of work that several threads do, and its end when the caller says so.

#include <libmesh/stream/record_file.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::stream {

/// A range of consecutive elements; by default all.
struct share {
    std::uint64_t first = 0;
    std::uint64_t last = std::numeric_limits<std::uint64_t>::max();  ///< exclusive

    [[nodiscard]] std::uint64_t size() const { return last - first; }
    [[nodiscard]] bool has(std::uint64_t i) const { return i >= first && i < last; }
};

class communicator {
  public:
    explicit communicator(const treeform::communicator& all) : all_(all) {}

    [[nodiscard]] std::size_t size() const { return all_.size; }
    [[nodiscard]] std::size_t rank() const { return all_.rank; }
    [[nodiscard]] bool is_root() const { return all_.rank == 0; }
    /// Whether there is only one process.
    [[nodiscard]] bool is_alone() const { return all_.size == 1; }

    /// The share of a rank in `count` elements.
    [[nodiscard]] share share_of(std::uint64_t count, std::size_t rank) const {
        const std::uint64_t each = count / size();
        const auto begin = [&](std::uint64_t r) {
            return each * r + std::min<std::uint64_t>(r, count % size());
        };
        return {begin(rank), begin(rank + 1)};
    }

    /// The rank whose share contains element `i` of `count`.
    [[nodiscard]] std::size_t owner_of(std::uint64_t i, std::uint64_t count) const {
        const std::uint64_t each = count / size();
        const std::uint64_t larger = count % size() * (each + 1);  // elements in the larger shares
        return static_cast<std::size_t>(i < larger ? i / (each + 1)
                                                   : count % size() + (i - larger) / each);
    }

    /// All-gather: returns what every rank gives, by rank. Collective: every rank must call this.
    [[nodiscard]] std::vector<state_reader> exchange(const state_writer& mine) const {
        std::vector<state_reader> received;
        if (is_alone())
            received.emplace_back(mine.bytes());
        else
            for (std::string& bytes : all_.exchange(mine.bytes())) received.emplace_back(bytes);
        return received;
    }
    /// Rank by rank: the rank writes its message in `send(mine)`, and all ranks get it in
    /// `receive(received)`, before the next rank begins. Collective: every rank must call this.
    template <class Send, class Receive>
    void sequential(const Send& send, const Receive& receive) const {
        for (std::size_t turn = 0; turn < size(); ++turn) {
            state_writer mine;
            if (turn == rank()) send(mine);
            receive(std::move(exchange(mine)[turn]));
        }
    }
    /// The byte at which this rank ends its turn: the end of its share of `bytes`; no limit for the
    /// last rank.
    [[nodiscard]] std::uint64_t end_of_turn(std::uint64_t bytes) const {
        return rank() + 1 == size() ? std::numeric_limits<std::uint64_t>::max()
                                    : share_of(bytes, rank()).last;
    }
    /// Returns when every rank has called it.
    void barrier() const { static_cast<void>(exchange({})); }
    [[nodiscard]] double most(double mine) const {
        state_writer sent;
        sent.real(mine);
        for (state_reader& one : exchange(sent)) mine = std::max(mine, one.real());
        return mine;
    }
    [[nodiscard]] std::uint64_t sum(std::uint64_t mine) const {
        state_writer sent;
        sent.number(mine);
        std::uint64_t all = 0;
        for (state_reader& one : exchange(sent)) all += one.number();
        return all;
    }

    /// The sum of the values of lower ranks.
    [[nodiscard]] std::uint64_t sum_before(std::uint64_t mine) const {
        state_writer sent;
        sent.number(mine);
        std::vector<state_reader> all = exchange(sent);
        std::uint64_t sum = 0;
        for (std::size_t r = 0; r < rank(); ++r) sum += all[r].number();
        return sum;
    }

  private:
    treeform::communicator all_;
};

/// Thrown if the progress callback returned false; caught by the public functions.
struct cancelled {};

class cancellable_progress {
  public:
    explicit cancellable_progress(std::function<bool(std::string_view, double)> progress)
        : progress_(std::move(progress)) {}

    /// \throws cancelled
    void show(std::string_view step, double share) {
        const std::lock_guard lock(one_at_a_time_);
        step_ = step;
        share_ = share;
        ask();
    }
    /// \throws cancelled
    void check() {
        const std::lock_guard lock(one_at_a_time_);
        ask();
    }

  private:
    void ask() const {
        if (progress_ && !progress_(step_, share_)) throw cancelled{};
    }

    std::function<bool(std::string_view, double)> progress_;
    std::mutex one_at_a_time_{};
    std::string step_{"survey"};
    double share_ = 0.0;
};

}  // namespace treeform::detail::stream
