/// A file that takes its name only once it is sound.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace drillstrand {

class HeldFile;

/// What becomes of a file that has the name already. Who asks for its replacement has made sure
/// that it may go.
enum class Existing { keep, replace };

/// A file beside the place where it is to be, removed again unless it takes its name. What killed
/// processes left of theirs there is removed as well.
///
/// Errors name the path as the caller wrote it. ResultError: no file can be there (a folder of that
/// name, no such folder, another drillstrand writes it, one is there that is to be kept);
/// WriteError: the disk failed.
class NewFile {
  public:
    NewFile(const std::filesystem::path& path, Existing existing);
    ~NewFile();
    NewFile(NewFile&&) noexcept;
    NewFile& operator=(NewFile&&) = delete;

    /// Where it is until it takes its name.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] const HeldFile& held() const { return *held_; }

    void write(std::string_view bytes);
    /// Takes its name. From here on it stays.
    void take_name();
    /// Gives the open file away.
    std::unique_ptr<HeldFile> release();

  private:
    void write_rest();

    std::filesystem::path shown_path_;
    std::filesystem::path target_;
    std::filesystem::path path_;
    Existing existing_;
    std::unique_ptr<HeldFile> held_;
    std::string unwritten_;
    bool named_ = false;
};

/// `path` with its links followed, where a file would be written. Throws ResultError where they go
/// round in a circle.
std::filesystem::path followed(const std::filesystem::path& path);

}  // namespace drillstrand
