#include "abut/mesh/io/vtk_promises.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "abut/mesh/io/binary_values.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

struct Tag {
    std::string_view name;
    std::map<std::string_view, std::string_view> attributes;
    std::size_t begin = 0, end = 0;  ///< of the file: '<', and behind '>'

    [[nodiscard]] std::string_view attribute(std::string_view key) const {
        const auto found = attributes.find(key);
        return found == attributes.end() ? std::string_view{} : found->second;
    }
};

constexpr const char* blanks = " \t\r\n";

/// Behind a comment, a declaration or the like that begins at `at`.
std::size_t behind_aside(std::string_view text, std::size_t at) {
    for (const auto& [begin, end] : {std::pair<std::string_view, std::string_view>{"<!--", "-->"}, {"<![CDATA[", "]]>"}})
        if (text.substr(at).starts_with(begin)) return std::min(text.find(end, at), text.size());
    return std::min(text.find('>', at), text.size());
}

/// The next tag that opens an element, from `at` on; its name is empty at the end.
Tag next_tag(std::string_view text, std::size_t at) {
    Tag tag;
    while (true) {
        tag.begin = text.find('<', at);
        if (tag.begin == std::string_view::npos || tag.begin + 1 == text.size()) return {};
        if (const char kind = text[tag.begin + 1]; kind != '!' && kind != '?' && kind != '/') break;
        at = behind_aside(text, tag.begin);
    }
    at = std::min(text.find_first_of(" \t\r\n/>", tag.begin), text.size());
    tag.name = text.substr(tag.begin + 1, at - tag.begin - 1);
    while (true) {
        at = text.find_first_not_of(blanks, at);
        if (at == std::string_view::npos) return {};
        if (text[at] == '>') break;
        if (text[at] == '/') {
            ++at;
            continue;
        }
        const std::size_t equals = text.find('=', at), quote = text.find_first_of("\"'", at);
        if (equals == std::string_view::npos || quote == std::string_view::npos || equals > quote) return {};
        std::string_view key = text.substr(at, equals - at);
        key = key.substr(0, key.find_first_of(blanks));
        const std::size_t end = text.find(text[quote], quote + 1);
        if (end == std::string_view::npos) return {};
        tag.attributes.emplace(key, text.substr(quote + 1, end - quote - 1));
        at = end + 1;
    }
    tag.end = at + 1;
    return tag;
}

/// How many bytes can come out of one. Deflate: 258 bytes for 2 bits. LZ4: 255 bytes for one. LZMA: 273 bytes for 14 bits of
/// the least cost, 0.022 each, is 7,090, rounded up here.
double compression_ratio(std::string_view compressor) {
    if (compressor.find("ZLib") != std::string_view::npos) return 1032.0;
    if (compressor.find("LZ4") != std::string_view::npos) return 255.0;
    return compressor.empty() ? 1.0 : 8192.0;
}

double n_bytes_of(std::string_view type) {
    if (type == "Bit") return 0.125;
    if (type.ends_with("64")) return 8.0;
    if (type.ends_with("32")) return 4.0;
    return type.ends_with("16") ? 2.0 : 1.0;
}

/// The first n bytes of what is written so; fewer where it ends.
std::string from_base64(std::string_view text, std::size_t n) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int n_bits = 0;
    for (const char letter : text) {
        const std::size_t digit = digits.find(letter);
        if (digit == std::string_view::npos || bytes.size() == n) break;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        n_bits += 6;
        if (n_bits < 8) continue;
        n_bits -= 8;
        bytes.push_back(static_cast<char>(bits >> n_bits & 0xFF));
    }
    return bytes;
}

/// [bytes] Writers may name a block larger than what is in it.
constexpr double largest_block = 1e8;

/// Whether VTK reads that word of a text as a value of its type: neither what is out of range nor "nan".
bool holds(std::string_view type, std::string_view word) {
    const auto value = number_in(word);
    if (!value || !std::isfinite(*value)) return false;
    if (type == "Float32") return std::abs(*value) <= static_cast<double>(std::numeric_limits<float>::max());
    if (type == "Float64") return true;
    const auto whole = whole_number_in(word);
    const double n_bits = 8.0 * n_bytes_of(type);
    const bool is_signed = !type.starts_with("UInt");
    return whole && *value >= (is_signed ? -std::exp2(n_bits - 1.0) : 0.0) &&
           (n_bits > 60.0 || *value < std::exp2(is_signed ? n_bits - 1.0 : n_bits));  // 64 bits: whole_number_in knows
}

constexpr std::array counts = {"NumberOfPoints", "NumberOfCells",  "NumberOfVerts",
                               "NumberOfLines",  "NumberOfStrips", "NumberOfPolys"};
enum CountOf : std::size_t { points, cells, verts, lines, strips, polys };

class Checker {
public:
    Checker(const std::string& name, std::string_view contents) : name_(name), contents_(contents) {}

    void check() {
        const std::size_t appended = contents_.find("<AppendedData");
        if (appended != std::string_view::npos) {
            const Tag tag = next_tag(contents_, appended);
            appended_is_raw_ = tag.attribute("encoding") == "raw";
            appended_ = contents_.find_first_not_of(blanks, tag.end);
            if (tag.name.empty() || appended_ == std::string_view::npos || contents_[appended_] != '_')
                refuse(tag, "the file is damaged: '_' does not follow <AppendedData>");
        }
        for (Tag tag = next_tag(contents_, 0); !tag.name.empty() && tag.name != "AppendedData";
             tag = next_tag(contents_, tag.end)) {
            if (tag.name == "VTKFile")
                read_file_tag(tag);
            else if (tag.name == "Piece")
                check_piece(tag);
            else if (tag.name == "DataArray" || tag.name == "Array")
                check_array(tag);
            else
                begin_section(tag);
        }
    }

private:
    [[nodiscard]] double n_bytes() const { return static_cast<double>(contents_.size()); }

    [[noreturn]] void refuse(const Tag& tag, const std::string& what) const {
        const auto line =
            1 + std::count(contents_.begin(), contents_.begin() + static_cast<std::ptrdiff_t>(tag.begin), '\n');
        throw MeshError(name_ + ": line " + std::to_string(line) + ": " + what + ". Write the mesh again.");
    }
    void read_file_tag(const Tag& tag) {
        ratio_ = compression_ratio(tag.attribute("compressor"));
        order_ = tag.attribute("byte_order") == "BigEndian" ? ByteOrder::big : ByteOrder::little;
        header_size_ = tag.attribute("header_type") == "UInt64" ? 8 : 4;
    }
    /// An attribute, or that value without it.
    double count(const Tag& tag, std::string_view key, double without) const {
        std::string_view text = tag.attribute(key);
        text = text.substr(std::min(text.find_first_not_of(blanks), text.size()));
        text = text.substr(0, text.find_last_not_of(blanks) + 1);
        if (tag.attributes.find(key) == tag.attributes.end()) return without;
        const auto value = whole_number_in(text);
        if (!value || *value < 0)
            refuse(tag, std::string(key) + " is " + in_quotes(text) + ", a whole number of at least 0 is needed");
        return static_cast<double>(*value);
    }
    /// All pieces together: each has points and cells of its own. No point and no cell takes less than a byte.
    void check_piece(const Tag& tag) {
        for (std::size_t i = 0; i < counts.size(); ++i) {
            n_of_[i] = count(tag, counts[i], 0.0);
            n_in_all_ += n_of_[i];
            if (n_in_all_ > ratio_ * n_bytes())
                refuse(tag, "the file is damaged: it promises " + count_text(n_of_[i]) + " as " + counts[i] + " in " +
                                count_text(n_bytes()) + " bytes");
        }
    }
    /// Of an array in the current section; of the vertices of cells at least one.
    [[nodiscard]] double n_tuples(const Tag& tag) const {
        if (!tag.attribute("NumberOfTuples").empty()) return count(tag, "NumberOfTuples", 0.0);
        if (section_ == "Points" || section_ == "PointData") return n_of_[points];
        const double n_cells = n_of_[cells] + n_of_[verts] + n_of_[lines] + n_of_[strips] + n_of_[polys];
        if (section_ == "CellData") return n_cells;
        if (tag.attribute("Name") == "connectivity") return tag.attribute("NumberOfComponents").empty() ? 0.0 : 1.0;
        for (const auto& [name, of] : {std::pair{"Verts", verts}, {"Lines", lines}, {"Strips", strips}, {"Polys", polys}})
            if (section_ == name) return n_of_[of];
        return section_ == "Cells" ? n_of_[cells] : 1.0;
    }
    /// Sections whose arrays have a value for each point or cell.
    static bool is_known(std::string_view section) {
        constexpr std::array<std::string_view, 8> known = {"Points", "PointData", "CellData", "Cells",
                                                           "Verts",  "Lines",     "Strips",   "Polys"};
        return std::find(known.begin(), known.end(), section) != known.end();
    }
    void begin_section(const Tag& tag) {
        section_ = tag.name;
        names_.clear();
    }
    void check_array(const Tag& tag) {
        const std::string_view array_name = tag.attribute("Name");
        if (!array_name.empty() && tag.attribute("TimeStep").empty() && !names_.insert(array_name).second)
            refuse(tag, "there are two arrays " + in_quotes(array_name) + " in one section, over which VTK crashes");
        const double n_components = count(tag, "NumberOfComponents", 1.0);
        const double n_values = n_tuples(tag) * n_components;
        const bool is_text =
            tag.attribute("format") != "appended" && tag.attribute("format") != "binary" && tag.attribute("offset").empty();
        const double least = is_text ? 2.0 * n_values - 1.0 : n_values * n_bytes_of(tag.attribute("type"));
        if (least > (is_text ? 1.0 : ratio_) * n_bytes())
            refuse(tag, "the file is damaged: the array " + in_quotes(tag.attribute("Name")) + " of " +
                            count_text(n_components) + " components promises " + count_text(n_values) +
                            " values in a file of " + count_text(n_bytes()) + " bytes");
        if (is_text)
            check_text(tag, is_known(section_) ? n_values : 0.0);
        else
            check_blocks(tag, is_known(section_) ? n_values * n_bytes_of(tag.attribute("type")) : 0.0);
    }
    /// What stands before the values: their number of bytes; of compressed ones the number of blocks, the bytes of a block
    /// and of the last one, and then those of each block as it is stored.
    void check_blocks(const Tag& tag, double n_needed) const {
        const bool is_appended = !tag.attribute("offset").empty();
        const auto offset = static_cast<std::size_t>(count(tag, "offset", 0.0));
        if (is_appended && (appended_ == std::string_view::npos || offset >= contents_.size() - appended_))
            refuse(tag, "the file is damaged: the data of the array " + in_quotes(tag.attribute("Name")) + " are not there");
        std::string_view stored = contents_.substr(is_appended ? appended_ + 1 + offset : tag.end);
        stored.remove_prefix(std::min(is_appended ? 0 : stored.find_first_not_of(blanks), stored.size()));
        const bool is_raw = is_appended && appended_is_raw_;
        const std::size_t n_numbers = ratio_ > 1.0 ? 3 : 1;
        const std::string header =
            is_raw ? std::string(stored.substr(0, n_numbers * header_size_)) : from_base64(stored, n_numbers * header_size_);
        if (header.size() < n_numbers * header_size_) return;  // VTK says so
        const auto number = [&](std::size_t i) { return stored_number(header, i); };
        const double n_promised = ratio_ > 1.0 ? std::max({number(1), number(2), number(0) * number(1)}) : number(0);
        // A block that is not full is no more than one that is.
        const double room = ratio_ * n_bytes() + (ratio_ > 1.0 ? largest_block : 0.0);
        const double n_stored = ratio_ > 1.0 ? number(0) * static_cast<double>(header_size_) : 0.0;
        if (n_promised > room || n_stored > n_bytes())
            refuse(tag, "the file is damaged: the data of the array " + in_quotes(tag.attribute("Name")) + " promise " +
                            count_text(n_promised) + " bytes in a file of " + count_text(n_bytes()) + " bytes");
        // VTK crashes where blocks hold less than the array needs. A last block that is full may be named 0 or in full.
        const double n_held =
            ratio_ > 1.0 ? (number(2) > 0.0 ? number(0) - 1.0 : number(0)) * number(1) + number(2) : number(0);
        if (n_held < n_needed || (ratio_ > 1.0 && number(2) > number(1)))
            refuse(tag, "the file is damaged: the data of the array " + in_quotes(tag.attribute("Name")) + " hold " +
                            count_text(n_held) + " bytes, " + count_text(n_needed) + " are needed");
        if (ratio_ > 1.0) check_stored_blocks(tag, stored, is_raw, static_cast<std::size_t>(number(0)));
    }
    /// VTK takes the sizes of the blocks as they stand there, too.
    void check_stored_blocks(const Tag& tag, std::string_view stored, bool is_raw, std::size_t n_blocks) const {
        const std::size_t n = (3 + n_blocks) * header_size_;
        const std::string header = is_raw ? std::string(stored.substr(0, n)) : from_base64(stored, n);
        double n_stored = header.size() < n ? std::numeric_limits<double>::infinity() : 0.0;
        for (std::size_t i = 3; i < 3 + n_blocks && header.size() == n; ++i) n_stored += stored_number(header, i);
        if (n_stored > n_bytes())
            refuse(tag, "the file is damaged: the blocks of the array " + in_quotes(tag.attribute("Name")) +
                            " end behind the " + count_text(n_bytes()) + " bytes of the file");
    }
    [[nodiscard]] double stored_number(std::string_view header, std::size_t i) const {
        return header_size_ == 8 ? static_cast<double>(binary_value<std::uint64_t>(header, 8 * i, order_))
                                 : static_cast<double>(binary_value<std::uint32_t>(header, 4 * i, order_));
    }
    /// All values must be there, and be numbers: VTK crashes over fewer. The last offset is the number of vertices of all
    /// cells, for which it makes room.
    void check_text(const Tag& tag, double n_values) const {
        const std::string_view rest = contents_.substr(tag.end);
        TextWords words(name_, rest.substr(0, rest.find('<')), {});
        const std::string array = "the array " + in_quotes(tag.attribute("Name"));
        double n_found = 0.0;
        for (auto word = words.next(); !word.empty(); word = words.next()) {
            ++n_found;
            if (!holds(tag.attribute("type"), word))
                refuse(tag, array + " holds " + in_quotes(word) + ", a number of the type " +
                                in_quotes(tag.attribute("type")) + " is needed");
            const auto offset = whole_number_in(word);
            if (tag.attribute("Name") == "offsets" && offset &&
                (*offset < 0 || static_cast<double>(*offset) > ratio_ * n_bytes()))
                refuse(tag, "the file is damaged: the offset " + std::to_string(*offset) +
                                " is none of vertices of cells in a file of " + count_text(n_bytes()) + " bytes");
        }
        if (n_found < n_values)
            refuse(tag, array + " has " + count_text(n_found) + " values, " + count_text(n_values) + " are needed");
    }

    const std::string& name_;
    std::string_view contents_, section_;
    std::set<std::string_view> names_;  ///< of the arrays of this section
    double ratio_ = 1.0, n_in_all_ = 0.0;
    ByteOrder order_ = ByteOrder::little;
    std::size_t header_size_ = 4;  ///< bytes of the numbers before the values
    bool appended_is_raw_ = false;
    std::size_t appended_ = std::string_view::npos;  ///< the '_' before the appended data
    std::array<double, counts.size()> n_of_{};       ///< of the piece
};

}  // namespace

void check_vtk_promises(const std::string& name, std::string_view contents) { Checker(name, contents).check(); }

}  // namespace abut::mesh
