#include "abut/mesh/io/ply_header.hpp"

#include <algorithm>
#include <array>

#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

struct TypeName {
    std::string_view name, other_name;
    std::size_t n_bytes;
};
constexpr std::array<TypeName, 8> types = {{{"char", "int8", 1},
                                            {"uchar", "uint8", 1},
                                            {"short", "int16", 2},
                                            {"ushort", "uint16", 2},
                                            {"int", "int32", 4},
                                            {"uint", "uint32", 4},
                                            {"float", "float32", 4},
                                            {"double", "float64", 8}}};

/// End of the header: behind the line "end_header".
std::size_t header_size(const std::string& name, std::string_view contents) {
    for (std::size_t begin = 0; begin < contents.size();) {
        const std::size_t end = std::min(contents.find('\n', begin), contents.size());
        std::string_view line = contents.substr(begin, end - begin);
        line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
        begin = std::min(end + 1, contents.size());
        if (line == "end_header") return begin;
    }
    throw MeshError(name + ": 'end_header' is missing in " + std::to_string(contents.size()) +
                    " bytes, a PLY header ends with it. See that the file is whole, and save it as PLY.");
}

class HeaderReader {
public:
    HeaderReader(const std::string& name, std::string_view header) : words_(name, header, {}) {}

    std::vector<PlyElement> read(PlyHeader::Format& format) {
        bool has_format = false;
        if (const auto word = words_.next(); word != "ply")
            words_.refuse("the file does not begin with 'ply'", "Save it as PLY.");
        for (auto word = words_.next(); word != "end_header"; word = words_.next()) {
            if (word == "format") {
                format = read_format();
                has_format = true;
            } else if (word == "element") {
                read_element();
            } else if (word == "property") {
                read_property();
            } else if (word != "comment" && word != "obj_info") {
                words_.refuse(in_quotes(word) + " is no word of a PLY header",
                              "Correct the line, or save the mesh again as PLY.");
            }
            words_.skip_line();
        }
        if (!has_format)
            words_.refuse("the header has no line 'format'", "Add 'format ascii 1.0', or save the mesh again as PLY.");
        return std::move(elements_);
    }

private:
    PlyHeader::Format read_format() {
        const std::string_view word = words_.next_in_line();
        if (word == "ascii") return PlyHeader::Format::ascii;
        if (word == "binary_little_endian") return PlyHeader::Format::binary_little;
        if (word == "binary_big_endian") return PlyHeader::Format::binary_big;
        words_.refuse("the format " + in_quotes(word) + " is none of ascii, binary_little_endian and binary_big_endian",
                      "Save the mesh again as PLY.");
    }
    void read_element() {
        const std::string element(words_.next_in_line());
        const std::int64_t n_items = words_.whole_number(words_.next_in_line(), "the number of an element");
        if (n_items < 0)
            words_.refuse("there are " + std::to_string(n_items) + " of the element " + in_quotes(element) +
                          ", at least 0 are needed");
        elements_.push_back({element, n_items, words_.line(), {}});
    }
    void read_property() {
        if (elements_.empty())
            words_.refuse("'property' stands before any 'element'", "Put it behind the element that has the property.");
        PlyProperty property{.name = {}, .type = PlyType::int8};
        std::string_view word = words_.next_in_line();
        if (word == "list") {
            property.count_type = type_called(words_.next_in_line());
            if (*property.count_type == PlyType::float32 || *property.count_type == PlyType::float64)
                words_.refuse("the length of a list cannot be a float", "Save the mesh again as PLY.");
            word = words_.next_in_line();
        }
        property.type = type_called(word);
        property.name = words_.next_in_line();
        if (property.name.empty()) words_.refuse("the property has no name", "Save the mesh again as PLY.");
        elements_.back().properties.push_back(std::move(property));
    }
    [[nodiscard]] PlyType type_called(std::string_view name) const {
        for (std::size_t i = 0; i < types.size(); ++i)
            if (name == types[i].name || name == types[i].other_name) return static_cast<PlyType>(i);
        words_.refuse("the type " + in_quotes(name) + " is none of char, uchar, short, ushort, int, uint, float and double",
                      "Save the mesh again as PLY.");
    }

    TextWords words_;
    std::vector<PlyElement> elements_;
};

/// Least bytes of an item: of a list its length alone.
std::size_t least_size(const PlyElement& element, PlyHeader::Format format) {
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties)
        size += format == PlyHeader::Format::ascii ? 2 : n_bytes_of(property.count_type.value_or(property.type));
    return size;
}

}  // namespace

std::size_t n_bytes_of(PlyType type) { return types[static_cast<std::size_t>(type)].n_bytes; }

PlyHeader read_ply_header(const std::string& name, std::string_view contents) {
    PlyHeader header{};
    header.n_bytes = header_size(name, contents);
    const std::string_view text = contents.substr(0, header.n_bytes);
    header.n_lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    header.elements = HeaderReader(name, text).read(header.format);
    // The last value of a text may have nothing behind it.
    const std::size_t n_left = contents.size() - header.n_bytes + 1;
    for (const PlyElement& element : header.elements) {
        const std::size_t size = least_size(element, header.format);
        if (size > 0 && static_cast<std::size_t>(element.n_items) > n_left / size)
            throw MeshError(name + ": line " + std::to_string(element.line) + ": the file is damaged: it promises " +
                            std::to_string(element.n_items) + " of the element " + in_quotes(element.name) +
                            " of at least " + std::to_string(size) + " bytes each, behind the header it has " +
                            std::to_string(n_left - 1) + " bytes. Write the mesh again.");
    }
    return header;
}

}  // namespace abut::mesh
