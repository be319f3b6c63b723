/// Lines of key.path=value as overrides of a good case: a case whose written text reads as a case
/// again, or one line that says what is wrong.
#include <string>

#include "drillstrand/case.hpp"
#include "fuzz/fuzz_folder.hpp"

namespace {

constexpr std::string_view base = R"(title = "Trial"
[well]
survey = "survey.csv"
diameter = 0.3111
[fluid]
density = 1917
viscosity = 1e-3
[[string.component]]
name = "pipe"
length = 400
outer_diameter = "5 in"
linear_density = "19.5 lb/ft"
youngs_modulus = "206 GPa"
[[string.component]]
length = 100
outer_diameter = "8 in"
density = 7850
youngs_modulus = "206 GPa"
[mesh]
segments = 50
[head]
rotation = [[0, 0], [2, "110 rpm"]]
[bit]
weight = [[5, 0], [10, "65 kN"]]
[run]
duration = 20
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    static const fuzz::Folder folder;
    static const auto path = folder.write("case.toml", base);
    [[maybe_unused]] static const auto survey =
        folder.write("survey.csv", "md,inclination,azimuth\n0,0,0\n250,2,40\n520,3,60\n");
    std::vector<std::pair<std::string, std::string>> overrides;
    std::string_view rest = fuzz::text_of(data, size);
    while (!rest.empty() && overrides.size() < 8) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos) continue;
        overrides.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    }
    Case changed;
    try {
        changed = read_case(path, overrides);
    } catch (const InputError& error) {
        fuzz::expect_one_line(error);
        return 0;
    }
    static_cast<void>(read_case(folder.write("again.toml", changed.text)));
    return 0;
}
