#pragma once
// Private to the layer; not installed.
#include <cstddef>
#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "abut/mesh/io/vtk_input.hpp"
#include "abut/mesh/io/vtk_numbers.hpp"

namespace abut::mesh {

/// A .vtu or .vtp file as XML with arrays of numbers, however these are stored. What it promises is weighed against its size
/// (read_vtk_grid). All of it throws MeshError with the name of the file and, where there is one, the line.
class VtkFile {
public:
    using Node = pugi::xml_node;

    /// Views `contents`, which must outlive this object.
    VtkFile(std::string name, std::string_view contents, VtkKind kind);

    [[nodiscard]] const std::string& name() const { return name_; }
    /// The element that holds the pieces.
    [[nodiscard]] Node grid() const;

    [[noreturn]] void refuse(Node node, const std::string& what) const;
    [[noreturn]] void refuse_damage(Node node, const std::string& what) const;

    [[nodiscard]] double n_bytes() const { return static_cast<double>(contents_.size()); }
    /// Bytes that can come out of those of this file at most.
    [[nodiscard]] double n_bytes_at_most() const { return ratio_ * n_bytes(); }

    /// An attribute, or that value without it.
    [[nodiscard]] double count(Node node, const char* key, double without) const;
    /// The arrays of numbers of a section; of several time steps those of the first.
    [[nodiscard]] std::vector<Node> first_step_of(Node section) const;
    /// So many tuples of an array; refused if the file is too small for them.
    [[nodiscard]] std::size_t n_values(Node array, double n_tuples) const;
    /// The values of so many tuples, as double or std::int64_t.
    template <class Value>
    [[nodiscard]] std::vector<Value> values(Node array, std::size_t n_tuples);

private:
    /// Stored part of an array from some byte on.
    struct Stored {
        std::string_view text;
        bool is_raw;

        [[nodiscard]] std::string first(std::size_t n) const;
        /// Part that is stored behind n bytes that are encoded by themselves.
        [[nodiscard]] Stored behind(std::size_t n) const;
    };

    [[nodiscard]] bool is_grid() const { return kind_ == VtkKind::unstructured_grid; }
    [[nodiscard]] const char* type_name() const { return is_grid() ? "UnstructuredGrid" : "PolyData"; }
    [[noreturn]] void refuse_at(std::ptrdiff_t at, const std::string& what) const;
    [[noreturn]] void refuse_kind() const;
    [[noreturn]] void refuse_end(Node array) const;

    void check_is_whole() const;
    void parse();
    void read_header();

    [[nodiscard]] const NumberType& type_of(Node array) const;
    template <class Value>
    [[nodiscard]] std::vector<Value> text_values(Node array, const NumberType& type, std::size_t n) const;
    [[nodiscard]] Stored stored_of(Node array) const;
    [[nodiscard]] double header_number(std::string_view header, std::size_t i) const;
    [[nodiscard]] std::string data_of(Node array, std::size_t n);
    void check_held(Node array, double n_promised, double n_held, std::size_t n_needed) const;
    [[nodiscard]] std::string compressed_data(Node array, const Stored& stored, std::size_t n) const;

    std::string name_;
    std::string_view contents_, compressor_;
    VtkKind kind_;
    pugi::xml_document document_;
    double ratio_ = 1.0, n_decoded_ = 0.0;
    ByteOrder order_ = ByteOrder::little;
    std::size_t header_size_ = 4;  ///< bytes of the numbers before the values
    bool appended_is_raw_ = false;
    std::size_t appended_ = std::string::npos;  ///< behind the '_' before the appended data
};

}  // namespace abut::mesh
