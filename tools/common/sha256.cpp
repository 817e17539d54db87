#include "tools/common/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace tools {
namespace {

class digest {
  public:
    digest() { require(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr)); }

    void add(std::span<const std::byte> bytes) {
        require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
    }

    [[nodiscard]] std::string hex() {
        std::array<unsigned char, 32> sum{};
        require(EVP_DigestFinal_ex(context_.get(), sum.data(), nullptr));
        constexpr std::string_view digits = "0123456789abcdef";
        std::string text;
        for (const unsigned byte : sum) text += {digits[byte >> 4], digits[byte & 15]};
        return text;
    }

  private:
    static void require(int result) {
        if (result != 1) throw std::runtime_error("SHA-256 is not available");
    }
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(),
                                                                     EVP_MD_CTX_free};
};

}  // namespace

std::string sha256_of(std::span<const std::byte> bytes) {
    digest sum;
    sum.add(bytes);
    return sum.hex();
}

std::string sha256_of_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    digest sum;
    std::vector<char> buffer(std::size_t{1} << 18);
    while (file) {
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        sum.add(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(file.gcount()))));
    }
    return file.eof() ? sum.hex() : std::string();
}

}  // namespace tools
