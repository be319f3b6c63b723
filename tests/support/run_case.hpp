/// Running cases inside a test: from the text of a case file to records in memory.
#pragma once

#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/isa.hpp"
#include "drillstrand/simulation.hpp"

namespace drillstrand::test {

/// Reads a case from text, through a file in a directory of its own that is removed afterwards.
/// Tables that the text names must be absolute paths.
Case case_from(const std::string& toml);

/// What a run recorded.
struct Run {
    std::vector<SeriesRecord> series;
    std::vector<Profile> profiles;
    std::vector<BendingRecord> bending;
    std::vector<std::vector<SensorRecord>> sensors;  ///< of each sensor
    StepStatistics statistics;
    std::vector<double>
        cell;  ///< of the nodes: what is lumped at one is a value per length of it (m)

    [[nodiscard]] const SeriesRecord& last() const { return series.back(); }
    [[nodiscard]] const Profile& end() const { return profiles.back(); }
};

/// The largest component of the stresses (N m, N).
double largest_stress(const Profile& profile);

/// Runs a case to its end in this process. Throws what the engine throws.
Run run(const Case& input);
Run run(const std::string& toml);

/// As run(), with the kernels of one instruction set.
Run run(const Case& input, Isa isa);

/// As run(), for a scene that no case file can express.
Run run(const Scene& scene, const RunCase& run, const OutputCase& output, Isa isa = best_isa());

}  // namespace drillstrand::test
