#include "abut/mesh/io/vtk_input.hpp"

#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/mesh/io/binary_values.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/io/vtk_data.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

using Node = pugi::xml_node;

constexpr const char* blanks = " \t\r\n";
constexpr std::string_view zlib = "vtkZLibDataCompressor";

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// A kind of cells in a piece: the section that holds them, the attribute that counts them and, where the section does not
/// say it, their type.
struct CellKind {
    const char *section, *count;
    VtkCell type;
};
constexpr std::array<CellKind, 1> kinds_of_grid = {{{"Cells", "NumberOfCells", vtk_empty_cell}}};
constexpr std::array<CellKind, 4> kinds_of_poly_data = {{{"Verts", "NumberOfVerts", vtk_poly_vertex},
                                                         {"Lines", "NumberOfLines", vtk_poly_line},
                                                         {"Polys", "NumberOfPolys", vtk_polygon},
                                                         {"Strips", "NumberOfStrips", vtk_triangle_strip}}};

struct NumberType {
    std::string_view name;
    double n_bytes;
};
constexpr std::array<NumberType, 11> number_types = {{{"Int8", 1},
                                                      {"UInt8", 1},
                                                      {"Int16", 2},
                                                      {"UInt16", 2},
                                                      {"Int32", 4},
                                                      {"UInt32", 4},
                                                      {"Int64", 8},
                                                      {"UInt64", 8},
                                                      {"Float32", 4},
                                                      {"Float64", 8},
                                                      {"Bit", 0.125}}};

template <class Stored, class Value>
void append_all(std::vector<Value>& values, std::string_view bytes, ByteOrder order) {
    values.reserve(bytes.size() / sizeof(Stored));
    for (std::size_t at = 0; at + sizeof(Stored) <= bytes.size(); at += sizeof(Stored))
        values.push_back(static_cast<Value>(binary_value<Stored>(bytes, at, order)));
}

/// The values that are stored so. Whole numbers are not asked of types with fractions.
template <class Value>
std::vector<Value> values_in(std::string_view bytes, std::string_view type, ByteOrder order) {
    std::vector<Value> values;
    if (type == "Int8") append_all<std::int8_t>(values, bytes, order);
    if (type == "UInt8") append_all<std::uint8_t>(values, bytes, order);
    if (type == "Int16") append_all<std::int16_t>(values, bytes, order);
    if (type == "UInt16") append_all<std::uint16_t>(values, bytes, order);
    if (type == "Int32") append_all<std::int32_t>(values, bytes, order);
    if (type == "UInt32") append_all<std::uint32_t>(values, bytes, order);
    if (type == "Int64") append_all<std::int64_t>(values, bytes, order);
    if (type == "UInt64") append_all<std::uint64_t>(values, bytes, order);
    if constexpr (std::is_floating_point_v<Value>) {
        if (type == "Float32") append_all<float>(values, bytes, order);
        if (type == "Float64") append_all<double>(values, bytes, order);
    }
    if (type == "Bit")
        for (const char byte : bytes)
            for (int bit = 7; bit >= 0; --bit) values.push_back(static_cast<Value>(byte >> bit & 1));
    return values;
}

/// A word of a text as a value of a type; nothing for any other word.
template <class Value>
std::optional<Value> value_in(std::string_view word, const NumberType& type) {
    if constexpr (std::is_floating_point_v<Value>)
        if (type.name.starts_with("Float")) {
            const auto value = number_in(word);
            if (!value || type.name == "Float64") return value;
            if (std::isfinite(*value) && std::abs(*value) > static_cast<double>(std::numeric_limits<float>::max()))
                return {};
            return static_cast<float>(*value);
        }
    const auto value = whole_number_in(word);
    const double n_bits = 8.0 * type.n_bytes;
    const bool is_signed = type.name.starts_with("Int");
    if (!value || (!is_signed && *value < 0)) return {};
    if (n_bits < 64.0 && (static_cast<double>(*value) < -std::exp2(n_bits - 1.0) ||
                          static_cast<double>(*value) >= std::exp2(is_signed ? n_bits - 1.0 : n_bits)))
        return {};
    return static_cast<Value>(*value);
}

/// Tuples [begin, end) of arrays behind those of others of the same names, or as the first ones.
void append_tuples(std::vector<VtkArray>& arrays, const std::vector<VtkArray>& more, std::size_t begin, std::size_t end) {
    if (arrays.empty())
        for (const VtkArray& array : more) arrays.push_back({array.name, array.n_components, {}});
    for (std::size_t i = 0; i < more.size(); ++i) {
        const auto at = [&](std::size_t tuple) {
            return more[i].values.begin() + static_cast<std::ptrdiff_t>(tuple * more[i].n_components);
        };
        arrays[i].values.insert(arrays[i].values.end(), at(begin), at(end));
    }
}

bool are_alike(const std::vector<VtkArray>& a, const std::vector<VtkArray>& b) {
    return std::ranges::equal(a, b, [](const VtkArray& one, const VtkArray& other) {
        return one.name == other.name && one.n_components == other.n_components;
    });
}

class Reader {
public:
    Reader(std::string name, std::string_view contents, VtkKind kind)
        : name_(std::move(name)), contents_(contents), is_grid_(kind == VtkKind::unstructured_grid) {}

    VtkGrid read() {
        const std::string type = is_grid_ ? "UnstructuredGrid" : "PolyData";
        check_is_whole(type);
        parse();
        const Node file = document_.child("VTKFile");
        if (file.attribute("type").value() != type) refuse_kind(type);
        order_ = file.attribute("byte_order").value() == std::string_view("BigEndian") ? ByteOrder::big : ByteOrder::little;
        header_size_ = file.attribute("header_type").value() == std::string_view("UInt64") ? 8 : 4;
        compressor_ = file.attribute("compressor").value();
        if (compressor_ == zlib)
            ratio_ = static_cast<double>(largest_zlib_ratio);
        else if (!compressor_.empty())
            ratio_ = 8192.0;  // LZMA's; what is compressed so is refused when it is met
        const Node grid = file.child(type.c_str());
        for (const Node field : grid.children("FieldData"))
            for (const Node array : field.children("DataArray"))
                static_cast<void>(n_values(array, count(array, "NumberOfTuples", 0.0)));
        const auto pieces = grid.children("Piece");
        has_one_piece_ = std::distance(pieces.begin(), pieces.end()) == 1;
        for (const Node piece : pieces) read_piece(piece);
        join_cells();
        return std::move(grid_);
    }

private:
    [[nodiscard]] double n_bytes() const { return static_cast<double>(contents_.size()); }

    [[noreturn]] void refuse_at(std::ptrdiff_t at, const std::string& what) const {
        const std::string_view before = contents_.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(at, 0)));
        throw MeshError(name_ + ": line " + std::to_string(1 + std::ranges::count(before, '\n')) + ": " + what +
                        ". Write the mesh again.");
    }
    [[noreturn]] void refuse(Node node, const std::string& what) const { refuse_at(node.offset_debug(), what); }
    [[noreturn]] void refuse_damage(Node node, const std::string& what) const {
        refuse(node, "the file is damaged: " + what);
    }
    [[noreturn]] void refuse_kind(const std::string& type) const {
        throw MeshError(name_ + ": is not a VTK " + (is_grid_ ? "unstructured grid" : "poly data file") +
                        ": '<VTKFile type=\"" + type + "\"' is missing in its first lines. Save it as " +
                        (is_grid_ ? ".vtu" : ".vtp") + ".");
    }
    static std::string quoted_name(Node array) { return in_quotes(array.attribute("Name").value()); }

    void check_is_whole(const std::string& type) const {
        const std::string_view head = contents_.substr(0, 1024);
        if (head.find("<VTKFile") == std::string::npos || head.find(type) == std::string::npos) refuse_kind(type);
        if (contents_.substr(contents_.size() - std::min<std::size_t>(contents_.size(), 64)).find("</VTKFile>") ==
            std::string::npos)
            throw MeshError(name_ + ": the file is truncated: '</VTKFile>' is missing after " +
                            std::to_string(contents_.size()) + " bytes. Write the mesh again.");
    }
    /// Appended data may be raw, which is no XML: the parser gets the file without them. It takes no memory per level of nesting
    /// or entity, and some 20 bytes for each of the file at most.
    void parse() {
        std::string_view text = contents_;
        std::string head;
        if (const auto section = contents_.find("<AppendedData"); section != std::string::npos) {
            const auto end = std::min(contents_.find('>', section), contents_.size() - 1);
            appended_ = contents_.find_first_not_of(blanks, end + 1);
            if (appended_ == std::string::npos || contents_[appended_] != '_')
                refuse_at(static_cast<std::ptrdiff_t>(section), "the file is damaged: '_' does not follow <AppendedData>");
            ++appended_;
            text = head = std::string(contents_.substr(0, end + 1)) + "</AppendedData></VTKFile>";
        }
        const auto result = document_.load_buffer(text.data(), text.size(), pugi::parse_escapes, pugi::encoding_utf8);
        if (!result) refuse_at(result.offset, std::string("the file is damaged: ") + result.description());
        const Node appended = document_.child("VTKFile").child("AppendedData");
        appended_is_raw_ = appended.attribute("encoding").value() == std::string_view("raw");
    }

    /// An attribute, or that value without it.
    [[nodiscard]] double count(Node node, const char* key, double without) const {
        const pugi::xml_attribute attribute = node.attribute(key);
        if (!attribute) return without;
        const std::string_view text = trimmed(attribute.value());
        const auto value = whole_number_in(text);
        if (!value || *value < 0)
            refuse(node, std::string(key) + " is " + in_quotes(text) + ", a whole number of at least 0 is needed");
        return static_cast<double>(*value);
    }
    /// All pieces together: each has points and cells of its own. No point and no cell takes less than a byte.
    std::size_t count_of_piece(Node piece, const char* key) {
        const double n = count(piece, key, 0.0);
        n_in_all_ += n;
        if (n_in_all_ > ratio_ * n_bytes())
            refuse_damage(piece, "it promises " + count_text(n) + " as " + key + " in " + count_text(n_bytes()) + " bytes");
        return static_cast<std::size_t>(n);
    }

    void read_piece(Node piece) {
        const std::span<const CellKind> kinds =
            is_grid_ ? std::span<const CellKind>(kinds_of_grid) : std::span<const CellKind>(kinds_of_poly_data);
        const std::size_t n_points = count_of_piece(piece, "NumberOfPoints");
        std::array<std::size_t, 4> n{};
        for (std::size_t i = 0; i < kinds.size(); ++i) n[i] = count_of_piece(piece, kinds[i].count);
        const std::size_t n_cells = n[0] + n[1] + n[2] + n[3];
        if (!has_one_piece_ && n_points + n_cells == 0) return;  // may have other arrays than the rest

        const auto point_data = arrays_of(piece.child("PointData"), n_points);
        const auto cell_data = arrays_of(piece.child("CellData"), n_cells);
        if (!is_first_ && !(are_alike(point_data, grid_.point_data) && are_alike(cell_data, grid_.cell_data)))
            refuse(piece, "the arrays of this piece are not those of the first one");
        is_first_ = false;
        append_tuples(grid_.point_data, point_data, 0, n_points);
        append_tuples(grid_.cell_data, cell_data, 0, 0);
        const std::size_t first_point = grid_.points.size();
        if (n_points > 0) read_points(piece, n_points);
        std::size_t begin = 0;
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            append_tuples(cells_[i].cell_data, cell_data, begin, begin + n[i]);
            if (n[i] > 0) read_cells(piece, kinds[i], n[i], first_point, cells_[i]);
            begin += n[i];
        }
    }
    void read_points(Node piece, std::size_t n_points) {
        const auto arrays = first_step_of(piece.child("Points"));
        if (arrays.empty()) refuse(piece, "<Points> holds no array");
        const auto x = values<double>(arrays[0], n_points);
        if (x.size() != 3 * n_points)
            refuse(arrays[0], std::to_string(n_points) + " points have " + std::to_string(x.size()) +
                                  " coordinates, 3 of each are needed");
        for (std::size_t i = 0; i < n_points; ++i) grid_.points.emplace_back(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
        if (grid_.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
            throw MeshError(name_ + ": has " + std::to_string(grid_.points.size()) +
                            " points, at most 2147483647 are allowed. Coarsen the mesh.");
    }
    void read_cells(Node piece, const CellKind& kind, std::size_t n, std::size_t first_point, VtkGrid& cells) {
        const auto arrays = first_step_of(piece.child(kind.section));
        const auto array = [&](std::string_view wanted) {
            const auto found =
                std::ranges::find_if(arrays, [&](Node node) { return node.attribute("Name").value() == wanted; });
            if (found == arrays.end())
                refuse(piece, std::string("<") + kind.section + "> holds no array '" + std::string(wanted) + "'");
            return *found;
        };
        const Node offsets = array("offsets"), connectivity = array("connectivity");
        const auto ends = values<std::int64_t>(offsets, n);
        const auto types =
            kind.type == vtk_empty_cell ? values<std::int64_t>(array("types"), n) : std::vector<std::int64_t>(n, kind.type);
        for (std::size_t i = 0; i < n; ++i)
            if (ends[i] < (i == 0 ? 0 : ends[i - 1]) || static_cast<double>(ends[i]) > ratio_ * n_bytes())
                refuse_damage(offsets, "the offset " + std::to_string(ends[i]) +
                                           " is none of vertices of cells in a file of " + count_text(n_bytes()) + " bytes");
        const auto corners = values<std::int64_t>(connectivity, static_cast<std::size_t>(ends.back()));
        const std::int64_t before = std::ssize(cells.corners);
        for (const std::int64_t end : ends) cells.cell_ends.push_back(before + end);
        for (const std::int64_t corner : corners) {
            const bool is_there = corner >= 0 && corner < std::ssize(grid_.points) - static_cast<std::int64_t>(first_point);
            if (!is_there && !has_one_piece_)
                refuse(connectivity, "a cell has the point " + std::to_string(corner) + ", the piece has " +
                                         std::to_string(grid_.points.size() - first_point));
            cells.corners.push_back(is_there ? corner + static_cast<std::int64_t>(first_point) : corner);
        }
        cells.cell_types.insert(cells.cell_types.end(), types.begin(), types.end());
    }
    /// Kind by kind.
    void join_cells() {
        for (VtkGrid& cells : cells_) {
            if (cells.n_cells() == 0) continue;
            if (grid_.n_cells() == 0) {
                std::swap(grid_.cell_types, cells.cell_types);
                std::swap(grid_.cell_ends, cells.cell_ends);
                std::swap(grid_.corners, cells.corners);
                std::swap(grid_.cell_data, cells.cell_data);
                continue;
            }
            const std::int64_t before = std::ssize(grid_.corners);
            for (const std::int64_t end : cells.cell_ends) grid_.cell_ends.push_back(before + end);
            grid_.corners.insert(grid_.corners.end(), cells.corners.begin(), cells.corners.end());
            grid_.cell_types.insert(grid_.cell_types.end(), cells.cell_types.begin(), cells.cell_types.end());
            append_tuples(grid_.cell_data, cells.cell_data, 0, cells.n_cells());
        }
    }

    /// The arrays of numbers of a section; of several time steps those of the first.
    [[nodiscard]] std::vector<Node> first_step_of(Node section) const {
        std::vector<Node> arrays;
        std::set<std::string_view> names;
        for (const Node array : section.children("DataArray")) {
            const std::string_view steps = array.attribute("TimeStep").value(), name = array.attribute("Name").value();
            if (!steps.empty() && steps != "0" && !steps.starts_with("0 ")) continue;
            if (!name.empty() && !names.insert(name).second)
                refuse(array, "there are two arrays " + in_quotes(name) + " in one section");
            arrays.push_back(array);
        }
        return arrays;
    }
    std::vector<VtkArray> arrays_of(Node section, std::size_t n_tuples) {
        std::vector<VtkArray> arrays;
        for (const Node node : first_step_of(section))
            arrays.push_back({node.attribute("Name").value(),
                              static_cast<std::size_t>(count(node, "NumberOfComponents", 1.0)),
                              values<double>(node, n_tuples)});
        return arrays;
    }

    [[nodiscard]] const NumberType& type_of(Node array) const {
        const std::string_view wanted = array.attribute("type").value();
        const auto found = std::ranges::find(number_types, wanted, &NumberType::name);
        if (found == number_types.end())
            refuse(array,
                   "the array " + quoted_name(array) + " has the type " + in_quotes(wanted) + ", which is none of numbers");
        return *found;
    }
    static bool is_text(Node array) {
        const std::string_view format = array.attribute("format").value();
        return format != "appended" && format != "binary" && !array.attribute("offset");
    }
    /// So many tuples of an array; refused if the file is too small for them.
    [[nodiscard]] std::size_t n_values(Node array, double n_tuples) const {
        const double n_components = count(array, "NumberOfComponents", 1.0), n = n_tuples * n_components;
        if (is_text(array) ? 2.0 * n - 1.0 > n_bytes() : n * type_of(array).n_bytes > ratio_ * n_bytes())
            refuse_damage(array, "the array " + quoted_name(array) + " of " + count_text(n_components) +
                                     " components promises " + count_text(n) + " values in a file of " +
                                     count_text(n_bytes()) + " bytes");
        return static_cast<std::size_t>(n);
    }
    template <class Value>
    std::vector<Value> values(Node array, std::size_t n_tuples) {
        const std::size_t n = n_values(array, static_cast<double>(n_tuples));
        const NumberType& type = type_of(array);
        if (std::is_integral_v<Value> && (n != n_tuples || type.name.starts_with("Float")))
            refuse(array, "the array " + quoted_name(array) + " has " + std::to_string(n) + " values of the type " +
                              in_quotes(type.name) + ", " + std::to_string(n_tuples) + " whole numbers are needed");
        std::vector<Value> values;
        if (is_text(array)) {
            values = text_values<Value>(array, type, n);
        } else if (n > 0) {
            const std::string bytes =
                data_of(array, static_cast<std::size_t>(std::ceil(static_cast<double>(n) * type.n_bytes)));
            values = values_in<Value>(bytes, type.name, order_);
        }
        values.resize(n);
        return values;
    }
    static std::string_view text_of(Node array) { return array.text().get(); }

    /// All words must be values, the first n are needed.
    template <class Value>
    std::vector<Value> text_values(Node array, const NumberType& type, std::size_t n) const {
        std::vector<Value> values;
        TextWords words(name_, text_of(array), {});
        for (auto word = words.next(); !word.empty(); word = words.next()) {
            const auto value = value_in<Value>(word, type);
            if (!value)
                refuse(array, "the array " + quoted_name(array) + " holds " + in_quotes(word) + ", a number of the type " +
                                  in_quotes(type.name) + " is needed");
            values.push_back(*value);
        }
        if (values.size() < n)
            refuse(array, "the array " + quoted_name(array) + " has " + std::to_string(values.size()) + " values, " +
                              std::to_string(n) + " are needed");
        return values;
    }

    /// What is stored of an array from some byte on.
    struct Stored {
        std::string_view text;
        bool is_raw;

        [[nodiscard]] std::string first(std::size_t n) const {
            return is_raw ? std::string(text.substr(0, n)) : from_base64(text, n);
        }
        /// What is stored behind n bytes that are encoded by themselves.
        [[nodiscard]] Stored behind(std::size_t n) const {
            return {text.substr(std::min(is_raw ? n : (n + 2) / 3 * 4, text.size())), is_raw};
        }
    };
    [[nodiscard]] Stored stored_of(Node array) const {
        if (!array.attribute("offset")) return {trimmed(text_of(array)), false};
        const double offset = count(array, "offset", 0.0);
        if (appended_ == std::string::npos || offset >= static_cast<double>(contents_.size() - appended_))
            refuse_damage(array, "the data of the array " + quoted_name(array) + " are not there");
        return {contents_.substr(appended_ + static_cast<std::size_t>(offset)), appended_is_raw_};
    }
    [[nodiscard]] double header_number(std::string_view header, std::size_t i) const {
        return header_size_ == 8 ? static_cast<double>(binary_value<std::uint64_t>(header, 8 * i, order_))
                                 : static_cast<double>(binary_value<std::uint32_t>(header, 4 * i, order_));
    }

    /// The first n bytes of an array; refused if it has fewer, or if its blocks promise more than the file can hold.
    std::string data_of(Node array, std::size_t n) {
        n_decoded_ += static_cast<double>(n);
        if (n_decoded_ > ratio_ * n_bytes())
            refuse_damage(array, "its arrays, up to " + quoted_name(array) + ", need " + count_text(n_decoded_) +
                                     " bytes of a file of " + count_text(n_bytes()) + " bytes");
        const Stored stored = stored_of(array);
        if (!compressor_.empty()) return compressed_data(array, stored, n);
        std::string bytes = stored.first(header_size_);
        const double n_held = bytes.size() < header_size_ ? 0.0 : header_number(bytes, 0);
        check_held(array, n_held, n_held, n);
        bytes = stored.first(header_size_ + n);
        if (bytes.size() < header_size_ + n) refuse_end(array);
        return bytes.erase(0, header_size_);
    }
    void check_held(Node array, double n_promised, double n_held, std::size_t n_needed) const {
        // Writers may name a block larger than what is in it.
        constexpr double largest_block = 1e8;
        if (n_promised > ratio_ * n_bytes() + (compressor_.empty() ? 0.0 : largest_block))
            refuse_damage(array, "the data of the array " + quoted_name(array) + " promise " + count_text(n_promised) +
                                     " bytes in a file of " + count_text(n_bytes()) + " bytes");
        if (n_held < static_cast<double>(n_needed))
            refuse_damage(array, "the data of the array " + quoted_name(array) + " hold " + count_text(n_held) + " bytes, " +
                                     std::to_string(n_needed) + " are needed");
    }
    [[noreturn]] void refuse_end(Node array) const {
        refuse_damage(array, "the blocks of the array " + quoted_name(array) + " end behind the " + count_text(n_bytes()) +
                                 " bytes of the file");
    }
    /// Before the blocks stand their number, the bytes of a block and of the last one (0 if it is full), and the bytes of each
    /// as it is stored.
    std::string compressed_data(Node array, const Stored& stored, std::size_t n) {
        if (compressor_ != zlib)
            throw MeshError(name_ + ": its data are compressed by " + in_quotes(compressor_) +
                            ", of which no reader is here. Convert it: open it in ParaView and save it with the compressor "
                            "ZLib, or without one.");
        std::string header = stored.first(3 * header_size_);
        if (header.size() < 3 * header_size_) refuse_end(array);
        const double n_blocks = header_number(header, 0), size = header_number(header, 1), last = header_number(header, 2);
        check_held(array, std::max({size, last, n_blocks * size}),
                   last > size ? 0.0 : (last > 0.0 ? n_blocks - 1.0 : n_blocks) * size + last, n);
        if (n_blocks * static_cast<double>(header_size_) > n_bytes()) refuse_end(array);

        const std::size_t header_bytes = (3 + static_cast<std::size_t>(n_blocks)) * header_size_;
        header = stored.first(header_bytes);
        double n_stored = header.size() < header_bytes ? std::numeric_limits<double>::infinity() : 0.0;
        for (std::size_t i = 3; (i + 1) * header_size_ <= header.size(); ++i) n_stored += header_number(header, i);
        if (n_stored > n_bytes()) refuse_end(array);
        const std::string blocks = stored.behind(header_bytes).first(static_cast<std::size_t>(n_stored));
        if (static_cast<double>(blocks.size()) < n_stored) refuse_end(array);

        std::string bytes;
        for (std::size_t i = 0, at = 0; bytes.size() < n; ++i) {
            const bool is_last_part = static_cast<double>(i + 1) == n_blocks && last > 0.0;
            const auto block_size = static_cast<std::size_t>(header_number(header, 3 + i));
            if (!append_inflated(bytes, std::string_view(blocks).substr(at, block_size),
                                 static_cast<std::size_t>(is_last_part ? last : size)))
                refuse_damage(array, "block " + std::to_string(i) + " of the array " + quoted_name(array) +
                                         " is not what zlib makes of its bytes");
            at += block_size;
        }
        bytes.resize(n);
        return bytes;
    }

    std::string name_;
    std::string_view contents_, compressor_;
    bool is_grid_, is_first_ = true, has_one_piece_ = true;
    pugi::xml_document document_;
    double ratio_ = 1.0, n_in_all_ = 0.0, n_decoded_ = 0.0;
    ByteOrder order_ = ByteOrder::little;
    std::size_t header_size_ = 4;  ///< bytes of the numbers before the values
    bool appended_is_raw_ = false;
    std::size_t appended_ = std::string::npos;  ///< behind the '_' before the appended data
    VtkGrid grid_;                              ///< without cells, but with the names of their arrays, until the end
    std::array<VtkGrid, 4> cells_;              ///< by their kind
};

}  // namespace

std::span<const std::int64_t> VtkGrid::corners_of(std::size_t cell) const {
    const std::int64_t begin = cell == 0 ? 0 : cell_ends[cell - 1];
    return {corners.data() + begin, static_cast<std::size_t>(cell_ends[cell] - begin)};
}

VtkGrid read_vtk_grid(const std::filesystem::path& path, VtkKind kind) {
    const std::string contents = file_contents(path);
    try {
        return Reader(path.string(), contents, kind).read();
    } catch (const std::bad_alloc&) {
        throw MeshError(path.string() +
                        ": the memory of this machine is too small for what the file holds. See that the file is whole, or "
                        "coarsen the mesh.");
    }
}

std::vector<std::int64_t> body_values(const std::string& name, const VtkGrid& grid) {
    const auto array = std::ranges::find(grid.cell_data, "body", &VtkArray::name);
    std::vector<std::int64_t> values;
    for (std::size_t cell = 0; array != grid.cell_data.end() && cell < grid.n_cells(); ++cell) {
        const double value = array->n_components == 0 ? 0.0 : array->values[cell * array->n_components];
        if (value != std::floor(value) || !(std::abs(value) <= 1e9))
            throw MeshError(name + ": cell " + std::to_string(cell) + " has the body " + number(value) +
                            ", a whole number between -1e9 and 1e9 is needed. Correct the cell array 'body'.");
        values.push_back(static_cast<std::int64_t>(value));
    }
    return values;
}

std::vector<std::string> names_of_bodies(std::vector<std::int64_t>& values) {
    std::vector<std::int64_t> distinct = values;
    sort_unique(distinct);
    for (std::int64_t& value : values) value = std::lower_bound(distinct.begin(), distinct.end(), value) - distinct.begin();
    std::vector<std::string> names;
    for (const std::int64_t value : distinct) names.push_back(std::string("body_") + std::to_string(value));
    return names;
}

}  // namespace abut::mesh
