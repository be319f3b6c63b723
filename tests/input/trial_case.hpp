/// A small valid case, and a folder of its own to try it and its corruptions in.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "drillstrand/case.hpp"

namespace drillstrand {

inline const std::string trial_survey = "md,inclination,azimuth\n0,0,0\n250,2,40\n520,3,60\n";

inline const std::string trial_case = R"(title = "Trial"

[well]
survey = "survey.csv"
diameter = 0.3111

[fluid]
density = 1917
viscosity = 1e-3

[string]
[[string.component]]
name = "pipe"
length = 400
outer_diameter = "5 in"
inner_diameter = "4.276 in"
linear_density = "19.5 lb/ft"
youngs_modulus = "206 GPa"
[[string.component]]
name = "collar"
length = 100
outer_diameter = "8 in"
inner_diameter = "3 in"
density = 7850
youngs_modulus = "206 GPa"

[mesh]
segments = 50

[head]
rotation = [[0, 0], [2, "110 rpm"]]

[bit]
weight = [[5, 0], [10, "65 kN"]]
torque = "10 kN m"

[run]
duration = 20
)";

/// `text` with the first occurrence of `passage` replaced; a missing passage is a test's mistake.
std::string replaced(std::string text, const std::string& passage, const std::string& replacement);

/// The case with its list of components replaced by the name of a file.
std::string with_component_file(const std::string& text, const std::string& name);

using Overrides = std::vector<std::pair<std::string, std::string>>;

/// A temporary folder, removed with the object.
class TrialFolder {
  public:
    TrialFolder();
    TrialFolder(const TrialFolder&) = delete;
    TrialFolder& operator=(const TrialFolder&) = delete;
    ~TrialFolder();

    [[nodiscard]] std::filesystem::path path(const std::string& name) const;
    void write(const std::string& name, const std::string& bytes) const;
    /// Reads the case file of that name.
    [[nodiscard]] Case read(const std::string& name, const Overrides& overrides = {}) const;
    /// The message of the InputError on reading it, without the folder; "" where it is read.
    [[nodiscard]] std::string message(const std::string& name,
                                      const Overrides& overrides = {}) const;

  private:
    std::filesystem::path folder_;
};

/// The trial case and its survey, with one passage changed, read.
Case read_trial(const std::string& passage, const std::string& replacement);

/// Expects the same stations, to rounding.
void expect_same(const std::vector<SurveyStation>& a, const std::vector<SurveyStation>& b);

}  // namespace drillstrand
