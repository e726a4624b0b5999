#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/run/values/forward.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::run {

/// The gap of a face as frames show it [m]: where it is in contact, so that it is not above 0; NaN elsewhere. Gaps of
/// open faces are known of pairs that are listed alone, and lists depend on ranks and restarts, which results do not.
[[nodiscard]] inline double gap_in_contact(double gap) {
    return gap <= 0.0 ? gap : std::numeric_limits<double>::quiet_NaN();
}

/// Part of a frame that one rank has: its own cells, in their order in the scene.
template <int Dim>
struct FramePiece {
    std::int64_t frame = 0;                 ///< number of the frame
    double time = 0.0;                      ///< [s]
    int number = 0;                         ///< of the piece, that of the rank
    int n_pieces = 1;                       ///< of all ranks
    const mesh::Mesh<Dim>* mesh = nullptr;  ///< of the solid: the part of this rank

    std::vector<std::int32_t> cells;          ///< in the mesh, increasing (n)
    std::vector<std::int32_t> cell_number;    ///< of each in the mesh of the scene, increasing (n)
    std::vector<Vector<Dim>> displacement;    ///< (n) [m]
    std::vector<Vector<Dim>> velocity;        ///< (n) [m/s]
    std::vector<Matrix<Dim>> stress;          ///< (n) [Pa]
    std::vector<double> out_of_plane_stress;  ///< Solid::out_of_plane_stress (n) [Pa]
    std::vector<double> plastic_strain;       ///< (n) [-]; empty where no material has one
    std::vector<double> fragment;             ///< fragment_of_cells (n); empty where no bond may break

    std::vector<std::int32_t> vertices;            ///< of these cells, increasing (n_vertices)
    std::vector<Vector<Dim>> vertex_displacement;  ///< as mesh::VtuSeries has it for the whole mesh (n_vertices) [m]

    std::vector<std::int32_t> boundary;     ///< faces of these cells among Mesh::boundary_faces, increasing (n_faces)
    std::vector<std::int32_t> face_number;  ///< of each among those of the mesh of the scene, increasing (n_faces)
    std::vector<double> pressure;           ///< of contact (n_faces) [Pa]
    std::vector<double> gap;                ///< (n_faces) [m]; gap_in_contact
    /// Fields of friction (n_faces) as in solid::ContactField; empty without any
    std::vector<double> friction, slip, sliding;
    std::vector<double> bond;  ///< left_of_bonds (n_faces); empty without bonds
};

/// Remaining part of the pull of the bonds, per boundary face of the solid's mesh, by area [-]; NaN where none is, and
/// empty without bonds.
template <int Dim>
[[nodiscard]] std::vector<double> left_of_bonds(const solid::Solid<Dim>& solid);

/// solid::fragment_of_bodies of the body of each cell of the solid's mesh (n_cells); empty where no bond may break.
template <int Dim>
[[nodiscard]] std::vector<double> fragment_of_cells(const solid::Solid<Dim>& solid);

/// The piece of this rank, or the whole where there is one; `solid` is that of the run. A call of all ranks.
template <int Dim>
[[nodiscard]] FramePiece<Dim> frame_piece(std::int64_t frame, const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid);

}  // namespace abut::run
