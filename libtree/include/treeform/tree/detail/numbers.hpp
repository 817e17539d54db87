#pragma once
/// \file
/// The numbers from 0 on as a range, as `std::views::iota` would be if all compilers took it.

#include <compare>
#include <cstddef>
#include <iterator>
#include <ranges>

namespace treeform::detail {

/// The numbers 0 ... count - 1, a random-access range without memory.
class numbers {
  public:
    class iterator {
      public:
        using value_type = std::size_t;
        using difference_type = std::ptrdiff_t;
        using iterator_concept = std::random_access_iterator_tag;

        iterator() = default;
        explicit iterator(std::size_t at) : at_(at) {}

        std::size_t operator*() const { return at_; }
        std::size_t operator[](difference_type n) const { return *(*this + n); }
        iterator& operator++() { return *this += 1; }
        iterator& operator--() { return *this -= 1; }
        iterator operator++(int) { return iterator(at_++); }
        iterator operator--(int) { return iterator(at_--); }
        iterator& operator+=(difference_type n) {
            at_ += static_cast<std::size_t>(n);
            return *this;
        }
        iterator& operator-=(difference_type n) { return *this += -n; }
        friend iterator operator+(iterator i, difference_type n) { return i += n; }
        friend iterator operator+(difference_type n, iterator i) { return i += n; }
        friend iterator operator-(iterator i, difference_type n) { return i -= n; }
        friend difference_type operator-(iterator i, iterator j) {
            return static_cast<difference_type>(i.at_ - j.at_);
        }
        friend auto operator<=>(const iterator&, const iterator&) = default;

      private:
        std::size_t at_ = 0;
    };

    explicit numbers(std::size_t count) : count_(count) {}
    [[nodiscard]] iterator begin() const { return iterator(0); }
    [[nodiscard]] iterator end() const { return iterator(count_); }

  private:
    std::size_t count_;
};
static_assert(std::ranges::random_access_range<const numbers>);
static_assert(std::ranges::sized_range<const numbers>);

}  // namespace treeform::detail
