#include "input/witsml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "input/header_names.hpp"
#include "input/text_file.hpp"
#include "input/utf8.hpp"
#include "input/wording.hpp"

namespace drillstrand {

namespace {

constexpr std::string_view supported_version = "1.4.1.1";
constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// "md" of "witsml:md".
std::string_view local_name(pugi::xml_node node) {
    const std::string_view name = node.name();
    return name.substr(name.find(':') + 1);  // npos + 1 is 0
}

std::vector<std::size_t> starts_of_lines(std::string_view text) {
    std::vector<std::size_t> starts{0};
    for (std::size_t k = 0; k < text.size(); ++k)
        if (text[k] == '\n') starts.push_back(k + 1);
    return starts;
}

}  // namespace

bool is_witsml(const std::filesystem::path& path) {
    return lower_case(path.extension().string()) == ".xml";
}

std::string content_of(pugi::xml_node element) {
    return std::string(trimmed(element.child_value()));
}

WitsmlFile::WitsmlFile(const std::filesystem::path& path, const SourceLocation& asked_at,
                       const std::string& object)
    : file_(path.string()), text_(read_text_file(path, asked_at)) {
    line_starts_ = starts_of_lines(text_);
    parse();
    find_object(object);
}

void WitsmlFile::parse() {
    const std::size_t valid = valid_text_prefix(text_);
    if (valid < text_.size())
        throw InputError(place(static_cast<std::ptrdiff_t>(valid)),
                         "not text; expected XML in UTF-8");
    // a DOCTYPE is kept as a node, so that it can be refused; nothing that it declares is expanded
    constexpr unsigned int options = pugi::parse_default | pugi::parse_doctype;
    const pugi::xml_parse_result result =
        document_.load_buffer(text_.data(), text_.size(), options, pugi::encoding_utf8);
    if (!result) {
        std::string problem = result.description();
        problem.front() = lower_case(problem.substr(0, 1)).front();
        throw InputError(place(result.offset), fmt::format("not valid XML: {}; expected WITSML {}",
                                                           problem, supported_version));
    }
    for (const pugi::xml_node node : document_.children())
        if (node.type() == pugi::node_doctype)
            throw InputError({file_, 1, 1},
                             "the file has a DOCTYPE; expected WITSML, which has none");
}

void WitsmlFile::find_object(const std::string& name) {
    const pugi::xml_node root = document_.document_element();
    if (local_name(root) != name + "s")
        throw InputError(where(root), fmt::format("the root element is {}; expected {}s of WITSML "
                                                  "{}",
                                                  in_quotes(root.name()), name, supported_version));
    const std::string_view version = root.attribute("version").value();
    if (version != supported_version)
        throw InputError(where(root), fmt::format("the version is {}; expected WITSML {}",
                                                  in_quotes(version), supported_version));
    const std::vector<pugi::xml_node> objects = children(root, name);
    if (objects.size() != 1)
        throw InputError(where(objects.empty() ? root : objects[1]),
                         fmt::format("the file has {} elements {}; expected one", objects.size(),
                                     in_quotes(name)));
    object_ = objects.front();
}

std::vector<pugi::xml_node> WitsmlFile::children(pugi::xml_node node, std::string_view name) {
    std::vector<pugi::xml_node> found;
    for (const pugi::xml_node child : node.children())
        if (child.type() == pugi::node_element && local_name(child) == name) found.push_back(child);
    return found;
}

pugi::xml_node WitsmlFile::require(pugi::xml_node node, std::string_view name) const {
    const std::vector<pugi::xml_node> found = children(node, name);
    if (found.empty())
        throw InputError(where(node), fmt::format("missing element {} in {}; expected it once",
                                                  in_quotes(name), in_quotes(local_name(node))));
    if (found.size() > 1)
        throw InputError(where(found[1]), fmt::format("element {} is there twice; expected it once",
                                                      in_quotes(name)));
    return found.front();
}

std::optional<std::string> WitsmlFile::text(pugi::xml_node node, std::string_view name) const {
    const std::vector<pugi::xml_node> found = children(node, name);
    if (found.empty()) return std::nullopt;
    return content_of(found.front());
}

double WitsmlFile::quantity(pugi::xml_node element, const Dimension& dimension) const {
    const std::string name(local_name(element));
    const std::string digits = content_of(element);
    const char* const end_of_digits = digits.data() + digits.size();
    double number = 0;
    const auto [end, error] = std::from_chars(digits.data(), end_of_digits, number);
    if (error != std::errc() || end != end_of_digits || !std::isfinite(number))
        throw InputError(where(element), fmt::format("{} is {}; expected a finite number", name,
                                                     in_quotes(digits)));
    const std::string_view unit = trimmed(element.attribute("uom").value());
    if (unit.empty())
        throw InputError(where(element),
                         fmt::format("{} has no unit; expected an attribute uom", name));
    try {
        const std::string known = known_unit(unit, dimension).value_or(std::string(unit));
        const double value = number * unit_factor(known, dimension);
        if (std::isfinite(value)) return value;
    } catch (const std::invalid_argument& problem) {
        throw InputError(where(element), fmt::format("{}: {}", name, problem.what()));
    }
    throw InputError(where(element), fmt::format("{} is {}, too large; expected a finite number in "
                                                 "SI",
                                                 name, in_quotes(digits)));
}

std::string WitsmlFile::written(pugi::xml_node element) {
    return fmt::format("{} {}", content_of(element), element.attribute("uom").value());
}

SourceLocation WitsmlFile::where(pugi::xml_node node) const {
    // of the name, which the opening bracket precedes
    return place(std::max<std::ptrdiff_t>(node.offset_debug() - 1, 0));
}

SourceLocation WitsmlFile::place(std::ptrdiff_t offset) const {
    const std::size_t at =
        std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), text_.size());
    const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), at);
    const auto line = static_cast<std::size_t>(next - line_starts_.begin());
    const std::size_t start = line_starts_[line - 1];
    const std::string_view before = std::string_view(text_).substr(start, at - start);
    return {file_, line, count_characters(before) + 1};
}

}  // namespace drillstrand
