#include "abut/mesh/io/text_words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "abut/base/messages.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

bool is_blank(char letter) { return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\v' || letter == '\f'; }

template <class Value>
std::errc parse(std::string_view word, Value& value) {
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return stop == end ? error : std::errc::invalid_argument;
}

/// std::from_chars knows no plus sign.
std::string_view without_plus(std::string_view word) {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

std::optional<double> number_in(std::string_view word) {
    word = without_plus(word);
    double value = 0.0;
    const std::errc error = parse(word, value);
    if (error == std::errc{}) return value;
    if (error != std::errc::result_out_of_range) return std::nullopt;
    // Too large or too small, which of both is not told; too small is a zero.
    long double wide = 0.0L;
    const std::errc wide_error = parse(word, wide);
    if (wide_error == std::errc{} && std::abs(wide) < 1.0L) return static_cast<double>(wide);
    const bool is_tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    if (wide_error != std::errc{} && is_tiny) return 0.0;
    return std::nullopt;
}

std::optional<std::int64_t> whole_number_in(std::string_view word) {
    std::int64_t value = 0;
    return parse(without_plus(word), value) == std::errc{} ? std::optional(value) : std::nullopt;
}

std::string in_quotes(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string text(word.substr(0, longest));
    for (char& letter : text)
        if (letter < ' ' || letter > '~') letter = '?';
    return "'" + text + (word.size() > longest ? "...'" : "'");
}

std::string count_text(double count) {
    return std::abs(count) < 1e18 ? std::to_string(static_cast<std::int64_t>(count)) : exact_number(count);
}

TextWords::TextWords(std::string name, std::string_view text, Syntax syntax, std::size_t first_line)
    : name_(std::move(name)), text_(text), syntax_(syntax), line_(first_line), word_line_(first_line) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
}

/// Number of characters of a backslash and the end of the line behind it; 0 if there is none here.
std::size_t TextWords::continuation() const {
    if (!syntax_.has_continuations || text_[at_] != '\\') return 0;
    const std::string_view rest = text_.substr(at_ + 1, 2);
    if (rest.starts_with('\n')) return 2;
    return rest == "\r\n" ? 3 : 0;
}

std::string_view TextWords::next_in_line() {
    for (; at_ < text_.size(); ++at_) {
        const char letter = text_[at_];
        if (syntax_.comment != '\0' && letter == syntax_.comment) at_ = std::min(text_.find('\n', at_), text_.size());
        if (at_ == text_.size() || text_[at_] == '\n') break;
        if (const std::size_t length = continuation(); length > 0) {
            at_ += length - 1;
            ++line_;
        } else if (!is_blank(letter)) {
            break;
        }
    }
    const std::size_t begin = at_;
    for (; at_ < text_.size(); ++at_) {
        const char letter = text_[at_];
        if (letter == '\n' || is_blank(letter) || continuation() > 0) break;
        if (syntax_.comment != '\0' && letter == syntax_.comment) break;
    }
    if (at_ > begin) word_line_ = line_;
    return text_.substr(begin, at_ - begin);
}

std::string_view TextWords::next() {
    while (true) {
        const std::string_view word = next_in_line();
        if (!word.empty() || at_ == text_.size()) return word;
        ++at_;
        ++line_;
    }
}

void TextWords::skip_line() {
    while (!next_in_line().empty()) continue;
}

double TextWords::number(std::string_view word, const char* what) const {
    if (const auto value = number_in(word)) return *value;
    if (word.empty()) refuse(std::string(what) + " is missing", "See that the file is whole, and write the mesh again.");
    refuse(in_quotes(word) + " is no number of a double, " + what + " is needed",
           "Correct the line, or write the mesh again.");
}

std::int64_t TextWords::whole_number(std::string_view word, const char* what) const {
    if (const auto value = whole_number_in(word)) return *value;
    if (word.empty()) refuse(std::string(what) + " is missing", "See that the file is whole, and write the mesh again.");
    refuse(in_quotes(word) + " is no whole number of 64 bits, " + what + " is needed",
           "Correct the line, or write the mesh again.");
}

void TextWords::refuse(const std::string& what, const std::string& remedy) const {
    throw MeshError(name_ + ": line " + std::to_string(word_line_) + ": " + what + ". " + remedy);
}

}  // namespace abut::mesh
