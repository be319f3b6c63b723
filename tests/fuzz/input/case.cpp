/// Any bytes as a case file, beside a good survey and a good table of components: a case, or one
/// line that says what is wrong.
#include "drillstrand/case.hpp"

#include "fuzz/fuzz_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    static const fuzz::Folder folder;
    [[maybe_unused]] static const auto survey =
        folder.write("survey.csv", "md,inclination,azimuth\n0,0,0\n250,2,40\n520,3,60\n");
    [[maybe_unused]] static const auto string =
        folder.write("string.csv",
                     "name,length,outer_diameter,inner_diameter,linear_density,youngs_modulus\n"
                     "pipe,400,0.127,0.1,29,2.06e11\n");
    try {
        static_cast<void>(read_case(folder.write("case.toml", fuzz::text_of(data, size))));
    } catch (const InputError& error) {
        fuzz::expect_one_line(error);
    }
    return 0;
}
