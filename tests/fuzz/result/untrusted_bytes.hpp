/// Any bytes as an HDF5 file.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace drillstrand::fuzz {

/// A file with these bytes. Each is another one for HDF5, which knows files by their numbers.
class ScratchFile {
  public:
    ScratchFile(const std::uint8_t* data, std::size_t size) {
        path_ = std::filesystem::exists("/dev/shm") ? "/dev/shm/result-XXXXXX" : "result-XXXXXX";
        const int number = ::mkstemp(path_.data());
        const ssize_t written = number < 0 ? -1 : ::write(number, data, size);
        if (written != static_cast<ssize_t>(size)) std::abort();
        ::close(number);
    }
    ~ScratchFile() { ::unlink(path_.c_str()); }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

inline std::uint64_t little_endian(const std::uint8_t* bytes) {
    std::uint64_t value = 0;
    for (int k = 7; k >= 0; --k)
        value = value << 8 | bytes[k];
    return value;
}

/// Whether the objects of a heap of texts follow each other up to its end.
inline bool is_sound_heap(const std::uint8_t* heap, std::uint64_t bytes) {
    constexpr std::uint64_t head = 16;
    for (std::uint64_t place = head; place + head <= bytes;) {
        const bool is_free = heap[place] == 0 && heap[place + 1] == 0;
        const std::uint64_t size = little_endian(heap + place + 8);
        const std::uint64_t rest = bytes - place - (is_free ? 0 : head);
        if (size > rest) return false;
        if (is_free) return size == rest;
        place += head + (size + 7) / 8 * 8;
    }
    return true;
}

/// HDF5's library loops or crashes on other heaps, so that next to nothing else would be tried.
inline bool are_heaps_sound(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view mark = "GCOL";
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    for (std::size_t place = text.find(mark); place != std::string_view::npos;
         place = text.find(mark, place + 1)) {
        if (size - place < 16) return false;
        const std::uint64_t bytes = little_endian(data + place + 8);
        if (bytes > size - place || !is_sound_heap(data + place, bytes)) return false;
    }
    return true;
}

}  // namespace drillstrand::fuzz
