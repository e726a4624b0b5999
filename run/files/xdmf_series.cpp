#include "abut/run/files/xdmf_series.hpp"

#include <H5Cpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <type_traits>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/index.hpp"
#include "abut/base/messages.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/run/drawing/markup.hpp"
#include "abut/run/files/files.hpp"
#include "abut/run/files/journaled_hdf5.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;
using mesh::CellShape;
using mesh::FieldTuples;
using mesh::Mesh;

constexpr hsize_t rows_of_a_chunk = 1 << 16;
constexpr unsigned deflation = 4;
constexpr std::size_t beside_an_array = 1 << 14;  // bytes, more than HDF5 needs to keep an array

// Cells and faces in XDMF ------------------------------------------------------------------------------------------------

/// A kind of cell by its name and number in XDMF.
struct Topology {
    const char* name;
    std::int32_t number;
};
constexpr Topology segment{"Polyline", 2};

Topology topology_of(CellShape shape) {
    constexpr std::array<Topology, mesh::n_cell_shapes> topologies = {
        {{"Triangle", 4}, {"Quadrilateral", 5}, {"Tetrahedron", 6}, {"Hexahedron", 9}, {"Wedge", 8}, {"Pyramid", 7}}};
    return topologies[static_cast<std::size_t>(shape)];
}

/// Cells, or faces: rows of corners of one topology, or, mixed, each with its number in front.
struct XdmfCells {
    const char* topology = "Mixed";
    std::size_t n = 0, corners_each = 0;  ///< 0: mixed
    std::vector<std::int32_t> numbers{};

    [[nodiscard]] std::string size() const {
        return corners_each == 0 ? fmt::format("{}", numbers.size()) : fmt::format("{} {}", n, corners_each);
    }
};

void append_cell(XdmfCells& cells, Topology topology, std::span<const std::int32_t> corners) {
    if (cells.corners_each == 0) {
        cells.numbers.push_back(topology.number);
        if (topology.number == segment.number) cells.numbers.push_back(static_cast<std::int32_t>(corners.size()));
    }
    cells.numbers.insert(cells.numbers.end(), corners.begin(), corners.end());
}

template <class TopologyOf, class CornersOf>
XdmfCells xdmf_cells(std::int32_t n, const TopologyOf& topology, const CornersOf& corners) {
    XdmfCells cells{.n = at(n)};
    bool is_uniform = n > 0;
    for (std::int32_t i = 0; i < n; ++i) is_uniform = is_uniform && topology(i).number == topology(0).number;
    if (is_uniform) {
        cells.topology = topology(0).name;
        cells.corners_each = corners(0).size();
    }
    for (std::int32_t i = 0; i < n; ++i) append_cell(cells, topology(i), corners(i));
    return cells;
}

/// The wedge of XDMF, which is that of VTK, begins with our second triangle.
template <int Dim>
std::vector<std::int32_t> corners_in_xdmf(const Mesh<Dim>& mesh, std::int32_t cell) {
    std::vector<std::int32_t> corners(mesh.cell_vertices[cell].begin(), mesh.cell_vertices[cell].end());
    if (mesh.cell_shape[at(cell)] == CellShape::prism) std::ranges::rotate(corners, corners.begin() + 3);
    return corners;
}

template <int Dim>
XdmfCells cells_of(const Mesh<Dim>& mesh) {
    return xdmf_cells(
        mesh.n_cells(), [&](std::int32_t cell) { return topology_of(mesh.cell_shape[at(cell)]); },
        [&](std::int32_t cell) { return corners_in_xdmf(mesh, cell); });
}

template <int Dim>
XdmfCells faces_of(const Mesh<Dim>& mesh) {
    const auto corners = [&](std::int32_t i) { return mesh.face_vertices[mesh.boundary_faces[at(i)]]; };
    const auto topology = [&](std::int32_t i) {
        if (Dim == 2) return segment;
        return topology_of(corners(i).size() == 3 ? CellShape::triangle : CellShape::quadrangle);
    };
    return xdmf_cells(static_cast<std::int32_t>(mesh.boundary_faces.size()), topology, corners);
}

// The file of HDF5 -------------------------------------------------------------------------------------------------------

/// A name as one of HDF5, where slashes part groups.
std::string in_hdf5(const std::string& name) {
    std::string result;
    for (const char c : name) {
        if (c == '/')
            result += " per ";
        else
            result += c;
    }
    return result == "." ? "_" : result;
}

template <class Value>
const H5::PredType& hdf5_type() {
    if constexpr (std::is_same_v<Value, double>)
        return H5::PredType::NATIVE_DOUBLE;
    else
        return H5::PredType::NATIVE_INT32;
}

/// Rows of `width` values; 0: a list.
template <class Value>
H5::DataSet put_array(H5::H5File& file, const std::string& path, const std::vector<Value>& values, std::size_t width = 0) {
    const std::array<hsize_t, 2> size = {width == 0 ? values.size() : values.size() / width, width};
    const int rank = width == 0 ? 1 : 2;
    H5::DSetCreatPropList properties;
    H5Pset_obj_track_times(properties.getId(), false);  // files of equal runs are equal
    if (!values.empty()) {
        const std::array<hsize_t, 2> chunk = {std::min(size[0], rows_of_a_chunk), size[1]};
        properties.setChunk(rank, chunk.data());
        properties.setShuffle();
        properties.setDeflate(deflation);
    }
    H5::DataSet set = file.createDataSet(path, hdf5_type<Value>(), H5::DataSpace(rank, size.data()), properties);
    if (!values.empty()) set.write(values.data(), hdf5_type<Value>());
    return set;
}

H5::StrType text_type() {
    H5::StrType type(H5::PredType::C_S1, H5T_VARIABLE);
    type.setCset(H5T_CSET_UTF8);
    return type;
}

void put_text(const H5::H5Object& of, const char* name, const std::string& text) {
    of.createAttribute(name, text_type(), H5::DataSpace()).write(text_type(), text);
}

std::string get_text(const H5::H5Object& of, const char* name) {
    std::string text;
    of.openAttribute(name).read(text_type(), text);
    return text;
}

void add_names(const H5::DataSet& set, const std::vector<std::string>& names) {
    std::vector<const char*> texts;
    for (const std::string& name : names) texts.push_back(name.c_str());
    const hsize_t n = texts.size();
    set.createAttribute("names", text_type(), H5::DataSpace(1, &n)).write(text_type(), texts.data());
}

constexpr const char* name_attribute = "name";  // of a field, which may have slashes
constexpr const char* mesh_attribute = "mesh";  // of a frame: path of its mesh, where that is not the first one
constexpr std::array mesh_lists{"xdmf_cells", "xdmf_faces"};  // of such a mesh: its elements in the lists

/// `to`: path of its arrays, empty or with a slash at its end.
template <int Dim>
void write_mesh(H5::H5File& file, const Mesh<Dim>& mesh, const std::string& to) {
    put_array(file, to + "points", mesh::field_tuples<Dim>(std::span<const Vector<Dim>>(mesh.vertices)).values, 3);
    const XdmfCells cells = cells_of(mesh), faces = faces_of(mesh);
    put_array(file, to + "cells", cells.numbers, cells.corners_each);
    put_array(file, to + "faces", faces.numbers, faces.corners_each);
    add_names(put_array(file, to + "body", mesh.cell_body), mesh.body_names);
    std::vector<std::int32_t> of_faces;
    for (const std::int32_t face : mesh.boundary_faces) of_faces.push_back(mesh.cell_body[at(mesh.face_cells[at(face)][0])]);
    put_array(file, to + "face_body", of_faces);
    file.createGroup(to + "groups");
    for (const mesh::BoundaryGroup& group : mesh.groups) {
        std::vector<std::int32_t> is_in;
        for (const std::int32_t face : mesh.boundary_faces)
            is_in.push_back(std::ranges::binary_search(group.faces, face) ? 1 : 0);
        put_array(file, to + "groups/" + in_hdf5(group.name), is_in);
    }
}

std::string frame_path(std::size_t frame) { return fmt::format("frames/{:06}", frame); }

/// By their paths within the file: names and values.
using Arrays = std::map<std::string, std::pair<std::string, FieldTuples>>;

template <int Dim>
Arrays arrays_of(const mesh::Frame<Dim>& frame, const Mesh<Dim>& mesh, const std::string& path) {
    Arrays arrays;
    const auto add = [&](const char* of, const std::string& name, const mesh::FieldValues<Dim>& values, std::size_t n) {
        FieldTuples tuples = mesh::field_tuples<Dim>(values);
        if (tuples.values.size() != n * tuples.n_components)
            throw BadInput(fmt::format("frame: field '{}' has {} values, one for each of the {} {} is needed.", name,
                                       tuples.values.size() / tuples.n_components, n, of));
        arrays.emplace(fmt::format("{}/{}/{}", path, of, in_hdf5(name)), std::pair(name, std::move(tuples)));
    };
    const auto n_cells = at(mesh.n_cells());
    add("cells", "displacement", frame.displacement, n_cells);
    if (frame.vertex_displacement.empty()) {
        const auto means = mesh::vertex_means<Dim>(frame.displacement, mesh.cell_vertices, mesh.vertices.size());
        add("points", "displacement", std::span<const Vector<Dim>>(means), mesh.vertices.size());
    } else {
        add("points", "displacement", frame.vertex_displacement, mesh.vertices.size());
    }
    for (const mesh::Field<Dim>& field : frame.cell_fields) add("cells", field.name, field.values, n_cells);
    for (const mesh::Field<Dim>& field : frame.boundary_fields)
        add("faces", field.name, field.values, mesh.boundary_faces.size());
    return arrays;
}

void write_frame(H5::H5File& file, const std::string& path, double time, const Arrays& arrays) {
    const H5::Group group = file.openGroup(path);
    for (const char* part : {"points", "cells", "faces"}) group.createGroup(part);
    const H5::DataSpace one;
    group.createAttribute("time", H5::PredType::NATIVE_DOUBLE, one).write(H5::PredType::NATIVE_DOUBLE, &time);
    for (const auto& [to, array] : arrays) {
        const auto& [name, tuples] = array;
        const H5::DataSet set = put_array(file, to, tuples.values, tuples.n_components == 1 ? 0 : tuples.n_components);
        put_text(set, name_attribute, name);
    }
    file.flush(H5F_SCOPE_GLOBAL);
}

std::size_t space_of(const Arrays& arrays) {
    std::size_t bytes = beside_an_array;
    for (const auto& [path, array] : arrays)
        bytes += array.second.values.size() * sizeof(double) / 100 * 101 + beside_an_array;
    return bytes;
}

template <int Dim>
std::size_t space_of(const Mesh<Dim>& mesh) {
    const std::size_t numbers =
        6 * mesh.vertices.size() + 10 * at(mesh.n_cells()) + (6 + mesh.groups.size()) * mesh.boundary_faces.size();
    return numbers * sizeof(std::int32_t) / 100 * 101 + (8 + mesh.groups.size()) * beside_an_array;
}

/// Takes space behind the end of a file, so that no full disc is ever left to HDF5, which gives back what it does not need.
void take_space(const fs::path& path, std::size_t bytes) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) throw BadInput(cannot_be_written(path, std::strerror(errno)));
    const off_t end = ::lseek(file, 0, SEEK_END);
    const bool is_refused = ::fallocate(file, 0, end, static_cast<off_t>(bytes)) != 0;
    const int reason = errno;
    if (is_refused) static_cast<void>(::ftruncate(file, end));
    ::close(file);
    if (is_refused && reason != EOPNOTSUPP) throw BadInput(cannot_be_written(path, std::strerror(reason)));
}

/// Runs what writes a file of HDF5: errors of HDF5 are none of the standard library.
template <class Action>
void guarded(const fs::path& path, const Action& action) {
    H5::Exception::dontPrint();
    try {
        action();
    } catch (const H5::Exception& error) {
        throw BadInput(cannot_be_written(path, "HDF5 says " + error.getDetailMsg()));
    }
}

/// As the run that wrote it has left it, at whatever moment it was killed.
H5::H5File opened(const fs::path& path) {
    H5::Exception::dontPrint();
    finish_journal(path);
    try {
        return {path.string(), H5F_ACC_RDWR, H5::FileCreatPropList::DEFAULT, journaled_access()};
    } catch (const H5::Exception& error) {
        throw BadInput(
            fmt::format("{}: HDF5 cannot open it: {}. Put the file back as the run has left it, or move it away: a new "
                        "one then begins with the next frame; or run from the start.",
                        path.string(), error.getDetailMsg()));
    }
}

H5::H5File begun(const fs::path& path) {
    return {path.string(), H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, journaled_access()};
}

// The lists --------------------------------------------------------------------------------------------------------------

Markup data_item(const std::string& file, const std::string& path, const char* type, const char* bytes,
                 const std::string& size) {
    return element("DataItem", {{"Dimensions", size}, {"NumberType", type}, {"Precision", bytes}, {"Format", "HDF"}},
                   file + ":/" + path);
}

Markup attribute(const std::string& name, const char* type, const char* center, const Markup& data) {
    return element("Attribute", {{"Name", name}, {"AttributeType", type}, {"Center", center}}, data) + "\n";
}

template <int Dim>
Markup grid_of(const Mesh<Dim>& mesh, const XdmfCells& cells, const std::string& file, const std::string& of_mesh,
               const char* path) {
    Attributes of_topology = {{"TopologyType", cells.topology}, {"NumberOfElements", std::to_string(cells.n)}};
    if (cells.topology == std::string(segment.name)) of_topology.push_back({"NodesPerElement", "2"});
    return element("Geometry", {{"GeometryType", "XYZ"}},
                   data_item(file, of_mesh + "points", "Float", "8", fmt::format("{} 3", mesh.vertices.size()))) +
           "\n" + element("Topology", of_topology, data_item(file, of_mesh + path, "Int", "4", cells.size())) + "\n";
}

Markup numbers(const std::string& name, const std::string& file, const std::string& path, std::size_t n) {
    return attribute(name, "Scalar", "Cell", data_item(file, path, "Int", "4", std::to_string(n)));
}

/// Elements of the arrays in a part of a frame.
Markup listed(const H5::H5File& h5, const std::string& file, const std::string& path, const char* center) {
    const H5::Group group = h5.openGroup(path);
    Markup text;
    for (hsize_t i = 0; i < group.getNumObjs(); ++i) {
        const std::string array = path + "/" + group.getObjnameByIdx(i);
        const H5::DataSet set = h5.openDataSet(array);
        std::array<hsize_t, 2> size = {0, 1};
        const bool is_list = set.getSpace().getSimpleExtentDims(size.data()) == 1;
        const char* type = is_list ? "Scalar" : (size[1] == 3 ? "Vector" : "Matrix");
        const std::string dimensions = is_list ? std::to_string(size[0]) : fmt::format("{} {}", size[0], size[1]);
        text += attribute(get_text(set, name_attribute), type, center, data_item(file, array, "Float", "8", dimensions));
    }
    return text;
}

/// A frame in the lists of cells and of boundary faces.
std::array<std::string, 2> listed_frame(const H5::H5File& h5, const std::string& file, std::size_t frame, double time,
                                        const std::array<std::string, 2>& of_mesh) {
    std::array<std::string, 2> lists;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        const Markup data = listed(h5, file, frame_path(frame) + "/points", "Node") +
                            listed(h5, file, frame_path(frame) + (i == 0 ? "/cells" : "/faces"), "Cell");
        lists[i] = fmt::format("<Grid Name=\"frame {}\" GridType=\"Uniform\">\n<Time Value=\"{}\"/>\n{}{}</Grid>\n", frame,
                               exact_number(time), of_mesh[i], data.html());
    }
    return lists;
}

}  // namespace

template <int Dim>
XdmfSeries<Dim>::XdmfSeries(std::filesystem::path directory, std::string basename, const Mesh<Dim>& mesh)
    : directory_(std::move(directory)), basename_(std::move(basename)), mesh_(mesh) {
    std::error_code error;
    std::filesystem::create_directories(directory_, error);
    if (error) refuse_directory(directory_, error.message());
    meshes_.push_back({"", mesh_.n_cells(), lists_of_mesh("")});
}

template <int Dim>
auto XdmfSeries<Dim>::lists_of_mesh(const std::string& path) const -> Lists {
    const std::string h5 = file().filename().string();
    const XdmfCells cells = cells_of(mesh_), faces = faces_of(mesh_);
    Markup surface = grid_of(mesh_, faces, h5, path, "faces") + numbers("body", h5, path + "face_body", faces.n);
    for (const mesh::BoundaryGroup& group : mesh_.groups)
        surface += numbers("group: " + group.name, h5, path + "groups/" + in_hdf5(group.name), faces.n);
    return {(grid_of(mesh_, cells, h5, path, "cells") + numbers("body", h5, path + "body", cells.n)).html(), surface.html()};
}

template <int Dim>
void XdmfSeries<Dim>::take_mesh(const Mesh<Dim>& mesh) {
    mesh_ = mesh;
    is_stored_ = meshes_.back().n_cells == mesh.n_cells();
}

template <int Dim>
std::filesystem::path XdmfSeries<Dim>::file() const {
    return directory_ / (basename_ + ".h5");
}

template <int Dim>
void XdmfSeries<Dim>::write(const mesh::Frame<Dim>& frame) {
    const std::string path = frame_path(times_.size());
    const Arrays arrays = arrays_of(frame, mesh_, path);
    if (!is_begun_) remove_files(directory_, {file().filename().string(), journal_of(file()).filename().string()});
    guarded(file(), [&] {
        H5::H5File h5 = is_begun_ ? opened(file()) : begun(file());
        take_space(file(), space_of(arrays) + (is_begun_ && is_stored_ ? 0 : space_of(mesh_)));
        if (!is_begun_) begin(h5);
        if (h5.nameExists(path)) h5.unlink(path);  // which could not be listed
        h5.createGroup(path);
        if (!is_stored_) store_mesh(h5, path + "/mesh/");
        if (!meshes_.back().path.empty()) put_text(h5.openGroup(path), mesh_attribute, meshes_.back().path);
        write_frame(h5, path, frame.time, arrays);
        frames_.push_back(listed_frame(h5, file().filename().string(), times_.size(), frame.time, meshes_.back().lists));
        close_journaled(h5);
    });
    is_begun_ = true;
    times_.push_back(frame.time);
    write_lists();
}

/// With the mesh of the first frame, whose elements are written as they are in a new file.
template <int Dim>
void XdmfSeries<Dim>::begin(H5::H5File& h5) {
    write_mesh(h5, mesh_, "");
    h5.createGroup("frames");
    meshes_ = {{"", mesh_.n_cells(), lists_of_mesh("")}};
    is_stored_ = true;
}

template <int Dim>
void XdmfSeries<Dim>::store_mesh(H5::H5File& h5, const std::string& path) {
    const H5::Group group = h5.createGroup(path);
    write_mesh(h5, mesh_, path);
    meshes_.push_back({path, mesh_.n_cells(), lists_of_mesh(path)});
    for (std::size_t i = 0; i < mesh_lists.size(); ++i) put_text(group, mesh_lists[i], meshes_.back().lists[i]);
    is_stored_ = true;
}

/// The mesh of a frame that is there, which becomes the last one that is known.
template <int Dim>
auto XdmfSeries<Dim>::mesh_of(const H5::H5File& h5, const std::string& frame) -> const StoredMesh& {
    const H5::Group group = h5.openGroup(frame);
    if (!group.attrExists(mesh_attribute)) return meshes_.front();
    const std::string path = get_text(group, mesh_attribute);
    if (meshes_.back().path == path) return meshes_.back();
    const H5::Group stored = h5.openGroup(path);
    const auto n_cells = h5.openDataSet(path + "body").getSpace().getSimpleExtentNpoints();
    meshes_.push_back(
        {path, static_cast<std::int32_t>(n_cells), {get_text(stored, mesh_lists[0]), get_text(stored, mesh_lists[1])}});
    return meshes_.back();
}

template <int Dim>
void XdmfSeries<Dim>::go_on_after(std::vector<double> times) {
    times_ = std::move(times);
    is_begun_ = std::filesystem::exists(file()) && !times_.empty();
    if (!is_begun_) return;
    guarded(file(), [&] {
        H5::H5File h5 = opened(file());
        for (std::size_t frame = times_.size(); h5.nameExists(frame_path(frame)); ++frame) h5.unlink(frame_path(frame));
        for (std::size_t frame = 0; frame < times_.size(); ++frame) {
            const std::string path = frame_path(frame);
            if (h5.nameExists(path))
                frames_.push_back(
                    listed_frame(h5, file().filename().string(), frame, times_[frame], mesh_of(h5, path).lists));
            else if (!frames_.empty())
                throw BadInput(
                    fmt::format("{}: frame {} of {} is not there. Put the file back as the run has left it, or run from the "
                                "start.",
                                file().string(), frame, times_.size()));
        }
        close_journaled(h5);
    });
    write_lists();
}

template <int Dim>
void XdmfSeries<Dim>::write_lists() const {
    Markup bodies;
    for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body)
        bodies +=
            element("Information", {{"Name", "body: " + mesh_.body_names[at(body)]}, {"Value", std::to_string(body)}}) +
            "\n";
    for (std::size_t i = 0; i < mesh_lists.size(); ++i) {
        std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n" + bodies.html() +
                           "<Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
        for (const Lists& frame : frames_) text += frame[i];
        write_whole(directory_ / (basename_ + (i == 0 ? ".xmf" : "_surface.xmf")), text + "</Grid>\n</Domain>\n</Xdmf>\n");
    }
}

template class XdmfSeries<2>;
template class XdmfSeries<3>;

}  // namespace abut::run
