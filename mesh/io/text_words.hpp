#pragma once
// Private to the layer; not installed.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace abut::mesh {

/// A finite number, an infinity or "nan", the whole word of it, whatever the locale; nothing for any other word and for what
/// is too large for a double.
[[nodiscard]] std::optional<double> number_in(std::string_view word);
/// A whole number of 64 bits, the whole word of it.
[[nodiscard]] std::optional<std::int64_t> whole_number_in(std::string_view word);
/// For messages: in quotes, cut to 40 characters, with '?' for what does not print.
[[nodiscard]] std::string in_quotes(std::string_view word);

/// For messages: a whole number in full, "4000000000"; beyond 18 digits as "1e+20".
[[nodiscard]] std::string count_text(double count);

/// The words of a text file one after the other, with the line of each for messages. A byte order mark at the start is
/// skipped.
class TextWords {
public:
    struct Syntax {
        char comment = '\0';             ///< what begins with it does not count, to the end of its line
        bool has_continuations = false;  ///< a backslash at the end of a line joins it to the next one; not in a comment
    };

    /// Views `text`, which must outlive this object.
    TextWords(std::string name, std::string_view text, Syntax syntax, std::size_t first_line = 1);

    /// The next word of this line; empty at its end.
    [[nodiscard]] std::string_view next_in_line();
    /// The next word, of this line or a later one; empty at the end of the file.
    [[nodiscard]] std::string_view next();
    void skip_line();
    /// Line of the last word, counted from 1.
    [[nodiscard]] std::size_t line() const { return word_line_; }

    /// A word that must be a number. `what` is what the message calls it: "a coordinate".
    [[nodiscard]] double number(std::string_view word, const char* what) const;
    [[nodiscard]] std::int64_t whole_number(std::string_view word, const char* what) const;

    /// Throws MeshError "<name>: line <line of the last word>: <what>. <remedy>".
    [[noreturn]] void refuse(const std::string& what, const std::string& remedy = "Write the mesh again.") const;

private:
    [[nodiscard]] std::size_t continuation() const;

    std::string name_;
    std::string_view text_;
    Syntax syntax_;
    std::size_t at_ = 0, line_, word_line_;
};

}  // namespace abut::mesh
