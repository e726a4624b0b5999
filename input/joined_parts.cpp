#include "abut/input/joined_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "abut/base/disjoint_sets.hpp"
#include "abut/input/make_body.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::input {
namespace {

/// The bodies of each piece of more than one, by the first of them.
template <int Dim>
std::vector<std::vector<std::int32_t>> pieces_of(const mesh::Mesh<Dim>& mesh) {
    const std::int32_t n = mesh.n_bodies();
    DisjointSets joined(static_cast<std::size_t>(n));
    for (const auto& [a, b] : mesh.report.joined_bodies) joined.join(a, b);
    std::vector<std::vector<std::int32_t>> pieces(static_cast<std::size_t>(n));
    for (std::int32_t body = 0; body < n; ++body) pieces[static_cast<std::size_t>(joined.find(body))].push_back(body);
    std::erase_if(pieces, [](const auto& piece) { return piece.size() < 2; });
    return pieces;
}

template <int Dim>
class Pieces {
public:
    Pieces(run::Scene<Dim>& scene, const Settings& settings, Answers& answers, std::vector<Fault>& faults)
        : scene_(scene), settings_(settings), answers_(answers), faults_(faults) {}

    void join(const std::vector<std::int32_t>& piece) {
        check(piece);
        const bool touches_itself = std::ranges::all_of(piece, [&](std::int32_t body) { return touches(body); });
        const bool breaks = fracture_of(piece.front()) != nullptr;
        for (std::size_t i = 0; i < piece.size() && !touches_itself && !breaks; ++i)
            for (std::size_t j = 0; j < i; ++j) scene_.solid.ignored_pairs.push_back({piece[j], piece[i]});
        if (!scene_.spin.empty()) turn_about_common_centroid(piece);
    }

    void bond(const std::array<std::int32_t, 2>& sides) {
        solid::Bond& bond = scene_.solid.bonds.emplace_back(solid::Bond{.sides = sides});
        const FractureSettings* fracture = fracture_of(sides[0]);
        if (!fracture) return;
        bond.of_grains = true;
        bond.strength = fracture->strength;
        bond.fracture_energy = fracture->fracture_energy;
        bond.weibull_modulus = fracture->weibull;
        bond.seed = static_cast<std::uint32_t>(fracture->seed);
    }

private:
    /// Settings of the body that this one is a grain of; null: it is no grain.
    [[nodiscard]] const FractureSettings* fracture_of(std::int32_t body) const {
        const BodySettings* table = table_of(name_of(body), settings_.bodies);
        return table && table->fracture ? &*table->fracture : nullptr;
    }
    [[nodiscard]] const std::string& name_of(std::int32_t body) const {
        return scene_.mesh.body_names[static_cast<std::size_t>(body)];
    }
    [[nodiscard]] bool touches(std::int32_t body) const {
        return settings_.options.contact.search.self_contact &&
               std::ranges::find(scene_.solid.ignored_pairs, std::array{body, body}) == scene_.solid.ignored_pairs.end();
    }
    void check(const std::vector<std::int32_t>& piece) {
        const auto first = static_cast<std::size_t>(piece.front());
        if (const BodySettings* body = table_of(name_of(piece.front()), settings_.bodies); body && body->fracture)
            return check_that_breaks(*body, scene_.solid.kinematics[first]);
        const auto fault = [&](std::int32_t body, const std::string& what) {
            faults_.push_back(
                {settings_.file.string(), fmt::format("bodies '{}' and '{}' have faces in common and are one piece, but {}.",
                                                      name_of(piece.front()), name_of(body), what)});
        };
        for (const std::int32_t body : piece) {
            const auto i = static_cast<std::size_t>(body);
            if (!solid::properties_of(scene_.solid.kinematics[i]).deforms)
                fault(piece.back(), fmt::format("'{}' is rigid, and pieces of several materials deform. Give it another "
                                                "kinematics, or one material and no tables of parts",
                                                name_of(body)));
            const bool moves_otherwise = scene_.velocity[i] != scene_.velocity[first] ||
                                         (!scene_.spin.empty() && scene_.spin[i] != scene_.spin[first]);
            if (moves_otherwise) fault(body, "their velocity or spin differs. Give it to the piece");
        }
    }
    void check_that_breaks(const BodySettings& body, solid::Kinematics of_scene) const {
        if (!settings_.contact)
            faults_.push_back(
                {body.where, fmt::format("body '{}' may break, and with contact.enabled = false its pieces pass "
                                         "through each other. Leave contact.enabled out, or fracture.",
                                         body.name)});
        const auto kinematics = run::kinematics_of_all(settings_.options.kinematics).value_or(of_scene);
        if (settings_.options.kinematics == run::BodyKinematics::automatic || !solid::properties_of(kinematics).turns)
            faults_.push_back(
                {body.where, fmt::format("body '{}' may break, and pieces that come off turn. Give it kinematics "
                                         "= \"floating\", or \"finite\" where it bends far.",
                                         body.name)});
    }
    void turn_about_common_centroid(const std::vector<std::int32_t>& piece) {
        const std::vector<Vector<Dim>> arms = answers_.of([&] { return arms_of(piece); });
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const auto body = static_cast<std::size_t>(piece[i]);
            scene_.velocity[body] += turned_with(scene_.spin[body], arms[i]);
        }
    }
    /// From the centroid of the piece to those of its bodies [m].
    [[nodiscard]] std::vector<Vector<Dim>> arms_of(const std::vector<std::int32_t>& piece) const {
        const mesh::Mesh<Dim>& mesh = scene_.mesh;
        std::vector<double> mass(piece.size(), 0.0);
        std::vector<Vector<Dim>> centre(piece.size(), Vector<Dim>::Zero());
        Vector<Dim> common = Vector<Dim>::Zero();
        double all = 0.0;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const double density = scene_.solid.materials[static_cast<std::size_t>(piece[i])].density;
            for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
                if (mesh.cell_body[cell] != piece[i]) continue;
                mass[i] += density * mesh.cell_measure[cell];
                centre[i] += density * mesh.cell_measure[cell] * mesh.cell_centroid[cell];
            }
            common += centre[i];
            all += mass[i];
            centre[i] /= mass[i];
        }
        common /= all;
        for (Vector<Dim>& arm : centre) arm -= common;
        return centre;
    }
    static Vector<2> turned_with(const AxialVector<2>& spin, const Vector<2>& arm) {
        return {-spin[0] * arm[1], spin[0] * arm[0]};
    }
    static Vector<3> turned_with(const AxialVector<3>& spin, const Vector<3>& arm) { return moment<3>(spin, arm); }

    run::Scene<Dim>& scene_;
    const Settings& settings_;
    Answers& answers_;
    std::vector<Fault>& faults_;
};

}  // namespace

template <int Dim>
void join_parts(run::Scene<Dim>& scene, const Settings& settings, Answers& mesh, std::vector<Fault>& faults) {
    Pieces<Dim> pieces(scene, settings, mesh, faults);
    for (const auto& pair : scene.mesh.report.joined_bodies) pieces.bond(pair);
    for (const auto& piece : pieces_of(scene.mesh)) pieces.join(piece);
}

template void join_parts<2>(run::Scene<2>&, const Settings&, Answers&, std::vector<Fault>&);
template void join_parts<3>(run::Scene<3>&, const Settings&, Answers&, std::vector<Fault>&);

}  // namespace abut::input
