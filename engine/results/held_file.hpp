/// A file that this process writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace drillstrand {

/// Room for HDF5's own tables in one flush, and for the last attributes of a file on a full disk.
inline constexpr std::size_t metadata_bytes = std::size_t{1} << 20;

/// An open file, locked against every other drillstrand for as long as it is open; the kernel gives
/// the lock back however the process ends. The lock belongs to the open file (F_OFD_SETLK), not to
/// the path, and HDF5 and h5py look at another kind, flock(), so that a run can be read while it
/// writes. On a file system without locks nothing is locked.
///
/// Errors name `shown_path`, the file as the caller wrote it.
class HeldFile {
  public:
    /// Makes the file; nothing where there is one of that name. Throws ResultError or WriteError.
    static std::optional<HeldFile> create(const std::filesystem::path& path,
                                          const std::filesystem::path& shown_path);
    /// Opens a file that is there. Throws ResultError where it cannot be written, or where another
    /// drillstrand writes it.
    static HeldFile open(const std::filesystem::path& path,
                         const std::filesystem::path& shown_path);
    /// Throws as open() would.
    static void require_free(const std::filesystem::path& path,
                             const std::filesystem::path& shown_path);

    ~HeldFile();
    HeldFile(HeldFile&& other) noexcept;
    HeldFile& operator=(HeldFile&&) = delete;

    /// Throws WriteError unless `bytes` more fit on the disk. HDF5 cannot take back a write that
    /// failed half-way, so a full disk is found before it writes.
    void require_space(std::size_t bytes) const;
    void write(std::string_view bytes) const;
    /// Makes the file that long and says so in its first bytes, as HDF5 does at the end of a flush
    /// (superblock of version 0, "HDF5 File Format Specification" 3.0, II.A; others are left
    /// alone).
    void write_hdf5_end(std::uint64_t end) const;
    /// Returns once the disk itself has the file.
    void sync() const;

    /// Throws WriteError where `path` no longer leads to this file.
    void require_name(const std::filesystem::path& path) const;
    /// Throws WriteError where the file is shorter than at the last call of remember_size().
    void require_size() const;
    void remember_size();

  private:
    HeldFile(int descriptor, std::filesystem::path shown_path);
    /// Opened, but not locked.
    static HeldFile open_only(const std::filesystem::path& path,
                              const std::filesystem::path& shown_path);

    int descriptor_;
    std::filesystem::path shown_path_;
    std::size_t size_ = 0;
};

/// Removes the file, unless a living process holds it.
void remove_if_forsaken(const std::filesystem::path& path);

/// While it lives, no other drillstrand gives a file of this folder its name. Does nothing where
/// folders cannot be locked.
class HeldFolder {
  public:
    explicit HeldFolder(const std::filesystem::path& path);
    ~HeldFolder();
    HeldFolder(const HeldFolder&) = delete;
    HeldFolder& operator=(const HeldFolder&) = delete;

  private:
    int descriptor_;
};

/// Throws the error of a system call that failed on a file to be written: ResultError where the
/// name is to blame, WriteError otherwise.
[[noreturn]] void refuse_to_write(const std::filesystem::path& shown_path, int error);

}  // namespace drillstrand
