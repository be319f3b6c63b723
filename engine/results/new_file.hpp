/// A file that takes its name only once it is sound.
#pragma once

#include <cstddef>
#include <filesystem>

namespace drillstrand {

/// Room for HDF5's own tables in one flush, and for the last attributes of a file on a full disk.
inline constexpr std::size_t metadata_bytes = std::size_t{1} << 20;

/// Throws ResultError unless `bytes` more fit on the disk. HDF5 cannot take back a write that
/// failed half-way, so a full disk is found before it writes.
void require_space(const std::filesystem::path& file_path, const std::filesystem::path& shown_path,
                   std::size_t bytes);

/// An empty file beside `target`, removed again unless it takes the target's name. Errors name
/// `shown_path`, the target as the caller wrote it.
class NewFile {
  public:
    /// Throws ResultError where the target exists and is not a file that may be written, or where
    /// no file can be made beside it.
    NewFile(const std::filesystem::path& target, const std::filesystem::path& shown_path);
    ~NewFile();
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Replaces the target.
    void take_name();

  private:
    std::filesystem::path target_;
    std::filesystem::path path_;
    bool named_ = false;
};

}  // namespace drillstrand
