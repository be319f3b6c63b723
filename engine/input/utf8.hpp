/// Counting characters in UTF-8 text.
#pragma once

#include <cstddef>
#include <string_view>

namespace drillstrand {

/// Characters (code points) in valid UTF-8.
std::size_t count_characters(std::string_view text);

/// Bytes of the longest valid start of `text` without zero bytes; text.size() where all is valid.
std::size_t valid_text_prefix(std::string_view text);

}  // namespace drillstrand
