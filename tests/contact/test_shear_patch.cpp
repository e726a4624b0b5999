#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/geometry/polygon.hpp"
#include "contact/nodal_scenes.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;

namespace {

/// Uniform shear and pressure over an interface that does not match: two unit boxes, pressed together and moved past each other by
/// 1e-6 of their size as they stick. Cells behind the faces are from half to one and a half of their mean depth high.
template <int Dim>
struct ShearPatch {
    static constexpr double p_wave_modulus = 1.0, shear_modulus = 0.3, depth = 0.125, moved = 1e-6;

    explicit ShearPatch(bool one_k_per_face) {
        const double least_depth =
            one_k_per_face ? 0.5 * depth : depth;  // the stiffness of a body bounds those of its faces
        scene = two_boxes<Dim>(6, 7, 0.0, 0.013, p_wave_modulus / least_depth, p_wave_modulus / least_depth);
        contact::NodalFaces<Dim> faces = scene.faces.view();
        const std::vector<double> of_body(scene.faces.stiffness.size(), shear_modulus / least_depth);
        faces.shear_stiffness = of_body;
        std::vector<double> stiffness, shear;
        for (std::size_t face = 0; face < faces.body.size(); ++face) {
            const double height = depth * (1.0 + 0.5 * std::sin(5.0 * static_cast<double>(face)));
            stiffness.push_back(p_wave_modulus / height);
            shear.push_back(shear_modulus / height);
        }
        if (one_k_per_face) {
            faces.face_stiffness = stiffness;
            faces.face_shear_stiffness = shear;
        }
        contact::NodalOptions options;
        options.friction.laws = {{.coefficient = 1e3}};  // nothing slides
        contact::NodalContact<Dim> contact(contact::NodalSurface<Dim>(scene.rest, faces), options);
        std::vector<Vector<Dim>> x = scene.rest, pressed = x, sheared = x;
        for (std::size_t n = 0; n < x.size(); ++n)
            if (scene.node_body[n] == 1) {
                pressed[n] -= moved * up<Dim>();
                sheared[n] += moved * (axis<Dim>(0) - up<Dim>());
            }
        contact.step(1.0, x, pressed);
        contact.step(1.0, pressed, sheared);
        force = forces(contact.evaluate(sheared), x.size());
    }

    /// Largest error of the force along the interface on one of its nodes off the rim, over the shear stress times the share of
    /// the node in the area of its faces. The stress is that of the shear of both half cells in series.
    [[nodiscard]] double error() const {
        const double stress = moved / (2.0 * depth / shear_modulus);
        double worst = 0.0;
        for (std::size_t n = 0; n < scene.rest.size(); ++n) {
            if (!is_inside(scene.rest[n])) continue;
            const double side = scene.node_body[n] == 0 ? 1.0 : -1.0;  // the upper box, which moves on, is held back
            raise(worst, std::abs(side * force[n][0] / (stress * area_of(n)) - 1.0));
        }
        return worst;
    }

private:
    /// On the interface, away from faces of the rim, which are covered in part, and from what they touch.
    [[nodiscard]] static bool is_inside(const Vector<Dim>& x) {
        bool inside = x[Dim - 1] == 1.0;
        for (int d = 0; d + 1 < Dim; ++d) inside = inside && x[d] > 0.3 && x[d] < 0.8;
        return inside;
    }
    /// 1/Dim of the area of each face of the interface that has the node.
    [[nodiscard]] double area_of(std::size_t node) const {
        double area = 0.0;
        for (std::size_t face = 0; face + 1 < scene.faces.offsets.size(); ++face) {
            std::vector<Vector<Dim>> corners;
            bool has_it = false, is_level = true;
            for (std::int32_t i = scene.faces.offsets[face]; i < scene.faces.offsets[face + 1]; ++i) {
                const std::int32_t corner = scene.faces.nodes[i];
                corners.push_back(scene.rest[corner]);
                has_it = has_it || static_cast<std::size_t>(corner) == node;
                is_level = is_level && scene.rest[corner][Dim - 1] == 1.0;
            }
            if (has_it && is_level) area += geometry::face_measure<Dim>(corners) / Dim;
        }
        return area;
    }

    NodalScene<Dim> scene;
    std::vector<Vector<Dim>> force;
};

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "faces that stick pass the shear patch at nodes with one stiffness of each body, and fail it with one of each face",
    "[contact][friction][nodal]", ((int Dim), Dim), 2, 3) {
    CHECK(ShearPatch<Dim>(false).error() < 1e-9);
    CHECK(ShearPatch<Dim>(true).error() > 0.1);
}
