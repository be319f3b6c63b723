#include "input/trial_case.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "drillstrand/error.hpp"

namespace drillstrand {

std::string replaced(std::string text, const std::string& passage, const std::string& replacement) {
    const std::size_t begin = text.find(passage);
    if (begin == std::string::npos) throw std::logic_error("no passage " + passage);
    return text.replace(begin, passage.size(), replacement);
}

std::string with_component_file(const std::string& text, const std::string& name) {
    const std::size_t begin = text.find("[[string.component]]");
    const std::size_t end = text.find("[mesh]");
    return text.substr(0, begin) + "components = \"" + name + "\"\n" + text.substr(end);
}

TrialFolder::TrialFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "drillstrand-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
}

TrialFolder::~TrialFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path TrialFolder::path(const std::string& name) const {
    return folder_ / name;
}

void TrialFolder::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
}

Case TrialFolder::read(const std::string& name, const Overrides& overrides) const {
    return read_case(path(name), overrides);
}

std::string TrialFolder::message(const std::string& name, const Overrides& overrides) const {
    try {
        static_cast<void>(read(name, overrides));
        return "";
    } catch (const InputError& error) {
        std::string text = error.what();
        const std::string folder = folder_.string() + "/";
        for (std::size_t at; (at = text.find(folder)) != std::string::npos;) {
            text.erase(at, folder.size());
        }
        return text;
    }
}

Case read_trial(const std::string& passage, const std::string& replacement) {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    folder.write("case.toml", replaced(trial_case, passage, replacement));
    return folder.read("case.toml");
}

void expect_same(const std::vector<SurveyStation>& a, const std::vector<SurveyStation>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_DOUBLE_EQ(a[k].measured_depth, b[k].measured_depth);
        EXPECT_DOUBLE_EQ(a[k].inclination, b[k].inclination);
        EXPECT_DOUBLE_EQ(a[k].azimuth, b[k].azimuth);
    }
}

}  // namespace drillstrand
