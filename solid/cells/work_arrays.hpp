#pragma once
// Private to the sources of this layer.
#include <cstddef>

#include "abut/base/large_array.hpp"
#include "abut/solid/cells/sweep_tables.hpp"
#include "abut/solid/operator/arrays.hpp"

namespace abut::solid {

/// Arrays that sweeps leave for each other: SweepTables.
template <int Dim, class Real>
struct WorkArrays {
    LargeArray<double> u;
    LargeArray<Real> of_face, g, trace, s, deviation, direct, boundary_y, affine_y, correction, pair_gradient;

    explicit WorkArrays(const CcgArrays<Dim>& arrays) {
        constexpr std::size_t width = lane_width<Dim>;
        const std::size_t n_cells = arrays.cells.size(), n_boundary = arrays.boundary_faces.size();
        u.resize(width * n_cells);
        of_face.resize(width * arrays.faces.size());
        if (!arrays.simplices.all()) {
            g.resize(width * Dim * n_cells);
            trace.resize(width * arrays.half_faces.size());
        }
        s.resize(width * Dim * n_cells);
        deviation.resize(width * n_cells);
        direct.resize(width * n_cells);
        boundary_y.resize(width * n_boundary);
        affine_y.resize(width * arrays.affine.faces.size());
        correction.resize(width * n_boundary);
        pair_gradient.resize(width * n_boundary);
    }

    /// Lets the tables point to the arrays.
    void set(SweepTables<Dim, Real>& tables) {
        tables.u = Table<double>(u);
        tables.of_face = Table<Real>(of_face);
        tables.g = Table<Real>(g);
        tables.trace = Table<Real>(trace);
        tables.s = Table<Real>(s);
        tables.deviation = Table<Real>(deviation);
        tables.direct = Table<Real>(direct);
        tables.boundary_y = Table<Real>(boundary_y);
        tables.affine_y = Table<Real>(affine_y);
        tables.correction = Table<Real>(correction);
        tables.pair_gradient = Table<Real>(pair_gradient);
    }
};

}  // namespace abut::solid
