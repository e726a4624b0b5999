#include <catch2/catch.hpp>
#include <string>

#include "abut/base/text.hpp"

using namespace abut;

TEST_CASE("as_utf8 keeps what is UTF-8, and replaces every byte that is not", "[base][text]") {
    const std::string mark = "\xEF\xBF\xBD";
    for (const char* valid : {"", "plain", "K\xC3\xB6rper", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "\x7F\x01"})
        CHECK(as_utf8(valid) == valid);
    CHECK(as_utf8("K\xF6rper") == "K" + mark + "rper");
    CHECK(as_utf8("\xC3") == mark);                                   // cut off
    CHECK(as_utf8("\xC0\xAF") == mark + mark);                        // overlong
    CHECK(as_utf8("\xED\xA0\x80") == mark + mark + mark);             // a surrogate
    CHECK(as_utf8("\xF4\x90\x80\x80") == mark + mark + mark + mark);  // above U+10FFFF
    CHECK(as_utf8("\xE2\x82"
                  "a") == mark + mark + "a");
}

TEST_CASE("a text is no formula in a spreadsheet, and a number stays one", "[base][text]") {
    for (const char* plain : {"", "left", "1", "-1.5", "+2e3", "-inf", "1+1"}) CHECK(as_cell(plain) == plain);
    for (const char* formula : {"=1+1", "+cmd", "-left", "@SUM(A1)", "-1+2"})
        CHECK(as_cell(formula) == "'" + std::string(formula));
    CHECK(as_cell("a\r\n\tb\x7F") == "a   b ");
    CHECK(as_cell("\xFF") == "\xEF\xBF\xBD");
}

TEST_CASE("marks that turn the direction of writing count as control characters, and letters of any language do not",
          "[base][text]") {
    // U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069, and the neighbours of each
    for (const char* mark :
         {"\xD8\x9C", "\xE2\x80\x8E", "\xE2\x80\x8F", "\xE2\x80\xAA", "\xE2\x80\xAB", "\xE2\x80\xAC", "\xE2\x80\xAD",
          "\xE2\x80\xAE", "\xE2\x81\xA6", "\xE2\x81\xA7", "\xE2\x81\xA8", "\xE2\x81\xA9"}) {
        CHECK(has_control_character(std::string("a") + mark + "b"));
        CHECK(in_one_line(std::string("a") + mark + "b" + mark) == "a b ");
    }
    for (const char* other : {"\xD8\x9B", "\xD8\xA7", "\xE2\x80\x8D", "\xE2\x80\x90", "\xE2\x80\xA9", "\xE2\x80\xAF",
                              "\xE2\x81\xA5", "\xE2\x81\xAA", "\xE2\x82\xAA", "K\xC3\xB6rper", "\xE2\x80", "\xE2"}) {
        CHECK_FALSE(has_control_character(other));
        CHECK(in_one_line(other) == other);
    }
}

TEST_CASE("a text that is cut for a message is cut between characters", "[base][text]") {
    CHECK(shortened("abc", 3) == "abc");
    CHECK(shortened("abcd", 3) == "abc...");
    CHECK(shortened("ab\xC3\xB6", 3) == "ab...");
}
