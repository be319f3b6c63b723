#include "input/text_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <system_error>

#include "input/wording.hpp"

namespace drillstrand {

namespace {

constexpr std::size_t largest_file = std::size_t{64} << 20U;  // bytes

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string reason(int error) {
    return std::generic_category().message(error);
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, const SourceLocation& asked_at) {
    const auto fail = [&](const std::string& why) -> void {
        throw InputError(asked_at,
                         fmt::format("cannot read {}: {}", in_quotes(path.string()), why));
    };
    // A name with a zero byte would open the file named by what stands before it.
    if (path.native().find('\0') != std::string::npos) fail("no such file name");
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) fail("it is a directory; expected a file");
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    if (!file) fail(fmt::format("{}; expected an existing, readable file", reason(errno)));

    std::string text;
    std::array<char, 65536> buffer{};
    for (;;) {
        const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get());
        text.append(buffer.data(), count);
        if (text.size() > largest_file) fail("larger than 64 MiB; expected a text file");
        if (count < buffer.size()) break;
    }
    if (std::ferror(file.get()) != 0) fail(reason(errno));
    return text;
}

}  // namespace drillstrand
