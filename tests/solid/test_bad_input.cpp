#include <catch2/catch.hpp>

#include "abut/solid/material/material_numbers.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a material out of bounds is refused with the body, the quantity, its value and its limit", "[solid][errors]") {
    const auto mesh = two_discs(0.0, 0.6);
    auto options = reconstructed_bodies<2>(2);
    solid::Material& material = options.materials[1];
    std::string quantity, limit;
    SECTION("poisson") {
        material.poisson = GENERATE(0.5, 0.7, -1.0, -2.0, not_a_number);
        quantity = "poisson", limit = "above -1, below 0.5";
    }
    SECTION("young") {
        material.young = GENERATE(0.0, -1.0, not_a_number, infinite);
        quantity = "young", limit = "above 0 Pa";
    }
    SECTION("density") {
        material.density = GENERATE(0.0, -1.0, not_a_number, infinite);
        quantity = "density", limit = "above 0 kg/m^3";
    }
    SECTION("eta") {
        material.eta = GENERATE(-1.0, not_a_number, infinite);
        quantity = "eta", limit = "0 Pa or above";
    }
    CHECK_THROWS_AS(solid::Solid<2>(mesh, options), BadInput);
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains("body 1") && Contains(quantity) && Contains(limit));
}

TEST_CASE("every number of a material is refused where it is none or beyond its limits, and where another law reads it",
          "[solid][errors]") {
    for (const solid::MaterialNumber& number : solid::material_numbers) {
        CAPTURE(number.name);
        for (const double value : {not_a_number, infinite, -2.0}) {
            if (number.limits.allow(value)) continue;  // an angle, a ratio of any sign
            solid::Material material{.law = number.law.value_or(solid::MaterialLaw::st_venant_kirchhoff)};
            number.at.in(material) = value;
            CHECK_THROWS_WITH(solid::check(material, 3),
                              Contains("body 3") && Contains(number.name) && Contains("is needed"));
        }
        if (!number.law) continue;
        solid::Material other{.law = solid::MaterialLaw::neo_hookean};
        number.at.in(other) = 0.5;
        CHECK_THROWS_WITH(solid::check(other, 3), Contains(number.name) && Contains("its law is not"));
    }
}

TEST_CASE("materials at the edge of what is allowed are taken", "[solid][errors]") {
    const auto mesh = unit_disc(0.6);
    auto options = reconstructed_bodies<2>(1);
    options.materials[0].poisson = GENERATE(-0.99, 0.0, 0.49);
    CHECK_NOTHROW(solid::Solid<2>(mesh, options));
}

TEST_CASE("a wrong number of materials or accelerations, or obstacles that nothing feels, are refused", "[solid][errors]") {
    const auto mesh = two_discs(0.0, 0.6);
    auto options = reconstructed_bodies<2>(2);
    SECTION("materials") {
        options.materials.pop_back();
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains("materials: 1 given") && Contains("2 bodies"));
    }
    SECTION("accelerations") {
        options.acceleration = {Vector<2>::Zero()};
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains("accelerations: 1 given") && Contains("2 bodies"));
    }
    SECTION("obstacles without contact") {
        options.contact.reset();
        options.obstacles = {contact::plane_obstacle<2>({-3.0, 0.0}, {1.0, 0.0}, 1.0)};
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains("1 obstacles") && Contains("SolidOptions::contact"));
    }
    CHECK_THROWS_AS(solid::Solid<2>(mesh, options), BadInput);
}

TEMPLATE_TEST_CASE_SIG("bad boundary conditions are refused by the name of their group", "[solid][errors]", ((int Dim), Dim),
                       2, 3) {
    const auto mesh = mesh::box<Dim>({.size = 0.5, .name = "block"});
    auto options = reconstructed_bodies<Dim>(1);
    solid::DirichletCondition<Dim> condition;
    condition.group = "xmin";
    options.boundary.dirichlet = {condition};
    std::string says = "'xmin'";
    SECTION("an unknown group to hold") {
        options.boundary.dirichlet[0].group = "nowhere";
        says = "nowhere";
    }
    SECTION("an unknown group to load") {
        options.boundary.traction.push_back({.group = "nowhere", .value = Vector<Dim>::Ones(), .history = {}});
        says = "nowhere";
    }
    SECTION("the same direction twice") {
        condition.constraint = solid::Constraint::normal;
        options.boundary.dirichlet.push_back(condition);
    }
    SECTION("no component at all") { options.boundary.dirichlet[0].constraint = solid::Constraint::components; }
    SECTION("a traction where all is prescribed") {
        options.boundary.traction.push_back({.group = "xmin", .value = Vector<Dim>::Ones(), .history = {}});
    }
    CHECK_THROWS_AS(solid::Solid<Dim>(mesh, options), BadInput);
    CHECK_THROWS_WITH(solid::Solid<Dim>(mesh, options), Contains(says));
}

TEMPLATE_TEST_CASE_SIG("loads that are not finite are refused with what they act on, when they are", "[solid][errors]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = mesh::box<Dim>({.size = 0.5, .name = "block"});
    auto options = reconstructed_bodies<Dim>(1);
    const Vector<Dim> bad = Vector<Dim>::Constant(GENERATE(not_a_number, infinite));
    const solid::Field<Dim> later = [bad](double t, const Vector<Dim>&) { return t > 0.0 ? bad : Vector<Dim>::Zero(); };
    std::string says = "'xmin'";
    bool from_the_start = true;
    SECTION("a displacement") { options.boundary.dirichlet.push_back({.group = "xmin", .value = bad, .history = {}}); }
    SECTION("a traction") { options.boundary.traction.push_back({.group = "xmin", .value = bad, .history = {}}); }
    SECTION("a displacement later on") {
        options.boundary.dirichlet.push_back({.group = "xmin", .history = later});
        from_the_start = false;
    }
    SECTION("a traction later on") {
        options.boundary.traction.push_back({.group = "xmin", .history = later});
        from_the_start = false;
    }
    SECTION("gravity") {
        options.acceleration = {bad};
        says = "acceleration of body 0 ('block')";
    }
    SECTION("a force density") {
        options.body_load = [bad](const Vector<Dim>&) { return bad; };
        says = "SolidOptions::body_load";
    }
    SECTION("the path of an obstacle, later on") {
        options.obstacles = {contact::plane_obstacle<Dim>(-2.0 * Vector<Dim>::Unit(0), Vector<Dim>::Unit(0), 1.0,
                                                          [later](double t) { return later(t, Vector<Dim>::Zero()); })};
        says = "obstacle 0";
        from_the_start = false;
    }
    if (from_the_start) {
        CHECK_THROWS_WITH(solid::Solid<Dim>(mesh, options), Contains(says) && Contains("not finite"));
        return;
    }
    solid::Solid<Dim> solid(mesh, options);
    const std::vector<double> zero(solid.size(), 0.0);
    dynamics::Memm<solid::Solid<Dim>> memm(solid, zero, zero, 0.01);
    const auto two_steps = [&] {
        memm.step();
        memm.step();
    };
    CHECK_THROWS_WITH(two_steps(), Contains(says) && Contains("0.01 s") && Contains("not finite"));
}

TEST_CASE("velocities for another number of bodies are refused", "[solid][errors]") {
    const auto mesh = two_discs(0.0, 0.6);
    const solid::Solid<2> solid(mesh, reconstructed_bodies<2>(2));
    const std::vector<Vector<2>> one{{0.05, 0.0}};
    CHECK_THROWS_WITH(solid::uniform_momentum<2>(solid, one), Contains("1 velocities") && Contains("2 bodies"));
}

TEST_CASE("an unknown group is answered with the names that exist", "[solid][errors]") {
    const auto mesh = mesh::box<2>({.size = 0.5});
    auto options = reconstructed_bodies<2>(1);
    solid::DirichletCondition<2> condition;
    condition.group = "left";
    options.boundary.dirichlet = {condition};
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains("xmin") && Contains("ymax"));
}

TEMPLATE_TEST_CASE_SIG("a body one cell thick is refused when the solid is made", "[solid][errors]", ((int Dim), Dim), 2,
                       3) {
    std::array<int, Dim> counts;
    counts.fill(4);
    counts[0] = 1;
    const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts,
                                                Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, "plate");
    const auto options = reconstructed_bodies<Dim>(1);
    CHECK_THROWS_WITH(solid::Solid<Dim>(mesh, options), Contains("plate: face") && Contains("one cell thick"));
}

TEST_CASE("bad contact options are refused when the solid is made", "[solid][errors]") {
    const auto mesh = two_discs(0.0, 0.6);
    auto options = reconstructed_bodies<2>(2);
    options.contact->quadrature = 9;
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains("quadrature is 9"));
}

TEST_CASE("a run that has diverged ends with an error that says so", "[solid][errors]") {
    auto options = reconstructed_bodies<2>(2);
    Scene<2> scene(two_discs(0.0, 0.5), options, disc_velocities, -3.0);
    CHECK_THROWS_WITH(scene.run(5000, 5000), Contains("not finite") || Contains("pressed") || Contains("within a step"));
}
