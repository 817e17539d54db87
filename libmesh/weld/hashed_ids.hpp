#pragma once
/// \file
/// A hash multimap from hashes to numbers.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::weld {

/// Numbers by hash, with open addressing; grows on demand.
class hashed_ids {
  public:
    hashed_ids() : slots_(256, empty) {}

    void add(std::uint64_t hash, std::uint32_t id) {
        if (2 * (used_ + 1) > slots_.size()) grow();
        const slot added{static_cast<std::uint32_t>(hash), id};
        slots_[free_from(hash)] = added;
        ++used_;
    }

    /// Calls `visit_id(id)` for the numbers added with that hash, and sometimes for others.
    template <class Visit>
    void visit(std::uint64_t hash, const Visit& visit_id) const {
        const auto tag = static_cast<std::uint32_t>(hash);
        for (std::size_t at = home(tag); slots_[at].id != nobody; at = (at + 1) & mask())
            if (slots_[at].tag == tag) visit_id(slots_[at].id);
    }

    void prefetch(std::uint64_t hash) const {
        __builtin_prefetch(&slots_[home(static_cast<std::uint32_t>(hash))]);
    }

  private:
    struct slot {
        std::uint32_t tag;
        std::uint32_t id;
    };
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
    static constexpr slot empty{0, nobody};

    [[nodiscard]] std::size_t mask() const { return slots_.size() - 1; }
    [[nodiscard]] std::size_t home(std::uint32_t tag) const { return tag & mask(); }
    [[nodiscard]] std::size_t free_from(std::uint64_t hash) const {
        std::size_t at = home(static_cast<std::uint32_t>(hash));
        while (slots_[at].id != nobody) at = (at + 1) & mask();
        return at;
    }

    void grow() {
        std::vector<slot> old(2 * slots_.size(), empty);
        old.swap(slots_);
        for (const slot& s : old)
            if (s.id != nobody) slots_[free_from(s.tag)] = s;
    }

    std::vector<slot> slots_;
    std::size_t used_ = 0;
};

}  // namespace treeform::detail::weld
