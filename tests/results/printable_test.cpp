/// Texts of somebody else's file on a terminal and in a page.
#include "printable.hpp"

#include <gtest/gtest.h>

#include "report_data.hpp"

namespace drillstrand::program {
namespace {

TEST(Printable, TextOfAnyLanguageStaysAsItIs) {
    const std::string text =
        "Pozzo n\xc2\xb0 1, \xe6\xb7\xb1\xe3\x81\x95 \xf0\x9f\x9b\xa2 \"3\\4\"";
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printable(""), "");
}

TEST(Printable, ControlCharactersAreShownAndNotObeyed) {
    EXPECT_EQ(printable("\x1b]0;owned\x07\x7f\r\n\t"), "\\x1b]0;owned\\x07\\x7f\\x0d\\n\\t");
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
    // the one-character form of ESC [, and the turn from right to left
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m\xe2\x80\xae"),
              "\\u{9b}31m\\u{202e}");
}

TEST(Printable, BytesThatAreNoUtf8AreShownAsNumbers) {
    EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
    EXPECT_EQ(printable("\x9b[2J"), "\\x9b[2J");
    EXPECT_EQ(printable("a\xc3"), "a\\xc3");                           // cut off
    EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");                    // longer than needed
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half of a pair
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // past the last one
}

TEST(Printable, APageGetsNoMarkupNoControlCharactersAndNoBrokenText) {
    EXPECT_EQ(json_text("a\"\\<b>&\n\x1b\x7f\xc2\x9b\xff\xc2\xb0"),
              "\"a\\\"\\\\\\u003cb\\u003e\\u0026\\u000a\\u001b\\u007f\\u009b\\ufffd\xc2\xb0\"");
}

}  // namespace
}  // namespace drillstrand::program
