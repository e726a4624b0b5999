#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "abut/dynamics/ledger.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/solid/solid.hpp"

namespace abut::examples {

/// A run as a series for ParaView: displacement, velocity, stress and von Mises stress on cells, contact pressure and gap on
/// boundary faces (a face that nothing faces has the gap NaN). `n_frames` equally far apart, first and last step included.
/// `series` is what the files are called by, see mesh::VtuSeries.
template <int Dim>
class Frames {
public:
    Frames(const std::filesystem::path& directory, const std::string& series, const mesh::Mesh<Dim>& mesh, int n_frames,
           std::int64_t n_steps);

    /// Writes a frame if one is due at this step.
    void write_if_due(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid);

private:
    void write(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid);

    mesh::VtuSeries<Dim> series_;
    std::int64_t n_frames_;
    std::int64_t n_steps_;
};

/// von Mises equivalent stress [Pa]; in 2D of plane strain, with sigma_zz = nu (sigma_xx + sigma_yy).
template <int Dim>
[[nodiscard]] double von_mises(const Matrix<Dim>& stress, double poisson);

}  // namespace abut::examples
