#include "abut/mesh/io/msh_values.hpp"

#include <algorithm>
#include <limits>

#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

bool is_blank(char letter) { return letter == ' ' || (letter >= '\t' && letter <= '\r'); }

constexpr const char* correct = "Correct the file, or write the mesh again.";

}  // namespace

void MshValues::set_binary(ByteOrder order) {
    is_binary_ = true;
    order_ = order;
}

std::string_view MshValues::word() {
    for (; at_ < text_.size() && is_blank(text_[at_]); ++at_)
        if (text_[at_] == '\n') ++line_;
    word_at_ = at_;
    word_line_ = line_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(word_at_, at_ - word_at_);
}

std::string_view MshValues::rest_of_line() {
    const std::size_t begin = at_, end = std::min(text_.find('\n', at_), text_.size());
    at_ = std::min(end + 1, text_.size());
    if (end < text_.size()) ++line_;
    std::string_view rest = text_.substr(begin, end - begin);
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    return rest;
}

void MshValues::check_has_end(std::string_view section) const {
    // Some programs end no line between binary data and this.
    const std::string end = "$End" + std::string(section);
    if (text_.find(end, at_) != std::string_view::npos) return;
    throw MeshError(name_ + ": the file is truncated: '" + end + "' is missing after " + std::to_string(text_.size()) +
                    " bytes. Write the mesh again.");
}

void MshValues::skip_section(std::string_view section) {
    check_has_end(section);
    const std::size_t end = text_.find("$End" + std::string(section), at_);
    line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                 text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at_ = end;
    (void)word();
}

void MshValues::finish_section(std::string_view section) {
    const std::string end = "$End" + std::string(section);
    const std::string_view found = word();
    if (found != end)
        refuse("the file is damaged: " + in_quotes(found) + " stands where '" + end +
               "' must follow what the section promises");
}

std::int64_t MshValues::whole_number(std::string_view word, const char* what) const {
    if (const auto value = whole_number_in(word)) return *value;
    if (word.empty() || word.starts_with('$')) refuse_missing(word, what);
    refuse(in_quotes(word) + " is no whole number of 64 bits, " + what + " is needed", correct);
}

void MshValues::refuse_missing(std::string_view instead, const char* what) const {
    refuse(std::string("the file is damaged: ") + what + " is missing" +
           (instead.empty() ? "" : ", " + in_quotes(instead) + " stands there"));
}

std::int64_t MshValues::text_number(const char* what) { return whole_number(word(), what); }

template <class Value>
Value MshValues::next_bytes(const char* what) {
    word_at_ = at_;
    if (n_bytes_left() < sizeof(Value)) refuse(std::string("the file is truncated: ") + what + " is missing");
    at_ += sizeof(Value);
    return binary_value<Value>(text_, word_at_, order_);
}

std::int32_t MshValues::next_int(const char* what) {
    if (is_binary_) return next_bytes<std::int32_t>(what);
    const std::int64_t value = text_number(what);
    if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max())
        refuse(std::to_string(value) + " is no whole number of 32 bits, " + what + " is needed", correct);
    return static_cast<std::int32_t>(value);
}

std::int64_t MshValues::next_size(const char* what) {
    const std::int64_t value = is_binary_ ? next_bytes<std::int64_t>(what) : text_number(what);
    if (value < 0) refuse(std::string(what) + " is " + std::to_string(value) + ", 0 or more is needed", correct);
    return value;
}

double MshValues::next_double(const char* what) {
    if (is_binary_) return next_bytes<double>(what);
    const std::string_view number = word();
    if (const auto value = number_in(number)) return *value;
    if (number.empty() || number.starts_with('$')) refuse_missing(number, what);
    refuse(in_quotes(number) + " is no number of a double, " + what + " is needed", correct);
}

void MshValues::check_fits(std::int64_t n, const char* what, std::size_t n_values, std::size_t n_bytes) const {
    // A number of a text takes a digit and a blank.
    const std::size_t most = n_bytes_left() / (is_binary_ ? n_bytes : 2 * n_values) + 1;
    if (n < 0 || static_cast<std::uint64_t>(n) > most)
        refuse("the file is damaged: it promises " + std::to_string(n) + " as " + what +
               ", what is left of it holds at most " + std::to_string(most));
}

std::int64_t MshValues::next_count(const char* what, std::size_t n_values, std::size_t n_bytes) {
    const std::int64_t n = is_binary_ ? next_size(what) : text_number(what);
    check_fits(n, what, n_values, n_bytes);
    return n;
}

void MshValues::refuse(const std::string& what, const std::string& remedy) const {
    const std::string where = is_binary_ ? "byte " + std::to_string(word_at_) : "line " + std::to_string(word_line_);
    throw MeshError(name_ + ": " + where + ": " + what + ". " + remedy);
}

}  // namespace abut::mesh
