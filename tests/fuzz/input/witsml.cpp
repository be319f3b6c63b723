/// Any bytes as WITSML, of a survey and of a string: stations in ascending depth, components, or
/// one line that says what is wrong.
#include "fuzz/fuzz_folder.hpp"
#include "input/component_reader.hpp"
#include "input/survey.hpp"

namespace drillstrand {
namespace {

template <class Read>
void expect_sense_or_one_line(const Read& read) {
    try {
        read();
    } catch (const InputError& error) {
        fuzz::expect_one_line(error);
    }
}

}  // namespace
}  // namespace drillstrand

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    static const fuzz::Folder folder;
    const auto path = folder.write("file.xml", fuzz::text_of(data, size));
    expect_sense_or_one_line([&] {
        const auto stations = read_survey(path, {"case.toml", 1, 1}).stations;
        for (std::size_t k = 1; k < stations.size(); ++k)
            if (!(stations[k].measured_depth > stations[k - 1].measured_depth)) std::abort();
    });
    expect_sense_or_one_line([&] {
        for (const PlacedComponent& placed : read_component_file(path, {"case.toml", 1, 1}))
            if (!(placed.component.length > 0 && placed.component.linear_density > 0)) std::abort();
    });
    return 0;
}
