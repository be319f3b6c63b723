/// Result files (HDF5): written while a run goes on, readable at any moment of it.
/// The layout is listed in engine/results/README.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "drillstrand/records.hpp"

namespace drillstrand {

/// What a result file says about how it was made.
struct ResultHeader {
    std::string title;
    std::string case_text;
    std::string integrator;
    int threads = 1;
    std::vector<double> node_s;     ///< N+1 (m)
    std::vector<double> segment_s;  ///< N (m)
};

/// How a run ended; becomes root attributes.
struct ResultFooter {
    std::string status;  ///< "complete", "interrupted", "failed: why"
    double wall_seconds = 0;
    double energy_residual = 0;
    StepStatistics statistics;
};

/// Creates the file and appends records. Data go to disk at most 2 s after they are appended.
/// Throws ResultError where the file cannot be written.
class ResultWriter {
  public:
    ResultWriter(const std::filesystem::path& path, const ResultHeader& header);
    ~ResultWriter();
    ResultWriter(ResultWriter&&) noexcept;
    ResultWriter& operator=(ResultWriter&&) noexcept;

    void append(const SeriesRecord& record);
    void append(const Profile& profile);
    /// Flushes when the last flush is older than a second; call it often.
    void keep_fresh();
    /// Writes the footer and closes the file.
    void close(const ResultFooter& footer);

  private:
    struct Impl;
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
};

/// Reads a result file, also one that a killed run left. Throws ResultError where it is not one.
Result read_result(const std::filesystem::path& path);

}  // namespace drillstrand
