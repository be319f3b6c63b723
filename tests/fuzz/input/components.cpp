/// Any bytes as a table of components: components, or one line that says what is wrong.
#include "fuzz/fuzz_folder.hpp"
#include "input/component_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    static const fuzz::Folder folder;
    try {
        const auto path = folder.write("string.csv", fuzz::text_of(data, size));
        for (const PlacedComponent& placed : read_component_file(path, {"case.toml", 1, 1}))
            if (!(placed.component.length > 0 && placed.component.linear_density >= 0))
                std::abort();
    } catch (const InputError& error) {
        fuzz::expect_one_line(error);
    }
    return 0;
}
