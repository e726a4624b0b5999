#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>

#include "abut/solid/cells/cell_moments.hpp"
#include "abut/solid/cells/sweep_tables.hpp"

namespace abut::solid {

/// Puts corrections where the sweeps see them, face by face and cell by cell, until the end of its life:
/// SweepTables::correction and pair_gradient of boundary faces, zero everywhere else, and the moments of cells.
template <int Dim, class Real>
class PlacedCorrections {
public:
    /// All must outlive it.
    PlacedCorrections(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite, const SweepUnits<Dim, Real>& units,
                      const SweepTables<Dim, Real>& tables, CellMoments<Dim>& moments,
                      const FaceCorrections<Dim>& corrections)
        : arrays_(arrays), units_(units), tables_(tables), moments_(moments), corrections_(corrections) {
        moments.assign(arrays, finite, corrections);
        for (std::size_t i = 0; i < corrections.faces.size(); ++i) {
            if (!corrections.energy_gradient.empty())
                store(units.force(load_packed<Dim>(corrections.energy_gradient[i])), tables.pair_gradient.data,
                      number_of(corrections.faces[i]));
            if (corrections.displacement.empty()) continue;
            const Vector<Dim>& correction = corrections.displacement[i];
            add(correction, corrections.faces[i]);
            arrays.boundary.for_each_answer(
                corrections.faces[i], [&](BoundaryFace face, const Matrix<Dim>& answer) { add(answer * correction, face); });
        }
    }
    ~PlacedCorrections() {
        moments_.clear();
        for (const BoundaryFace face : corrections_.faces) {
            store(Lanes<Dim, Real>{}, tables_.correction.data, number_of(face));
            store(Lanes<Dim, Real>{}, tables_.pair_gradient.data, number_of(face));
            arrays_.boundary.for_each_answer(face, [&](BoundaryFace answering, const Matrix<Dim>&) {
                store(Lanes<Dim, Real>{}, tables_.correction.data, number_of(answering));
            });
        }
    }
    PlacedCorrections(const PlacedCorrections&) = delete;
    PlacedCorrections& operator=(const PlacedCorrections&) = delete;

private:
    void add(const Vector<Dim>& correction, BoundaryFace face) {
        const std::int32_t b = number_of(face);
        store(load<Lanes<Dim, Real>>(tables_.correction.data, b) + units_.displacement(load_packed<Dim>(correction)),
              tables_.correction.data, b);
    }

    const CcgArrays<Dim>& arrays_;
    const SweepUnits<Dim, Real>& units_;
    const SweepTables<Dim, Real>& tables_;
    CellMoments<Dim>& moments_;
    const FaceCorrections<Dim>& corrections_;
};

}  // namespace abut::solid
