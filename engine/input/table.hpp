/// One table of a case file: its keys by name, and a refusal for those it does not know.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/value.hpp"

namespace drillstrand {

class Table {
  public:
    /// Throws InputError at the first key that is not among `known`. `path` is empty for the root.
    Table(const toml::table& table, std::string path,
          std::initializer_list<std::string_view> known);

    /// A value that must be a table with the `known` keys.
    Table(const Value& value, std::initializer_list<std::string_view> known);
    Table(const Value& value, std::span<const std::string_view> known);

    [[nodiscard]] SourceLocation where() const { return locate(table_->source()); }
    /// Throws InputError with `problem` at the start of the table.
    [[noreturn]] void fail(const std::string& problem) const;

    [[nodiscard]] std::string path_of(std::string_view key) const;
    [[nodiscard]] std::optional<Value> find(std::string_view key) const;
    /// Of a key that, left out, means `standard`.
    [[nodiscard]] std::optional<Value> find(std::string_view key,
                                            const std::string& standard) const;
    /// The value of a key that must be there; `meaning` says in the message what to give.
    [[nodiscard]] Value require(std::string_view key, std::string_view meaning) const;
    /// The table of that name; an empty one where it is left out.
    [[nodiscard]] Table subtable(std::string_view key,
                                 std::initializer_list<std::string_view> known) const;

    /// Throws InputError where both keys are there.
    void refuse_both(std::string_view first, std::string_view second) const;

    // The value of a key, or `standard` where it is left out.
    [[nodiscard]] double quantity(std::string_view key, const Dimension& dimension, double standard,
                                  const Range& range = any_value) const;
    [[nodiscard]] double number(std::string_view key, double standard,
                                const Range& range = any_value) const;
    [[nodiscard]] bool boolean(std::string_view key, bool standard) const;
    [[nodiscard]] int whole_number(std::string_view key, int standard, int low, int high) const;
    [[nodiscard]] Eigen::Vector3d vector(std::string_view key, const Dimension& dimension,
                                         const Range& range = any_value) const;
    [[nodiscard]] ScalarSchedule scalar_schedule(std::string_view key, const Dimension& dimension,
                                                 const Range& range = any_value) const;
    [[nodiscard]] VectorSchedule vector_schedule(std::string_view key, const Dimension& dimension,
                                                 const Range& range = any_value) const;

    template <class Meaning>
    [[nodiscard]] Meaning choice(
        std::string_view key, Meaning standard,
        std::initializer_list<std::pair<std::string_view, Meaning>> words) const {
        std::string word;
        for (const auto& [name, meaning] : words)
            if (meaning == standard) word = name;
        const std::optional<Value> value = find(key, '"' + word + '"');
        return value ? value->choice(words) : standard;
    }

  private:
    Table(const toml::table& table, std::string path, std::span<const std::string_view> known);
    void refuse_unknown(std::span<const std::string_view> known) const;

    const toml::table* table_;
    std::string path_;
};

}  // namespace drillstrand
