#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "abut/mesh/io/binary_values.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/ply_header.hpp"
#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

bool is_float(PlyType type) { return type == PlyType::float32 || type == PlyType::float64; }

/// The values behind the header, as text or binary, each as the number of its type. `where` begins every complaint.
class PlyValues {
public:
    PlyValues(const std::string& name, std::string_view contents, const PlyHeader& header)
        : name_(name),
          bytes_(contents),
          at_(header.n_bytes),
          is_text_(header.format == PlyHeader::Format::ascii),
          order_(header.format == PlyHeader::Format::binary_big ? ByteOrder::big : ByteOrder::little),
          words_(name, contents.substr(header.n_bytes), {}, header.n_lines + 1) {}

    double next(PlyType type) { return is_text_ ? next_in_text(type) : next_in_bytes(type); }
    /// The length of a list, all of whose values fit into the rest of the file.
    std::int64_t next_length(PlyType length_type, PlyType type) {
        const double length = next(length_type);
        const std::size_t n_left = bytes_.size() - at_;
        const std::size_t size = is_text_ ? 1 : n_bytes_of(type);
        if (length < 0.0 || length > static_cast<double>(n_left / size))
            refuse("a list of " + count_text(length) + " values does not fit into the " + std::to_string(n_left) +
                   (is_text_ ? " bytes behind the header" : " bytes that are left"));
        return static_cast<std::int64_t>(length);
    }
    void begin_item(const std::string& element, std::int64_t item) {
        element_ = &element;
        item_ = item;
    }
    [[noreturn]] void refuse(const std::string& what) const {
        const std::string item = *element_ + " " + std::to_string(item_) + ": " + what;
        if (is_text_) words_.refuse(item);
        throw MeshError(name_ + ": byte " + std::to_string(at_) + ": " + item + ". Write the mesh again.");
    }
    /// Values that no element of the header owns: of a text an error, as some line then has too many of them.
    void finish(std::vector<std::string>& warnings) {
        if (is_text_ && !words_.next().empty())
            words_.refuse("the file goes on behind the last item that the header promises, some line has too many values");
        if (!is_text_ && at_ < bytes_.size())
            warnings.push_back(std::to_string(bytes_.size() - at_) + " bytes behind the last element are not read");
    }

private:
    double next_in_text(PlyType type) {
        const std::string_view word = words_.next();
        if (word.empty()) refuse("the file is truncated: it ends here");
        const auto value = number_in(word);
        if (!value || (!is_float(type) && !whole_number_in(word)))
            refuse(in_quotes(word) + (is_float(type) ? " is no number" : " is no whole number"));
        return type == PlyType::float32 ? static_cast<double>(static_cast<float>(*value)) : *value;
    }
    double next_in_bytes(PlyType type) {
        const std::size_t begin = at_;
        if (bytes_.size() - at_ < n_bytes_of(type)) refuse("the file is truncated: it ends here");
        at_ += n_bytes_of(type);
        switch (type) {
            case PlyType::int8:
                return binary_value<std::int8_t>(bytes_, begin, order_);
            case PlyType::uint8:
                return binary_value<std::uint8_t>(bytes_, begin, order_);
            case PlyType::int16:
                return binary_value<std::int16_t>(bytes_, begin, order_);
            case PlyType::uint16:
                return binary_value<std::uint16_t>(bytes_, begin, order_);
            case PlyType::int32:
                return binary_value<std::int32_t>(bytes_, begin, order_);
            case PlyType::uint32:
                return binary_value<std::uint32_t>(bytes_, begin, order_);
            case PlyType::float32:
                return static_cast<double>(binary_value<float>(bytes_, begin, order_));
            default:
                return binary_value<double>(bytes_, begin, order_);
        }
    }

    const std::string& name_;
    std::string_view bytes_;
    std::size_t at_;
    bool is_text_;
    ByteOrder order_;
    TextWords words_;
    const std::string* element_ = nullptr;
    std::int64_t item_ = 0;
};

/// A vertex out of range stays so.
std::int32_t index_of(double value) {
    constexpr double largest = std::numeric_limits<std::int32_t>::max();
    return value >= 0.0 ? static_cast<std::int32_t>(std::min(value, largest)) : -1;
}

class PlyReader {
public:
    PlyReader(SurfaceMesh& mesh, std::string_view contents)
        : mesh_(mesh), header_(read_ply_header(mesh.name, contents)), values_(mesh.name, contents, header_) {}

    void read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex" || element.name == "vertices")
                read_vertices(element);
            else if (element.name == "face" || element.name == "faces")
                read_lists(element, false);
            else if (element.name == "tristrips")
                read_lists(element, true);
            else
                skip(element);
        }
        values_.finish(mesh_.warnings);
    }

private:
    [[noreturn]] void refuse(const PlyElement& element, const std::string& what) const {
        throw MeshError(mesh_.name + ": line " + std::to_string(element.line) + ": the element " + in_quotes(element.name) +
                        " " + what + ". Save the mesh again as PLY.");
    }
    /// All values of an item; `take` gets those of lists and scalars with the index of their property.
    template <class TakeValue>
    void read_item(const PlyElement& element, std::int64_t item, TakeValue&& take) {
        values_.begin_item(element.name, item);
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            const std::int64_t length = property.count_type ? values_.next_length(*property.count_type, property.type) : 1;
            for (std::int64_t k = 0; k < length; ++k) take(i, values_.next(property.type));
        }
    }
    void read_vertices(const PlyElement& element) {
        std::array<std::size_t, 3> coordinates{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string name(1, "xyz"[k]);
            coordinates[k] = index_of_property(element, {name});
            if (coordinates[k] == element.properties.size()) refuse(element, "has no property '" + name + "'");
            if (element.properties[coordinates[k]].count_type) refuse(element, "has a list as its property '" + name + "'");
        }
        for (std::int64_t item = 0; item < element.n_items; ++item) {
            Vector<3> vertex = Vector<3>::Zero();
            read_item(element, item, [&](std::size_t property, double value) {
                for (std::size_t k = 0; k < 3; ++k)
                    if (coordinates[k] == property) vertex[static_cast<std::ptrdiff_t>(k)] = value;
            });
            mesh_.vertices.push_back(vertex);
        }
    }
    void read_lists(const PlyElement& element, bool are_strips) {
        const std::size_t wanted = index_of_property(element, {"vertex_indices", "vertex_index"});
        if (wanted == element.properties.size() || !element.properties[wanted].count_type)
            refuse(element, "has no list 'vertex_indices'");
        for (std::int64_t item = 0; item < element.n_items; ++item) {
            corners_.clear();
            read_item(element, item, [&](std::size_t property, double value) {
                if (property != wanted) return;
                if (value != std::floor(value)) values_.refuse("a vertex is no whole number");
                corners_.push_back(index_of(value));
            });
            if (are_strips)
                append_strips();
            else
                mesh_.faces.append(corners_);
        }
    }
    /// A strip ends where -1 stands; every other triangle of it runs the other way.
    void append_strips() {
        std::size_t n_before = 0;  // of this strip
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            n_before = corners_[i] < 0 ? 0 : n_before + 1;
            if (n_before < 3) continue;
            const std::size_t swap = (n_before - 1) % 2;
            mesh_.faces.append(std::array{corners_[i - 2 + swap], corners_[i - 1 - swap], corners_[i]});
        }
    }
    void skip(const PlyElement& element) {
        if (element.properties.empty()) return;
        for (std::int64_t item = 0; item < element.n_items; ++item) read_item(element, item, [](std::size_t, double) {});
        mesh_.n_ignored_elements += static_cast<std::int32_t>(
            std::min<std::int64_t>(element.n_items, std::numeric_limits<std::int32_t>::max() - mesh_.n_ignored_elements));
    }
    /// The number of properties if there is none of these names.
    static std::size_t index_of_property(const PlyElement& element, std::initializer_list<std::string_view> names) {
        const auto found =
            std::find_if(element.properties.begin(), element.properties.end(), [&](const PlyProperty& property) {
                return std::find(names.begin(), names.end(), property.name) != names.end();
            });
        return static_cast<std::size_t>(found - element.properties.begin());
    }

    SurfaceMesh& mesh_;
    PlyHeader header_;
    PlyValues values_;
    std::vector<std::int32_t> corners_;
};

}  // namespace

SurfaceMesh read_ply_surface(const std::filesystem::path& path) {
    const std::string contents = file_contents(path);
    SurfaceMesh mesh;
    mesh.name = path.string();
    PlyReader(mesh, contents).read();
    return mesh;
}

}  // namespace abut::mesh
