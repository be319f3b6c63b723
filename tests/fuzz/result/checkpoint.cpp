/// A checkpoint of this build with bytes of it changed: read, taken up by the integrator and the
/// summary of the run, and gone on from. A changed checkpoint is another state or one line that
/// says what is wrong; never a crash.
///
/// The first byte chooses the integrator. Then comes one change after the other: three bytes of the
/// place, counted around the file; one of how many bytes, up to eight; and these.
#include "drillstrand/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/run_summary.hpp"
#include "drillstrand/simulation.hpp"
#include "fuzz/fuzz_folder.hpp"
#include "fuzz/result/untrusted_bytes.hpp"

namespace drillstrand {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr const char* case_text = R"(
[well]
survey = "survey.csv"
diameter = 0.2
[[string.component]]
length = 20
outer_diameter = 0.127
inner_diameter = 0.1
linear_density = 40
youngs_modulus = "200 GPa"
[fluid]
density = 1200
viscosity = 0.05
[mesh]
segments = 2
[head]
rotation = [[0, 0], [0.01, 5]]
[bit]
weight = [[0, 0], [0.01, 1000]]
[run]
duration = 0.05
)";

/// A run in the middle, and its checkpoint.
struct Run {
    explicit Run(IntegratorKind kind)
        : input(read_case(case_file())),
          scene(starting_scene(input)),
          options(integrator_options(input.run)) {
        options.kind = kind;
        const auto integrator = fresh();
        integrator->advance(0.02, 50);
        RunSummary summary(scene);
        summary.add(integrator->series());
        Checkpoint checkpoint;
        checkpoint.header = result_header(input, scene);
        checkpoint.state = integrator->save();
        checkpoint.summary = summary.save();
        const std::string path = folder.write("run.checkpoint.h5", "");
        write_checkpoint(path, checkpoint);
        std::ifstream stream(path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(stream), {});
        if (!goes_on_from(bytes)) std::abort();  // or nothing would be tried
    }

    [[nodiscard]] std::filesystem::path case_file() const {
        static_cast<void>(folder.write("survey.csv", "md,inclination,azimuth\n0,60,0\n25,80,5\n"));
        return folder.write("case.toml", case_text);
    }

    [[nodiscard]] std::unique_ptr<Integrator> fresh() const {
        return make_integrator(scene, options);
    }

    /// Whether these bytes are a checkpoint of this run.
    [[nodiscard]] bool goes_on_from(const Bytes& changed) const {
        const fuzz::ScratchFile file(changed.data(), changed.size());
        try {
            const Checkpoint checkpoint = read_checkpoint(file.path());
            RunSummary summary(scene);
            summary.restore(checkpoint.summary);
            const auto integrator = fresh();
            integrator->restore(checkpoint.state);
            integrator->advance(0.05, 3);
            summary.add(integrator->series());
            return true;
        } catch (const ResultError&) {
            // not a checkpoint
        } catch (const std::invalid_argument&) {
            // not one of this run
        } catch (const SimulationError&) {
            // a state from which nothing can go on
        }
        return false;
    }

    fuzz::Folder folder;
    Case input;
    Scene scene;
    IntegratorOptions options;
    Bytes bytes;
};

Bytes with_changes(Bytes bytes, const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t head = 4;
    constexpr std::size_t most = 8;
    while (size > head) {
        const std::size_t place = data[0] + 0x100U * data[1] + 0x10000U * data[2];
        const std::size_t count = std::min<std::size_t>(1 + data[3] % most, size - head);
        for (std::size_t k = 0; k < count; ++k)
            bytes[(place + k) % bytes.size()] = data[head + k];
        data += head + count;
        size -= head + count;
    }
    return bytes;
}

}  // namespace
}  // namespace drillstrand

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    static const std::array<Run, 2> runs{Run(IntegratorKind::leapfrog),
                                         Run(IntegratorKind::dormand_prince)};
    if (size == 0) return 0;
    const Run& run = runs[data[0] % 2];
    const Bytes changed = with_changes(run.bytes, data + 1, size - 1);
    if (fuzz::are_heaps_sound(changed.data(), changed.size()))
        static_cast<void>(run.goes_on_from(changed));
    return 0;
}
