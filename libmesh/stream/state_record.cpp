#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/state_record.hpp>

#include <bit>
#include <cstring>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::size_t word = 8;

std::uint64_t digest_of(std::string_view bytes) {
    digest d;
    d.add(std::as_bytes(std::span(bytes)));
    return d.value();
}

}  // namespace

void state_writer::number(std::uint64_t n) {
    char bytes[word];
    std::memcpy(bytes, &n, word);
    bytes_.append(bytes, word);
}

void state_writer::real(double x) { number(std::bit_cast<std::uint64_t>(x)); }

void state_writer::point(const point3& p) {
    for (std::size_t k = 0; k < 3; ++k) real(p[k]);
}

void state_writer::text(std::string_view s) {
    number(s.size());
    bytes_ += s;
    bytes_.append((word - s.size() % word) % word, '\0');
}

std::string state_writer::bytes() const {
    state_writer all = *this;
    all.number(digest_of(bytes_));
    return std::move(all.bytes_);
}

state_reader::state_reader(std::string bytes) : bytes_(std::move(bytes)) {
    if (bytes_.size() < word || bytes_.size() % word != 0) return;
    end_ = bytes_.size() - word;
    std::uint64_t stored = 0;
    std::memcpy(&stored, bytes_.data() + end_, word);
    whole_ = stored == digest_of(std::string_view(bytes_).substr(0, end_));
}

std::uint64_t state_reader::number() {
    whole_ = whole_ && at_ < end_;
    if (!whole_) return 0;
    std::uint64_t n = 0;
    std::memcpy(&n, bytes_.data() + at_, word);
    at_ += word;
    return n;
}

double state_reader::real() { return std::bit_cast<double>(number()); }

point3 state_reader::point() {
    point3 p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = real();
    return p;
}

std::string state_reader::text() {
    const std::uint64_t size = number();
    whole_ = whole_ && size <= end_ - at_;
    if (!whole_) return {};
    std::string s = bytes_.substr(at_, size);
    at_ += size + (word - size % word) % word;
    return s;
}

}  // namespace treeform::detail::stream
