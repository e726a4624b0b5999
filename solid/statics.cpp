#include "abut/solid/statics.hpp"

#include <LBFGS.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/sparse.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/rigid_motions.hpp"

namespace abut::solid {
namespace {

/// Measure by which a step is judged. Near the minimum values of V differ by less than their rounding.
enum class Descent {
    potential,  ///< V itself
    /// V from the last state by the trapezoidal rule on its slope (the approximate Wolfe conditions of Hager and Zhang)
    slope,
};

/// Why a descent ends.
enum class Ending {
    balanced,    ///< all forces are as small as they should be
    lowest,      ///< V falls no more
    stuck,       ///< no step goes down any more
    iterations,  ///< all of them are used up
};

/// Ends the minimiser from inside: it has no other means.
struct Finished {
    Ending ending;
};

constexpr int window = 100;             // iterations within which V must fall
constexpr double nearly_closed = 1e-6;  // of the smallest depth: a gap this small may close
constexpr double rounding_of_potential = 1e-12;
constexpr double balanced_elsewhere = 1e-3;  // of the largest stress: where more is left away from contact, V is not lowest

void check_options(const StaticOptions& options) {
    const auto refuse = [](const std::string& what, double value, double allowed) {
        throw BadInput("statics: " + what, {.value = value, .allowed = allowed});
    };
    if (!(options.tolerance > 0.0))
        refuse("tolerance is " + number(options.tolerance) + "; it must be > 0. 1e-8 is the default.", options.tolerance,
               0.0);
    if (!(options.potential_tolerance >= 0.0))
        refuse("potential_tolerance is " + number(options.potential_tolerance) +
                   "; it must be 0 or more. 1e-11 is the default.",
               options.potential_tolerance, 0.0);
    if (options.iterations < 1)
        refuse("iterations is " + std::to_string(options.iterations) + "; at least 1 is needed.", options.iterations, 1.0);
    if (options.history < 1)
        refuse("history is " + std::to_string(options.history) + "; at least 1 is needed. 20 is the default.",
               options.history, 1.0);
    if (!(options.first_step >= 0.0 && std::isfinite(options.first_step)))
        refuse("first_step is " + number(options.first_step) + " m; it must be 0 (chosen) or more.", options.first_step,
               0.0);
}

template <int Dim>
double smallest_cell_depth(const mesh::Mesh<Dim>& mesh) {
    double depth = std::numeric_limits<double>::infinity();
    for (const std::int32_t f : mesh.boundary_faces) depth = std::min(depth, cell_depth(mesh, f));
    return depth;
}

/// Stiffness of each cell between the planes of its faces [N/m]: near enough to the diagonal of K.
template <int Dim>
Eigen::VectorXd stiffness_between_faces(const Solid<Dim>& solid) {
    const mesh::Mesh<Dim>& mesh = solid.mesh();
    Eigen::VectorXd result(static_cast<Eigen::Index>(solid.size()));
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        double stiffness = 0.0;
        for (const std::int32_t f : mesh.cell_faces[c])
            stiffness +=
                mesh.face_measure[f] / std::abs((mesh.face_centroid[f] - mesh.cell_centroid[c]).dot(mesh.face_normal[f]));
        result.segment<Dim>(Eigen::Index{c} * Dim)
            .setConstant(stiffness * solid.options().materials[mesh.cell_body[c]].wave_modulus());
    }
    return result;
}

/// Objective that L-BFGS minimises: V over scaled unknowns, in which the curvature is about the same in all directions.
template <int Dim>
class Objective {
public:
    Objective(Solid<Dim>& solid, const StaticOptions& options, std::span<const double> q_0)
        : solid_(solid), options_(options), q_(q_0.begin(), q_0.end()), force_(solid.size()) {
        scale_ = stiffness_between_faces(solid).cwiseSqrt().cwiseInverse();
        base_ = dynamics::dense(q_0).cwiseQuotient(scale_);
    }

    /// The state that the descent goes on from.
    [[nodiscard]] const Eigen::VectorXd& base() const { return base_; }
    [[nodiscard]] std::vector<double> q() const {
        const Eigen::VectorXd q = scale_.cwiseProduct(base_);
        return {q.begin(), q.end()};
    }
    [[nodiscard]] StaticReport& report() { return report_; }
    void begin_descent(Descent descent) {
        descent_ = descent;
        descent_begins_ = true;
    }
    [[nodiscard]] bool descent_begins() const { return descent_begins_; }

    /// V and its gradient; not a number where the state is out of reach, which makes the search shorten its step.
    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
        dynamics::dense(std::span<double>(q_)) = scale_.cwiseProduct(x);
        ++report_.evaluations;
        try {
            const double value = evaluate(x, gradient);
            error_ = nullptr;
            return value;
        } catch (const std::exception&) {
            error_ = std::current_exception();
            return std::numeric_limits<double>::quiet_NaN();
        }
    }

    /// Why the last state was out of reach; empty: it was not.
    [[nodiscard]] std::exception_ptr error() const { return error_; }

    /// Length of the first step along a direction: whole, unless a cell would move too far.
    [[nodiscard]] double first_step(const Eigen::VectorXd& direction) const {
        const double allowed = options_.first_step > 0.0 ? options_.first_step : 0.1 * smallest_cell_depth(solid_.mesh());
        const double moved = scale_.cwiseProduct(direction).cwiseAbs().maxCoeff();
        return std::min(1.0, allowed / moved);
    }

    /// A line search begins at x, where the function was evaluated last. Gives the value there; throws Finished.
    double begin_search(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, double value) {
        descent_begins_ = false;
        base_ = x;
        base_gradient_ = gradient;
        report_.residual = report_.residual_elsewhere = residual_;
        report_.compression = solid_.contact().compression();
        report_.iterations.push_back(
            {report_.evaluations, residual_, descent_ == Descent::potential ? value : solid_.potential(q_)});
        if (residual_ <= options_.tolerance) throw Finished{Ending::balanced};
        if (std::cmp_greater(report_.iterations.size(), options_.iterations)) throw Finished{Ending::iterations};
        if (falls_no_more()) throw Finished{Ending::lowest};
        return descent_ == Descent::potential ? value : 0.0;
    }

    /// Goes back to a state where V was lower.
    void go_back(const Eigen::VectorXd& x) { base_ = x; }

    /// Brings the report to the state reached.
    void update_report() {
        const std::vector<double> reached = q();
        std::vector<BoundaryFace> faces;
        for (const TouchingPair<Dim>& pair :
             solid_.contact_at(reached).touching_pairs(nearly_closed * smallest_cell_depth(solid_.mesh())))
            for (const BoundaryFace face : {pair.face_1, pair.face_2})
                if (face != no_face) faces.push_back(face);
        sort_unique(faces);
        solid_.force(reached, force_);
        report_.compression = solid_.contact().compression();
        report_.residual = residual();
        report_.residual_elsewhere = residual(solid_.ccg().region_of_faces(faces).input_cells);
        touches_ = !faces.empty();
    }
    /// Whether all that is out of balance there is around contacts.
    [[nodiscard]] bool is_balanced_elsewhere() const { return touches_ && report_.residual_elsewhere <= balanced_elsewhere; }
    /// V of the last iteration [J].
    [[nodiscard]] double potential() const { return report_.iterations.back().potential; }

private:
    [[nodiscard]] bool falls_no_more() const {
        const auto& steps = report_.iterations;
        if (descent_ != Descent::potential || steps.size() <= window) return false;
        const double fallen = steps[steps.size() - 1 - window].potential - steps.back().potential;
        return fallen < options_.potential_tolerance * (steps.front().potential - steps.back().potential);
    }

    double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
        solid_.force(q_, force_);
        gradient = -scale_.cwiseProduct(dynamics::dense(std::span<const double>(force_)));
        residual_ = residual();
        if (descent_ == Descent::potential || base_gradient_.size() == 0) return solid_.potential(q_);
        return 0.5 * (gradient + base_gradient_).dot(x - base_);
    }

    /// Residual of all cells but some, which are given in increasing order.
    [[nodiscard]] double residual(std::span<const std::int32_t> left_out = {}) const {
        const mesh::Mesh<Dim>& mesh = solid_.mesh();
        const auto force = as_vectors<Dim>(std::span<const double>(force_));
        double left = 0.0, stress = 0.0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            stress = std::max(stress, solid_.ccg().stress(c).norm());
            if (std::ranges::binary_search(left_out, c)) continue;
            double area = 0.0;
            for (const std::int32_t f : mesh.cell_faces[c]) area += mesh.face_measure[f];
            left = std::max(left, force[c].norm() / area);
        }
        return left == 0.0 ? 0.0 : left / stress;
    }

    Solid<Dim>& solid_;
    const StaticOptions& options_;
    std::vector<double> q_;
    std::vector<double> force_;
    Eigen::VectorXd scale_;
    Eigen::VectorXd base_;
    Eigen::VectorXd base_gradient_;
    Descent descent_ = Descent::potential;
    bool descent_begins_ = true;
    double residual_ = std::numeric_limits<double>::infinity();
    bool touches_ = false;
    std::exception_ptr error_;
    StaticReport report_;
};

/// The library's line search, with the objective told where it begins.
template <class Scalar>
struct ToldLineSearch {
    template <class Function, class Array>
    static void LineSearch(Function& function, Scalar& value, Array& x, Array& gradient, Scalar& step,
                           const Array& direction, const Array& x_0, const LBFGSpp::LBFGSParam<Scalar>& parameters) {
        if (function.descent_begins()) step = function.first_step(direction);
        value = function.begin_search(x_0, gradient, value);
        LBFGSpp::LineSearchBracketing<Scalar>::LineSearch(function, value, x, gradient, step, direction, x_0, parameters);
    }
};

LBFGSpp::LBFGSParam<double> parameters(const StaticOptions& options) {
    LBFGSpp::LBFGSParam<double> result;
    result.m = options.history;
    result.epsilon = 0.0;  // the objective decides
    result.epsilon_rel = 0.0;
    result.max_iterations = 0;
    result.linesearch = LBFGSpp::LBFGS_LINESEARCH_BACKTRACKING_WOLFE;
    result.max_linesearch = 20;
    return result;
}

template <int Dim>
Ending descend(Objective<Dim>& objective, const StaticOptions& options) {
    const auto settings = parameters(options);
    LBFGSpp::LBFGSSolver<double, ToldLineSearch> solver(settings);
    Eigen::VectorXd x = objective.base();
    double value = 0.0;
    try {
        solver.minimize(objective, x, value);
        return Ending::balanced;  // not a force at all
    } catch (const Finished& finished) {
        return finished.ending;
    } catch (const std::runtime_error&) {  // of the line search
        return Ending::stuck;
    } catch (const std::logic_error&) {
        return Ending::stuck;
    }
}

/// Down by values of V first, then by slopes, as long as these bring it closer. Where V has edges these do not, and may lead
/// up: then what was reached before counts.
template <int Dim>
Ending approach(Objective<Dim>& objective, const StaticOptions& options) {
    StaticReport& report = objective.report();
    const Ending first = descend(objective, options);
    if (objective.error() && report.iterations.empty()) std::rethrow_exception(objective.error());
    if (first == Ending::balanced || first == Ending::iterations) return first;
    const Eigen::VectorXd lowest = objective.base();
    const double potential = objective.potential();
    for (double last = std::numeric_limits<double>::infinity(); report.residual < 0.1 * last;) {
        last = report.residual;
        ++report.restarts;
        objective.begin_descent(Descent::slope);
        const Ending ending = descend(objective, options);
        if (ending == Ending::balanced || ending == Ending::iterations) return ending;
    }
    if (objective.potential() > potential + rounding_of_potential * std::abs(potential)) objective.go_back(lowest);
    objective.update_report();
    return objective.is_balanced_elsewhere() ? Ending::lowest : Ending::stuck;
}

std::string words_of_ending(Ending ending, const StaticOptions& options) {
    switch (ending) {
        case Ending::balanced:
            return "The forces are in balance.";
        case Ending::lowest:
            return "The potential falls no more: around contacts that just open, or whose overlap changes its formula, "
                   "forces have no balance.";
        case Ending::stuck:
            return "No step goes down any more: rounding allows no better solution, or there is none.";
        case Ending::iterations:
            return std::to_string(options.iterations) + " iterations were not enough. Allow more, or ask for less.";
    }
    throw BadInput("not an Ending");
}

template <int Dim>
void check_start(const Solid<Dim>& solid, std::span<const double> q) {
    const SolidOptions<Dim>& options = solid.options();
    FeatureSet sought{Feature::rest};
    sought.add(Feature::loaded_rest, !options.boundary.traction.empty() || !options.moments.empty());
    require_together(solid.mesh(), options, sought);
    if (q.size() != solid.size())
        throw BadInput("statics: q_0 has " + std::to_string(q.size()) + " numbers, the solid has " +
                           std::to_string(solid.size()) + " degrees of freedom. Give one per component of each cell.",
                       {.value = static_cast<double>(q.size()), .allowed = static_cast<double>(solid.size())});
    for (std::size_t i = 0; i < q.size(); ++i)
        if (!std::isfinite(q[i]))
            throw BadInput("statics: q_0 is not finite in cell " + std::to_string(solid.mesh().cell_label[i / Dim]) +
                               ". Start from finite displacements.",
                           {.cell = static_cast<std::int32_t>(i / Dim)});
}

template <int Dim>
void require_held(Solid<Dim>& solid, std::span<const double> q) {
    if (const auto motion = free_rigid_motion(solid, q))
        throw BadInput("statics: " + *motion +
                       ", so that there is no one solution. Prescribe a displacement that stops it, or begin "
                       "with bodies that touch, or are lightly pressed into each other.");
}

}  // namespace

template <int Dim>
StaticSolution solve_statics(Solid<Dim>& solid, std::vector<double> q_0, const StaticOptions& options) {
    check_options(options);
    check_start(solid, q_0);
    require_held<Dim>(solid, q_0);
    Objective<Dim> objective(solid, options, q_0);
    StaticReport& report = objective.report();
    const Ending ending = approach(objective, options);
    report.converged = ending == Ending::balanced || ending == Ending::lowest;
    report.ending = words_of_ending(ending, options);
    std::vector<double> q = objective.q();
    static_cast<void>(solid.potential(q));
    solid.contact().require_depth();
    if (report.converged) return {std::move(q), std::move(report)};
    if (const auto motion = free_rigid_motion(solid, std::span<const double>(q)))
        throw BadInput("statics: after " + std::to_string(report.iterations.size()) + " iterations " + *motion +
                       ": its contact has opened, and the loads carry it away. Prescribe a displacement that stops "
                       "it, or turn the loads.");
    return {std::move(q), std::move(report)};
}

template StaticSolution solve_statics<2>(Solid<2>&, std::vector<double>, const StaticOptions&);
template StaticSolution solve_statics<3>(Solid<3>&, std::vector<double>, const StaticOptions&);

}  // namespace abut::solid
