#include "abut/dynamics/statics.hpp"

#include <LBFGS.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/rigid_motions.hpp"
#include "abut/dynamics/sparse.hpp"
#include "abut/geometry/messages.hpp"

namespace abut::dynamics {
namespace {

/// Gradient and value of what is minimised change with every evaluation, but the values lose their meaning near the minimum:
/// there they differ by less than their rounding.
enum class Descent {
    potential,  ///< V itself
    slope,  ///< V from the last state by the trapezoidal rule on its slope (the approximate Wolfe conditions of Hager and Zhang)
};

/// Ends the minimiser from inside: it has no other way.
struct Finished {
    bool converged;
};

void check(const StaticOptions& options) {
    const auto refuse = [](const std::string& what) { throw std::invalid_argument("statics: " + what); };
    if (!(options.tolerance > 0.0))
        refuse("tolerance is " + number(options.tolerance) + "; it must be > 0. 1e-8 is the default.");
    if (options.iterations < 1) refuse("iterations is " + std::to_string(options.iterations) + "; at least 1 is needed.");
    if (options.history < 1)
        refuse("history is " + std::to_string(options.history) + "; at least 1 is needed. 20 is the default.");
    if (!(options.first_step >= 0.0 && std::isfinite(options.first_step)))
        refuse("first_step is " + number(options.first_step) + " m; it must be 0 (chosen) or more.");
}

template <int Dim>
double smallest_depth(const mesh::Mesh<Dim>& mesh) {
    double depth = std::numeric_limits<double>::infinity();
    for (const std::int32_t f : mesh.boundary_faces)
        depth =
            std::min(depth, (mesh.face_centroid[f] - mesh.cell_centroid[mesh.face_cells[f][0]]).dot(mesh.face_normal[f]));
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

/// What L-BFGS minimises: V over scaled unknowns, in which the curvature is about the same in all directions.
template <int Dim>
class Objective {
public:
    Objective(Solid<Dim>& solid, const StaticOptions& options, std::span<const double> q_0)
        : solid_(solid), options_(options), q_(q_0.begin(), q_0.end()), force_(solid.size()) {
        scale_ = stiffness_between_faces(solid).cwiseSqrt().cwiseInverse();
        base_ = dense(q_0).cwiseQuotient(scale_);
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
        dense(std::span<double>(q_)) = scale_.cwiseProduct(x);
        ++report_.evaluations;
        try {
            const double value = evaluate(x, gradient);
            error_ = nullptr;
            return value;
        } catch (const std::runtime_error&) {
            error_ = std::current_exception();
            return std::numeric_limits<double>::quiet_NaN();
        }
    }

    /// Why the last state was out of reach; empty: it was not.
    [[nodiscard]] std::exception_ptr error() const { return error_; }

    /// Length of the first step along a direction: whole, unless a cell would move too far.
    [[nodiscard]] double first_step(const Eigen::VectorXd& direction) const {
        const double allowed = options_.first_step > 0.0 ? options_.first_step : 0.1 * smallest_depth(solid_.mesh());
        const double moved = scale_.cwiseProduct(direction).cwiseAbs().maxCoeff();
        return std::min(1.0, allowed / moved);
    }

    /// A line search begins at x, where the function was evaluated last. Gives the value there; throws Finished.
    double begin_search(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, double value) {
        descent_begins_ = false;
        base_ = x;
        base_gradient_ = gradient;
        report_.residual = residual_;
        if (const auto* contact = solid_.contact()) report_.compression = contact->result().compression();
        report_.iterations.push_back(
            {report_.evaluations, residual_, descent_ == Descent::potential ? value : solid_.potential(q_)});
        if (residual_ <= options_.tolerance) throw Finished{true};
        if (std::cmp_greater(report_.iterations.size(), options_.iterations)) throw Finished{false};
        return descent_ == Descent::potential ? value : 0.0;
    }

private:
    double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
        solid_.force(q_, force_);
        gradient = -scale_.cwiseProduct(dense(std::span<const double>(force_)));
        residual_ = residual();
        if (descent_ == Descent::potential || base_gradient_.size() == 0) return solid_.potential(q_);
        return 0.5 * (gradient + base_gradient_).dot(x - base_);
    }

    [[nodiscard]] double residual() const {
        const mesh::Mesh<Dim>& mesh = solid_.mesh();
        double left = 0.0, stress = 0.0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            double area = 0.0;
            for (const std::int32_t f : mesh.cell_faces[c]) area += mesh.face_measure[f];
            left = std::max(left, as_vectors<Dim>(std::span<const double>(force_))[c].norm() / area);
            stress = std::max(stress, solid_.ccg().stress(c).norm());
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
    result.linesearch = LBFGSpp::LBFGS_LINESEARCH_BACKTRACKING_STRONG_WOLFE;
    result.max_linesearch = 20;
    return result;
}

/// Goes down until no step goes down any more. Whether it got as far as it should.
template <int Dim>
bool descend(Objective<Dim>& objective, const StaticOptions& options) {
    const auto settings = parameters(options);
    LBFGSpp::LBFGSSolver<double, ToldLineSearch> solver(settings);
    Eigen::VectorXd x = objective.base();
    double value = 0.0;
    try {
        solver.minimize(objective, x, value);
        return true;  // not a force at all
    } catch (const Finished& finished) {
        return finished.converged;
    } catch (const std::runtime_error&) {  // of the line search
        return false;
    } catch (const std::logic_error&) {
        return false;
    }
}

/// Descents, each from where the last one ended, as long as they bring it closer.
template <int Dim>
bool approach(Objective<Dim>& objective, const StaticOptions& options) {
    StaticReport& report = objective.report();
    double last = std::numeric_limits<double>::infinity();
    for (;; ++report.restarts) {
        if (descend(objective, options)) return true;
        if (objective.error() && report.iterations.empty()) std::rethrow_exception(objective.error());
        if (std::cmp_greater(report.iterations.size(), options.iterations)) {
            report.ending = std::to_string(options.iterations) + " iterations were not enough. Allow more, or ask for less.";
            return false;
        }
        if (report.restarts > 0 && !(report.residual < 0.1 * last)) {
            report.ending = "No step goes down any more: rounding allows no better solution, or there is none.";
            return false;
        }
        last = report.residual;
        objective.begin_descent(Descent::slope);
    }
}

template <int Dim>
void require_held(Solid<Dim>& solid, std::span<const double> q) {
    if (const auto motion = free_rigid_motion(solid, q))
        throw std::invalid_argument("statics: " + *motion +
                                    ", so that there is no one solution. Prescribe a displacement that stops it, or begin "
                                    "with bodies that touch, or are lightly pressed into each other.");
}

}  // namespace

template <int Dim>
StaticSolution solve_statics(Solid<Dim>& solid, std::vector<double> q_0, const StaticOptions& options) {
    check(options);
    detail::check_start(solid.size(), q_0, q_0);
    require_held<Dim>(solid, q_0);
    Objective<Dim> objective(solid, options, q_0);
    StaticReport& report = objective.report();
    report.converged = approach(objective, options);
    std::vector<double> q = objective.q();
    if (report.converged)
        report.ending = "The forces are in balance.";
    else if (const auto motion = free_rigid_motion(solid, std::span<const double>(q)))
        throw std::runtime_error(
            "statics: after " + std::to_string(report.iterations.size()) + " iterations " + *motion +
            ": its contact has opened, and the loads carry it away. Prescribe a displacement that stops "
            "it, or turn the loads.");
    return {std::move(q), std::move(report)};
}

template StaticSolution solve_statics<2>(Solid<2>&, std::vector<double>, const StaticOptions&);
template StaticSolution solve_statics<3>(Solid<3>&, std::vector<double>, const StaticOptions&);

}  // namespace abut::dynamics
