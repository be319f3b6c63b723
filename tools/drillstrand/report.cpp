/// drillstrand report: one HTML page of pictures from a result file.
#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "commands.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/measured.hpp"
#include "drillstrand/units.hpp"
#include "messages.hpp"
#include "output.hpp"
#include "printable.hpp"
#include "read_apart.hpp"
#include "report_compare.hpp"
#include "report_data.hpp"
#include "report_page.hpp"
#include "report_sensors.hpp"
#include "report_series.hpp"
#include "report_string.hpp"
#include "report_summary.hpp"
#include "report_units.hpp"
#include "signals.hpp"

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

constexpr seconds follow_period{5};
/// A run writes at least every two seconds; one that has not for so long was killed.
constexpr seconds killed_after{60};
/// Readings in a row that may meet the file in the middle of a flush.
constexpr int most_failures = 3;

struct Measured {
    MeasuredChannels channels;
    double offset = 0;
};

fs::path output_of(const ReportOptions& options) {
    fs::path output = options.output;
    if (output.empty()) output = options.result.stem().string() + ".html";
    return output;
}

double offset_of(const std::string& text) {
    try {
        return parse_quantity(text, dimension::time);
    } catch (const std::invalid_argument& error) {
        throw UsageError(fmt::format("--offset {}: {}", text, error.what()));
    }
}

std::optional<Measured> read_measured_of(const ReportOptions& options) {
    if (options.measured.empty()) {
        if (!options.offset.empty())
            throw UsageError("--offset shifts the clock of --compare FILE.csv");
        return std::nullopt;
    }
    return Measured{read_measured(options.measured),
                    options.offset.empty() ? 0 : offset_of(options.offset)};
}

std::string json_texts(const std::vector<std::string>& texts) {
    std::vector<std::string> list;
    for (const std::string& text : texts)
        list.push_back(json_text(text));
    return json_list(list);
}

std::string made_by(const ReportOptions& options, const Result& result) {
    return fmt::format("{}, made by drillstrand {} ({})", options.result.filename().string(),
                       result.version, result.commit);
}

std::string metadata_of(const ReportOptions& options, const Result& result, bool live,
                        const ArrayBlock& arrays, const std::vector<std::string>& notes,
                        const std::optional<std::vector<ChannelComparison>>& comparison) {
    const UniformSeries uniform = uniform_part(result.series);
    const auto boolean = [](bool value) { return value ? "true" : "false"; };
    return json_object({{"title", json_text(result.header.title)},
                        {"made", json_text(made_by(options, result))},
                        {"status", status_json(result.footer.status)},
                        {"warnings", json_texts(warnings_of(result))},
                        {"notes", json_texts(notes)},
                        {"tiles", tiles_json(result)},
                        {"facts", facts_json(result)},
                        {"case_text", json_text(result.header.case_text)},
                        {"units", units_json()},
                        {"sensors", sensors_json(result.header)},
                        {"well", boolean(result.header.well.has_value())},
                        {"has_time_error", boolean(result.footer.statistics.time_error > 0)},
                        {"dense_start", json_number(uniform.start)},
                        {"dense_interval", json_number(uniform.interval)},
                        {"follow", live ? std::to_string(follow_period.count()) : "null"},
                        {"measured", comparison ? json_of(*comparison) : "null"},
                        {"arrays", arrays.json()}});
}

PageContent page_of(const ReportOptions& options, const Result& result, bool live,
                    const std::optional<Measured>& measured,
                    const std::optional<std::vector<ChannelComparison>>& comparison) {
    ArrayBlock arrays;
    std::vector<std::string> notes;
    for (const std::string& warning : result.footer.warnings)
        notes.push_back("Warning: " + warning + ".");
    add_series(result, arrays, notes);
    add_string(result, arrays, notes);
    add_sensors(result, arrays, notes);
    if (comparison) add_measured(measured->channels, measured->offset, arrays, notes);
    return {result.header.title, metadata_of(options, result, live, arrays, notes, comparison),
            arrays.base64()};
}

/// Throws UsageError for files of other commands.
Result read_run(const fs::path& path) {
    Contents contents = read_apart(path);
    if (const auto other = other_than_run(contents))
        throw UsageError(fmt::format(
            "{}: holds {}, not a run over time; 'drillstrand info {}' says what is in it",
            path.string(), *other, path.string()));
    return std::get<Result>(std::move(contents));
}

OutputRules rules_of(const ReportOptions& options) {
    OutputRules rules{options.overwrite, {{options.result, "the result file"}}};
    if (!options.measured.empty())
        rules.inputs.push_back({options.measured, "the table of --compare"});
    return rules;
}

/// Writes the page of what the result file holds now; true while its run goes on.
bool write_report(const ReportOptions& options, const std::optional<Measured>& measured,
                  Existing existing, bool last) {
    const Result result = read_run(options.result);
    const bool running = result.footer.status == "running";
    std::optional<std::vector<ChannelComparison>> comparison;
    if (measured) comparison = compare(measured->channels, measured->offset, result.series);
    const bool live = options.follow && running && !last;
    write_page(output_of(options), page_of(options, result, live, measured, comparison), existing);
    if (comparison && !live) print_comparison(*comparison);
    return running;
}

bool is_forsaken(const fs::path& result) {
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(result);
    return age > killed_after;
}

void wait_for_next() {
    const auto until = std::chrono::steady_clock::now() + follow_period;
    while (std::chrono::steady_clock::now() < until && !stop_requested())
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

/// Writes the page again and again until the run ends, or the reader has had enough.
void follow(const ReportOptions& options, const std::optional<Measured>& measured) {
    watch_signals();
    int failures = 0;
    OutputRules rules = rules_of(options);
    while (true) {
        const bool last = stop_requested() || is_forsaken(options.result);
        try {
            require_output("-o", output_of(options), rules);
            if (!write_report(options, measured, rules.existing(), last) || last) return;
            rules.overwrite = true;  // from here on the page is the one written here
            failures = 0;
        } catch (const ResultError&) {
            if (last || ++failures == most_failures) throw;
        }
        wait_for_next();
    }
}

}  // namespace

int report(const ReportOptions& options) {
    const fs::path output = output_of(options);
    const std::optional<Measured> measured = read_measured_of(options);
    require_output("-o", output, rules_of(options));
    if (options.follow) {
        say("drillstrand: writing {} every {} s until the run ends; open it in a browser\n",
            printable(output.string()), follow_period.count());
        follow(options, measured);
    } else {
        write_report(options, measured, rules_of(options).existing(), true);
    }
    say("drillstrand: the report is in {}\n", printable(output.string()));
    return done;
}

}  // namespace drillstrand::program
