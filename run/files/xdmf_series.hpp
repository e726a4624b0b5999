#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/mesh/io/write_vtu.hpp"

namespace H5 {
class H5File;
}

namespace abut::run {

/// Frames as mesh::VtuSeries writes them, in one file of HDF5, BASENAME.h5, with BASENAME.xmf and BASENAME_surface.xmf
/// (XDMF 3, temporal collections), which ParaView opens. Values are bitwise those of the VTU files; tensors are
/// matrices of their six components in the order of VTK; the surface shares the vertices of the cells.
///
/// BASENAME.h5 has `points`, `cells`, `body` (its attribute `names` has those of the bodies), `faces`, `face_body`,
/// `groups/NAME`, and `frames/000012` with the attribute `time` and an array for each field: `points/displacement`,
/// `cells/NAME`, `faces/NAME`, where a slash in a name is written " per ".
///
/// Where cells have left, the first frame after that has their mesh in `frames/000012/mesh`, with the same arrays, and later
/// ones name it in their attribute `mesh`.
///
/// A frame is appended to the .h5 file, in space that is taken for it before; then the .xmf files, which are written
/// beside their places and moved, list it. A full disc leaves the frames before it alone, and so does a process that is
/// killed (journaled_hdf5.hpp).
template <int Dim>
class XdmfSeries {
public:
    /// Makes the folder if needed. Nothing is written before the first frame, which replaces a file of that name.
    XdmfSeries(std::filesystem::path directory, std::string basename, const mesh::Mesh<Dim>& mesh);

    /// Frames that follow are of this mesh, with the same bodies and fewer cells than those before.
    void take_mesh(const mesh::Mesh<Dim>& mesh);
    /// Throws BadInput naming a field whose size is wrong, or the file that cannot be written.
    void write(const mesh::Frame<Dim>& frame);
    [[nodiscard]] const std::vector<double>& times() const { return times_; }  ///< of the frames [s]
    /// Goes on after frames of these times: later ones are removed. Where the file is not there a new one begins with
    /// the next frame. Throws BadInput if the file cannot be opened, or if a frame is missing in it.
    void go_on_after(std::vector<double> times);

private:
    /// Elements of XDMF, for cells and for boundary faces.
    using Lists = std::array<std::string, 2>;

    /// A mesh in the file.
    struct StoredMesh {
        std::string path;  ///< of its arrays; empty: that of the first frame
        std::int32_t n_cells;
        Lists lists;
    };

    [[nodiscard]] std::filesystem::path file() const;
    [[nodiscard]] Lists lists_of_mesh(const std::string& path) const;
    void begin(H5::H5File& h5);
    void store_mesh(H5::H5File& h5, const std::string& path);
    [[nodiscard]] const StoredMesh& mesh_of(const H5::H5File& h5, const std::string& frame);
    void write_lists() const;

    std::filesystem::path directory_;
    std::string basename_;
    mesh::Mesh<Dim> mesh_;
    std::vector<StoredMesh> meshes_;  // in the file, the last one that of the frames that follow
    bool is_stored_ = true;           // that one is, or comes with the first frame
    std::vector<double> times_;
    bool is_begun_ = false;      // a file with the mesh is there
    std::vector<Lists> frames_;  // that are in it
};

}  // namespace abut::run
