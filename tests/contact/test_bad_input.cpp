#include <catch2/catch.hpp>

#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;

namespace {

template <int Dim>
contact::Surface<Dim> touching_tiles() {
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.3, 1.0, 0);
    surface.append(tile<Dim>(0.1 * up<Dim>(), -up<Dim>(), 0.5), 0.3, 1.0, 1);
    return surface;
}

template <int Dim>
Vector<Dim> tilted() {
    Vector<Dim> normal = -up<Dim>();
    normal[0] = 1e-3;
    return normal.normalized();
}

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEMPLATE_TEST_CASE_SIG("a good surface passes the check", "[contact][errors]", ((int Dim), Dim), 2, 3) {
    CHECK_NOTHROW(contact::check(touching_tiles<Dim>().view()));
    CHECK_NOTHROW(contact::check(contact::Surface<Dim>{}.view()));
}

TEMPLATE_TEST_CASE_SIG("a bad surface is refused with the face and what is wrong with it", "[contact][errors]",
                       ((int Dim), Dim), 2, 3) {
    auto surface = touching_tiles<Dim>();
    std::string says = "face 1";
    SECTION("arrays of different sizes") {
        surface.cell_depth.pop_back();
        says = "`cell_depth` has 1";
    }
    SECTION("an empty row table") {
        surface.face_offsets.clear();
        says = "`face_offsets` has 0";
    }
    SECTION("a vertex that does not exist") { surface.face_vertices.back() = 99; }
    SECTION("a negative vertex") { surface.face_vertices.back() = -1; }
    SECTION("a corner that is not a number") { surface.vertices.back()[0] = not_a_number; }
    SECTION("too few corners") {
        surface.face_vertices.pop_back();
        surface.face_offsets.back() -= 1;
        if (Dim == 3) {
            surface.face_vertices.pop_back();
            surface.face_offsets.back() -= 1;
        }
    }
    SECTION("no area") { surface.area[1] = 0.0; }
    SECTION("an area that is not a number") { surface.area[1] = not_a_number; }
    SECTION("a centroid that is not a number") { surface.centroid[1][0] = not_a_number; }
    SECTION("a normal that is not unit") { surface.normal[1] *= 1.001; }
    SECTION("a normal that is not a number") { surface.normal[1][0] = not_a_number; }
    SECTION("a negative depth") { surface.cell_depth[1] = -1e-9; }
    SECTION("a depth that is not a number") { surface.cell_depth[1] = not_a_number; }
    SECTION("no depth") { surface.cell_depth[1] = 0.0; }
    SECTION("an area that is not that of the corners") {
        surface.area[1] *= 1.001;
        says = ") m) has the area 1.001, its corners give 1";
    }
    SECTION("a centroid that is not that of the corners") {
        surface.centroid[1][0] += 1e-6;
        says = "centroid 1e-06 m away";
    }
    SECTION("a normal that is not that of the corners") {
        surface.normal[1] = tilted<Dim>();
        says = "away from that of its corners";
    }
    SECTION("offsets that do not begin at 0") {
        surface.face_offsets.front() = 1;
        says = "begins with 1";
    }
    SECTION("offsets that fall") {
        surface.face_offsets[1] = surface.face_offsets[2] + 1;
        says = "falls after face 1";
    }
    SECTION("offsets that end too early") {
        surface.face_vertices.push_back(0);
        says = "ends with";
    }
    SECTION("a negative stiffness") { surface.stiffness[1] = -1.0; }
    SECTION("no stiffness") { surface.stiffness[1] = 0.0; }
    SECTION("a stiffness that is not a number") { surface.stiffness[1] = not_a_number; }
    CHECK_THROWS_AS(contact::check(surface.view()), BadInput);
    CHECK_THROWS_WITH(contact::check(surface.view()), Contains(says));
    using contact::Contact;
    CHECK_THROWS_AS(Contact<Dim>(surface.view(), {}), BadInput);
}

TEST_CASE("a face that is not flat is refused with its deviation", "[contact][errors]") {
    auto surface = touching_tiles<3>();
    surface.vertices.back()[2] += 1e-5;
    CHECK_THROWS_WITH(contact::check(surface.view()), Contains("face 1") && Contains("not flat"));
}

TEST_CASE("a face that is not convex is refused", "[contact][errors]") {
    contact::Surface<3> surface;
    surface.append(std::vector<Vector<3>>{{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}}, 0.1, 1.0, 0);
    CHECK_THROWS_WITH(contact::check(surface.view()), Contains("face 0") && Contains("not convex"));
}

TEST_CASE("a face of too many corners is refused", "[contact][errors]") {
    contact::Surface<3> surface;
    std::vector<Vector<3>> corners;
    for (int i = 0; i <= geometry::max_polygon_vertices; ++i)
        corners.emplace_back(std::cos(0.3 * i), std::sin(0.3 * i), 0.0);
    const auto append = [&] { surface.append(corners, 0.1, 1.0, 0); };
    CHECK_THROWS_WITH(append(), Contains("face 0") && Contains("17 corners"));
    corners.pop_back();
    CHECK_NOTHROW(append());
}

TEST_CASE("a segment has two corners", "[contact][errors]") {
    contact::Surface<2> surface;
    const std::vector<Vector<2>> polyline{{0, 0}, {1, 0}, {2, 1}};
    for (const std::size_t n_corners : {0, 1, 3}) {
        INFO(n_corners << " corners");
        CHECK_THROWS_WITH(surface.append(std::span(polyline).first(n_corners), 0.1, 1.0, 0),
                          Contains("face 0 has " + std::to_string(n_corners) + " corners; 2 are needed"));
    }
    CHECK(surface.size() == 0);
    surface.append(std::span(polyline).first(2), 0.1, 1.0, 0);
    surface.vertices.push_back(polyline[2]);
    surface.face_vertices.push_back(2);
    surface.face_offsets.back() = 3;
    CHECK_THROWS_WITH(contact::check(surface.view()), Contains("3 corners"));
}

TEMPLATE_TEST_CASE_SIG("faces far from the origin pass the check, in map coordinates for one", "[contact][errors]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(3);
    contact::Surface<Dim> surface;
    for (int i = 0; i < 300; ++i) {
        const Vector<Dim> normal = random_vector<Dim>(random, 1.0).normalized();
        const Vector<Dim> centre = random_vector<Dim>(random, 1.0) + 5e6 * Vector<Dim>::Ones();
        surface.append(tile<Dim>(centre, normal, 0.5), 0.1, 1.0, 0);
        if constexpr (Dim == 3)
            surface.append(std::vector<Vector<3>>{centre, centre + normal, centre + normal.unitOrthogonal()}, 0.1, 1.0, 0);
    }
    CHECK_NOTHROW(contact::check(surface.view()));
    surface.centroid[7][0] += 1e-6;  // rounding explains 1e-8
    CHECK_THROWS_WITH(contact::check(surface.view()), Contains("face 7"));
}

TEMPLATE_TEST_CASE_SIG("bad contact options are refused by name", "[contact][errors]", ((int Dim), Dim), 2, 3) {
    const auto surface = touching_tiles<Dim>();
    contact::ContactOptions options;
    std::string says;
    SECTION("four points") {
        options.quadrature = 4;
        says = "quadrature";
    }
    SECTION("minus one points") {
        options.quadrature = -1;
        says = "quadrature";
    }
    SECTION("facing away") {
        options.search.facing_cosine = 0.0;
        says = "facing_cosine";
    }
    SECTION("no angle") {
        options.search.facing_cosine = -1.0;  // nothing would ever be below
        says = "facing_cosine";
    }
    SECTION("angle not a number") {
        options.search.facing_cosine = not_a_number;
        says = "facing_cosine";
    }
    SECTION("negative skin") {
        options.search.skin = -0.1;
        says = "skin";
    }
    SECTION("skin not a number") {
        options.search.skin = not_a_number;
        says = "skin";
    }
    SECTION("endless skin") {
        options.search.skin = std::numeric_limits<double>::infinity();
        says = "skin";
    }
    SECTION("warning not a number") {
        options.compression_warning = not_a_number;
        says = "compression_warning";
    }
    SECTION("no compression") {
        options.compression_limit = 0.0;
        says = "compression_limit";
    }
    SECTION("less than no pairs") {
        options.search.limits.pairs = -5;
        says = "max_pairs is -5; 0 or more";
    }
    SECTION("a broad phase that there is not") {
        options.search.broad_phase = static_cast<geometry::BroadPhase>(5);
        says = "the broad phase is 5; 0 (automatic) to 4";
    }
    SECTION("bodies below 0") {
        options.search.ignored_bodies = {{0, -1}};
        says = "ignored_bodies names body -1";
    }
    SECTION("an area that there is not") {
        options.area = static_cast<geometry::AreaMethod>(2);
        says = "area is 2; 0 (fast) and 1 (exact)";
    }
    SECTION("an overlap that there is not") {
        options.overlap = static_cast<contact::OverlapMode>(-1);
        says = "overlap is -1; 0 (moving) and 1 (frozen)";
    }
    SECTION("a weighting that there is not") {
        options.weighting = static_cast<contact::InterfaceWeighting>(9);
        says = "weighting is 9; 0 (half) and 1 (stiffness)";
    }
    using contact::Contact;
    CHECK_THROWS_AS(Contact<Dim>(surface.view(), options), BadInput);
    CHECK_THROWS_WITH(Contact<Dim>(surface.view(), options), Contains(says));
}

TEMPLATE_TEST_CASE_SIG("pressing deeper than the compression limit is refused with both faces and both numbers",
                       "[contact][errors]", ((int Dim), Dim), 2, 3) {
    const auto surface = touching_tiles<Dim>();
    contact::ContactOptions options;
    options.search.skin = 10.0;
    Mover<Dim> mover(surface, options);
    auto u = at_rest(surface);
    mover.search(u);
    u[1] = -(0.1 + 2.0 * 0.6 - 1e-6) * up<Dim>();  // D = 0.6, the limit is 2
    CHECK_NOTHROW(mover.move_to(u));
    CHECK(mover.contact.report().compressed_steps == 1);
    u[1] = -(0.1 + 2.0 * 0.6 + 1e-6) * up<Dim>();
    CHECK_THROWS(mover.move_to(u));
    u[1] = -(0.1 + 2.5 * 0.6) * up<Dim>();
    CHECK_THROWS_WITH(mover.move_to(u), Contains("face 0 (body 0") && Contains("face 1 (body 1") && Contains("2.5 times") &&
                                            Contains("2 is allowed") && Contains("compression_limit"));
}

TEMPLATE_TEST_CASE_SIG("forces between faces that are not finite are refused with both faces", "[contact][errors]",
                       ((int Dim), Dim), 2, 3) {
    const auto surface = touching_tiles<Dim>();
    contact::Contact<Dim> contact(surface.view(), {.search = {.skin = 1.0}});
    const auto u = at_rest(surface);
    contact.search(u, u, [](std::span<const contact::Face> faces) { return uncoupled<Dim>(faces.size()); });
    auto pressed = u, gradient = u;
    pressed[1] = -0.3 * up<Dim>();
    CHECK_NOTHROW(contact.integrate(1.0, {u, pressed, gradient, gradient}));
    gradient[0] = 1e300 * up<Dim>();
    CHECK_THROWS_AS(contact.integrate(1.0, {u, pressed, gradient, gradient}), Diverged);
    CHECK_THROWS_WITH(contact.integrate(1.0, {u, pressed, gradient, gradient}),
                      Contains("face 0 (body 0") && Contains("face 1 (body 1") && Contains("not finite"));
    CHECK_THROWS_AS(contact.evaluate(pressed, gradient), Diverged);
    gradient[0].setZero();
    CHECK_NOTHROW(contact.integrate(1.0, {u, pressed, gradient, gradient}));
}

TEMPLATE_TEST_CASE_SIG("a search that fails leaves no list behind, and the next one makes it", "[contact][errors]",
                       ((int Dim), Dim), 2, 3) {
    const auto surface = touching_tiles<Dim>();
    contact::Contact<Dim> contact(surface.view(), {.search = {.skin = 1.0}});
    const auto u = at_rest(surface);
    CHECK_THROWS_WITH(contact.integrate(1.0, {u, u, u, u}), Contains("no candidate list"));
    const auto good = [](std::span<const contact::Face> faces) { return uncoupled<Dim>(faces.size()); };
    contact.search(u, u, good);
    REQUIRE(contact.is_valid_for(0.0));
    CHECK_THROWS_WITH(contact.search(u, u, [](auto) -> contact::FaceCoupling<Dim> { throw std::runtime_error("host"); }),
                      "host");
    CHECK_FALSE(contact.is_valid_for(0.0));
    CHECK_THROWS_AS(contact.integrate(1.0, {u, u, u, u}), Misuse);
    CHECK_THROWS_AS(contact.evaluate(u, u), Misuse);
    contact.search(u, u, good);
    CHECK(contact.is_valid_for(0.0));
    CHECK_NOTHROW(contact.integrate(1.0, {u, u, u, u}));
    auto bad = u;
    bad[1][0] = not_a_number;
    CHECK_THROWS_WITH(contact.integrate(1.0, {u, bad, u, u}), Contains("face 1") && Contains("not finite"));
    CHECK_THROWS_WITH(contact.evaluate(u, bad), Contains("face 1") && Contains("not finite"));
}

TEMPLATE_TEST_CASE_SIG("a displacement that is not finite is refused with its face", "[contact][errors]", ((int Dim), Dim),
                       2, 3) {
    const auto surface = touching_tiles<Dim>();
    Mover<Dim> mover(surface, {});
    auto u = at_rest(surface);
    u[1][0] = GENERATE(not_a_number, rigid);
    CHECK_THROWS_AS(mover.search(u), Diverged);
    CHECK_THROWS_WITH(mover.search(u), Contains("face 1") && Contains("not finite"));
}

TEMPLATE_TEST_CASE_SIG("a host's arrays of the wrong size are refused with both sizes", "[contact][errors]",
                       ((int Dim), Dim), 2, 3) {
    const auto surface = touching_tiles<Dim>();
    contact::Contact<Dim> contact(surface.view(), {});
    auto u = at_rest(surface);
    const auto none = [](std::span<const contact::Face> faces) { return uncoupled<Dim>(faces.size()); };
    contact.search(u, u, none);
    REQUIRE(contact.faces().size() == 2);
    const std::vector<Vector<Dim>> two(2, Vector<Dim>::Zero()), one(1, Vector<Dim>::Zero());
    CHECK_NOTHROW(contact.integrate(1.0, {two, two, two, two}));
    CHECK_THROWS_WITH(contact.integrate(1.0, {two, one, two, two}), Contains("1 entries for 2 faces"));
    CHECK_THROWS_WITH(contact.evaluate(two, one), Contains("1 entries for 2 faces"));
    CHECK_THROWS_WITH(contact.search(one, u, none), Contains("1 displacements are given for 2 faces"));
    const auto with = [&](auto&& spoil) {
        contact.search(u, u, [&](std::span<const contact::Face> faces) {
            auto coupling = uncoupled<Dim>(faces.size());
            spoil(coupling);
            return coupling;
        });
    };
    CHECK_THROWS_WITH(with([](auto& c) { c.offsets.pop_back(); }), Contains("2 offsets for 2 faces"));
    CHECK_THROWS_WITH(with([](auto& c) { c.blocks.pop_back(); }), Contains("1 blocks for 2 columns"));
    CHECK_THROWS_WITH(with([](auto& c) { c.columns.back() = 2; }), Contains("names face 2 of 2"));
}

TEMPLATE_TEST_CASE_SIG("a coupling that is no second derivative of an energy is refused with face, value and limit",
                       "[contact][errors]", ((int Dim), Dim), 2, 3) {
    const auto surface = touching_tiles<Dim>();
    contact::Contact<Dim> contact(surface.view(), {});
    const Matrix<Dim> one = Matrix<Dim>::Identity();
    contact::FaceCoupling<Dim> coupling{{0, 2, 4}, {0, 1, 0, 1}, {2.0 * one, one, one, 2.0 * one}};
    std::string says, face = "in the row of face 0 (body 0";
    SECTION("no rows at all") {
        coupling = {{0, 0, 0}, {}, {}};
        says = "lacks the column of the face itself, 0";
    }
    SECTION("a row without the face itself") {
        coupling = {{0, 1, 2}, {0, 0}, {one, one}};
        face = "in the row of face 1 (body 1";
        says = "lacks the column of the face itself, 1";
    }
    SECTION("a column twice") {
        coupling = {{0, 2, 3}, {0, 0, 1}, {one, one, one}};
        says = "has column 0 after 0";
    }
    SECTION("columns that fall") {
        coupling.columns = {1, 0, 0, 1};
        says = "has column 0 after 1";
    }
    SECTION("a block that is not a number") {
        coupling.blocks[1](0, 1) = not_a_number;
        says = "a block with column 1 that is not finite";
    }
    SECTION("an infinite block") {
        coupling.blocks[3](0, 0) = rigid;
        face = "in the row of face 1 (body 1";
        says = "a block with column 1 that is not finite";
    }
    SECTION("a sign turned around") {
        coupling.blocks[0] = -2.0 * one;
        says = "eigenvalue -2 N/m, -2e-10 is allowed";
    }
    SECTION("a block on the diagonal that pushes along one direction") {
        coupling.blocks[3](1, 1) = -1e-6;
        face = "in the row of face 1 (body 1";
        says = "eigenvalue -1e-06 N/m, -2e-10 is allowed";
    }
    SECTION("a block on the diagonal that is not symmetric") {
        coupling.blocks[0](0, 1) += 1e-6;
        says = "differs by 1e-06 N/m from the transpose of that one's block with it, 2e-10 is allowed";
    }
    SECTION("a block that is not the transpose of its twin") {
        coupling.blocks[1](0, 1) = 0.5;
        says = "a block with face 1 (body 1";
    }
    SECTION("a block without its twin") {
        coupling = {{0, 2, 3}, {0, 1, 1}, {one, one, one}};
        says = "but the row of face 1 (body 1";
    }
    const auto search = [&] { contact.search(at_rest(surface), at_rest(surface), [&](auto) { return coupling; }); };
    CHECK_THROWS_AS(search(), BadInput);
    CHECK_THROWS_WITH(search(), Contains(face) && Contains(says));
    CHECK_FALSE(contact.is_valid_for(0.0));
}

TEMPLATE_TEST_CASE_SIG(
    "blocks that are zero, singular or symmetric up to rounding, and empty rows of rigid faces, are a "
    "coupling",
    "[contact][errors]", ((int Dim), Dim), 2, 3) {
    auto surface = touching_tiles<Dim>();
    const Matrix<Dim> one = Matrix<Dim>::Identity(), zero = Matrix<Dim>::Zero();
    contact::FaceCoupling<Dim> coupling{{0, 2, 4}, {0, 1, 0, 1}, {2.0 * one, one, one, 2.0 * one}};
    SECTION("symmetric up to rounding") { coupling.blocks[1](0, 1) = 1e-11; }
    SECTION("singular") { coupling.blocks[0] = up<Dim>() * up<Dim>().transpose(); }
    SECTION("zero") { coupling.blocks.assign(4, zero); }
    SECTION("empty row of a rigid face") {
        surface.stiffness[1] = rigid;
        coupling = {{0, 1, 1}, {0}, {one}};
    }
    contact::Contact<Dim> contact(surface.view(), {});
    CHECK_NOTHROW(contact.search(at_rest(surface), at_rest(surface), [&](auto) { return coupling; }));
}
