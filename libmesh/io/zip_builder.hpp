#pragma once
/// \file
/// Writes a ZIP archive member by member.

#include <cstddef>
#include <string>
#include <string_view>

namespace treeform::detail::io {

/// Writes an archive to a string. Members have no time stamps, so that the same members give the
/// same bytes.
class zip_builder {
  public:
    /// `bytes` must outlive the archive.
    explicit zip_builder(std::string& bytes);
    zip_builder(const zip_builder&) = delete;
    zip_builder& operator=(const zip_builder&) = delete;
    ~zip_builder();

    /// Begins a member of at most `most_bytes` bytes.
    void begin(const char* name, std::size_t most_bytes);
    void put(std::string_view bytes);
    void end();

    /// Writes the directory, which completes the archive.
    void finish();

  private:
    struct stream;

    void check(int status) const;

    stream* stream_;
    void* file_ = nullptr;  ///< handle of the ZIP library
};

}  // namespace treeform::detail::io
