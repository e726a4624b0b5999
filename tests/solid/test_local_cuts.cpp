#include <catch2/catch.hpp>

#include "abut/contact/contact.hpp"
#include "abut/solid/contact_view.hpp"
#include "contact/law.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::Cuts;

namespace {

/// Bodies whose boundary cells are next to each other, so that their faces are coupled, sliding fast over one another.
template <int Dim>
mesh::Mesh<Dim> coupled_bodies() {
    if constexpr (Dim == 2)
        return together(mesh::fan_disc({-0.96, -0.4}, 1.0, 17, 0.1), mesh::fan_disc({0.96, 0.4}, 1.0, 14, 0.45));
    else
        return two_boxes(4);
}

template <int Dim>
std::vector<Vector<Dim>> fast_velocities() {
    if constexpr (Dim == 2)
        return {{0.1, 0.3}, {-0.1, -0.3}};
    else
        return {{0.3, 0.1, 0.05}, {-0.3, 0.0, -0.05}};
}

template <int Dim>
double size_of(std::span<const Vector<Dim>> v) {
    double size = 0.0;
    for (const Vector<Dim>& x : v) raise(size, x.norm());
    return size;
}

template <int Dim>
double distance(std::span<const Vector<Dim>> a, std::span<const Vector<Dim>> b) {
    double size = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) raise(size, (a[i] - b[i]).norm());
    return size;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "the local path integral is the one over the union of all events of the scene, on meshes with coupled faces",
    "[solid][contact]", ((int Dim), Dim), 2, 3) {
    Scene<Dim> scene(coupled_bodies<Dim>(), reconstructed_bodies<Dim>(2), fast_velocities<Dim>());
    const auto& contact = *scene.solid.contact().reconstruction();
    auto& ccg = scene.solid.ccg();
    LawOnList<Dim> local({}), global({});
    double worst = 0.0, worst_against_solid = 0.0;
    std::int64_t events = 0, steps_with_contact = 0, steps_with_coupled_faces = 0;
    for (int step = 0; step < 250; ++step) {
        const std::vector<double> q_0(scene.memm.q().begin(), scene.memm.q().end());
        scene.memm.step();
        if (contact.last().pairs.empty()) continue;
        // Nothing is prescribed: face i of the surface is boundary face i.
        const std::vector<contact::Face> faces(contact.faces().begin(), contact.faces().end());
        std::vector<solid::BoundaryFace> boundary;
        for (const contact::Face face : faces) boundary.push_back(solid::BoundaryFace{number_of(face)});
        const auto region = ccg.region_of_faces(boundary);
        std::vector<Vector<Dim>> u_0(faces.size()), u_1(u_0), y_0(u_0), y_1(u_0);
        ccg.evaluate_faces(region, vectors<Dim>(q_0), {}, u_0, y_0);
        ccg.evaluate_faces(region, as_vectors<Dim>(scene.memm.q()), {}, u_1, y_1);
        contact::PairList<Dim> list;
        for (const auto& [face_1, face_2] : contact.pair_store().pairs())
            list.append(contact.surface(), number_of(face_1), number_of(face_2), contact::InterfaceWeighting::stiffness);
        list.number_faces(faces);
        const std::vector memory(contact.pair_store().memory().begin(), contact.pair_store().memory().end());
        const contact::FacePath<Dim> path{u_0, u_1, y_0, y_1};
        const auto& here = local(contact.surface(), list, memory, faces, contact.coupling(), path, Cuts::coupled);
        const auto& there = global(contact.surface(), list, memory, faces, contact.coupling(), path, Cuts::global);
        const auto reference = there.mean_gradient.values();
        const double size = size_of<Dim>(reference);
        raise(worst, distance<Dim>(here.mean_gradient.values(), reference) / size);
        raise(worst_against_solid, distance<Dim>(here.mean_gradient.values(), contact.last().mean_gradient.values()) / size);
        events += there.report.events;
        ++steps_with_contact;
        steps_with_coupled_faces += contact.coupling().columns.size() > faces.size();
    }
    CHECK(steps_with_contact > 15);
    CHECK(events > 2 * steps_with_contact);
    CHECK(steps_with_coupled_faces == steps_with_contact);
    CHECK(worst < 1e-14);
    CHECK(worst_against_solid == 0.0);
}
