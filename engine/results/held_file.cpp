#include "results/held_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "drillstrand/error.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

template <class Call>
auto uninterrupted(Call&& call) {
    auto result = call();
    while (result < 0 && errno == EINTR)
        result = call();
    return result;
}

int open_file(const fs::path& path, int flags) {
    return uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC, 0666); });
}

/// Who writes a file shares its lock with nobody who would: a writer holds the lock of readers,
/// and asks for that of a writer first. So HDF5's readers are let in also where, as over NFS, both
/// kinds of locks are one.
bool lock(int descriptor, short type, int command) {
    struct flock whole = {};
    whole.l_type = type;
    whole.l_whence = SEEK_SET;
    const int result = uninterrupted([&] { return ::fcntl(descriptor, command, &whole); });
    // any other error is a file system without locks
    return result == 0 || (errno != EAGAIN && errno != EACCES);
}

[[noreturn]] void refuse_to_share(const fs::path& shown_path) {
    throw ResultError(shown_path.string() +
                      ": another run writes it; wait for its end, or name another file");
}

/// False where another process holds the file.
bool is_free(int descriptor) {
    struct flock whole = {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    return ::fcntl(descriptor, F_OFD_GETLK, &whole) != 0 || whole.l_type == F_UNLCK;
}

bool leads_to(const fs::path& path, int descriptor) {
    struct stat named = {};
    struct stat held = {};
    return ::stat(path.c_str(), &named) == 0 && ::fstat(descriptor, &held) == 0 &&
           named.st_dev == held.st_dev && named.st_ino == held.st_ino;
}

std::size_t size_of(int descriptor, const fs::path& shown_path) {
    struct stat held = {};
    if (::fstat(descriptor, &held) != 0) refuse_to_write(shown_path, errno);
    return static_cast<std::size_t>(held.st_size);
}

}  // namespace

void refuse_to_write(const fs::path& shown_path, int error) {
    const std::string text =
        shown_path.string() + ": cannot write: " + std::generic_category().message(error);
    switch (error) {
        case EACCES:
        case EPERM:
        case EROFS:
        case EISDIR:
        case ENOENT:
        case ENOTDIR:
        case ELOOP:
        case ENAMETOOLONG:
        case ETXTBSY:
            throw ResultError(text);
        default:
            throw WriteError(text);
    }
}

std::optional<HeldFile> HeldFile::create(const fs::path& path, const fs::path& shown_path) {
    while (true) {
        fs::path shown = shown_path;  // before there is a file that a lack of memory would leave
        const int descriptor = open_file(path, O_RDWR | O_CREAT | O_EXCL);
        if (descriptor < 0 && errno == EEXIST) return std::nullopt;
        if (descriptor < 0) refuse_to_write(shown_path, errno);
        HeldFile file(descriptor, std::move(shown));
        lock(descriptor, F_RDLCK, F_OFD_SETLKW);
        // between the two calls it may have passed for one that was left behind
        if (leads_to(path, descriptor)) return file;
    }
}

HeldFile HeldFile::open_only(const fs::path& path, const fs::path& shown_path) {
    if (fs::is_directory(path)) refuse_to_write(shown_path, EISDIR);
    const int descriptor = open_file(path, O_RDWR | O_NONBLOCK);
    if (descriptor < 0) refuse_to_write(shown_path, errno);
    HeldFile file(descriptor, shown_path);
    struct stat found = {};
    if (::fstat(descriptor, &found) != 0) refuse_to_write(shown_path, errno);
    if (!S_ISREG(found.st_mode))
        throw ResultError(shown_path.string() + ": cannot write: not a regular file");
    return file;
}

HeldFile HeldFile::open(const fs::path& path, const fs::path& shown_path) {
    HeldFile file = open_only(path, shown_path);
    if (!lock(file.descriptor_, F_WRLCK, F_OFD_SETLK)) refuse_to_share(shown_path);
    lock(file.descriptor_, F_RDLCK, F_OFD_SETLK);
    return file;
}

void HeldFile::require_free(const fs::path& path, const fs::path& shown_path) {
    if (!is_free(open_only(path, shown_path).descriptor_)) refuse_to_share(shown_path);
}

HeldFile::HeldFile(int descriptor, fs::path shown_path)
    : descriptor_(descriptor), shown_path_(std::move(shown_path)) {}

HeldFile::HeldFile(HeldFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      shown_path_(std::move(other.shown_path_)),
      size_(other.size_) {}

HeldFile::~HeldFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void HeldFile::require_space(std::size_t bytes) const {
    const auto size = static_cast<off_t>(size_of(descriptor_, shown_path_));
    int error = EINTR;
    while (error == EINTR)
        error = ::posix_fallocate(descriptor_, size, static_cast<off_t>(bytes));
    if (uninterrupted([&] { return ::ftruncate(descriptor_, size); }) != 0)
        refuse_to_write(shown_path_, errno);
    if (error != 0) refuse_to_write(shown_path_, error);
}

void HeldFile::write(std::string_view bytes) const {
    while (!bytes.empty()) {
        const ssize_t written =
            uninterrupted([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
        if (written < 0) refuse_to_write(shown_path_, errno);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void HeldFile::write_hdf5_end(std::uint64_t end) const {
    constexpr off_t version_place = 8;
    constexpr off_t end_place = 40;
    unsigned char version = 0xff;
    // a file that HDF5 has not written yet has none
    if (::pread(descriptor_, &version, 1, version_place) != 1 || version != 0) return;
    if (size_of(descriptor_, shown_path_) < end &&
        uninterrupted([&] { return ::ftruncate(descriptor_, static_cast<off_t>(end)); }) != 0)
        refuse_to_write(shown_path_, errno);
    std::array<unsigned char, 8> bytes{};
    for (unsigned char& byte : bytes) {
        byte = static_cast<unsigned char>(end & 0xff);
        end >>= 8;
    }
    if (uninterrupted([&] {
            return ::pwrite(descriptor_, bytes.data(), bytes.size(), end_place);
        }) != static_cast<ssize_t>(bytes.size()))
        refuse_to_write(shown_path_, errno);
}

void HeldFile::sync() const {
    if (uninterrupted([&] { return ::fsync(descriptor_); }) != 0)
        refuse_to_write(shown_path_, errno);
}

void HeldFile::require_name(const fs::path& path) const {
    if (!leads_to(path, descriptor_))
        throw WriteError(shown_path_.string() +
                         ": deleted, moved or replaced while results were written to it");
}

void HeldFile::require_size() const {
    if (size_of(descriptor_, shown_path_) < size_)
        throw WriteError(shown_path_.string() + ": cut off while results were written to it");
}

void HeldFile::remember_size() {
    size_ = size_of(descriptor_, shown_path_);
}

void remove_if_forsaken(const fs::path& path) {
    const int descriptor = open_file(path, O_RDWR | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) return;
    struct stat found = {};
    if (::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) &&
        lock(descriptor, F_WRLCK, F_OFD_SETLK))
        ::unlink(path.c_str());
    ::close(descriptor);
}

HeldFolder::HeldFolder(const fs::path& path)
    : descriptor_(open_file(path, O_RDONLY | O_DIRECTORY)) {
    if (descriptor_ >= 0) uninterrupted([&] { return ::flock(descriptor_, LOCK_EX); });
}

HeldFolder::~HeldFolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace drillstrand
