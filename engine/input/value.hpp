/// One value of a case file, with its place and its key path for messages.
#pragma once

#include <toml++/toml.h>

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/units.hpp"
#include "input/range.hpp"

namespace drillstrand {

/// A place in the case file, or the override that a value came from.
SourceLocation locate(const toml::source_region& region);

/// Every reader throws InputError at the value where type, dimension or range are wrong.
class Value {
  public:
    /// `path` is the key path from the root, as in bit.weight. The node must outlive the value.
    Value(const toml::node& node, std::string path) : node_(&node), path_(std::move(path)) {}

    [[nodiscard]] SourceLocation where() const { return locate(node_->source()); }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const toml::node& node() const { return *node_; }

    /// Throws InputError "PATH is VALUE; expected EXPECTED" here.
    [[noreturn]] void fail_expected(std::string_view expected) const;
    /// Throws InputError "PATH PROBLEM" here.
    [[noreturn]] void fail(std::string_view problem) const;

    /// A quantity as it is written, with its unit: "8.45 in", "9.8 kg/m3" for the number 9.8.
    [[nodiscard]] std::string written(const Dimension& dimension) const;
    /// A number in SI or a string with a unit, in SI.
    [[nodiscard]] double quantity(const Dimension& dimension, const Range& range = any_value) const;
    /// A number without a unit.
    [[nodiscard]] double number(const Range& range = any_value) const;
    [[nodiscard]] int whole_number(int low, int high) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;
    /// A list of three quantities.
    [[nodiscard]] Eigen::Vector3d vector(const Dimension& dimension,
                                         const Range& range = any_value) const;
    /// A quantity, or a list of [time, quantity] in ascending time.
    [[nodiscard]] ScalarSchedule scalar_schedule(const Dimension& dimension,
                                                 const Range& range = any_value) const;
    /// A list of three quantities, or a list of [time, [x, y, z]] in ascending time.
    [[nodiscard]] VectorSchedule vector_schedule(const Dimension& dimension,
                                                 const Range& range = any_value) const;

    [[nodiscard]] bool is_list() const { return node_->is_array(); }
    /// The elements of a list.
    [[nodiscard]] std::vector<Value> elements(std::string_view expected) const;

    /// The meaning of one of the words.
    template <class Meaning>
    [[nodiscard]] Meaning choice(
        std::initializer_list<std::pair<std::string_view, Meaning>> words) const {
        std::vector<std::string_view> known;
        for (const auto& [name, meaning] : words)
            known.push_back(name);
        const std::string expected = one_of(known);
        note("word", expected);
        const std::string word = read_text();
        for (const auto& [name, meaning] : words)
            if (name == word) return meaning;
        fail_expected(expected);
    }

  private:
    /// "a" or "b".
    static std::string one_of(const std::vector<std::string_view>& words);
    void note(std::string_view type, const std::string& range = "") const;
    [[nodiscard]] double read_quantity(const Dimension& dimension, const Range& range) const;
    [[nodiscard]] Eigen::Vector3d read_vector(const Dimension& dimension, const Range& range) const;
    [[nodiscard]] std::string read_text() const;
    /// The points of a schedule; `read` reads the value of a pair.
    template <class Element, class Read>
    [[nodiscard]] Schedule<Element> read_points(std::string_view expected, const Read& read) const;
    [[nodiscard]] double finite_number(std::string_view expected) const;

    const toml::node* node_;
    std::string path_;
};

}  // namespace drillstrand
