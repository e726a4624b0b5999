#pragma once
#include <string>
#include <vector>

namespace abut::solid {

template <int Dim>
class Solid;

/// How good a static solution must be and what it may cost.
struct StaticOptions {
    /// [-] > 0: the largest force left on a cell, over the area of its faces, in units of the largest stress
    double tolerance = 1e-8;
    /// [-] >= 0: where V has an edge at its minimum (a pair of faces just opens there, or its overlap changes its formula)
    /// forces never balance; the search ends when V falls by less than this part of its whole fall within 100 iterations
    double potential_tolerance = 1e-11;
    int iterations = 100'000;  ///< at most
    int history = 20;          ///< last steps that the curvature is learned from
    /// [m] >= 0: how far a cell moves at most in the first iteration, so that a bad start does not throw a body through
    /// another; 0: a tenth of the smallest distance of a boundary face from its cell's centroid
    double first_step = 0.0;
};

/// The state after an iteration.
struct StaticIteration {
    int evaluations;   ///< of the force, so far
    double residual;   ///< as StaticOptions::tolerance counts it [-]
    double potential;  ///< V less the work of the loads [J]
};

struct StaticReport {
    /// The forces are in balance to `tolerance`; or V falls no more and, except in the cells that feel contact, they are to
    /// 1e-3
    bool converged = false;
    std::string ending;  ///< why it stopped, in a sentence
    int evaluations = 0;
    int restarts = 0;       ///< times the curvature was forgotten because no step went down any more
    double residual = 0.0;  ///< [-]
    /// Residual over the cells that feel no contact: at an edge of V those around it stay out of balance [-]
    double residual_elsewhere = 0.0;
    double compression = 0.0;  ///< largest |g|/D of a pair in contact: above 0.3 the result is that of the skin's cells
    std::vector<StaticIteration> iterations;
};

struct StaticSolution {
    std::vector<double> q;  ///< cell by cell, shape (n_cells, Dim) [m]
    StaticReport report;
};

/// The state of least potential, with the loads and prescribed displacements of t = 0 and with contact, found from q_0 by
/// L-BFGS; the curvature is first guessed as that of each cell between its faces. Which pairs may touch is decided as at the
/// start of a run: begin where bodies just touch, or lightly pressed into each other. The solid must not have stepped.
/// docs/method.md, Statics.
///
/// Throws BadInput if q_0 has another size than the solid, if an option is out of range, where a body is free to move as a
/// rigid one (held neither by a prescribed displacement nor by a bond or a contact of q_0), and where a body leaves the
/// others for good; TooDeep where the state reached is pressed in deeper than ContactOptions::compression_limit: a run
/// refuses it, too. A solution that is not as good as asked for is returned with what it reached: see `converged`.
template <int Dim>
[[nodiscard]] StaticSolution solve_statics(Solid<Dim>& solid, std::vector<double> q_0, const StaticOptions& options = {});

}  // namespace abut::solid
