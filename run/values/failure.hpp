#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/run/values/forward.hpp"

namespace abut::run {

/// Facts about a run that could not end a step, or that has diverged.
struct Failure {
    const dynamics::IntegratorState& sound;  ///< of the last record at which H - H~ was at most half the energy in play
    const dynamics::IntegratorState* lost = nullptr;  ///< in which the run was given up; none where a step has no end
    std::vector<std::int32_t> cells{};                ///< of the mesh, that the error names, if it does
    std::vector<double> lost_speed{};  ///< of the cells in that state (n_cells) [m/s]; empty where there is none
    std::string not_evaluated{};       ///< why the sound state could not be evaluated, so that no stress is shown
};

/// A cell that is no longer sound: the first one whose displacement or velocity is not finite, else the fastest one.
struct WorstCell {
    std::int32_t cell = 0;
    double speed = 0.0;  ///< [m/s]; may be NaN
};

/// The worst of all cells, of their displacements and velocities.
template <int Dim>
[[nodiscard]] WorstCell worst_cell(std::span<const Vector<Dim>> displacement, std::span<const Vector<Dim>> velocity);
/// "cell 12 of body 'left' at (0.5, 1)", at rest, or where it has moved to.
template <int Dim>
[[nodiscard]] std::string name_of_cell(const mesh::Mesh<Dim>& mesh, std::int32_t cell);
template <int Dim>
[[nodiscard]] std::string name_of_cell(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const Vector<Dim>& position);

}  // namespace abut::run
