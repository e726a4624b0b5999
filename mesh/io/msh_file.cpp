#include "abut/mesh/io/msh_file.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <tuple>

#include "abut/base/sort_unique.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/msh_values.hpp"
#include "abut/mesh/io/node_numbers.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

/// The name between quotes, or the whole of a text without.
std::string name_in(std::string_view text) {
    const std::size_t first = text.find('"'), last = text.rfind('"');
    if (first != std::string_view::npos && last > first) return std::string(text.substr(first + 1, last - first - 1));
    const std::size_t begin = text.find_first_not_of(" \t\""), end = text.find_last_not_of(" \t\"");
    return begin == std::string_view::npos ? std::string() : std::string(text.substr(begin, end - begin + 1));
}

/// Tag of a physical group, which stands with a minus sign where Gmsh turned its elements round. 0 is none.
std::int32_t group_tag(std::int32_t tag) { return tag == std::numeric_limits<std::int32_t>::min() ? 0 : std::abs(tag); }

class MshReader {
public:
    MshReader(const std::string& name, std::string_view contents) : values_(name, contents) { file_.name = name; }

    MshFile read() {
        read_head();
        for (auto word = values_.word(); !word.empty(); word = values_.word()) {
            if (word.starts_with('$'))
                read_section(word.substr(1));
            else
                skip_stray_line(word);
        }
        for (const auto& [found, section] : {std::pair{has_nodes_, "Nodes"}, {has_elements_, "Elements"}})
            if (!found)
                throw MeshError(file_.name + ": the file is truncated: '$" + section + "' is missing after " +
                                std::to_string(n_bytes_) + " bytes. Write the mesh again.");
        give_groups_of_entities();
        std::ranges::stable_sort(file_.blocks, {}, [](const MshBlock& block) {
            return std::tuple(block.type.dimension, block.entity, block.type.number);
        });
        if (n_stray_lines_ > 0)
            file_.warnings.push_back(
                "line " + std::to_string(stray_line_) + ": " + stray_ +
                " is in no section of a Gmsh file; lines of that kind that were skipped: " + std::to_string(n_stray_lines_));
        return std::move(file_);
    }

private:
    void read_head() {
        n_bytes_ = values_.n_bytes_left();
        std::string_view section = values_.word();
        for (; section == "$Comments"; section = values_.word()) values_.skip_section(section.substr(1));
        if (section != "$MeshFormat")  // a file of somebody else: what it holds stays out of the message
            throw MeshError(file_.name +
                            ": is not a Gmsh mesh file: it does not start with '$MeshFormat'. Save it with gmsh "
                            "-format msh41.");
        const std::string_view version = values_.word(), type = values_.word(), size = values_.word();
        const std::optional<double> number = number_in(version);                                 // Netgen writes 2.000000
        const bool is_known = number && ((*number >= 2.0 && *number <= 2.2) || *number == 4.1);  // version 2: one grammar
        if (!is_known || (type != "0" && type != "1"))
            throw MeshError(file_.name + ": has the Gmsh format " + in_quotes(version) +
                            ", 2.0 to 2.2 and 4.1 can be read. Save it with gmsh -format msh41.");
        is_version_4_ = *number == 4.1;
        if (type == "1") read_byte_order(size);
        values_.check_has_end("MeshFormat");
        values_.finish_section("MeshFormat");
    }
    /// Behind the header of a binary file stands a 1, in its order of bytes.
    void read_byte_order(std::string_view size) {
        if (size != "8")
            values_.refuse("a number takes " + in_quotes(size) + " bytes, '8' can be read",
                           "Save it with gmsh -format msh41.");
        (void)values_.rest_of_line();
        values_.set_binary(ByteOrder::little);
        const std::int32_t one = values_.next_int("a 1 that tells the order of bytes");
        if (one == 1) return;
        if (one != 0x01000000)
            values_.refuse("the file is damaged: its binary part begins with " + std::to_string(one) + ", 1 is needed");
        values_.set_binary(ByteOrder::big);
    }
    void skip_stray_line(std::string_view word) {
        if (n_stray_lines_++ == 0) {
            stray_ = in_quotes(word);
            stray_line_ = values_.line();
        }
        (void)values_.rest_of_line();
    }

    void read_section(std::string_view section) {
        const bool is_known = section == "PhysicalNames" || section == "Nodes" || section == "Elements" ||
                              (is_version_4_ && (section == "Entities" || section == "PartitionedEntities"));
        if (!is_known) return values_.skip_section(section);
        values_.check_has_end(section);
        if (section == "PhysicalNames")
            read_names();
        else if (section == "Entities")
            read_entities(false);
        else if (section == "PartitionedEntities")
            read_entities(true);
        else if (section == "Nodes")
            read_nodes();
        else
            read_elements();
        values_.finish_section(section);
    }
    void begin_once(bool& was_there, const char* section) {
        if (was_there) values_.refuse(std::string("there is a second section ") + section + ", one is allowed");
        was_there = true;
    }

    void read_names() {
        const std::int64_t n = text_count("the number of physical names", 3);
        for (std::int64_t i = 0; i < n; ++i) {
            const std::int64_t dimension = values_.text_number("the dimension of a physical group");
            if (dimension < 0 || dimension > 3)
                values_.refuse("a physical group has the dimension " + std::to_string(dimension) + ", 0 to 3 are allowed");
            const std::int64_t tag = values_.text_number("the tag of a physical group");
            if (tag < std::numeric_limits<std::int32_t>::min() || tag > std::numeric_limits<std::int32_t>::max())
                values_.refuse("the tag " + std::to_string(tag) + " of a physical group has more than 32 bits");
            file_.group_names.emplace(
                MshGroup{static_cast<std::int32_t>(dimension), group_tag(static_cast<std::int32_t>(tag))},
                name_in(values_.rest_of_line()));
        }
    }
    /// A number in text on a line of its own.
    std::int64_t text_count(const char* what, std::size_t n_values) {
        const std::int64_t n = values_.text_number(what);
        // Of one byte each at least, text or binary.
        values_.check_fits(n, what, n_values, n_values);
        return n;
    }

    /// Points, curves, surfaces, volumes: a tag, the box around it (of a point: where it is), the tags of its physical
    /// groups and those of its boundary (a point has none). A partitioned one has its parent and its parts before the
    /// box. Where its parent has more dimensions it is a cut between parts: the group of that body is not for it.
    void read_entities(bool are_parts) {
        if (values_.is_binary()) (void)values_.rest_of_line();
        if (are_parts) {
            (void)values_.next_size("the number of parts");
            const std::int64_t n_ghosts = values_.next_count("the number of ghost entities", 2, 8);
            for (std::int64_t i = 0; i < 2 * n_ghosts; ++i) (void)values_.next_int("a ghost entity");
        }
        std::array<std::int64_t, 4> n_entities{};
        for (auto& n : n_entities) n = values_.next_count("the number of entities", 5, 36);
        for (std::int32_t dimension = 0; dimension < 4; ++dimension)
            for (std::int64_t i = 0; i < n_entities[static_cast<std::size_t>(dimension)]; ++i)
                read_entity(dimension, are_parts);
    }
    void read_entity(std::int32_t dimension, bool is_part) {
        const std::int32_t tag = values_.next_int("the tag of an entity");
        bool is_cut = false;
        if (is_part) {
            is_cut = values_.next_int("the dimension of a parent") > dimension;
            (void)values_.next_int("the tag of a parent");
            skip_tags("the number of parts of an entity", "a part");
        }
        for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) (void)values_.next_double("the box of an entity");
        auto& groups = groups_of_entity_[{dimension, tag}];
        const std::int64_t n_groups = values_.next_count("the number of physical groups of an entity", 1, 4);
        for (std::int64_t i = 0; i < n_groups; ++i)
            if (const std::int32_t group = group_tag(values_.next_int("a physical group")); group > 0 && !is_cut) {
                groups.push_back(group);
                file_.groups.insert({dimension, group});
            }
        sort_unique(groups);
        if (dimension > 0) skip_tags("the number of entities around one", "an entity around one");
    }
    void skip_tags(const char* count, const char* what) {
        const std::int64_t n = values_.next_count(count, 1, 4);
        for (std::int64_t i = 0; i < n; ++i) (void)values_.next_int(what);
    }

    void read_nodes() {
        begin_once(has_nodes_, "$Nodes");
        if (is_version_4_)
            read_nodes_4();
        else
            read_nodes_2();
        if (file_.vertices.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
            throw MeshError(file_.name + ": has " + std::to_string(file_.vertices.size()) +
                            " nodes, at most 2147483647 are allowed. Coarsen the mesh.");
        number_ = NodeNumbers<std::int64_t>(file_.vertex_label);
        drop_repeated_nodes();
    }
    void read_nodes_2() {
        const std::int64_t n = values_.text_number("the number of nodes");
        values_.check_fits(n, "the number of nodes", 4, 28);
        if (values_.is_binary()) (void)values_.rest_of_line();
        for (std::int64_t i = 0; i < n; ++i) {
            append_tag(values_.next_int("the tag of a node"));
            append_vertex(0);
        }
    }
    void read_nodes_4() {
        if (values_.is_binary()) (void)values_.rest_of_line();
        const std::int64_t n_blocks = values_.next_count("the number of blocks of nodes", 4, 20);
        const std::int64_t n_nodes = values_.next_count("the number of nodes", 4, 32);
        for (int i = 0; i < 2; ++i) (void)values_.next_size("the range of the tags of nodes");
        for (std::int64_t block = 0; block < n_blocks; ++block) {
            const std::int32_t dimension = values_.next_int("the dimension of a block of nodes");
            (void)values_.next_int("the entity of a block of nodes");
            const bool is_parametric = values_.next_int("whether nodes have parameters") != 0;
            const std::int64_t n = values_.next_count("the number of nodes of a block", 4, 32);
            check_block(n, file_.vertices.size(), n_nodes, "nodes");
            for (std::int64_t i = 0; i < n; ++i) append_tag(values_.next_size("the tag of a node"));
            for (std::int64_t i = 0; i < n; ++i)
                append_vertex(is_parametric && (dimension == 1 || dimension == 2) ? dimension : 0);
        }
        check_total(file_.vertices.size(), n_nodes, "nodes");
    }
    void append_tag(std::int64_t tag) {
        if (tag < 0) values_.refuse("a node has the tag " + std::to_string(tag) + ", 0 or more is needed");
        file_.vertex_label.push_back(tag);
    }
    void append_vertex(std::int32_t n_parameters) {
        Vector<3> vertex;
        for (double& x : vertex) x = values_.next_double("a coordinate");
        for (std::int32_t i = 0; i < n_parameters; ++i) (void)values_.next_double("a parameter of a node");
        file_.vertices.push_back(vertex);
    }
    void check_block(std::int64_t n, std::size_t n_before, std::int64_t promised, const char* what) const {
        if (n > promised - static_cast<std::int64_t>(n_before))
            values_.refuse("the file is damaged: its blocks hold at least " + std::to_string(n_before) + " and " +
                           std::to_string(n) + " " + what + ", the head of the section promises " +
                           std::to_string(promised));
    }
    void check_total(std::size_t found, std::int64_t promised, const char* what) const {
        if (static_cast<std::int64_t>(found) != promised)
            throw MeshError(file_.name + ": the file is damaged: " + std::to_string(found) + " " + what +
                            " could be read, its header promises " + std::to_string(promised) + ". Write the mesh again.");
    }
    /// Elements take the last node of a tag: which one that is must not matter.
    void drop_repeated_nodes() {
        std::vector<Vector<3>> vertices;
        std::vector<std::int64_t> labels;
        std::vector<bool> is_repeated(file_.vertices.size());
        std::size_t n_repeated = 0;
        for (std::size_t i = 0; i < file_.vertices.size(); ++i) {
            const auto other = static_cast<std::size_t>(number_(file_.vertex_label[i]));
            if (other == i) continue;
            if (file_.vertices[i] != file_.vertices[other])
                throw MeshError(file_.name + ": node " + std::to_string(file_.vertex_label[i]) +
                                " stands twice, at two places. Give every node a tag of its own.");
            is_repeated[i] = true;
            if (n_repeated++ == 0)
                file_.warnings.push_back("node " + std::to_string(file_.vertex_label[i]) +
                                         " stands twice, at the same place; nodes of that kind that were skipped: ");
        }
        if (n_repeated == 0) return;
        file_.warnings.back() += std::to_string(n_repeated);
        for (std::size_t i = 0; i < file_.vertices.size(); ++i) {
            if (is_repeated[i]) continue;
            vertices.push_back(file_.vertices[i]);
            labels.push_back(file_.vertex_label[i]);
        }
        file_.vertices = std::move(vertices);
        file_.vertex_label = std::move(labels);
        number_ = NodeNumbers<std::int64_t>(file_.vertex_label);
    }

    void read_elements() {
        begin_once(has_elements_, "$Elements");
        if (!has_nodes_) values_.refuse("the section $Elements stands before $Nodes");
        if (is_version_4_)
            read_elements_4();
        else if (values_.is_binary())
            read_binary_elements_2();
        else
            read_text_elements_2();
    }
    void read_text_elements_2() {
        const std::int64_t n = text_count("the number of elements", 2);
        for (std::int64_t i = 0; i < n; ++i) {
            const std::int64_t label = values_.text_number("the tag of an element");
            const MshType& type = known_type(values_.next_int("the type of an element"));
            read_element_2(type, label, values_.next_int("the number of tags of an element"));
        }
    }
    void read_binary_elements_2() {
        const std::int64_t promised = values_.text_number("the number of elements");
        values_.check_fits(promised, "the number of elements", 2, 8);
        (void)values_.rest_of_line();
        for (std::int64_t n_before = 0; n_before < promised;) {
            const MshType& type = known_type(values_.next_int("the type of elements"));
            const std::int32_t n = values_.next_int("the number of elements of a block");
            const std::int32_t n_tags = values_.next_int("the number of tags of an element");
            if (n <= 0 || n_tags < 0)
                values_.refuse("the file is damaged: a block has " + std::to_string(n) + " elements with " +
                               std::to_string(n_tags) + " tags each");
            check_block(n, static_cast<std::size_t>(n_before), promised, "elements");
            values_.check_fits(n, "the number of elements of a block", 1, 4 * (1 + type.n_nodes));
            for (std::int32_t i = 0; i < n; ++i) read_element_2(type, values_.next_int("the tag of an element"), n_tags);
            n_before += n;
        }
    }
    /// Reads what follows the tag of the element and the number of its tags: physical group, entity, others; nodes.
    void read_element_2(const MshType& type, std::int64_t label, std::int32_t n_tags) {
        values_.check_fits(n_tags, "the number of tags of an element", 1, 4);
        std::int32_t group = 0, entity = 0;
        for (std::int32_t i = 0; i < n_tags; ++i) {
            const std::int32_t tag = values_.next_int("a tag of an element");
            if (i == 0) group = group_tag(tag);
            if (i == 1) entity = tag;
        }
        if (group > 0) file_.groups.insert({type.dimension, group});
        append_element(block_of(type, entity, group), label, [&] { return values_.next_int("a node of an element"); });
    }
    void read_elements_4() {
        if (values_.is_binary()) (void)values_.rest_of_line();
        const std::int64_t n_blocks = values_.next_count("the number of blocks of elements", 4, 20);
        const std::int64_t n_elements = values_.next_count("the number of elements", 2, 16);
        for (int i = 0; i < 2; ++i) (void)values_.next_size("the range of the tags of elements");
        std::int64_t n_before = 0;
        for (std::int64_t block = 0; block < n_blocks; ++block) {
            const std::int32_t dimension = values_.next_int("the dimension of a block of elements");
            const std::int32_t entity = values_.next_int("the entity of a block of elements");
            const MshType& type = known_type(values_.next_int("the type of elements"));
            if (type.dimension != dimension)
                values_.refuse(std::string("the file is damaged: a ") + type.name + " is in an entity of dimension " +
                               std::to_string(dimension));
            const std::int64_t n =
                values_.next_count("the number of elements of a block", 1 + type.n_nodes, 8 * (1 + type.n_nodes));
            check_block(n, static_cast<std::size_t>(n_before), n_elements, "elements");
            for (std::int64_t i = 0; i < n; ++i) {
                const std::int64_t label = values_.next_size("the tag of an element");
                append_element(block_of(type, entity, 0), label, [&] { return values_.next_size("a node of an element"); });
            }
            n_before += n;
        }
        check_total(static_cast<std::size_t>(n_before), n_elements, "elements");
    }
    const MshType& known_type(std::int32_t number) const {
        if (const MshType* type = msh_type(number)) return *type;
        values_.refuse("an element has the type " + std::to_string(number) + ", Gmsh's 1 to 31 can be read",
                       "Mesh the part with elements of order 1: gmsh -order 1.");
    }
    /// `group`: 0 for none.
    MshBlock& block_of(const MshType& type, std::int32_t entity, std::int32_t group) {
        const std::array key = {type.number, entity, group};
        if (key != last_key_) {
            last_key_ = key;
            const auto [found, is_new] = block_.emplace(key, file_.blocks.size());
            if (is_new) {
                file_.blocks.push_back({type, entity, {}, {}, {}});
                if (group > 0) file_.blocks.back().groups.push_back(group);
            }
            last_block_ = found->second;
        }
        return file_.blocks[last_block_];
    }
    template <class NextNode>
    void append_element(MshBlock& block, std::int64_t label, NextNode&& next_node) {
        for (std::size_t i = 0; i < block.type.n_nodes; ++i) {
            const std::int64_t tag = next_node();
            const std::int32_t node = number_(tag);
            if (node < 0)
                values_.refuse("element " + std::to_string(label) + " has the node " + std::to_string(tag) +
                               ", which is not in the file");
            if (i < block.type.n_corners) block.nodes.push_back(node);
        }
        block.labels.push_back(label);
    }
    void give_groups_of_entities() {
        if (!is_version_4_) return;
        for (MshBlock& block : file_.blocks)
            if (const auto found = groups_of_entity_.find({block.type.dimension, block.entity});
                found != groups_of_entity_.end())
                block.groups = found->second;
    }

    MshValues values_;
    MshFile file_;
    bool is_version_4_ = false, has_nodes_ = false, has_elements_ = false;
    std::size_t n_bytes_ = 0;
    NodeNumbers<std::int64_t> number_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> groups_of_entity_;  ///< format 4.1
    std::map<std::array<std::int32_t, 3>, std::size_t> block_;  ///< by type, entity and group
    std::array<std::int32_t, 3> last_key_{};
    std::size_t last_block_ = 0;
    std::size_t n_stray_lines_ = 0, stray_line_ = 0;
    std::string stray_;  ///< the first
};

}  // namespace

std::string MshFile::name_of(const MshGroup& group) const {
    const auto found = group_names.find(group);
    return found == group_names.end() || found->second.empty() ? "physical_" + std::to_string(group.second) : found->second;
}

std::size_t MshFile::n_elements(std::int32_t dimension) const {
    std::size_t count = 0;
    for (const MshBlock& block : blocks)
        if (block.type.dimension == dimension) count += block.size();
    return count;
}

MshFile read_msh_file(const std::filesystem::path& path) {
    const std::string contents = file_contents(path), name = path.string();
    return MshReader(name, contents).read();
}

}  // namespace abut::mesh
