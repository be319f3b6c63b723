#include "report_page.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>

#include "drillstrand/error.hpp"
#include "printable.hpp"

// Files that the build puts into the program, each with a zero at its end (report_assets.cpp.in).
extern "C" {
extern const char drillstrand_report_page[];
extern const char drillstrand_report_style[];
extern const char drillstrand_report_script[];
extern const char drillstrand_report_plotly[];
}

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;

struct Insertion {
    std::string_view marker;
    std::string_view text;
};

std::string escaped(std::string_view text) {
    std::string out;
    for (const char character : printable(text)) {
        if (character == '<')
            out += "&lt;";
        else if (character == '&')
            out += "&amp;";
        else
            out += character;
    }
    return out;
}

/// Writes the template with its markers replaced, in the order in which they stand there.
template <std::size_t count>
void fill(std::ostream& out, std::string_view page,
          const std::array<Insertion, count>& insertions) {
    for (const Insertion& insertion : insertions) {
        const std::size_t place = page.find(insertion.marker);
        out << page.substr(0, place) << insertion.text;
        page.remove_prefix(place + insertion.marker.size());
    }
    out << page;
}

[[noreturn]] void refuse(const fs::path& path, int error) {
    throw ResultError(path.string() + ": cannot write: " + std::generic_category().message(error));
}

}  // namespace

void write_page(const fs::path& path, const PageContent& content) {
    if (fs::is_directory(path)) refuse(path, EISDIR);
    const std::string title = escaped(content.title);
    fs::path fresh = path;
    fresh += ".new" + std::to_string(::getpid());
    errno = 0;
    std::ofstream out(fresh, std::ios::binary);
    fill(out, drillstrand_report_page,
         std::array<Insertion, 6>{{{"{{title}}", title},
                                   {"{{style}}", drillstrand_report_style},
                                   {"{{metadata}}", content.metadata},
                                   {"{{data}}", content.data},
                                   {"{{plotly}}", drillstrand_report_plotly},
                                   {"{{script}}", drillstrand_report_script}}});
    out.close();
    const int error = errno;
    std::error_code problem;
    if (out) fs::rename(fresh, path, problem);
    if (out && !problem) return;
    std::error_code ignored;
    fs::remove(fresh, ignored);
    refuse(path, problem ? problem.value() : error);
}

}  // namespace drillstrand::program
