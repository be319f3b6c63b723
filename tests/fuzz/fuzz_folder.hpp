/// Where a fuzz target puts the files that the readers shall read.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "drillstrand/error.hpp"

namespace drillstrand::fuzz {

/// A folder of this process, in memory where the system has such a place; removed at the end.
class Folder {
  public:
    Folder() {
        const std::filesystem::path memory = "/dev/shm";
        const std::filesystem::path root =
            std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
        path_ = root / ("drillstrand-fuzz-" + std::to_string(::getpid()));
        std::filesystem::create_directories(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    /// The path of a file with these bytes.
    [[nodiscard]] std::filesystem::path write(const char* name, std::string_view bytes) const {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

/// Ends the program where a message is not one line.
inline void expect_one_line(const std::exception& error) {
    if (std::string_view(error.what()).find_first_of("\r\n") != std::string_view::npos)
        std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace drillstrand::fuzz
