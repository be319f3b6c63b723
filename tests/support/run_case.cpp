#include "support/run_case.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace drillstrand::test {

namespace {

namespace fs = std::filesystem;

/// A directory that goes with its owner.
class ScratchDirectory {
  public:
    ScratchDirectory() {
        std::string name = (fs::temp_directory_path() / "drillstrand-test-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch directory");
        path_ = name;
    }
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;
    ~ScratchDirectory() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

class MemoryObserver : public Observer {
  public:
    explicit MemoryObserver(Run& run) : run_(run) {}
    void on_series(const SeriesRecord& record) override { run_.series.push_back(record); }
    void on_profile(const Profile& profile) override { run_.profiles.push_back(profile); }
    void on_bending(const BendingRecord& record) override { run_.bending.push_back(record); }
    void on_sensor(std::size_t sensor, const SensorRecord& record) override {
        run_.sensors.resize(std::max(run_.sensors.size(), sensor + 1));
        run_.sensors[sensor].push_back(record);
    }
    bool on_progress(double /*time*/, const StepStatistics& /*statistics*/) override {
        return true;
    }

  private:
    Run& run_;
};

}  // namespace

Case case_from(const std::string& toml) {
    const ScratchDirectory directory;
    const fs::path file = directory.path() / "case.toml";
    std::ofstream(file) << toml;
    return read_case(file);
}

Run run(const Scene& scene, const RunCase& settings, const OutputCase& output, Isa isa) {
    IntegratorOptions options = integrator_options(settings);
    options.isa = isa;
    const auto integrator = make_integrator(scene, options);
    Run result;
    result.cell = scene.mesh.cell;
    MemoryObserver observer(result);
    Case asked;
    asked.run = settings;
    asked.output = output;
    simulate(*integrator, run_schedule(asked), observer);
    result.statistics = integrator->statistics();
    return result;
}

Run run(const Case& input) {
    return run(input, best_isa());
}

Run run(const Case& input, Isa isa) {
    return run(starting_scene(input), input.run, input.output, isa);
}

Run run(const std::string& toml) {
    return run(case_from(toml));
}

double largest_stress(const Profile& profile) {
    double largest = 0;
    for (const Vector6& stress : profile.stress)
        largest = std::max(largest, stress.cwiseAbs().maxCoeff());
    return largest;
}

}  // namespace drillstrand::test
