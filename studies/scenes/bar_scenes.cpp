#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "studies/scenes/bars.hpp"

namespace abut::studies {
namespace {

template <int Dim>
constexpr mesh::CellShape brick = Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron;

/// A box of square cross-section along the axis, its middle at the origin of the others.
template <int Dim>
mesh::Mesh<Dim> strip(double bottom, double top, double width, int across, int along, const std::string& name) {
    Vector<Dim> lower = Vector<Dim>::Constant(-0.5 * width), upper = -lower;
    lower[bar_axis<Dim>] = bottom;
    upper[bar_axis<Dim>] = top;
    std::array<int, Dim> counts;
    counts.fill(across);
    counts[bar_axis<Dim>] = along;
    return mesh::structured_box<Dim>(lower, upper, counts, brick<Dim>, name);
}

/// Names of the sides of a box, all except its ends.
template <int Dim>
std::vector<std::string> side_names() {
    if constexpr (Dim == 2)
        return {"xmin", "xmax"};
    else
        return {"xmin", "xmax", "ymin", "ymax"};
}

template <int Dim>
void add_rollers(solid::SolidOptions<Dim>& solid, const std::string& prefix = "") {
    for (const std::string& side : side_names<Dim>())
        solid.boundary.dirichlet.push_back({.group = prefix + side, .constraint = solid::Constraint::normal});
}

}  // namespace

BarChain bar_chain(const BarOnWall& scene, int cells) {
    using Bond = dynamics::Bond<dynamics::LineSpring>;
    const double h = scene.bar.length / cells, stiffness = scene.bar.young / h, mass = scene.bar.density * h;
    std::vector<Bond> bonds = {{Bond::fixed, 0, {.stiffness = 2.0 * stiffness, .one_sided = true}, Vector<1>(scene.gap)}};
    for (std::int32_t i = 0; i + 1 < cells; ++i) bonds.push_back({i, i + 1, {.stiffness = stiffness}});
    if (scene.held) bonds.push_back({cells - 1, Bond::fixed, {.stiffness = 2.0 * stiffness}});
    const auto n = static_cast<std::size_t>(cells);
    return {std::vector<double>(n, 1.0 / mass), bonds, std::vector<double>(n, -mass * scene.gravity)};
}

double strip_width(const Bar& bar, int cells) { return 2.0 * bar.length / cells; }

template <int Dim>
run::Scene<Dim> bar_strip(const BarOnWall& scene, int cells) {
    const Bar& bar = scene.bar;
    const Vector<Dim> up = Vector<Dim>::Unit(bar_axis<Dim>);
    const double width = strip_width(bar, cells), eta = scene.eta == 0.0 ? bar.young : scene.eta;
    run::Scene<Dim> result;
    result.mesh = strip<Dim>(scene.gap, scene.gap + bar.length, width, 2, cells, "bar");
    result.solid.law = solid::ContactLaw::reconstruction;  // figures of docs/validation.md
    result.solid.materials = {{.young = bar.young, .poisson = 0.0, .density = bar.density, .eta = eta}};
    if (scene.gravity != 0.0) result.solid.acceleration = {Vector<Dim>(-scene.gravity * up)};
    add_rollers(result.solid);
    if (scene.held) result.solid.boundary.dirichlet.push_back({.group = Dim == 2 ? "ymax" : "zmax"});
    result.solid.obstacles = {contact::plane_obstacle<Dim>(Vector<Dim>::Zero(), up, bar.length)};
    result.velocity = {Vector<Dim>(-scene.speed * up)};
    if (scene.displacement)
        result.displacement = [u = scene.displacement, up](const Vector<Dim>& x) { return Vector<Dim>(u(x.dot(up)) * up); };
    result.time = scene.time;
    result.energy_scale = {"H0", scene.energy * cross_section<Dim>(width)};
    result.remedy_if_overlapping = "The bar is one body.";
    result.options = {{"cells", cells}, {"eta", eta}};
    return result;
}

double two_strips_width(const Bar& bar, std::array<int, 2> cells) { return strip_width(bar, std::ranges::min(cells)); }

template <int Dim>
run::Scene<Dim> two_bar_strips(const TwoBars& scene, std::array<int, 2> cells) {
    const Bar& bar = scene.bar;
    const double width = two_strips_width(bar, cells), near = 0.5 * scene.gap;
    const auto across = [&](int along) { return static_cast<int>(std::lround(width * along / bar.length)); };
    run::Scene<Dim> result;
    const std::vector<mesh::Mesh<Dim>> strips = {
        strip<Dim>(-near - bar.length, -near, width, across(cells[0]), cells[0], "lower"),
        strip<Dim>(near, near + bar.length, width, across(cells[1]), cells[1], "upper")};
    result.mesh = mesh::combine<Dim>(strips);
    result.mesh.name = "bars";
    result.solid.law = solid::ContactLaw::reconstruction;
    const Vector<Dim> up = Vector<Dim>::Unit(bar_axis<Dim>);
    for (std::size_t body = 0; body < 2; ++body) {
        result.solid.materials.push_back({.young = bar.young, .poisson = 0.0, .density = bar.density, .eta = bar.young});
        result.velocity.push_back((body == 0 ? 1.0 : -1.0) * scene.speed[body] * up);
        add_rollers(result.solid, result.mesh.body_names[body] + ".");
    }
    result.time = scene.time;
    result.remedy_if_overlapping = fmt::format("Raise the gap, it is {} m.", scene.gap);
    result.options = {{"cells", std::vector<std::int64_t>(cells.begin(), cells.end())},
                      {"speed", std::vector<double>(scene.speed.begin(), scene.speed.end())}};
    return result;
}

template run::Scene<2> bar_strip<2>(const BarOnWall&, int);
template run::Scene<3> bar_strip<3>(const BarOnWall&, int);
template run::Scene<2> two_bar_strips<2>(const TwoBars&, std::array<int, 2>);
template run::Scene<3> two_bar_strips<3>(const TwoBars&, std::array<int, 2>);

}  // namespace abut::studies
