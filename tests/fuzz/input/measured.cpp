/// Any bytes as a table of measured channels: channels of one length with ascending times, or one
/// line that says what is wrong.
#include "drillstrand/measured.hpp"

#include <cmath>

#include "fuzz/fuzz_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    static const fuzz::Folder folder;
    try {
        const MeasuredChannels channels =
            read_measured(folder.write("rig.csv", fuzz::text_of(data, size)));
        for (std::size_t k = 0; k < channels.time.size(); ++k)
            if (!std::isfinite(channels.time[k]) ||
                (k > 0 && channels.time[k] <= channels.time[k - 1]))
                std::abort();
        for (const auto* channel : {&channels.hook_load, &channels.torque})
            for (const double value : *channel)
                if (channel->size() != channels.time.size() || !std::isfinite(value)) std::abort();
    } catch (const InputError& error) {
        fuzz::expect_one_line(error);
    }
    return 0;
}
