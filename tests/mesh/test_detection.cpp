// Every broad phase against brute force, over all the kinds of surfaces there are.
#include <catch2/catch.hpp>

#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"

using namespace abut;
using namespace abut::mesh;
using geometry::Box;
using geometry::BroadPhase;
using geometry::IndexPair;

namespace {

struct TwoSurfaces {
    std::string name;
    SurfaceMesh first, second;
    double margin = 0.05;  ///< by which boxes are grown [m]
};

SurfaceMesh moved(SurfaceMesh surface, const Vector<3>& way) {
    for (Vector<3>& vertex : surface.vertices) vertex += way;
    return surface;
}

/// In near contact, in contact, one in the other, identical, flat.
std::vector<TwoSurfaces> scenes() {
    const SurfaceMesh torus = torus_surface({}), gear = gear_surface({.n_teeth = 12});
    const SurfaceMesh sphere = sphere_surface({.n_subdivisions = 3}), sheet = sheet_surface({});
    const SurfaceMesh barrel = barrel_surface({.n_side = 6});
    return {
        {"interlocked tori", torus, torus_surface({.centre = {1.0, 0.0, 0.0}, .tube_radius = 0.65, .axis = 1})},
        {"tori that touch", torus, torus_surface({.centre = {2.6, 0.0, 0.0}})},
        {"gears, a tooth in a gap", gear, gear_surface({.centre = {1.8, 0.0, 0.0}, .n_teeth = 12, .turn = 0.26})},
        {"sphere in a sphere", sphere, sphere_surface({.radius = 0.95, .n_subdivisions = 3})},
        {"sphere in a far larger one", sphere, sphere_surface({.radius = 0.01, .n_subdivisions = 2})},
        {"plug in a barrel", barrel, barrel_surface({.radius = 0.98, .length = 1.5, .n_side = 7})},
        {"barrels in line contact", barrel, moved(barrel, {2.001, 0.0, 0.3})},
        {"cloth on cloth", sheet, moved(sheet_surface({.n_x = 29, .n_y = 37}), {0.0, 0.0, 0.001})},
        {"flat sheets in one plane", sheet_surface({.amplitude = 0.0}),
         moved(sheet_surface({.n_x = 30, .n_y = 20, .amplitude = 0.0}), {0.5, 0.5, 0.0}), 0.0},
        {"a mesh and itself", torus, torus},
        {"a soup and a sphere", random_triangles({.n = 1500, .lower = {-1, -1, -1}, .box_size = 2.0, .size = 0.3}), sphere},
    };
}

/// Boxes of the faces, scaled and then moved, and grown.
std::vector<Box<3>> boxes_of(const SurfaceMesh& surface, double scale, double offset, double margin) {
    std::vector<Box<3>> boxes(static_cast<std::size_t>(surface.faces.size()));
    for (std::int32_t face = 0; face < surface.faces.size(); ++face) {
        Box<3>& box = boxes[static_cast<std::size_t>(face)];
        for (const std::int32_t v : surface.faces[face])
            box.extend(scale * surface.vertices[static_cast<std::size_t>(v)] + Vector<3>::Constant(offset));
        box = box.grown(scale * margin);
    }
    return boxes;
}

}  // namespace

TEST_CASE("no broad phase misses a pair of faces of any surface, at any scale and place", "[mesh][detection]") {
    const auto all = scenes();
    const TwoSurfaces& scene = all[static_cast<std::size_t>(GENERATE_COPY(range(0, static_cast<int>(all.size()))))];
    for (const auto& [scale, offset] :
         {std::pair{1.0, 0.0}, {1e-9, 0.0}, {1e9, 0.0}, {1e-3, 1e7}, {1e-3, -1e3}, {1e9, 1e7}, {1e-9, 1.0}}) {
        const auto boxes_1 = boxes_of(scene.first, scale, offset, scene.margin);
        const auto boxes_2 = boxes_of(scene.second, scale, offset, scene.margin);
        const auto expected = geometry::overlapping_pairs<3>({BroadPhase::brute_force}, boxes_1, boxes_2);
        const auto expected_within = geometry::overlapping_pairs<3>({BroadPhase::brute_force}, boxes_1);
        CAPTURE(scene.name, scale, offset);
        CHECK(expected.empty() == (scene.name == "sphere in a far larger one"));
        CHECK(expected_within.size() > boxes_1.size());  // neighbours
        for (const BroadPhase method : geometry::broad_phases()) {
            CAPTURE(std::string(geometry::name(method)));
            CHECK((geometry::overlapping_pairs<3>({method}, boxes_1, boxes_2) == expected));
            CHECK((geometry::overlapping_pairs<3>({method}, boxes_1) == expected_within));
        }
    }
}
