// Steps on the device of Kokkos: the bits of those on the host, and what is not made there. Debian's Kokkos has the host for a
// device; the source is the same for all of them.
#include <catch2/catch.hpp>

#include <cstring>

#include "abut/dynamics/leapfrog.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::BoundaryFace;
using solid::FreeFaceRule;
using solid::Precision;
using solid::StepDevice;

namespace {

const solid::Material material{.young = 2.0, .poisson = 0.2, .density = 1.5};

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

template <int Dim>
solid::Ccg<Dim> operators(const mesh::Mesh<Dim>& mesh, const solid::BoundaryConditions<Dim>& conditions, StepDevice device) {
    return solid::Ccg<Dim>(mesh, std::vector{material}, conditions, {}, solid::CellForm::automatic,
                           Precision::double_precision, device);
}

/// Of a step, and of what is asked for after it.
template <int Dim>
struct Answers {
    std::vector<Vector<Dim>> force, of_faces;
    std::vector<Matrix<Dim>> stress, gradient;

    Answers(solid::Ccg<Dim>& ccg, std::span<const Vector<Dim>> u, const solid::BoundaryLoad<Dim>& load,
            const solid::FaceCorrections<Dim>& corrections)
        : force(u.size()) {
        ccg.step_gradient(u, load, corrections, force);
        for (const BoundaryFace b : ccg.boundary_faces()) of_faces.push_back(ccg.boundary_gradient(b));
        for (std::int32_t c = 0; c < ccg.n_cells(); ++c) {
            stress.push_back(ccg.stress(c));
            gradient.push_back(ccg.displacement_gradient(c));
        }
    }
    [[nodiscard]] bool has_bits_of(const Answers& other) const {
        return same_bits(force, other.force) && same_bits(of_faces, other.of_faces) && same_bits(stress, other.stress) &&
               same_bits(gradient, other.gradient);
    }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("steps on a device have the bits of those on the host: forces, boundary forces and stresses",
                       "[solid][device]", ((int Dim), Dim), 2, 3) {
    const auto rule = GENERATE(FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate, FreeFaceRule::adjacent);
    for (const auto& [name, mesh] : boxes<Dim>(4)) {
        INFO(name);
        auto conditions = held_and_pulled<Dim>();
        conditions.free_face_rule = rule;
        auto host = operators(mesh, conditions, StepDevice::host);
        auto device = operators(mesh, conditions, StepDevice::kokkos);
        std::vector<BoundaryFace> faces;
        for (std::int32_t b = 1; b < host.n_boundary(); b += 3)
            if (host.prescribed()[BoundaryFace{b}].isZero(0.0)) faces.push_back(BoundaryFace{b});
        const auto u = random_vectors<Dim>(static_cast<std::size_t>(mesh.n_cells()), 3);
        const auto moved = random_vectors<Dim>(faces.size(), 5), pushed = random_vectors<Dim>(faces.size(), 6);
        const std::vector<Matrix<Dim>> moments(faces.size(), Matrix<Dim>(random_state(Dim * Dim, 7).data()));
        const auto load = host.load_at(0.0, 0.0);
        const std::vector<solid::FaceCorrections<Dim>> corrections = {
            {}, {faces, moved, pushed}, {faces, {}, pushed, moments}, {}};  // the last: nothing stays of those before
        for (const auto& of_contact : corrections)
            CHECK(Answers<Dim>(device, u, load, of_contact).has_bits_of(Answers<Dim>(host, u, load, of_contact)));
        const Answers<Dim> loaded(host, u, load, {}), unloaded(host, u, {}, {});
        CHECK(!loaded.has_bits_of(unloaded));
        CHECK(Answers<Dim>(device, u, {}, {}).has_bits_of(unloaded));
    }
}

TEST_CASE("bodies that step on a device meet and part with the bits of the host", "[solid][device]") {
    const auto law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    const auto run = [&](StepDevice device) {
        auto options = bodies<2>(2);
        options.device = device;
        options.law = law;
        auto scene = std::make_unique<Scene<2>>(two_discs(0.8), options, disc_velocities);
        scene->run_until(12.0);
        return scene;
    };
    const auto host = run(StepDevice::host), device = run(StepDevice::kokkos);
    const auto q = [](const Scene<2>& scene) { return std::vector<double>(scene.memm.q().begin(), scene.memm.q().end()); };
    const auto p = [](const Scene<2>& scene) {
        return std::vector<double>(scene.memm.p_after().begin(), scene.memm.p_after().end());
    };
    CHECK(same_bits(q(*device), q(*host)));
    CHECK(same_bits(p(*device), p(*host)));
    CHECK(device->solid.contact().report().active_pairs_max > 0);
}

TEST_CASE("what is not made on a device is refused", "[solid][device]") {
    const auto mesh = unit_cylinder(0.5);
    const std::vector materials{material};
    CHECK_THROWS_WITH(solid::Ccg<3>(mesh, materials, {}, std::vector{solid::Kinematics::finite}, {},
                                    Precision::double_precision, StepDevice::kokkos),
                      Catch::Contains("on a device: it is made on the host alone") && Catch::Contains("--device host"));
    CHECK_THROWS_WITH(solid::Ccg<3>(mesh, materials, {}, {}, {}, Precision::single_precision, StepDevice::kokkos),
                      Catch::Contains("double precision alone") && Catch::Contains("--device host"));
}
