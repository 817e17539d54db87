#include "tools/tf-weld/work_folder.hpp"

#include "tools/tf-weld/record_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace tools {
namespace {

namespace fs = std::filesystem;

const char* const lock_name = "lock";

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
    throw failure(bad_output, "work-folder", path.string() + ": " + why);
}

}  // namespace

work_folder::work_folder(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    fs::create_directory(path_, error);
    if (error) refuse(path_, "cannot be made: " + error.message());
    const fs::path lock = path_ / lock_name;
    if (!fs::exists(lock) && !fs::is_empty(path_))
        refuse(path_, "holds files that tf-weld has not put there");
    lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0) refuse(path_, std::string("cannot be written to: ") + std::strerror(errno));
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        ::close(lock_);
        refuse(path_, "is in use by another tf-weld");
    }
}

work_folder::~work_folder() { ::close(lock_); }

std::optional<json> work_folder::load(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    std::ostringstream text;
    if (!in || !(text << in.rdbuf())) return std::nullopt;
    json object = json::parse(text.str(), nullptr, false);
    if (!object.is_object()) return std::nullopt;
    return object;
}

void work_folder::store(const std::string& name, const json& object) const {
    const fs::path whole = file(name);
    const fs::path part = file(name + ".part");
    fs::remove(part);
    const std::string text = object.dump() + "\n";
    append_to(part, std::as_bytes(std::span(text)));
    sync_file(part);
    std::error_code error;
    fs::rename(part, whole, error);
    if (error) refuse(whole, "cannot be written: " + error.message());
}

void work_folder::clear() const {
    for (const auto& entry : fs::directory_iterator(path_))
        if (entry.path().filename() != lock_name) fs::remove(entry.path());
}

void work_folder::remove() {
    clear();
    fs::remove(path_ / lock_name);
    std::error_code ignored;
    fs::remove(path_, ignored);
}

}  // namespace tools
