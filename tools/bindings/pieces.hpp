#pragma once
/// \file
/// Work on many elements piece by piece, so that progress can be reported in between.

#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace tools {

/// A message about an element of a piece, with its number in the whole instead.
[[nodiscard]] inline std::string numbered_in_whole(const std::string& message, std::size_t begin) {
    const std::size_t at = message.find_first_of("0123456789");
    if (begin == 0 || at == std::string::npos) return message;
    std::size_t digits = 0;
    const std::size_t number = std::stoull(message.substr(at), &digits);
    return message.substr(0, at) + std::to_string(begin + number) + message.substr(at + digits);
}

/// Calls `body(begin, end)` for pieces of `count` elements, one after the other. A piece takes some
/// hundredths of a second; results must not depend on its size. `report` is called before each
/// piece with the completed share.
///
/// Returns false if `report` asked to stop.
///
/// \throws what `body` throws; in the message of std::invalid_argument, the first number is that of
///         an element, and is replaced by its number in the whole
template <class Body>
[[nodiscard]] bool in_pieces(std::size_t count, const treeform::progress_callback& report,
                             const Body& body) {
    using std::chrono::milliseconds;
    using std::chrono::steady_clock;
    std::size_t piece = 128;
    for (std::size_t begin = 0; begin < count;) {
        if (report && !report(static_cast<double>(begin) / static_cast<double>(count)))
            return false;
        const auto started = steady_clock::now();
        const std::size_t end = std::min(count, begin + piece);
        try {
            body(begin, end);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument(numbered_in_whole(error.what(), begin));
        }
        const auto taken = steady_clock::now() - started;
        if (taken < milliseconds(10)) piece *= 2;
        if (taken > milliseconds(40)) piece = std::max<std::size_t>(1, piece / 2);
        begin = end;
    }
    return true;
}

}  // namespace tools
