#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Some cells of a mesh with what a moment of a run shows of them: what one of several ranks writes of a frame. The mesh may
/// be a part of the whole, which has numbers of its own.
template <int Dim>
struct PieceFrame {
    double time = 0.0;                          ///< [s]
    std::span<const std::int32_t> cells;        ///< increasing (n)
    std::span<const std::int32_t> cell_number;  ///< of each in the whole mesh (n)
    std::span<const std::int32_t> vertices;     ///< of these cells, increasing (n_vertices)
    /// Faces of these cells that are boundary faces of the mesh: indices into Mesh::boundary_faces (n_faces)
    std::span<const std::int32_t> boundary;
    std::span<const std::int32_t> face_number;         ///< of each in Mesh::boundary_faces of the whole (n_faces)
    std::span<const Vector<Dim>> displacement;         ///< (n) [m]
    std::span<const Vector<Dim>> vertex_displacement;  ///< (n_vertices) [m]
    std::vector<Field<Dim>> cell_fields{};             ///< each of n
    std::vector<Field<Dim>> boundary_fields{};         ///< each of n_faces
};

/// A series for ParaView, written in pieces: as VtuSeries, but a frame is frames/BASENAME_000000.pvtu, which names the
/// files of its pieces BASENAME_000000_0.vtu, ..., and so is that of the surfaces (.pvtp, .vtp). Cells have a cell
/// array more, "cell", their number in the whole mesh; boundary faces have "face", their index in its boundary_faces.
///
/// Each rank writes its piece by `write_piece`; when all have, one of them calls `publish`.
class PieceSeries {
public:
    /// Makes the folder if needed. Throws MeshError if that fails.
    PieceSeries(std::filesystem::path directory, std::string basename);

    /// The next frame has this many pieces of `mesh`, which are there, with the arrays of this one. Throws MeshError if
    /// a file cannot be written.
    template <int Dim>
    void publish(int n_pieces, const Mesh<Dim>& mesh, const PieceFrame<Dim>& frame);
    [[nodiscard]] std::size_t n_frames() const { return times_.size(); }
    [[nodiscard]] const std::vector<double>& times() const { return times_; }  ///< of the frames [s]
    /// As VtuSeries::go_on_after.
    void go_on_after(std::vector<double> times);

private:
    void publish_lists(const std::vector<double>& times);

    std::filesystem::path directory_;
    std::string basename_;
    std::vector<double> times_;
};

/// Writes a piece of a frame, both of its files; needs nothing of other ranks. Throws BadInput naming a field whose size is
/// wrong, MeshError if a file cannot be written.
template <int Dim>
void write_piece(const std::filesystem::path& directory, const std::string& basename, std::size_t frame_number, int piece,
                 const Mesh<Dim>& mesh, const PieceFrame<Dim>& frame);

}  // namespace abut::mesh
