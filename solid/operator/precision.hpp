#pragma once

namespace abut::solid {

/// Precision of the bulk of a step. Displacements, momenta, contact and energies are double in both.
/// docs/method.md, Single precision.
enum class Precision {
    double_precision,
    single_precision,  ///< in float, where roundings are 2^-24 of a number; for bodies of linear elasticity, on one rank
};

}  // namespace abut::solid
