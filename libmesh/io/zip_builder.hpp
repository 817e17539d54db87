#pragma once
/// \file
/// A ZIP archive that is written member by member.

#include <cstddef>
#include <string>
#include <string_view>

namespace treeform::detail::io {

/// Writes an archive to a string. Members have no time of their own, so that the same members make
/// the same bytes.
class zip_builder {
  public:
    /// `bytes` must outlive the archive.
    explicit zip_builder(std::string& bytes);
    zip_builder(const zip_builder&) = delete;
    zip_builder& operator=(const zip_builder&) = delete;
    ~zip_builder();

    /// Starts a member of at most `most_bytes` bytes.
    void begin(const char* name, std::size_t most_bytes);
    void put(std::string_view bytes);
    void end();

    /// Ends the archive, without which it is none.
    void finish();

  private:
    struct stream;

    void check(int status) const;

    stream* stream_;
    void* file_ = nullptr;  ///< of the library behind it
};

}  // namespace treeform::detail::io
