#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Numbers, vectors or tensors, one for each cell or boundary face. Of a tensor the symmetric part is written.
template <int Dim>
using FieldValues = std::variant<std::span<const double>, std::span<const Vector<Dim>>, std::span<const Matrix<Dim>>>;

template <int Dim>
struct Field {
    std::string name;  ///< as ParaView will show it; put the unit in, for example "contact pressure [Pa]"
    FieldValues<Dim> values;
};

/// A number that a file has as a whole, such as that of a body in an array.
struct NamedNumber {
    std::string name;
    std::int32_t value;
};

/// State of a run at one moment.
template <int Dim>
struct Frame {
    double time = 0.0;                            ///< [s]
    std::span<const Vector<Dim>> displacement{};  ///< u_c [m], (n_cells, Dim), or empty
    /// Displacement of the vertices [m], (n_vertices, Dim), or empty: of a host that has them, in place of means over
    /// the cells around
    std::span<const Vector<Dim>> vertex_displacement{};
    std::vector<Field<Dim>> cell_fields{};      ///< each of n_cells
    std::vector<Field<Dim>> boundary_fields{};  ///< each of boundary_faces.size(), in that order
};

/// The folder of the frames of a series, in that of its lists.
inline constexpr const char* frames_folder = "frames";

/// The mesh in motion, as files for ParaView: frames/BASENAME_000000.vtu, ... with the cells and
/// frames/BASENAME_surface_000000.vtp, ... with the boundary faces. BASENAME.pvd and BASENAME_surface.pvd list them
/// with their times: open these two.
///
/// Both carry the cell array "body", the number "body: <name>" of each body and the time, "TimeValue"; boundary faces
/// an array "group: <name>" for each group of the mesh, 1 on its faces and 0 elsewhere. The displacement is written on
/// cells and on points, where the filter Warp By Vector takes it: that of the vertices if the frame has it, else the
/// mean over the cells around each. 2D vectors get a third component 0, tensors six components (xx, yy, zz, xy, yz,
/// xz). Data are binary and compressed. Every file is written under another name and then moved, the lists last: a run
/// that breaks off leaves a readable series.
template <int Dim>
class VtuSeries {
public:
    /// Makes the folder if needed; files of an earlier series of that name are written over as frames come. Keeps its own
    /// copy of what it needs of the mesh. Throws MeshError if the folder cannot be made.
    VtuSeries(const std::filesystem::path& directory, const std::string& basename, const Mesh<Dim>& mesh);
    ~VtuSeries();
    VtuSeries(VtuSeries&&) noexcept;
    VtuSeries& operator=(VtuSeries&&) noexcept;

    /// Throws BadInput naming the field whose size is wrong, MeshError if a file cannot be written: the
    /// lists are then as before the call, and the next call writes the same frame again.
    void write(const Frame<Dim>& frame);
    /// Frames that follow are of this mesh, with the same bodies: one whose cells have left in part.
    void take_mesh(const Mesh<Dim>& mesh);
    [[nodiscard]] int n_frames() const;
    [[nodiscard]] const std::vector<double>& times() const;  ///< of the frames [s]
    /// Goes on with a series that another object has begun, after its frames of these times: later ones are written over.
    /// Throws MeshError, and stays as it is, if the file of one is not there.
    void go_on_after(std::vector<double> times);

private:
    struct Files;
    std::unique_ptr<Files> files_;
};

/// A field as files hold it: vectors with a third component 0 in 2D, tensors as their six components.
struct FieldTuples {
    std::size_t n_components;
    std::vector<double> values;  ///< (n, n_components)
};
template <int Dim>
[[nodiscard]] FieldTuples field_tuples(const FieldValues<Dim>& values);

/// The mean over the cells around each vertex, of which each needs one. Bodies share no vertex, so nothing mixes
/// between them.
template <int Dim>
[[nodiscard]] std::vector<Vector<Dim>> vertex_means(std::span<const Vector<Dim>> of_cells, const Rows& cell_vertices,
                                                    std::size_t n_vertices);

/// The mesh alone in one .vtu file: its cells with the array "body", behind them the boundary faces that are in groups,
/// and an array "group: <name>" for each group, 1 on its faces and 0 elsewhere, so that read_mesh gives the groups
/// back. Throws MeshError if it cannot be written.
template <int Dim>
void write_vtu(const Mesh<Dim>& mesh, const std::filesystem::path& path);

}  // namespace abut::mesh
