#include "abut/mesh/io/vtk_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <type_traits>
#include <utility>

#include "abut/mesh/io/binary_values.hpp"
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

std::string quoted_name(Node array) { return in_quotes(array.attribute("Name").value()); }

bool is_text(Node array) {
    const std::string_view format = array.attribute("format").value();
    return format != "appended" && format != "binary" && !array.attribute("offset");
}

std::string_view text_of(Node array) { return array.text().get(); }

}  // namespace

VtkFile::VtkFile(std::string name, std::string_view contents, VtkKind kind)
    : name_(std::move(name)), contents_(contents), kind_(kind) {
    check_is_whole();
    parse();
    read_header();
}

VtkFile::Node VtkFile::grid() const { return document_.child("VTKFile").child(type_name()); }

void VtkFile::refuse_at(std::ptrdiff_t at, const std::string& what) const {
    const std::string_view before = contents_.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(at, 0)));
    throw MeshError(name_ + ": line " + std::to_string(1 + std::ranges::count(before, '\n')) + ": " + what +
                    ". Write the mesh again.");
}

void VtkFile::refuse(Node node, const std::string& what) const { refuse_at(node.offset_debug(), what); }

void VtkFile::refuse_damage(Node node, const std::string& what) const { refuse(node, "the file is damaged: " + what); }

void VtkFile::refuse_kind() const {
    throw MeshError(name_ + ": is not a VTK " + (is_grid() ? "unstructured grid" : "poly data file") +
                    ": '<VTKFile type=\"" + type_name() + "\"' is missing in its first lines. Save it as " +
                    (is_grid() ? ".vtu" : ".vtp") + ".");
}

void VtkFile::check_is_whole() const {
    const std::string_view head = contents_.substr(0, 1024);
    if (head.find("<VTKFile") == std::string::npos || head.find(type_name()) == std::string::npos) refuse_kind();
    if (contents_.substr(contents_.size() - std::min<std::size_t>(contents_.size(), 64)).find("</VTKFile>") ==
        std::string::npos)
        throw MeshError(name_ + ": the file is truncated: '</VTKFile>' is missing after " +
                        std::to_string(contents_.size()) + " bytes. Write the mesh again.");
}

/// Appended data may be raw, which is no XML: the parser gets the file without them. It takes no memory per level of nesting
/// or entity, and some 20 bytes for each of the file at most.
void VtkFile::parse() {
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

void VtkFile::read_header() {
    const Node file = document_.child("VTKFile");
    if (file.attribute("type").value() != std::string_view(type_name())) refuse_kind();
    order_ = file.attribute("byte_order").value() == std::string_view("BigEndian") ? ByteOrder::big : ByteOrder::little;
    header_size_ = file.attribute("header_type").value() == std::string_view("UInt64") ? 8 : 4;
    compressor_ = file.attribute("compressor").value();
    if (compressor_ == zlib)
        ratio_ = static_cast<double>(largest_zlib_ratio);
    else if (!compressor_.empty())
        ratio_ = 8192.0;  // LZMA's; what is compressed so is refused when it is met
}

double VtkFile::count(Node node, const char* key, double without) const {
    const pugi::xml_attribute attribute = node.attribute(key);
    if (!attribute) return without;
    const std::string_view text = trimmed(attribute.value());
    const auto value = whole_number_in(text);
    if (!value || *value < 0)
        refuse(node, std::string(key) + " is " + in_quotes(text) + ", a whole number of at least 0 is needed");
    return static_cast<double>(*value);
}

std::vector<VtkFile::Node> VtkFile::first_step_of(Node section) const {
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

const NumberType& VtkFile::type_of(Node array) const {
    const std::string_view wanted = array.attribute("type").value();
    if (const NumberType* found = number_type(wanted)) return *found;
    refuse(array, "the array " + quoted_name(array) + " has the type " + in_quotes(wanted) + ", which is none of numbers");
}

std::size_t VtkFile::n_values(Node array, double n_tuples) const {
    const double n_components = count(array, "NumberOfComponents", 1.0), n = n_tuples * n_components;
    if (is_text(array) ? 2.0 * n - 1.0 > n_bytes() : n * type_of(array).n_bytes > n_bytes_at_most())
        refuse_damage(array, "the array " + quoted_name(array) + " of " + count_text(n_components) +
                                 " components promises " + count_text(n) + " values in a file of " + count_text(n_bytes()) +
                                 " bytes");
    return static_cast<std::size_t>(n);
}

template <class Value>
std::vector<Value> VtkFile::values(Node array, std::size_t n_tuples) {
    const std::size_t n = n_values(array, static_cast<double>(n_tuples));
    const NumberType& type = type_of(array);
    if (std::is_integral_v<Value> && (n != n_tuples || type.name.starts_with("Float")))
        refuse(array, "the array " + quoted_name(array) + " has " + std::to_string(n) + " values of the type " +
                          in_quotes(type.name) + ", " + std::to_string(n_tuples) + " whole numbers are needed");
    std::vector<Value> values;
    if (is_text(array)) {
        values = text_values<Value>(array, type, n);
    } else if (n > 0) {
        const std::string bytes = data_of(array, static_cast<std::size_t>(std::ceil(static_cast<double>(n) * type.n_bytes)));
        values = values_in<Value>(bytes, type.name, order_);
    }
    values.resize(n);
    return values;
}

/// All words must be values, the first n are needed.
template <class Value>
std::vector<Value> VtkFile::text_values(Node array, const NumberType& type, std::size_t n) const {
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

std::string VtkFile::Stored::first(std::size_t n) const {
    return is_raw ? std::string(text.substr(0, n)) : from_base64(text, n);
}

VtkFile::Stored VtkFile::Stored::behind(std::size_t n) const {
    return {text.substr(std::min(is_raw ? n : (n + 2) / 3 * 4, text.size())), is_raw};
}

VtkFile::Stored VtkFile::stored_of(Node array) const {
    if (!array.attribute("offset")) return {trimmed(text_of(array)), false};
    const double offset = count(array, "offset", 0.0);
    if (appended_ == std::string::npos || offset >= static_cast<double>(contents_.size() - appended_))
        refuse_damage(array, "the data of the array " + quoted_name(array) + " are not there");
    return {contents_.substr(appended_ + static_cast<std::size_t>(offset)), appended_is_raw_};
}

double VtkFile::header_number(std::string_view header, std::size_t i) const {
    return header_size_ == 8 ? static_cast<double>(binary_value<std::uint64_t>(header, 8 * i, order_))
                             : static_cast<double>(binary_value<std::uint32_t>(header, 4 * i, order_));
}

/// The first n bytes of an array; refused if it has fewer, or if its blocks promise more than the file can hold.
std::string VtkFile::data_of(Node array, std::size_t n) {
    n_decoded_ += static_cast<double>(n);
    if (n_decoded_ > n_bytes_at_most())
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

void VtkFile::check_held(Node array, double n_promised, double n_held, std::size_t n_needed) const {
    // Writers may name a block larger than what is in it.
    constexpr double largest_block = 1e8;
    if (n_promised > n_bytes_at_most() + (compressor_.empty() ? 0.0 : largest_block))
        refuse_damage(array, "the data of the array " + quoted_name(array) + " promise " + count_text(n_promised) +
                                 " bytes in a file of " + count_text(n_bytes()) + " bytes");
    if (n_held < static_cast<double>(n_needed))
        refuse_damage(array, "the data of the array " + quoted_name(array) + " hold " + count_text(n_held) + " bytes, " +
                                 std::to_string(n_needed) + " are needed");
}

void VtkFile::refuse_end(Node array) const {
    refuse_damage(array, "the blocks of the array " + quoted_name(array) + " end behind the " + count_text(n_bytes()) +
                             " bytes of the file");
}

/// Before the blocks stand their number, the bytes of a block and of the last one (0 if it is full), and the bytes of each
/// as it is stored.
std::string VtkFile::compressed_data(Node array, const Stored& stored, std::size_t n) const {
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

template std::vector<double> VtkFile::values(Node, std::size_t);
template std::vector<std::int64_t> VtkFile::values(Node, std::size_t);

}  // namespace abut::mesh
