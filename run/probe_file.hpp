#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "abut/run/observer.hpp"
#include "abut/run/outputs.hpp"
#include "abut/run/partial_file.hpp"

namespace abut::run {

/// Values at the probes of a scene, as CSV: a row at the start, every `Outputs::interval` steps, and at the end. Columns are
/// step, time and, for each probe, "<name>.displacement_x" [m], "<name>.velocity_x" [m/s], "<name>.stress_xx" [Pa] and so
/// on, "<name>.von_mises" [Pa]; in 2D stress_zz is that of plane strain.
///
/// A probe at a place takes the cell that holds it: the displacement is that of the place itself, velocity and stress are
/// those of the cell. That of a body takes the means over its volume.
///
/// It is written as it goes, and is called `path`.partial until `finish`.
template <int Dim>
class ProbeFile : public Observer<Dim> {
public:
    explicit ProbeFile(std::filesystem::path path);

    /// Opens the file. Throws BadInput if it cannot be written, for a body that does not exist, and for a place that is
    /// beside its body, with the distance.
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    /// Throws BadInput if a row cannot be written.
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override;
    [[nodiscard]] bool wants_look(std::int64_t step) const override;
    void save(StateWriter& state) override;
    /// Throws BadInput if rows that were written are gone.
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;
    /// The run is complete: gives the file its name. Throws BadInput if it cannot.
    void finish();

private:
    void look_up(const Scene<Dim>& scene, const RunResult<Dim>& result);
    /// The cells that a probe looks at, and their shares.
    struct Watched {
        std::vector<std::int32_t> cells;
        std::vector<double> weights;
        std::vector<Vector<Dim>> arms;  // from the centroid of the cell to the place [m]
    };
    [[nodiscard]] static Watched watched(const mesh::Mesh<Dim>& mesh, const Probe<Dim>& probe);

    PartialFile file_;
    std::vector<Watched> probes_;
    std::int64_t interval_ = 1;
    std::int64_t n_steps_ = 0;
};

/// The cell of a body that holds a place at rest; of one that is beside all cells, but by no more than half the size of the
/// nearest, that one. Throws BadInput with the distance for a place that is farther.
template <int Dim>
[[nodiscard]] std::int32_t cell_at(const mesh::Mesh<Dim>& mesh, std::int32_t body, const Vector<Dim>& position);

}  // namespace abut::run
