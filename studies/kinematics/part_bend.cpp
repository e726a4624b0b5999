#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/statics.hpp"
#include "studies/kinematics/closed_forms.hpp"
#include "studies/kinematics/rows.hpp"

namespace abut::studies::kinematics {
namespace bend_part {
namespace {

constexpr double height = 0.1, poisson = 0.3;  // of a cantilever of length 1, E = rho = 1
constexpr double period = 59.0;                // of its softest mode, 2 pi/(3.516 sqrt(E I/(rho A))) [s]

/// A cantilever whose last column of cells carries the load; what lies beyond the centre of that hangs on it.
struct Cantilever {
    int along, across;
    [[nodiscard]] double column() const { return 1.0 / along; }
    [[nodiscard]] double length() const { return 1.0 - 0.5 * column(); }
    [[nodiscard]] bool is_loaded(const Vector<2>& x) const { return x[0] > 1.0 - column(); }
};

solid::SolidOptions<2> clamped(Kinematics kinematics) {
    solid::SolidOptions<2> options;
    options.materials = {{.young = 1.0, .poisson = poisson, .density = 1.0}};
    options.kinematics = {kinematics};
    solid::DirichletCondition<2> clamp;
    clamp.group = "xmin";
    options.boundary.dirichlet.push_back(clamp);
    return options;
}

/// Displacements of the cells in balance with a dead load of alpha E I/L^2 at the tip.
std::vector<double> bent(const mesh::Mesh<2>& mesh, const Cantilever& beam, Kinematics kinematics, double alpha) {
    const double stiffness = std::pow(height, 3) / (12.0 * (1.0 - poisson * poisson));
    const double density = alpha * stiffness / (beam.length() * beam.length()) / (height * beam.column());
    auto options = clamped(kinematics);
    options.body_load = [=](const Vector<2>& x) -> Vector<2> { return Vector<2>(0.0, beam.is_loaded(x) ? density : 0.0); };
    solid::Solid<2> solid(mesh, options);
    return solid::solve_statics<2>(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-7}).q;
}

void bend(const Cantilever& beam, Kinematics kinematics, double alpha, double allowed, const Options& options,
          const Sink& sink) {
    const auto mesh =
        mesh::structured_box<2>({0.0, 0.0}, {1.0, height}, {beam.along, beam.across}, mesh::CellShape::triangle);
    const std::vector<double> q = bent(mesh, beam, kinematics, alpha);
    std::map<std::pair<double, double>, Vector<2>> displacement;
    double tip = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const Vector<2>& x = mesh.cell_centroid[c];
        const Vector<2> u = as_vectors<2>(std::span<const double>(q))[c];
        displacement.emplace(std::pair(x[0], x[1]), u);
        if (beam.is_loaded(x)) tip += mesh.cell_measure[c] / (height * beam.column()) * u[1];
    }
    Case<2> one = case_of<2>("cantilever", {mesh}, kinematics);
    one.is_free = false;
    one.scene.contact = false;
    one.scene.solid = clamped(kinematics);
    one.scene.displacement = [=](const Vector<2>& x) { return displacement.at({x[0], x[1]}); };
    solid::Solid<2> at_rest(mesh, one.scene.solid);
    one.scene.energy_scale = {.name = "V0", .value = at_rest.potential(q)};
    one.scene.time = (options.quick || beam.across > 4 ? 0.2 : 4.0) * period;
    solid::FiniteExtremes extremes;
    const Watch<2> watch = [&](const auto&, const auto& solid) { extremes = solid.cells().finite_extremes(); };
    const auto setting = fmt::format("{}, {} x {}, alpha {:g}", run::name_of(kinematics), beam.along, beam.across, alpha);
    Row row = row_of<2>(one, setting, options, nullptr, watch);
    row.quantities.near("deflection of the tip, beside the elastica", tip / beam.length(), elastica_tip(alpha), allowed);
    row.quantities.at_most("H - H~", row.run->excess, 1e-2);
    if (kinematics == Kinematics::finite) {
        row.quantities.at_most("least det F", extremes.determinant);
        row.quantities.at_most("largest |E|", extremes.strain);
    }
    sink(row);
}

}  // namespace
}  // namespace bend_part

void run_bend(const Options& options, const Sink& sink) {
    using namespace bend_part;
    for (const double alpha : {1.0, 2.0, 5.0}) bend({40, 4}, Kinematics::finite, alpha, 0.02, options, sink);
    if (options.quick) return;
    for (const double alpha : {1.0, 2.0, 5.0}) bend({20, 2}, Kinematics::finite, alpha, no_target, options, sink);
    for (const double alpha : {1.0, 2.0, 5.0}) bend({80, 8}, Kinematics::finite, alpha, 0.02, options, sink);
    for (const double alpha : {1.0, 2.0, 5.0}) bend({40, 4}, Kinematics::small, alpha, no_target, options, sink);
}

}  // namespace abut::studies::kinematics
