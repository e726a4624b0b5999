// Patch tests: where a body is deformed affinely and its faces bear what a uniform stress asks of them, no cell has a force on it, and
// each has this stress. All kinds of faces x kinematics x shapes of cells x laws, as far as the table of combinations has them.
//
// Not here: faces that contact or bonds act on, and temperatures (test_contact_field.cpp, test_bonds.cpp, test_thermal.cpp). Of what is
// here `why_not` leaves out what no affine motion fills, or a kinematics does not have, and says why.
#include <catch2/catch.hpp>
#include <map>

#include "abut/solid/cell_view.hpp"
#include "abut/solid/combinations/combinations.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Feature;
using solid::Kinematics;

namespace {

/// The load on a side of the body.
enum class Side {
    free,       // nothing
    dead,       // a traction that keeps its direction
    following,  // one that turns with the body
    pressure,   // one along the normal, which turns with the face
    held,       // its displacement is given
    roller,     // the part along its normal
};
constexpr std::array all_sides{Side::free, Side::dead, Side::following, Side::pressure, Side::held, Side::roller};
constexpr std::array names_of_sides{"free", "dead", "following", "pressure", "held", "roller"};

/// How the body is stretched, in its frame.
enum class Stretching {
    any,       // with shear
    diagonal,  // along the axes of the box
    uniaxial,  // the same, and sides beside x bear nothing
    one_way,   // F = I + a e_x (x) e_x: the side at x = 0 stays
};

template <int Dim>
struct Patch {
    Side ends, sides;  // at xmax (at xmin the same, but `dead` opposite of what is held), and all round beside x
    Kinematics kinematics;
    solid::Material material;
    double turn;  // of the whole body, by an angle that only bodies that turn have
};

bool is_linear(Kinematics kinematics) { return !solid::properties_of(kinematics).finite_strains; }

bool is_along_axes(Side side) { return side == Side::roller || side == Side::pressure; }

template <int Dim>
Stretching stretching_of(const Patch<Dim>& patch) {
    if (patch.sides == Side::free) return Stretching::uniaxial;
    if (!is_linear(patch.kinematics) && patch.ends == Side::held) return Stretching::one_way;
    if (is_along_axes(patch.ends) || is_along_axes(patch.sides)) return Stretching::diagonal;
    // In a frame dead tractions have the arms of the deformed body, those that follow the ones at rest: with shear they do not balance.
    const bool has_frame = solid::properties_of(patch.kinematics).has_frame;
    if (has_frame && patch.ends != patch.sides) return Stretching::diagonal;
    return Stretching::any;
}

/// Why no affine motion fills a combination, or the kinematics does not have it; "": it is tested.
template <int Dim>
std::string why_not(const Patch<Dim>& patch) {
    const auto asks = [&](Side side) { return patch.ends == side || patch.sides == side; };
    const bool finite = !is_linear(patch.kinematics);
    if (patch.ends == Side::free) return "nothing pulls";
    if (asks(Side::held) && !go_together(feature_of(patch.kinematics), Feature::clamp)) return "not held";
    if (asks(Side::roller) && !go_together(feature_of(patch.kinematics), Feature::guide)) return "no rollers";
    if (asks(Side::following) && !go_together(feature_of(patch.kinematics), Feature::following_traction))
        return "follows as a pressure only";
    if (patch.sides == Side::held && !go_together(feature_of(patch.kinematics), Feature::guide))
        return "sides that are held cannot stretch";
    if (finite && patch.ends == Side::held && patch.sides == Side::free) return "a held end does not contract";
    if (patch.turn != 0.0 && (!solid::properties_of(patch.kinematics).turns || asks(Side::held))) return "does not turn";
    return "";
}

/// P of a displacement gradient: C : sym G where strains are linear.
template <int Dim>
Matrix<Dim> first_stress(const Patch<Dim>& patch, const Matrix<Dim>& g) {
    const double lambda = patch.material.lambda(), mu = patch.material.mu();
    if (is_linear(patch.kinematics)) return lambda * g.trace() * Matrix<Dim>::Identity() + mu * (g + g.transpose());
    if (patch.material.law != solid::MaterialLaw::st_venant_kirchhoff)
        return solid::stored_energy<Dim>(patch.material)->at(g).stress;
    return linear_in_green_strain<Dim>(patch.material, g).stress;
}

/// Some stretch of the wanted kind.
template <int Dim>
Matrix<Dim> gradient_of(const Patch<Dim>& patch) {
    Matrix<Dim> g = Matrix<Dim>::Zero();
    const Stretching stretching = stretching_of(patch);
    g(0, 0) = 0.05;
    if (stretching == Stretching::one_way) return g;
    g(1, 1) = -0.03;
    if constexpr (Dim == 3) g(2, 2) = 0.02;
    if (stretching == Stretching::any) {
        g(0, 1) = g(1, 0) = 0.04;
        if constexpr (Dim == 3) g(1, 2) = g(2, 1) = -0.025;
    }
    if (stretching != Stretching::uniaxial) return g;
    for (int iteration = 0; iteration < 50; ++iteration)  // Newton's method with slopes of differences
        for (int k = 1; k < Dim; ++k) {
            constexpr double h = 1e-6;
            Matrix<Dim> more = g, less = g;
            more(k, k) += h;
            less(k, k) -= h;
            const double slope = (first_stress(patch, more)(k, k) - first_stress(patch, less)(k, k)) / (2.0 * h);
            g(k, k) -= first_stress(patch, g)(k, k) / slope;
        }
    return g;
}

template <int Dim>
std::vector<NamedMesh<Dim>> cubes() {
    const Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones();
    std::vector<NamedMesh<Dim>> meshes;
    if constexpr (Dim == 2) {
        meshes.push_back({"quadrangles", mesh::structured_box<2>(lower, upper, {4, 3}, CellShape::quadrangle)});
        meshes.push_back({"triangles", mesh::structured_box<2>(lower, upper, {4, 3}, CellShape::triangle)});
    } else {
        meshes.push_back({"hexahedra", mesh::structured_box<3>(lower, upper, {4, 3, 3}, CellShape::hexahedron)});
        meshes.push_back({"tetrahedra", mesh::structured_box<3>(lower, upper, {3, 2, 2}, CellShape::tetrahedron)});
        meshes.push_back({"prisms", mesh::structured_box<3>(lower, upper, {3, 2, 2}, CellShape::prism)});
        meshes.push_back({"pyramids", mesh::structured_box<3>(lower, upper, {3, 2, 2}, CellShape::pyramid)});
    }
    meshes.push_back({"gmsh", mesh::box<Dim>({.lower = lower, .upper = upper, .size = 0.4})});
    return meshes;
}

/// A body in its patch: options, displacements, and the stress that it has.
template <int Dim>
class Filled {
public:
    explicit Filled(const Patch<Dim>& patch)
        : patch_(patch),
          gradient_(gradient_of(patch)),
          turn_(patch.turn != 0.0 ? turned_by<Dim>(patch.turn) : Matrix<Dim>::Identity()),
          first_stress_(first_stress(patch, gradient_)) {
        options = bodies<Dim>(1);
        options.contact.reset();
        options.materials = {patch.material};
        options.kinematics = {patch.kinematics};
        for (const std::string& name : box_sides(Dim)) add(name);
    }

    [[nodiscard]] Vector<Dim> displacement(const Vector<Dim>& x) const { return turn_ * (x + gradient_ * x) - x; }
    /// Cauchy's, in space.
    [[nodiscard]] Matrix<Dim> stress() const {
        const Matrix<Dim> in_frame = is_linear(patch_.kinematics)
                                         ? first_stress_
                                         : Matrix<Dim>(first_stress_ * stretch().transpose() / stretch().determinant());
        return turn_ * in_frame * turn_.transpose();
    }

    solid::SolidOptions<Dim> options;

private:
    [[nodiscard]] Matrix<Dim> stretch() const { return Matrix<Dim>::Identity() + gradient_; }

    void add(const std::string& name) {
        const int axis = name[0] - 'x';
        const bool is_min = name.ends_with("min");
        const Vector<Dim> normal = (is_min ? -1.0 : 1.0) * Vector<Dim>::Unit(axis);
        Side side = axis == 0 ? patch_.ends : patch_.sides;
        const bool fixes = side == Side::held || side == Side::roller;
        if (axis == 0 && fixes && !is_min) side = Side::dead;
        const Vector<Dim> traction = first_stress_ * normal;
        switch (side) {
            case Side::free:
                CHECK(traction.norm() <= 1e-14);
                break;
            case Side::dead:
                options.boundary.traction.push_back({.group = name, .value = turn_ * traction});
                break;
            case Side::following:
                options.boundary.traction.push_back({.group = name, .value = traction, .follows = true});
                break;
            case Side::pressure:
                options.boundary.traction.push_back({.group = name, .value = traction / area_ratio(axis), .follows = true});
                break;
            case Side::held:
                options.boundary.dirichlet.push_back({.group = name});
                if (stretching_of(patch_) != Stretching::one_way) options.boundary.dirichlet.back().history = field();
                break;
            case Side::roller:
                options.boundary.dirichlet.push_back({.group = name, .constraint = solid::Constraint::normal});
                options.boundary.dirichlet.back().history = field();
                break;
        }
    }
    [[nodiscard]] solid::Field<Dim> field() const {
        return [*this](double, const Vector<Dim>& x) { return displacement(x); };
    }
    /// Area of a stretched face across `axis` over that at rest; 1 if a pressure acts on the area at rest.
    [[nodiscard]] double area_ratio(int axis) const {
        return is_linear(patch_.kinematics) ? 1.0 : stretch().determinant() / stretch()(axis, axis);
    }

    Patch<Dim> patch_;
    Matrix<Dim> gradient_, turn_, first_stress_;
};

/// The largest force on a cell over that of the traction on a face, and how far a stress is off, over the stress.
template <int Dim>
std::pair<double, double> errors_of(const mesh::Mesh<Dim>& mesh, const Filled<Dim>& filled) {
    solid::Solid<Dim> solid(mesh, filled.options);
    std::vector<double> q, force(solid.size());
    for (const Vector<Dim>& x : solid.rest_positions()) {
        const Vector<Dim> u = filled.displacement(x);
        q.insert(q.end(), u.begin(), u.end());
    }
    solid.mean_force(q, q, 0.0, 0.01, force);
    double area = 0.0, stress = 0.0;
    for (const std::int32_t f : mesh.boundary_faces) raise(area, mesh.face_measure[static_cast<std::size_t>(f)]);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) raise(stress, (solid.cells().stress(c) - filled.stress()).norm());
    return {largest(force) / (area * filled.stress().norm()), stress / filled.stress().norm()};
}

/// A slab of triangles with a roof on each of its upper edges: a triangle with two free faces that turn by `degrees`.
mesh::Mesh<2> roofed_slab(double degrees) {
    constexpr int n = 4, rows = 2;
    mesh::CellSoup<2> soup;
    soup.name = soup.body_names.emplace_back("slab");
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= n; ++i) soup.vertices.push_back({double(i), double(j)});
    const auto node = [&](int i, int j) { return j * (n + 1) + i; };
    const auto append = [&](std::vector<std::int32_t> corners) {
        soup.cell_shape.push_back(CellShape::triangle);
        soup.cell_vertices.append(corners);
        soup.cell_body.push_back(0);
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < n; ++i) {
            append({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
            append({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    const double height = 0.5 * std::tan(degrees * M_PI / 360.0);
    for (int i = 0; i < n; ++i) {
        append({node(i, rows), node(i + 1, rows), static_cast<std::int32_t>(soup.vertices.size())});
        soup.vertices.push_back({i + 0.5, rows + height});
    }
    return mesh::build_mesh<2>(std::move(soup));
}

std::vector<solid::Material> materials_of(Kinematics kinematics) {
    const solid::Material plain{.young = 1.0, .poisson = 0.3, .density = 1.0};
    std::vector<solid::Material> materials{plain};
    solid::Material metal = plain;
    metal.law = solid::MaterialLaw::j2;
    metal.flow.yield_stress = 1.0;  // it does not flow
    metal.flow.hardening = 0.1;
    if (is_linear(kinematics)) {
        materials.push_back(metal);
    } else {
        materials.push_back(plain);
        materials.back().law = solid::MaterialLaw::neo_hookean;
    }
    return materials;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a uniform stress balances what acts on faces of every kind, in cells of every shape",
                       "[solid][patch]", ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    CAPTURE(solid::properties_of(kinematics).name);
    const auto meshes = cubes<Dim>();
    int n_tested = 0;
    std::map<std::string, int> left_out;
    for (const solid::Material& material : materials_of(kinematics))
        for (const Side ends : all_sides)
            for (const Side sides : all_sides)
                for (const double turn : {0.0, 0.7}) {
                    const Patch<Dim> patch{ends, sides, kinematics, material, turn};
                    if (const std::string why = why_not(patch); !why.empty()) {
                        ++left_out[why];
                        continue;
                    }
                    const Filled<Dim> filled(patch);
                    for (const auto& [name, mesh] : meshes) {
                        CAPTURE(name, names_of_sides[static_cast<std::size_t>(ends)],
                                names_of_sides[static_cast<std::size_t>(sides)], turn, int(material.law));
                        const auto [force, stress] = errors_of(mesh, filled);
                        CHECK(force <= 1e-12);
                        CHECK(stress <= 1e-12);
                        ++n_tested;
                    }
                }
    INFO("left out:");
    for (const auto& [why, n] : left_out) UNSCOPED_INFO(why << ": " << n);
    CHECK(n_tested >= 2 * std::ssize(meshes) * (kinematics == Kinematics::small ? 16 : 12));
}

TEST_CASE("a finite triangle bears a stretch along two free faces that turn by less than 28 degrees, and none at a corner",
          "[solid][patch]") {
    const double degrees = GENERATE(0.5, 6.0, 15.0, 23.0, 27.0, 40.0, 90.0), strain = 0.05;
    CAPTURE(degrees);
    const auto mesh = roofed_slab(degrees);
    const solid::Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
    solid::Solid<2> solid(mesh, alone<2>(material));
    static_cast<void>(solid.potential(sampled<2>(mesh, [&](const Vector<2>& x) -> Vector<2> {
        return {strain * x[0], 0.0};
    })));
    // Plane stress along x, F = (1 + strain) e_x (x) e_x + r e_y (x) e_y
    const double lambda = material.lambda(), mu = material.mu(), green = strain + 0.5 * strain * strain;
    const double stress = 4.0 * mu * (lambda + mu) / (lambda + 2.0 * mu) * green;
    const double r = std::sqrt(1.0 - 2.0 * lambda / (lambda + 2.0 * mu) * green);
    const Matrix<2> of_plane = stress * (1.0 + strain) / r * Vector<2>::UnitX() * Vector<2>::UnitX().transpose();
    int n_roofs = 0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        if (mesh.cell_centroid[c][1] < 2.0) continue;
        ++n_roofs;
        const Matrix<2> expected = degrees < 28.0 ? of_plane : Matrix<2>::Zero();
        CHECK((solid.cells().stress(c) - expected).norm() <= 1e-13);
    }
    CHECK(n_roofs == 4);
}

TEMPLATE_TEST_CASE_SIG("a bond of finite blocks bears a uniform tension, in their edges and corners, too", "[solid][patch]",
                       ((int Dim), Dim), 2, 3) {
    // Meshes that do not match; the bond opens by t (d_1 + d_2)/2 of the wave modulus, d being |c|/|f| of the cells behind it.
    const CellShape shape = GENERATE(Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, CellShape::triangle);
    if (Dim == 3 && shape == CellShape::triangle) return;
    const solid::Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
    const Patch<Dim> patch{Side::dead, Side::free, Kinematics::finite, material, 0.0};
    const Matrix<Dim> gradient = gradient_of(patch), first = first_stress(patch, gradient);
    const Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones(), along = Vector<Dim>::UnitX();
    const auto counts = [](std::int32_t nx, std::int32_t n) {
        std::array<std::int32_t, Dim> all;
        all.fill(n);
        all[0] = nx;
        return all;
    };
    const auto mesh = together(mesh::structured_box<Dim>(lower - along, upper - along, counts(4, 3), shape, "a"),
                               mesh::structured_box<Dim>(lower, upper, counts(5, 4), shape, "b"));
    auto options = finite_of<Dim>(material, 2);
    options.contact.reset();
    options.bonds = {{.sides = {0, 1}, .strength = 1.0}};
    const Vector<Dim> traction = first * along;
    options.boundary.traction = {{.group = "a.xmin", .value = -traction}, {.group = "b.xmax", .value = traction}};
    solid::Solid<Dim> solid(mesh, options);
    const double depth = (1.0 / 4 + 1.0 / 5) * (shape == CellShape::triangle ? 0.5 : 1.0);
    const Vector<Dim> opening = 0.5 * depth / material.wave_modulus() * traction;
    std::vector<double> q, force(solid.size());
    for (const Vector<Dim>& x : solid.rest_positions()) {
        const Vector<Dim> u = gradient * x + (x[0] > 0.0 ? opening : Vector<Dim>::Zero());
        q.insert(q.end(), u.begin(), u.end());
    }
    solid.mean_force(q, q, 0.0, 0.01, force);
    CHECK(largest(force) <= 1e-13);
    const Matrix<Dim> stretch = Matrix<Dim>::Identity() + gradient;
    const Matrix<Dim> stress = first * stretch.transpose() / stretch.determinant();
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) CHECK((solid.cells().stress(c) - stress).norm() <= 1e-13);
}
