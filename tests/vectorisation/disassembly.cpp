#include "vectorisation/disassembly.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace drillstrand::test {

namespace {

std::string output_of(const std::string& command) {
    struct Close {
        void operator()(FILE* pipe) const { pclose(pipe); }
    };
    std::unique_ptr<FILE, Close> pipe(popen(command.c_str(), "r"));
    if (!pipe) throw std::runtime_error("cannot start " + command);
    std::string text;
    std::array<char, 65536> buffer{};
    while (const std::size_t size = fread(buffer.data(), 1, buffer.size(), pipe.get()))
        text.append(buffer.data(), size);
    if (pclose(pipe.release()) != 0) throw std::runtime_error("failed: " + command);
    return text;
}

int entries_of(const std::string& instruction) {
    if (instruction.find("%zmm") != std::string::npos) return 8;
    return instruction.find("%ymm") != std::string::npos ? 4 : 2;
}

/// Counts one instruction, its operands behind blanks.
void count(const std::string& text, VectorUse& use) {
    static const std::regex arithmetic(
        "v?(?:add|sub|mul|div|sqrt|min|max|(fn?m(?:add|sub))\\d+)([ps])[sd]");
    const std::string instruction = text.substr(0, text.find(' '));
    std::smatch match;
    if (std::regex_match(instruction, match, arithmetic)) {
        if (match[1].matched) ++use.fused;
        if (match[2] == "s") {
            ++use.scalar_entries;
        } else {
            const int entries = entries_of(text);
            use.packed_entries += entries;
            use.widest = std::max(use.widest, entries);
        }
    } else if (instruction.starts_with("call")) {
        ++use.calls;
    }
}

}  // namespace

Kernels read_kernels(const std::string& objdump, const std::string& objects) {
    static const std::regex file("(?:.*/)?(\\w+)\\.[^/]*: +file format .*");
    // 0000 <RETURN drillstrand::Versions<&NAMESPACE::NAME>::LEVEL(ARGUMENTS)>:
    // or, of a template, ...Versions<&(RETURN NAMESPACE::NAME<...>(ARGUMENTS))>::LEVEL...
    static const std::regex version(
        ".*\\bVersions<&\\(?(?:[\\w:]+ )?(?:\\w+::|\\(anonymous "
        "namespace\\)::)*(\\w+)(?:[(<].*)?>::"
        "((?:baseline|avx2|avx512)(?:_unfused)?)\\(.*>:");
    Kernels kernels;
    std::string stem;
    VectorUse* use = nullptr;
    std::istringstream text(output_of(objdump + " -d -C --no-show-raw-insn " + objects));
    std::smatch match;
    for (std::string row; std::getline(text, row);) {
        if (row.ends_with(">:")) {
            const std::string name = row.substr(row.find('<') + 1);
            use = nullptr;
            if (!std::regex_match(name, match, version)) continue;
            kernels[stem + ": " + match[1].str()].push_back({match[2], name, {}});
            use = &kernels[stem + ": " + match[1].str()].back().use;
        } else if (const std::size_t tab = row.find('\t'); tab != std::string::npos) {
            if (use != nullptr) count(row.substr(tab + 1), *use);
        } else if (std::regex_match(row, match, file)) {
            stem = match[1];
        }
    }
    return kernels;
}

}  // namespace drillstrand::test
