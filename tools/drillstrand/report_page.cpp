#include "report_page.hpp"

#include <array>
#include <string_view>

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
void fill(NewFile& file, std::string_view page, const std::array<Insertion, count>& insertions) {
    for (const Insertion& insertion : insertions) {
        const std::size_t place = page.find(insertion.marker);
        file.write(page.substr(0, place));
        file.write(insertion.text);
        page.remove_prefix(place + insertion.marker.size());
    }
    file.write(page);
}

}  // namespace

void write_page(const fs::path& path, const PageContent& content, Existing existing) {
    const std::string title = escaped(content.title);
    NewFile file(path, existing);
    fill(file, drillstrand_report_page,
         std::array<Insertion, 6>{{{"{{title}}", title},
                                   {"{{style}}", drillstrand_report_style},
                                   {"{{metadata}}", content.metadata},
                                   {"{{data}}", content.data},
                                   {"{{plotly}}", drillstrand_report_plotly},
                                   {"{{script}}", drillstrand_report_script}}});
    file.take_name();
}

}  // namespace drillstrand::program
