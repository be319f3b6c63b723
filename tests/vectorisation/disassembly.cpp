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

int entries_of(const std::string& operands) {
    if (operands.find("%zmm") != std::string::npos) return 8;
    return operands.find("%ymm") != std::string::npos ? 4 : 2;
}

void count(const std::string& instruction, const std::string& operands, VectorUse& use) {
    static const std::regex arithmetic(
        "v?(?:add|sub|mul|div|sqrt|min|max|fn?m(?:add|sub)\\d+)([ps])d");
    std::smatch match;
    if (std::regex_match(instruction, match, arithmetic)) {
        if (match[1] == "s") {
            ++use.scalar_entries;
        } else {
            const int entries = entries_of(operands);
            use.packed_entries += entries;
            use.widest = std::max(use.widest, entries);
        }
    } else if (instruction.rfind("call", 0) == 0) {
        ++use.calls;
    }
}

}  // namespace

Kernels read_kernels(const std::string& objdump, const std::string& objects) {
    // 0000 <drillstrand::(anonymous namespace)::NAME(ARGUMENTS) [clone .VERSION]>:
    static const std::regex heading(
        "[0-9a-f]+ <(?:\\w+::|\\(anonymous namespace\\)::)*(\\w+)\\(.*\\[clone "
        "\\.(arch_\\w+|default)\\]>:");
    static const std::regex line("\\s+[0-9a-f]+:\\s+(?:\\{\\w+\\}\\s+)?(\\w+)\\s*(.*)");
    Kernels kernels;
    VectorUse* use = nullptr;
    std::istringstream text(output_of(objdump + " -d -C --no-show-raw-insn " + objects));
    std::smatch match;
    for (std::string row; std::getline(text, row);) {
        if (row.ends_with(">:")) {
            use = std::regex_match(row, match, heading) ? &kernels[match[1]][match[2]] : nullptr;
        } else if (use != nullptr && std::regex_match(row, match, line)) {
            count(match[1], match[2], *use);
        }
    }
    return kernels;
}

}  // namespace drillstrand::test
