#include "abut/mesh/io/gmsh_promises.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "abut/mesh/io/binary_values.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

constexpr const char* write_again = "Write the mesh again.";

struct Header {
    bool is_version_4 = false, is_binary = false;
    std::size_t n_bytes = 0;  ///< up to the end of its line
};

[[noreturn]] void refuse(const std::string& name, const std::string& what, const char* remedy = write_again) {
    throw MeshError(name + ": " + what + ". " + remedy);
}

Header read_header(const std::string& name, const std::string& contents) {
    TextWords words(name, std::string_view(contents).substr(0, 256), {});
    const std::string_view section = words.next();
    if (section != "$MeshFormat")
        throw MeshError(name + ": is not a Gmsh mesh file: it starts with " + in_quotes(section) +
                        ", '$MeshFormat' is needed. Save it with gmsh -format msh41.");
    const std::string_view version = words.next(), file_type = words.next(), size = words.next();
    // Gmsh reads all of version 2 in one way.
    const std::array<std::string_view, 5> known = {"2", "2.0", "2.1", "2.2", "4.1"};
    if (std::find(known.begin(), known.end(), version) == known.end() || (file_type != "0" && file_type != "1"))
        throw MeshError(name + ": has the Gmsh format " + in_quotes(version) +
                        ", 2.0 to 2.2 and 4.1 can be read. Save it with gmsh -format msh41.");
    Header header{version == "4.1", file_type == "1", 0};
    if (header.is_binary && size != "8")
        throw MeshError(name + ": line " + std::to_string(words.line()) + ": a number takes " + in_quotes(size) +
                        " bytes, '8' can be read. Save it with gmsh -format msh41.");
    header.n_bytes =
        std::min(contents.find('\n', static_cast<std::size_t>(size.data() - contents.data())), contents.size() - 1) + 1;
    return header;
}

/// Behind the header of a binary file stands a 1, in its order of bytes.
void check_byte_order(const std::string& name, const std::string& contents, const Header& header) {
    if (header.n_bytes + 4 > contents.size()) refuse(name, "the file is truncated: it ends with its header");
    const auto native = std::endian::native == std::endian::little ? ByteOrder::little : ByteOrder::big;
    const auto foreign = native == ByteOrder::little ? ByteOrder::big : ByteOrder::little;
    if (binary_value<std::int32_t>(contents, header.n_bytes, native) == 1) return;
    if (binary_value<std::int32_t>(contents, header.n_bytes, foreign) == 1)
        refuse(name, "the file is binary in the other order of bytes than this machine's, which Gmsh does not survive",
               "Save it as text (gmsh -bin 0), or on a machine with this order.");
    refuse(name, "line 3: the file is damaged: its binary part begins with " +
                     std::to_string(binary_value<std::int32_t>(contents, header.n_bytes, native)) + ", 1 is needed");
}

/// Where the contents of a section begin: behind the line with its name.
std::size_t section_start(const std::string& name, const std::string& contents, const std::string& section) {
    const auto start = contents.find("\n$" + section);
    const auto end = contents.rfind("\n$End" + section);
    if (start == std::string::npos || end == std::string::npos || end < start)
        throw MeshError(name + ": the file is truncated: '$" + (start == std::string::npos ? "" : "End") + section +
                        "' is missing after " + std::to_string(contents.size()) + " bytes. Write the mesh again.");
    return contents.find('\n', start + 1) + 1;
}

bool has_section(const std::string& contents, const std::string& section) {
    return contents.find("\n$" + section) != std::string::npos;
}

/// Nodes of an element by Gmsh's number of its type; 0 for one that is not known here.
std::size_t n_nodes_of(std::int32_t type) {
    constexpr std::array<std::size_t, 32> n_nodes = {0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                                     8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
    return type > 0 && static_cast<std::size_t>(type) < n_nodes.size() ? n_nodes[static_cast<std::size_t>(type)] : 0;
}

/// A section of a binary file, read from its start; what is not there is refused by the name of the section.
class BinarySection {
public:
    BinarySection(const std::string& name, const std::string& contents, std::string section)
        : name_(name), contents_(contents), section_(std::move(section)), at_(section_start(name, contents, section_)) {}

    template <class Value>
    Value next() {
        skip(1, sizeof(Value));
        const auto native = std::endian::native == std::endian::little ? ByteOrder::little : ByteOrder::big;
        return binary_value<Value>(contents_, at_ - sizeof(Value), native);
    }
    /// A number in text on a line of its own.
    std::size_t next_line() {
        const std::size_t end = std::min(contents_.find('\n', at_), contents_.size() - 1);
        TextWords words(name_, std::string_view(contents_).substr(at_, end - at_), {});
        const auto value = whole_number_in(words.next());
        if (!value || *value < 0) damaged("its number of items is none");
        at_ = end + 1;
        return static_cast<std::size_t>(*value);
    }
    void skip(std::size_t n, std::size_t size) {
        if (n > (contents_.size() - at_) / size)
            damaged("at byte " + std::to_string(at_) + " it promises " + std::to_string(n) + " items of " +
                    std::to_string(size) + " bytes, the file has " + std::to_string(contents_.size()));
        at_ += n * size;
    }
    void check_block(std::size_t n, std::size_t n_before, std::size_t promised) const {
        if (n > promised - n_before)
            damaged("its blocks hold at least " + std::to_string(n_before) + " and " + std::to_string(n) +
                    " items, its head promises " + std::to_string(promised));
    }
    void check_type(std::int32_t type) const {
        if (n_nodes_of(type) == 0)
            damaged("at byte " + std::to_string(at_) + " it has elements of the type " + std::to_string(type) +
                    ", which is none of Gmsh's 1 to 31");
    }
    void finish() const {
        const std::string end = "$End" + section_;
        const std::size_t begin = contents_.find_first_not_of(" \r\n", at_);
        if (begin == std::string::npos || contents_.compare(begin, end.size(), end) != 0)
            damaged("'" + end + "' does not follow what its head promises, at byte " + std::to_string(at_));
    }
    [[noreturn]] void damaged(const std::string& what) const {
        refuse(name_, "the file is truncated or damaged: the section $" + section_ + ": " + what);
    }

private:
    const std::string& name_;
    const std::string& contents_;
    std::string section_;
    std::size_t at_;
};

std::size_t check_binary_2(const std::string& name, const std::string& contents) {
    BinarySection nodes(name, contents, "Nodes");
    nodes.skip(nodes.next_line(), 28);  // a tag and three coordinates
    nodes.finish();
    BinarySection elements(name, contents, "Elements");
    const std::size_t promised = elements.next_line();
    for (std::size_t n_before = 0; n_before < promised;) {
        const auto type = elements.next<std::int32_t>(), n = elements.next<std::int32_t>(),
                   n_tags = elements.next<std::int32_t>();
        elements.check_type(type);
        if (n <= 0 || n_tags < 0)
            elements.damaged("a block has " + std::to_string(n) + " elements with " + std::to_string(n_tags) + " tags each");
        elements.check_block(static_cast<std::size_t>(n), n_before, promised);
        elements.skip(static_cast<std::size_t>(n), 4 * (1 + static_cast<std::size_t>(n_tags) + n_nodes_of(type)));
        n_before += static_cast<std::size_t>(n);
    }
    elements.finish();
    return promised;
}

/// Numbers behind the coordinates of a node on a curve or a surface.
std::size_t n_parameters_of(std::int64_t dimension, bool is_parametric) {
    return is_parametric && (dimension == 1 || dimension == 2) ? static_cast<std::size_t>(dimension) : 0;
}

/// The head of a section of format 4.1: numbers of blocks and of items; the least and largest tag.
std::array<std::size_t, 2> read_head(BinarySection& section) {
    const auto n_blocks = section.next<std::uint64_t>(), promised = section.next<std::uint64_t>();
    section.skip(2, 8);
    return {n_blocks, promised};
}

/// Points, curves, surfaces, volumes: a tag, the box around it (of a point: where it is), the tags of its physical groups and
/// those of its boundary (a point has none).
void check_binary_entities(const std::string& name, const std::string& contents) {
    if (!has_section(contents, "Entities")) return;
    BinarySection entities(name, contents, "Entities");
    std::array<std::uint64_t, 4> n_of_dimension{};
    for (auto& n : n_of_dimension) n = entities.next<std::uint64_t>();
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
        for (std::uint64_t i = 0; i < n_of_dimension[dimension]; ++i) {
            entities.skip(1, dimension == 0 ? 28 : 52);
            entities.skip(entities.next<std::uint64_t>(), 4);
            if (dimension > 0) entities.skip(entities.next<std::uint64_t>(), 4);
        }
    entities.finish();
}

std::size_t check_binary_4(const std::string& name, const std::string& contents) {
    check_binary_entities(name, contents);
    BinarySection nodes(name, contents, "Nodes");
    std::size_t n_before = 0;
    const auto [n_node_blocks, n_nodes] = read_head(nodes);
    for (std::size_t block = 0; block < n_node_blocks; ++block) {
        const auto dimension = nodes.next<std::int32_t>();
        nodes.skip(1, 4);
        const std::size_t n_parameters = n_parameters_of(dimension, nodes.next<std::int32_t>() != 0);
        const auto n = nodes.next<std::uint64_t>();
        nodes.check_block(n, n_before, n_nodes);
        nodes.skip(n, 8);
        nodes.skip(n, 8 * (3 + n_parameters));
        n_before += n;
    }
    nodes.finish();
    BinarySection elements(name, contents, "Elements");
    n_before = 0;
    const auto [n_element_blocks, n_elements] = read_head(elements);
    for (std::size_t block = 0; block < n_element_blocks; ++block) {
        elements.skip(2, 4);
        const auto type = elements.next<std::int32_t>();
        elements.check_type(type);
        const auto n = elements.next<std::uint64_t>();
        elements.check_block(n, n_before, n_elements);
        elements.skip(n, 8 * (1 + n_nodes_of(type)));
        n_before += n;
    }
    elements.finish();
    return n_elements;
}

std::size_t count_in(const TextWords& words, std::string_view word, std::size_t most, const char* what) {
    const std::int64_t n = words.whole_number(word, what);
    if (n < 0 || static_cast<std::size_t>(n) > most)
        words.refuse("the file is damaged: it promises " + std::to_string(n) + " as " + what +
                     ", a file of its size holds at most " + std::to_string(most));
    return static_cast<std::size_t>(n);
}

TextWords words_of(const std::string& name, const std::string& contents, const char* section) {
    const std::size_t start = section_start(name, contents, section);
    const auto line =
        static_cast<std::size_t>(std::count(contents.begin(), contents.begin() + static_cast<std::ptrdiff_t>(start), '\n'));
    return {name, std::string_view(contents).substr(start), {}, line + 1};
}

/// The heads of sections before the nodes; an item takes 4 bytes at least.
void check_text_heads(const std::string& name, const std::string& contents, const Header& header) {
    if (has_section(contents, "PhysicalNames")) {
        TextWords names = words_of(name, contents, "PhysicalNames");
        (void)count_in(names, names.next(), contents.size() / 4, "the number of physical names");
    }
    if (!header.is_version_4 || header.is_binary || !has_section(contents, "Entities")) return;
    TextWords entities = words_of(name, contents, "Entities");
    for (int dimension = 0; dimension < 4; ++dimension)
        (void)count_in(entities, entities.next(), contents.size() / 4, "the number of entities");
}

/// A node takes 8 bytes at least, "1 0 0 0" and the end of its line, and an element 4, "1 1" (4.1, a point).
std::size_t check_text(const std::string& name, const std::string& contents, const Header& header) {
    const std::size_t most_nodes = contents.size() / 8, most_elements = contents.size() / 4;
    TextWords nodes = words_of(name, contents, "Nodes");
    std::size_t n_blocks = 0;
    if (header.is_version_4) n_blocks = count_in(nodes, nodes.next(), contents.size(), "the number of blocks of nodes");
    (void)count_in(nodes, nodes.next(), most_nodes, "the number of nodes");
    nodes.skip_line();
    for (std::size_t block = 0; block < n_blocks; ++block) {
        const auto head = [&] { return nodes.whole_number(nodes.next(), "the head of a block of nodes"); };
        const std::int64_t dimension = head();
        (void)head();
        const std::size_t n_parameters = n_parameters_of(dimension, head() != 0);
        const std::size_t n = count_in(nodes, nodes.next(), most_nodes, "the number of nodes of a block");
        for (std::size_t i = 0; i < n * (4 + n_parameters); ++i) (void)nodes.next();
    }
    TextWords elements = words_of(name, contents, "Elements");
    if (header.is_version_4) (void)count_in(elements, elements.next(), contents.size(), "the number of blocks of elements");
    return count_in(elements, elements.next(), most_elements, "the number of elements");
}

}  // namespace

std::size_t check_gmsh_promises(const std::string& name, const std::string& contents) {
    const Header header = read_header(name, contents);
    check_text_heads(name, contents, header);
    if (!header.is_binary) return check_text(name, contents, header);
    check_byte_order(name, contents, header);
    return header.is_version_4 ? check_binary_4(name, contents) : check_binary_2(name, contents);
}

}  // namespace abut::mesh
