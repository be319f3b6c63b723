#include "results/new_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "drillstrand/error.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

/// Owns a POSIX file descriptor.
class FileDescriptor {
  public:
    FileDescriptor(const fs::path& path, int flags) : value_(::open(path.c_str(), flags, 0666)) {}
    ~FileDescriptor() {
        if (value_ >= 0) ::close(value_);
    }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    [[nodiscard]] int get() const { return value_; }

  private:
    int value_;
};

[[noreturn]] void refuse(const fs::path& path, int error) {
    throw ResultError(path.string() + ": cannot write: " + std::generic_category().message(error));
}

/// Throws where `path` exists and is not a file that may be written. HDF5's own words are vague.
void require_writable(const fs::path& path) {
    if (!fs::exists(path)) return;
    if (fs::is_directory(path)) refuse(path, EISDIR);
    if (!fs::is_regular_file(path))
        throw ResultError(path.string() + ": cannot write: not a regular file");
    const FileDescriptor file(path, O_WRONLY | O_CLOEXEC);
    if (file.get() < 0) refuse(path, errno);
}

void create_empty(const fs::path& file_path, const fs::path& shown_path) {
    const FileDescriptor file(file_path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
    if (file.get() < 0) refuse(shown_path, errno);
}

}  // namespace

void require_space(const fs::path& file_path, const fs::path& shown_path, std::size_t bytes) {
    const FileDescriptor file(file_path, O_WRONLY | O_CLOEXEC);
    // A file that was removed or renamed while the run goes on is written through HDF5's handle.
    if (file.get() < 0) return;
    const off_t size = ::lseek(file.get(), 0, SEEK_END);
    const int error = ::posix_fallocate(file.get(), size, static_cast<off_t>(bytes));
    if (::ftruncate(file.get(), size) != 0) refuse(shown_path, errno);
    if (error != 0) refuse(shown_path, error);
}

NewFile::NewFile(const fs::path& target, const fs::path& shown_path)
    : target_(target), path_(target) {
    require_writable(target_);
    path_ += ".new" + std::to_string(::getpid());
    create_empty(path_, shown_path);
}

NewFile::~NewFile() {
    std::error_code ignored;
    if (!named_) fs::remove(path_, ignored);
}

void NewFile::take_name() {
    fs::rename(path_, target_);
    named_ = true;
}

}  // namespace drillstrand
