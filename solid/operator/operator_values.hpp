#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/dynamics/losses.hpp"
#include "abut/solid/boundary/boundary_face.hpp"

namespace abut::solid {

/// Values of boundary conditions and temperatures at a time.
template <int Dim>
struct BoundaryLoad {
    std::vector<Vector<Dim>>
        displacement;  ///< B u_D + L t and what heat adds, the part of û that is not of the cells (n_boundary) [m]
    std::vector<Vector<Dim>> traction;  ///< |f| t_f (n_boundary) [N]
    std::vector<double> temperature;    ///< rise of that of each cell (n_cells) [K]; empty: none is warm
};

/// Changes of some boundary faces: what contact adds. Other free faces of their cells answer (CornerRule). Empty where there
/// is no contact.
template <int Dim>
struct FaceCorrections {
    std::span<const BoundaryFace> faces;           ///< boundary faces, increasing (n)
    std::span<const Vector<Dim>> displacement;     ///< delta_f (n) [m]; may be empty
    std::span<const Vector<Dim>> energy_gradient;  ///< dV/dû_f of the pairs (n) [N]; may be empty
    std::span<const Matrix<Dim>> moment = {};      ///< dV/dG_c of the pairs, c behind the face (n) [N m]; may be empty
};

/// Both ends of a step whose mean displacement is asked for: bodies of Kinematics::finite need more than the mean.
/// Empty: one state.
template <int Dim>
struct StepEnds {
    std::span<const Vector<Dim>> start;             ///< displacements (n_cells) [m]
    std::span<const Vector<Dim>> end;               ///< the same
    const BoundaryLoad<Dim>* start_load = nullptr;  ///< null: none; read where MeanForce is of both ends
    const BoundaryLoad<Dim>* end_load = nullptr;    ///< the same
    double dt = 0.0;                                ///< [s]; read where a material is damped
    FaceCorrections<Dim> change{};                  ///< change of `displacement` in the step; read there, too
};

/// Defect of a cell in a step whose mean force is that of both ends, contact and tractions not counted.
template <int Dim>
struct StepDefect {
    double energy;            ///< -dV less the work of the force [J]: what is to be added to that work
    double rounding;          ///< of `energy`, where it is a difference of energies [J]
    AxialVector<Dim> moment;  ///< of dV/du about the mean position [N m]
};

/// Energy that cells dissipate, in the order in which it is saved.
inline constexpr std::array losses_of_cells{&dynamics::Losses::in_cells,     &dynamics::Losses::in_jumps,
                                            &dynamics::Losses::on_faces,     &dynamics::Losses::by_damping,
                                            &dynamics::Losses::by_viscosity, &dynamics::Losses::lagged};

/// Which state of a step operators look at. Inelastic materials remember at the end what the step makes of them.
enum class StepState {
    given,  ///< any state, with what materials remember now
    end,    ///< the end of the step that has begun
};

/// A part of the mesh on which the operators can be applied alone: everything that the asked-for values depend on.
template <int Dim>
struct Region {
    std::vector<BoundaryFace> faces;        ///< boundary faces whose û and y are wanted, increasing
    std::vector<std::int32_t> cells;        ///< cells whose dV/du is wanted, increasing
    std::vector<std::int32_t> input_cells;  ///< all below: what is evaluated in between, increasing
    std::vector<std::int32_t> reconstructed;
    std::vector<BoundaryFace> reconstructed_boundary;
    std::vector<std::int32_t> displacement_gradient_cells;
    std::vector<std::int32_t> stress_cells;
    std::vector<std::int32_t> energy_gradient_faces;
    struct Offsets {  // into the lists
        std::int32_t face, cell, reconstructed, reconstructed_boundary, displacement_gradient_cell, stress_cell,
            energy_gradient_face;
    };
    /// Begin of each chunk of the mesh in `region_of_cells`, one more at the end; two for a small region as a whole.
    std::vector<Offsets> chunks;
};

}  // namespace abut::solid
