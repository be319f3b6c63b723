/// Any bytes as a survey: stations in ascending depth, or one line that says what is wrong.
#include "input/survey.hpp"

#include "fuzz/fuzz_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    static const fuzz::Folder folder;
    try {
        const auto path = folder.write("survey.csv", fuzz::text_of(data, size));
        const auto stations = read_survey(path, {"case.toml", 1, 1}).stations;
        for (std::size_t k = 1; k < stations.size(); ++k)
            if (!(stations[k].measured_depth > stations[k - 1].measured_depth)) std::abort();
    } catch (const InputError& error) {
        fuzz::expect_one_line(error);
    }
    return 0;
}
