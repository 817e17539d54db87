// Of OpenSSL only the older functions let the state of a digest be handed on.
#define OPENSSL_API_COMPAT 0x10101000L

#include "tools/shell/sha256.hpp"

#include <openssl/sha.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <vector>

namespace tools {
namespace {

SHA256_CTX context_of(const std::string& state) {
    SHA256_CTX context;
    std::memcpy(&context, state.data(), sizeof context);
    return context;
}

}  // namespace

sha256::sha256() {
    SHA256_CTX context{};
    SHA256_Init(&context);
    state_.assign(reinterpret_cast<const char*>(&context), sizeof context);
}

void sha256::add(std::span<const std::byte> bytes) {
    SHA256_CTX context = context_of(state_);
    SHA256_Update(&context, bytes.data(), bytes.size());
    state_.assign(reinterpret_cast<const char*>(&context), sizeof context);
}

bool sha256::add_from(const std::filesystem::path& path, std::uint64_t first, std::uint64_t count) {
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(first));
    std::vector<char> buffer(std::size_t{1} << 18);
    for (std::uint64_t left = count; file; left -= static_cast<std::uint64_t>(file.gcount())) {
        if (left == 0) return true;
        const std::uint64_t some = std::min<std::uint64_t>(left, buffer.size());
        file.read(buffer.data(), static_cast<std::streamsize>(some));
        add(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(file.gcount()))));
    }
    return count == to_the_end && file.eof();
}

std::string sha256::hex() const {
    SHA256_CTX context = context_of(state_);
    std::array<unsigned char, 32> sum{};
    SHA256_Final(sum.data(), &context);
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const unsigned byte : sum) text += {digits[byte >> 4], digits[byte & 15]};
    return text;
}

std::string sha256_of(std::span<const std::byte> bytes) {
    sha256 sum;
    sum.add(bytes);
    return sum.hex();
}

std::string sha256_of_file(const std::filesystem::path& path) {
    sha256 sum;
    return sum.add_from(path, 0, sha256::to_the_end) ? sum.hex() : std::string();
}

}  // namespace tools
