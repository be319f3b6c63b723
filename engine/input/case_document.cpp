#include "input/case_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <sstream>

#include "drillstrand/error.hpp"
#include "input/text_file.hpp"
#include "input/wording.hpp"

namespace drillstrand {

namespace {

constexpr std::string_view override_prefix = "--set ";

// Keys of one path. The parser, the destructor and the writer of a document descend by calling
// themselves, a level for each.
constexpr int most_keys = 16;

std::string too_many_keys() {
    return fmt::format("a path of too many keys; expected at most {}, joined by dots", most_keys);
}

/// Finds paths of too many keys, as in a.a.a.a, of tables or of values.
class LongPath {
  public:
    explicit LongPath(std::string_view text) : rest_(text) {}

    /// The line of the first one; none: 0.
    std::size_t line() {
        while (!rest_.empty()) {
            const char c = rest_.front();
            if (c == '#') {
                rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
            } else if (c == '"' || c == '\'') {
                skip_string(c);
            } else {
                if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots_ = 0;
                if (c == '.' && ++dots_ >= most_keys) return line_;
                take(1);
            }
        }
        return 0;
    }

  private:
    void take(std::size_t count) {
        line_ += rest_.front() == '\n' ? 1 : 0;
        rest_.remove_prefix(count);
    }

    /// A text on one line, or, in three quotes, on several.
    void skip_string(char quote) {
        const std::string three(3, quote);
        const bool long_one = rest_.starts_with(three);
        const std::string_view end = std::string_view(three).substr(0, long_one ? 3 : 1);
        take(end.size());
        while (!rest_.empty() && !rest_.starts_with(end)) {
            if (rest_.front() == '\n' && !long_one) return;  // the parser will say so
            const bool escape = quote == '"' && rest_.front() == '\\' && rest_.size() > 1;
            take(escape && rest_[1] != '\n' ? 2 : 1);
        }
        if (!rest_.empty()) take(end.size());
    }

    std::string_view rest_;
    std::size_t line_ = 1;
    int dots_ = 0;
};

toml::table parse_file(const std::string& text, const std::string& file) {
    if (const std::size_t line = LongPath(text).line(); line > 0)
        throw InputError({file, line, 1}, too_many_keys());
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        const toml::source_position& begin = error.source().begin;
        throw InputError({file, begin.line, begin.column},
                         fmt::format("not valid TOML: {}", error.description()));
    }
}

/// One `--set key.path=value`. Parsing "key.path = value" as a document of its own gives every
/// node the override as its source; the document is then merged into the case.
class Override {
  public:
    Override(const std::string& key_path, const std::string& value)
        : source_(fmt::format("{}{}", override_prefix, key_path)) {
        check_key_path(key_path);
        if (value.find_first_of("\r\n") != std::string::npos) {
            fail("the value has a line break; expected one line");
        }
        root_ = parse(key_path, value);
    }

    void apply(toml::table& target) { merge_table(target, root_, ""); }

  private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw InputError({source_, 0, 0}, problem);
    }

    void check_key_path(std::string_view path) const {
        char previous = '.';
        for (const char c : path) {
            const bool bare = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') || c == '_' || c == '-';
            if (!bare && (c != '.' || previous == '.')) previous = '\0';
            if (previous == '\0') break;
            previous = c;
        }
        if (std::count(path.begin(), path.end(), '.') >= most_keys) fail(too_many_keys());
        if (previous == '.' || previous == '\0') {
            fail(
                fmt::format("{} is not a key path; expected keys joined by dots, as in "
                            "run.duration or string.component.0.length",
                            in_quotes(path)));
        }
    }

    [[nodiscard]] toml::table parse(const std::string& path, const std::string& value) const {
        if (LongPath(value).line() > 0) return parse_as_text(path, value);
        try {
            return toml::parse(fmt::format("{} = {}", path, value), source_);
        } catch (const toml::parse_error&) {
            return parse_as_text(path, value);
        }
    }

    /// "65 kN" or a file name, written without quotes.
    [[nodiscard]] toml::table parse_as_text(const std::string& path,
                                            const std::string& value) const {
        std::string escaped;
        for (const char c : value) {
            if (c == '"' || c == '\\') escaped += '\\';
            escaped += c;
        }
        try {
            return toml::parse(fmt::format("{} = \"{}\"", path, escaped), source_);
        } catch (const toml::parse_error& error) {
            fail(fmt::format("the value is not text: {}", error.description()));
        }
    }

    void merge_table(toml::table& target, toml::table& from, const std::string& path) {
        for (auto&& [key, node] : from) {
            toml::node* existing = target.get(key.str());
            const std::string key_path =
                path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str());
            if (existing != nullptr && continues(node)) {
                descend(*existing, *node.as_table(), key_path);
            } else {
                node.visit([&target, &name = key](auto& concrete) {
                    target.insert_or_assign(name, std::move(concrete));
                });
            }
        }
    }

    /// Whether a node of the override's document stands for a step of its key path, not its value.
    [[nodiscard]] static bool continues(const toml::node& node) {
        return node.is_table() && !node.as_table()->is_inline();
    }

    void descend(toml::node& existing, toml::table& from, const std::string& path) {
        if (toml::table* table = existing.as_table()) {
            merge_table(*table, from, path);
        } else if (toml::array* list = existing.as_array()) {
            merge_list(*list, from, path);
        } else {
            fail(fmt::format("{} is a value; expected a table or a list to set a part of", path));
        }
    }

    void merge_list(toml::array& list, toml::table& from, const std::string& path) {
        for (auto&& [key, node] : from) {
            const std::string_view name = key.str();
            std::size_t index = 0;
            const auto [end, error] =
                std::from_chars(name.data(), name.data() + name.size(), index);
            if (error != std::errc() || end != name.data() + name.size() || index >= list.size()) {
                fail(fmt::format("{} has no entry {}; expected a number below its {} entries", path,
                                 in_quotes(name), list.size()));
            }
            if (continues(node)) {
                descend(list[index], *node.as_table(), fmt::format("{}.{}", path, index));
            } else {
                node.visit([&](auto& concrete) {
                    list.replace(list.cbegin() + static_cast<std::ptrdiff_t>(index),
                                 std::move(concrete));
                });
            }
        }
    }

    std::string source_;
    toml::table root_;
};

std::string written(const toml::table& root) {
    std::ostringstream stream;
    stream << root << '\n';
    return stream.str();
}

}  // namespace

bool is_override_source(std::string_view file) {
    return file.starts_with(override_prefix);
}

CaseDocument load_case_document(const std::filesystem::path& path,
                                const std::vector<std::pair<std::string, std::string>>& overrides) {
    CaseDocument document;
    const std::string file = path.string();
    document.text = read_text_file(path, {file, 0, 0});
    document.root = parse_file(document.text, file);
    for (const auto& [key_path, value] : overrides) {
        Override(key_path, value).apply(document.root);
    }
    if (!overrides.empty()) document.text = written(document.root);
    return document;
}

}  // namespace drillstrand
