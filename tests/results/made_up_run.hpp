/// Records of a run that never happened, with every value different.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "drillstrand/result_file.hpp"
#include "drillstrand/result_layout.hpp"

namespace drillstrand {

class MadeUpRun {
  public:
    explicit MadeUpRun(std::size_t segments, unsigned seed = 1)
        : segments_(segments), random_(seed) {}

    ResultHeader header() {
        ResultHeader header;
        header.title = "Pozzo n\xc2\xb0 1, \"drilling\"";
        header.case_text = "title = \"Pozzo\"\n" + std::string(100000, '#') + "\n";
        header.integrator = "dormand-prince";
        header.threads = 3;
        header.isa = "avx2";
        fill(header, mesh_datasets());
        for (auto* places : {&header.node_s, &header.segment_s})
            std::sort(places->begin(), places->end());
        fill(header, string_datasets());
        header.well = well();
        return header;
    }

    ResultFooter footer(const std::string& status) {
        ResultFooter footer;
        footer.status = status;
        footer.wall_seconds = number();
        footer.energy_residual = number();
        footer.stick_slip_index = number();
        footer.stuck_share = number();
        footer.unloaded_share = number();
        footer.warnings = {"the wall is too soft", "weight does not arrive: 87 kN"};
        footer.findings = {"whirl: 99 % of the string backward", "walls: friction of 87.5 kN"};
        footer.statistics = {123456789012, 345, 740740735, number(), number()};
        return footer;
    }

    SeriesRecord series(double time) { return record(time, series_datasets()); }
    Profile profile(double time) { return record(time, profile_datasets()); }
    SensorRecord sensor(double time) { return record(time, sensor_datasets("")); }
    SegmentCycles cycles() {
        SegmentCycles cycles;
        fill(cycles, cycle_datasets());
        return cycles;
    }

  private:
    /// Any double but infinities and not-a-number, of any size.
    double number() {
        const double mantissa = std::uniform_real_distribution<double>(-1, 1)(random_);
        return std::ldexp(mantissa, std::uniform_int_distribution<int>(-1080, 1000)(random_));
    }

    WellCase well() {
        const auto angle = [&] { return std::abs(std::remainder(number(), 1.0)); };
        WellCase well;
        for (int k = 0; k < 3; ++k)
            well.survey.push_back({100.0 * k, angle(), angle()});
        well.sections = {{100 + angle(), 0.3 + angle() / 10}, {200 + angle(), 0.2 + angle() / 10}};
        for (WellSectionCase& section : well.sections) {
            section.name = section.to < 150 ? "casing" : "";
            section.end_diameter = section.diameter + 0.01;
            section.static_friction = {angle(), angle()};
            section.dynamic_friction = {angle(), angle()};
            section.normal_stiffness = 1e6 + angle();
        }
        return well;
    }

    template <class Record>
    void fill(Record& record, const std::vector<RecordDataset<Record>>& layout) {
        for (const auto& entry : layout) {
            const std::size_t rows = entry.rows == Rows::one     ? 1
                                     : entry.rows == Rows::nodes ? segments_ + 1
                                                                 : segments_;
            std::vector<double> values(rows * entry.components);
            for (double& value : values)
                value = entry.integer ? static_cast<double>(random_() >> 1) : number();
            entry.assign(record, values.data(), rows);
        }
    }

    template <class Record>
    Record record(double time, const std::vector<RecordDataset<Record>>& layout) {
        Record record;
        fill(record, layout);
        record.time = time;
        return record;
    }

    std::size_t segments_;
    std::mt19937 random_;
};

/// Expects the same walls of two wells.
inline void expect_same_walls(const WellCase& left, const WellCase& right) {
    ASSERT_EQ(left.sections.size(), right.sections.size());
    for (std::size_t k = 0; k < left.sections.size(); ++k) {
        const WellSectionCase& a = left.sections[k];
        const WellSectionCase& b = right.sections[k];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.end_diameter, b.end_diameter);
        EXPECT_EQ(a.static_friction->axial, b.static_friction->axial);
        EXPECT_EQ(a.static_friction->azimuthal, b.static_friction->azimuthal);
        EXPECT_EQ(a.dynamic_friction->axial, b.dynamic_friction->axial);
        EXPECT_EQ(a.dynamic_friction->azimuthal, b.dynamic_friction->azimuthal);
        EXPECT_EQ(a.normal_stiffness, b.normal_stiffness);
    }
}

/// Expects the same bits in every dataset of two records.
template <class Record>
void expect_same_bits(const Record& left, const Record& right,
                      const std::vector<RecordDataset<Record>>& layout) {
    for (const auto& entry : layout) {
        std::vector<double> expected;
        std::vector<double> found;
        entry.append(left, expected);
        entry.append(right, found);
        ASSERT_EQ(expected.size(), found.size()) << entry.path;
        EXPECT_EQ(std::memcmp(expected.data(), found.data(), expected.size() * sizeof(double)), 0)
            << entry.path;
    }
}

/// A folder of a test's own, gone when the test ends.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "drillstrand-XXXXXX").string();
        if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder for temporary files");
        path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace drillstrand
