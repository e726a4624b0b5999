#pragma once
// A scene of contact on nodes, shared out to the ranks of the program, and the same on each of them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/ranks/shared_nodal_contact.hpp"
#include "contact/nodal_scenes.hpp"
#include "ranks/world.hpp"

namespace abut::test {

/// Which faces a rank gives.
using Gives = std::function<bool(std::int32_t face)>;

/// Faces without any order; a rank may be left out.
inline Gives scattered_faces(const ranks::Communicator& all, std::int32_t n, int empty_rank = -1) {
    return [mine = scattered(n, all.rank(), all.size(), empty_rank)](std::int32_t face) {
        return std::ranges::binary_search(mine, face);
    };
}

/// Of each body, for friction.
template <int Dim>
std::vector<double> shear_stiffnesses(const NodalScene<Dim>& scene) {
    std::vector<double> shear = scene.faces.stiffness;
    for (double& k : shear) k *= 0.3;
    return shear;
}

/// The whole of a scene on one rank.
template <int Dim>
contact::NodalSurface<Dim> surface_with_shear(const NodalScene<Dim>& scene) {
    const std::vector<double> shear = shear_stiffnesses(scene);
    contact::NodalFaces<Dim> faces = scene.faces.view();
    faces.shear_stiffness = shear;
    return {scene.rest, faces};
}

/// What a rank has of a scene: its faces, their nodes, and some nodes of the faces of others, in decreasing order.
template <int Dim>
struct ScenePart {
    std::vector<Vector<Dim>> rest;
    std::vector<std::int32_t> node;  ///< of each, the node of the scene
    contact::NodalFaceArrays<Dim> faces;
    std::vector<std::int32_t> face;  ///< of each, the face of the scene
    std::vector<double> shear_stiffness;

    ScenePart(const ranks::Communicator& all, const NodalScene<Dim>& scene, const Gives& gives) {
        const auto n = static_cast<std::int32_t>(scene.rest.size());
        std::vector<char> is_here(scene.rest.size(), 0);
        for (std::int32_t i = 0; i < n; ++i) is_here[i] = i % (all.size() + 1) == all.rank();
        const auto corners_of = [&](std::int32_t f) {
            return std::span(scene.faces.nodes)
                .subspan(scene.faces.offsets[f], scene.faces.offsets[f + 1] - scene.faces.offsets[f]);
        };
        for (std::int32_t f = 0; f < std::ssize(scene.faces.body); ++f)
            if (gives(f)) {
                face.push_back(f);
                for (const std::int32_t i : corners_of(f)) is_here[i] = 1;
            }
        std::vector<std::int32_t> own(scene.rest.size(), -1);
        for (std::int32_t i = n - 1; i >= 0; --i)
            if (is_here[i]) {
                own[i] = static_cast<std::int32_t>(node.size());
                node.push_back(i);
                rest.push_back(scene.rest[i]);
            }
        faces.stiffness = scene.faces.stiffness;
        shear_stiffness = shear_stiffnesses(scene);
        for (const std::int32_t f : face) {
            std::vector<std::int32_t> corners;
            for (const std::int32_t i : corners_of(f)) corners.push_back(own[i]);
            faces.append_face(corners, scene.faces.depth[f], scene.faces.body[f]);
        }
    }

    [[nodiscard]] ranks::NodalPart<Dim> view() const {
        return {.rest = rest, .node_number = node, .faces = faces.view(), .face_number = face};
    }
    [[nodiscard]] ranks::NodalPart<Dim> view_with_shear() const {
        ranks::NodalPart<Dim> part = view();
        part.faces.shear_stiffness = shear_stiffness;
        return part;
    }
    /// What this rank has of values by node of the scene.
    template <class T>
    [[nodiscard]] std::vector<T> own(const std::vector<T>& of_all) const {
        std::vector<T> values;
        for (const std::int32_t i : node) values.push_back(of_all[static_cast<std::size_t>(i)]);
        return values;
    }
};

template <int Dim>
bool same_bits(const std::vector<Vector<Dim>>& a, const std::vector<Vector<Dim>>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vector<Dim>)) == 0);
}

inline bool same_report(const contact::ContactReport& a, const contact::ContactReport& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;  // no gaps between its numbers
}

template <int Dim>
bool same_pairs(const std::vector<contact::PairStep<Dim>>& a, const std::vector<contact::PairStep<Dim>>& b) {
    return std::ranges::equal(a, b, [](const auto& p, const auto& q) {
        return p.face_1 == q.face_1 && p.face_2 == q.face_2 && p.normal == q.normal && p.gap_0 == q.gap_0 &&
               p.gap_1 == q.gap_1 && p.area == q.area && p.normal_force == q.normal_force && p.force == q.force &&
               p.events == q.events && p.active_share == q.active_share && p.compression == q.compression &&
               p.friction == q.friction && p.slip == q.slip && p.point == q.point;
    });
}

inline bool same_friction(const std::vector<contact::FaceFriction>& a, const std::vector<contact::FaceFriction>& b) {
    return std::ranges::equal(a, b, [](const auto& p, const auto& q) {
        return p.face == q.face && p.normal_force == q.normal_force && p.force == q.force && p.limit == q.limit &&
               p.slip == q.slip && p.dissipated == q.dissipated;
    });
}

template <int Dim>
bool same_bodies(const contact::NodalStep<Dim>& a, const contact::NodalStep<Dim>& b) {
    return std::ranges::equal(a.bodies, b.bodies,
                              [](const auto& p, const auto& q) {
                                  return p.body == q.body && p.force == q.force && p.moment == q.moment && p.work == q.work;
                              }) &&
           std::ranges::equal(a.body_pairs, b.body_pairs, [](const auto& p, const auto& q) {
               return p.body_1 == q.body_1 && p.body_2 == q.body_2 && p.active_pairs == q.active_pairs &&
                      p.force == q.force && p.normal_force == q.normal_force;
           });
}

/// An error as one rank sees it.
struct Caught {
    std::string type, text;
    ErrorFacts facts;
};

template <class Call>
Caught caught(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return {name(error.kind()), error.what(), error.facts()};
    } catch (const std::exception& error) {
        return {"other", error.what(), {}};
    }
    return {"none", "", {}};
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Contact of a scene on all ranks, and on each by itself.
template <int Dim>
struct BothContacts {
    const ranks::Communicator& all;
    const NodalScene<Dim>& scene;
    ScenePart<Dim> part;
    contact::NodalContact<Dim> alone;
    ranks::SharedNodalContact<Dim> shared;

    BothContacts(const ranks::Communicator& communicator, const NodalScene<Dim>& whole, const Gives& gives,
                 const contact::NodalOptions& options = {})
        : all(communicator),
          scene(whole),
          part(all, scene, gives),
          alone(surface_with_shear(scene), options),
          shared(all, part.view_with_shear(), options) {}

    /// Whether the last results are the same to the last bit, here.
    [[nodiscard]] bool same() const {
        const contact::NodalStep<Dim>&of_alone = alone.last(), &of_shared = shared.last();
        return same_bits<Dim>(part.own(forces<Dim>(of_alone, scene.rest.size())),
                              forces<Dim>(of_shared, part.rest.size())) &&
               same_pairs<Dim>(of_alone.pairs, of_shared.pairs) && same_bodies<Dim>(of_alone, of_shared) &&
               same_friction(of_alone.friction, of_shared.friction) &&
               of_alone.report.friction.energy == of_shared.report.friction.energy &&
               of_alone.energy_0 == of_shared.energy_0 && of_alone.energy == of_shared.energy &&
               of_alone.work == of_shared.work && of_alone.report.correction == of_shared.report.correction &&
               of_alone.report.most_compressed == of_shared.report.most_compressed &&
               same_report(alone.report(), shared.report()) && alone.skin() == shared.skin() &&
               alone.state() == shared.state();
    }
    /// Both take the step; whether they end the same on all ranks.
    [[nodiscard]] bool step(const std::vector<Vector<Dim>>& x_0, const std::vector<Vector<Dim>>& x_1,
                            contact::TakenForce take = contact::TakenForce::mean) {
        alone.step(1.0, x_0, x_1, take);
        shared.step(1.0, part.own(x_0), part.own(x_1), take);
        return everywhere(all, same());
    }
    [[nodiscard]] bool evaluate(const std::vector<Vector<Dim>>& x) {
        alone.evaluate(x);
        shared.evaluate(part.own(x));
        return everywhere(all, same());
    }
};

}  // namespace abut::test
