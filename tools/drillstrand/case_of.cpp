#include "case_of.hpp"

#include "messages.hpp"

namespace drillstrand::program {

Case case_of(const std::filesystem::path& path, const Overrides& overrides) {
    Case input = read_case(path, overrides);
    for (const std::string& warning : input.warnings)
        say("drillstrand: warning: {}\n", warning);
    return input;
}

}  // namespace drillstrand::program
