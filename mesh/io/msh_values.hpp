#pragma once
// Private to the layer; not installed.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "abut/mesh/io/binary_values.hpp"

namespace abut::mesh {

/// The words and, in a binary file, the numbers of a Gmsh file one after the other. Line ends are blanks, as they are to
/// Gmsh. Every complaint is a MeshError "<name>: line <n>: ..." of text, "<name>: byte <n>: ..." of a binary file.
class MshValues {
public:
    /// Views both, which must outlive this object.
    MshValues(const std::string& name, std::string_view contents) : name_(name), text_(contents) {}

    /// What follows the head of the file is binary from now on.
    void set_binary(ByteOrder order);
    [[nodiscard]] bool is_binary() const { return is_binary_; }

    /// The next word; empty at the end of the file.
    [[nodiscard]] std::string_view word();
    /// Rest of this line, without its end.
    [[nodiscard]] std::string_view rest_of_line();
    /// Goes to the end of the section of this name, which begins here. Throws MeshError if the section has none.
    void skip_section(std::string_view section);
    /// Throws MeshError unless "$End<section>" is further down in the file.
    void check_has_end(std::string_view section) const;
    /// Throws MeshError unless the next word is "$End<section>".
    void finish_section(std::string_view section);

    /// A number that is text in a binary file, too.
    [[nodiscard]] std::int64_t text_number(const char* what);
    /// Integer of 4 bytes in a binary file.
    [[nodiscard]] std::int32_t next_int(const char* what);
    /// Integer of 8 bytes in a binary file; at least 0.
    [[nodiscard]] std::int64_t next_size(const char* what);
    /// Number of 8 bytes in a binary file.
    [[nodiscard]] double next_double(const char* what);
    /// A number of things that each take at least so many numbers, or bytes of a binary file: those fit into the file.
    [[nodiscard]] std::int64_t next_count(const char* what, std::size_t n_values, std::size_t n_bytes);
    /// Throws MeshError where that many do not fit into the rest of the file.
    void check_fits(std::int64_t n, const char* what, std::size_t n_values, std::size_t n_bytes) const;

    /// Begins at the last word or number.
    [[noreturn]] void refuse(const std::string& what, const std::string& remedy = "Write the mesh again.") const;
    /// Line of the last word.
    [[nodiscard]] std::size_t line() const { return word_line_; }
    [[nodiscard]] std::size_t n_bytes_left() const { return text_.size() - at_; }

private:
    [[noreturn]] void refuse_missing(std::string_view instead, const char* what) const;
    [[nodiscard]] std::int64_t whole_number(std::string_view word, const char* what) const;
    template <class Value>
    [[nodiscard]] Value next_bytes(const char* what);

    const std::string& name_;
    std::string_view text_;
    std::size_t at_ = 0, word_at_ = 0, line_ = 1, word_line_ = 1;
    bool is_binary_ = false;
    ByteOrder order_ = ByteOrder::little;
};

}  // namespace abut::mesh
