#include "abut/mesh/io/vtk_output.hpp"

#include <bit>
#include <string_view>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/mesh/io/vtk_data.hpp"

namespace abut::mesh {
namespace {

template <class Value>
OutputArray array_of(const char* type, const std::string& name, std::span<const Value> values,
                     std::size_t n_components = 1) {
    return {array_attributes(type, name, n_components),
            zlib_blocks({reinterpret_cast<const char*>(values.data()), values.size_bytes()})};
}

std::string field_tag(const char* type, const std::string& name, const std::string& value) {
    return "<DataArray type=\"" + std::string(type) + "\" Name=\"" + in_xml(name) +
           "\" NumberOfTuples=\"1\" format=\"ascii\">" + value + "</DataArray>\n";
}

/// Puts tags one behind the other, and their data in reverse: meshio 5 rewrites offsets as it goes through the data and
/// looks each array up by its offset, which then is that of no array before it.
class Document {
public:
    Document(const OutputGrid& grid, const std::string& field_data) : text_(vtk_head(grid.type)) {
        if (!field_data.empty()) text_ += "<FieldData>\n" + field_data + "</FieldData>\n";
        text_ += "<Piece NumberOfPoints=\"" + std::to_string(grid.n_points) + "\"";
        for (const char* section : {"Cells", "Verts", "Lines", "Strips", "Polys"})
            if ((grid.type == "PolyData") != (section == std::string_view("Cells")))
                text_ += std::string(" NumberOf") + section + "=\"" +
                         std::to_string(section == grid.cell_section ? grid.n_cells : 0) + "\"";
        text_ += ">\n";
    }
    void add_section(const std::string& name, std::span<const OutputArray> arrays, std::span<const OutputArray> more = {}) {
        text_ += "<" + name + ">\n";
        for (const auto part : {arrays, more})
            for (const OutputArray& array : part) {
                heads_.push_back(std::exchange(text_, "\"/>\n") + "<DataArray " + array.attributes +
                                 " format=\"appended\" offset=\"");
                blocks_.emplace_back(array.blocks);
            }
        text_ += "</" + name + ">\n";
    }
    PreparedFile prepared(const std::filesystem::path& path, const std::string& type) {
        text_ += "</Piece>\n</" + type + ">\n<AppendedData encoding=\"raw\">\n_";
        std::size_t offset = 0;
        for (const std::string_view blocks : blocks_) offset += blocks.size();
        std::string whole;
        for (std::size_t i = 0; i < heads_.size(); ++i) whole += heads_[i] + std::to_string(offset -= blocks_[i].size());
        whole += text_;
        std::vector<std::string_view> data{whole};
        data.insert(data.end(), blocks_.rbegin(), blocks_.rend());
        data.emplace_back("\n</AppendedData>\n</VTKFile>\n");
        return prepared_file(path, data);
    }

private:
    std::string text_;                ///< behind the last array
    std::vector<std::string> heads_;  ///< up to the offset of each array
    std::vector<std::string_view> blocks_;
};

}  // namespace

std::string in_xml(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

std::string array_attributes(const char* type, const std::string& name, std::size_t n_components) {
    constexpr std::array<const char*, 6> names = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    std::string line = "type=\"" + std::string(type) + "\" Name=\"" + in_xml(name) + "\" NumberOfComponents=\"" +
                       std::to_string(n_components) + "\"";
    for (std::size_t i = 0; n_components == 6 && i < names.size(); ++i)
        line += " ComponentName" + std::to_string(i) + "=\"" + names[i] + "\"";
    return line;
}

std::string vtk_head(const std::string& type) {
    constexpr bool is_little = std::endian::native == std::endian::little;
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"0.1\" byte_order=\"" +
           (is_little ? "LittleEndian" : "BigEndian") +
           "\" header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n<" + type + ">\n";
}

OutputArray output_array(const std::string& name, std::span<const std::uint8_t> values) {
    return array_of("UInt8", name, values);
}
OutputArray output_array(const std::string& name, std::span<const std::int32_t> values) {
    return array_of("Int32", name, values);
}
OutputArray output_array(const std::string& name, std::span<const std::int64_t> values) {
    return array_of("Int64", name, values);
}
OutputArray output_array(const std::string& name, std::span<const double> values, std::size_t n_components) {
    return array_of("Float64", name, values, n_components);
}

void check_size(const std::string& field, std::size_t n, std::size_t wanted, const char* of_what, const char* writer) {
    if (n != wanted)
        throw BadInput(std::string(writer) + ": field '" + field + "' has " + std::to_string(n) +
                       " values, one for each of the " + std::to_string(wanted) + " " + of_what + " is needed.");
}

std::string field_number(const std::string& name, double value) { return field_tag("Float64", name, exact_number(value)); }
std::string field_number(const std::string& name, std::int32_t value) {
    return field_tag("Int32", name, std::to_string(value));
}
std::string field_time(double time) { return field_number("TimeValue", time); }

PreparedFile prepared_grid(const OutputGrid& grid, const std::filesystem::path& path, const std::string& more_field_data,
                           std::span<const OutputArray> more_point_data, std::span<const OutputArray> more_cell_data) {
    Document document(grid, grid.field_data + more_field_data);
    document.add_section("PointData", grid.point_data, more_point_data);
    document.add_section("CellData", grid.cell_data, more_cell_data);
    document.add_section("Points", grid.points);
    document.add_section(grid.cell_section, grid.cells);
    return document.prepared(path, grid.type);
}

}  // namespace abut::mesh
