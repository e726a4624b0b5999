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

TEST_CASE("a text that is cut for a message is cut between characters", "[base][text]") {
    CHECK(shortened("abc", 3) == "abc");
    CHECK(shortened("abcd", 3) == "abc...");
    CHECK(shortened("ab\xC3\xB6", 3) == "ab...");
}
