/// Result files (HDF5): written while a run goes on, readable at any moment of it.
/// The layout is listed in engine/results/README.md.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drillstrand/bending_cycles.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/new_file.hpp"
#include "drillstrand/records.hpp"

namespace drillstrand {

/// What a result file says about how it was made.
struct ResultHeader {
    std::string title;
    std::string case_text;   ///< the TOML as read, overrides applied
    std::string integrator;  ///< as in the case file
    int threads = 1;
    std::string isa;             ///< of the kernels, as isa_name(); empty where a file does not say
    std::vector<double> node_s;  ///< N+1 (m)
    std::vector<double> segment_s;  ///< N (m)

    /// Components of the string, head to bit: name, and where it begins and ends from the head (m).
    std::vector<std::string> component_name;
    std::vector<double> component_start;
    std::vector<double> component_end;

    // The string on its mesh, for pictures and other programs. Empty where a file does not say.
    std::vector<double> cell;           ///< N+1, length whose loads the node carries (m)
    std::vector<double> mass;           ///< N+1, per length (kg/m)
    std::vector<double> weight;         ///< N+1, per length, buoyed (N/m)
    std::vector<double> outer_radius;   ///< N+1 (m)
    std::vector<double> polar_inertia;  ///< N+1, per length, about the axis (kg m)
    std::vector<double> metal_area;     ///< N (m2)
    std::vector<double> yield_tension;  ///< N, of YieldLoads (N)
    std::vector<double> yield_bending;  ///< N (N m)
    std::vector<double> yield_torque;   ///< N (N m)

    std::optional<WellCase> well;  ///< unset: no well, or a file that does not say

    std::optional<CyclesCase> cycles;  ///< unset: none were counted
    std::vector<SensorCase> sensors;
};

struct Scene;

/// What a result file of this case says; `threads`, `isa`, `cycles` and `sensors` are
/// left to the caller.
ResultHeader result_header(const Case& input, const Scene& scene);

/// How a run ended, or how far it has come; becomes root attributes.
struct ResultFooter {
    std::string status = "running";  ///< "running", "complete", "interrupted", "failed: why"
    double wall_seconds = 0;
    double energy_residual = 0;      ///< EnergyAudit::residual()
    double largest_penetration = 0;  ///< m
    double time_error_median = 0;    ///< RunSummary::time_error_median()
    double stick_slip_index = 0;     ///< of RunSummary::bit(), as the next two
    double stuck_share = 0;
    double unloaded_share = 0;
    std::vector<std::string> warnings;
    std::vector<std::string> findings;  ///< RunSummary::findings()
    SegmentCycles cycles;               ///< RunSummary::cycles()
    StepStatistics statistics;
};

/// Creates the file and appends records. The file is readable from the moment the constructor
/// returns, also when the process is killed; its status is "running" until close(). No other
/// drillstrand can write it meanwhile.
/// Throws WriteError where the file cannot be written, also where it was deleted, moved, replaced
/// or cut off since the last flush: what was flushed before stays readable, as far as it is there.
class ResultWriter {
  public:
    /// The file takes its name once it is sound. Throws ResultError where none can be there.
    ResultWriter(const std::filesystem::path& path, const ResultHeader& header,
                 Existing existing = Existing::replace);
    /// Goes on with a file that a run of this header wrote and left, whatever became of it: keeps
    /// its first records, that many (of sensors, one number each), and drops the others. Throws
    /// ResultError where it holds fewer or is of another string or integrator.
    static ResultWriter resume(const std::filesystem::path& path, const ResultHeader& header,
                               std::size_t series_records, std::size_t profile_records,
                               const std::vector<std::size_t>& sensor_records = {});
    /// Closes the file without a footer where close() was not called.
    ~ResultWriter();
    ResultWriter(ResultWriter&&) noexcept;
    ResultWriter& operator=(ResultWriter&&) noexcept;

    void append(const SeriesRecord& record);
    void append(const Profile& profile);
    /// `sensor`: its number in the header.
    void append(std::size_t sensor, const SensorRecord& record);
    /// True where the last flush is older than a second.
    [[nodiscard]] bool is_stale() const;
    /// Time of the last series record that is in the file, 0 before the first one (s).
    [[nodiscard]] double written_until() const;
    /// True once the file was found deleted, moved, replaced or cut off.
    [[nodiscard]] bool is_lost() const;
    /// Brings the file up to date with what was appended, and its attributes with `footer`. The
    /// file is at most 2 s old where this is called as soon as is_stale().
    void flush(const ResultFooter& footer);
    /// Returns once the disk itself has what was flushed.
    void sync();
    /// Flushes and closes the file. After an error, records that did not reach the file are given
    /// up and the footer alone is written.
    void close(const ResultFooter& footer);

  private:
    struct Impl;
    explicit ResultWriter(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// A whole result file in memory.
struct Result {
    ResultHeader header;
    ResultFooter footer;
    std::string version;
    std::string commit;
    std::vector<SeriesRecord> series;
    std::vector<Profile> profiles;
    std::vector<std::vector<SensorRecord>> sensors;  ///< of each in the header
};

/// Reads a result file, also one that is being written or that a killed run left. Throws
/// ResultError where it is not one.
Result read_result(const std::filesystem::path& path);

/// Whether a file is HDF5 with the root attributes of files that drillstrand writes, whatever
/// command made it.
bool is_own_result(const std::filesystem::path& path);

}  // namespace drillstrand
