#include "export_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace drillstrand::program {

ExportFile::ExportFile(const std::filesystem::path& path)
    : path_(path), fresh_(path.string() + ".new" + std::to_string(::getpid())) {
    if (std::filesystem::is_directory(path)) refuse(EISDIR);
    errno = 0;
    stream_.open(fresh_, std::ios::binary);
    if (!stream_) refuse(errno);
}

ExportFile::~ExportFile() {
    std::error_code ignored;
    std::filesystem::remove(fresh_, ignored);
}

void ExportFile::write(std::string_view bytes) {
    errno = 0;
    stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream_) refuse(errno);
}

void ExportFile::finish() {
    errno = 0;
    stream_.close();
    if (!stream_) refuse(errno);
    std::error_code problem;
    std::filesystem::rename(fresh_, path_, problem);
    if (problem) refuse(problem.value());
}

void ExportFile::refuse(int error) const {
    throw std::runtime_error(path_.string() +
                             ": cannot write: " + std::generic_category().message(error));
}

}  // namespace drillstrand::program
