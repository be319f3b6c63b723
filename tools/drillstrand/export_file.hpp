/// The files that drillstrand export writes.
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace drillstrand::program {

/// A file that is written in one go, beside one of that name, and takes the name once it is whole.
/// Every function throws std::runtime_error, "PATH: cannot write: why".
class ExportFile {
  public:
    explicit ExportFile(const std::filesystem::path& path);
    /// Removes what was written where finish() was not reached.
    ~ExportFile();
    ExportFile(const ExportFile&) = delete;
    ExportFile& operator=(const ExportFile&) = delete;

    void write(std::string_view bytes);
    void finish();

  private:
    [[noreturn]] void refuse(int error) const;

    std::filesystem::path path_;
    std::filesystem::path fresh_;
    std::ofstream stream_;
};

}  // namespace drillstrand::program
