#pragma once
// Runs of a scene on all ranks of the program, and what is seen of them.
#include <catch2/catch.hpp>

#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "abut/mesh/outline.hpp"
#include "abut/ranks/partition.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/values/sight.hpp"
#include "ranks/counting_ranks.hpp"
#include "ranks/shared_solid.hpp"
#include "ranks/world.hpp"

namespace abut::test {

/// The rank of each cell of a mesh, the first time and whenever they are shared out again; weights are of cells.
using Owners = std::function<std::vector<int>(int time, std::span<const double> weights)>;

/// A scene's mesh, shared out by these.
template <int Dim>
class SharedMesh {
public:
    /// `kinematics` of the bodies; none: all are `small`.
    SharedMesh(const ranks::Communicator& all, const mesh::Mesh<Dim>& mesh, Owners owners,
               std::vector<solid::Kinematics> kinematics = {})
        : all_(all), mesh_(mesh), owners_(std::move(owners)), kinematics_(std::move(kinematics)) {
        share_.emplace(share_out({}));
        share_->again = [this](std::span<const double> weights) { return share_out(weights); };
    }
    SharedMesh(const SharedMesh&) = delete;

    [[nodiscard]] const run::Share<Dim>* share() const { return &*share_; }
    [[nodiscard]] int times() const { return times_; }  ///< that cells were shared out
    [[nodiscard]] const Calls& calls() const { return calls_; }

private:
    struct Part {
        mesh::MeshPart<Dim> part;
        ranks::PointRanks points;
        CountingRanks counting;

        Part(const ranks::Communicator& all, const mesh::Mesh<Dim>& mesh, const std::vector<int>& owner,
             std::span<const solid::Kinematics> kinematics, Calls& calls)
            : part(solid::part_of<Dim>(mesh, owner, all.rank(), kinematics)),
              points(all, shared_points<Dim>(all, part, kinematics)),
              counting(points, calls) {}
    };
    run::Share<Dim> share_out(std::span<const double> weights) {
        before_ = std::move(part_);
        part_ = std::make_unique<Part>(all_, mesh_, owners_(times_++, solid::cell_weights(mesh_, kinematics_, weights)),
                                       kinematics_, calls_);
        return {part_->part.mesh, part_->counting};
    }

    const ranks::Communicator& all_;
    const mesh::Mesh<Dim>& mesh_;
    Owners owners_;
    std::vector<solid::Kinematics> kinematics_;
    int times_ = 0;
    Calls calls_;
    std::unique_ptr<Part> part_, before_;
    std::optional<run::Share<Dim>> share_;
};

/// As many cells to each, whatever they weigh.
template <int Dim>
Owners even(const ranks::Communicator& all, const mesh::Mesh<Dim>& mesh) {
    return [&](int, std::span<const double>) { return ranks::partition<Dim>(all, mesh.cell_centroid); };
}

/// Odd parts: nearly all cells on one rank, all on the last one, by weight, in stripes, and again.
template <int Dim>
Owners odd(const ranks::Communicator& all, const mesh::Mesh<Dim>& mesh) {
    return [&](int time, std::span<const double> weights) {
        const int last = all.size() - 1;
        std::vector<int> owner(static_cast<std::size_t>(mesh.n_cells()), last);
        if (time % 4 == 0) owner.assign(owner.size(), 0), owner[owner.size() / 2] = last;
        if (time % 4 == 2) owner = ranks::partition<Dim>(all, mesh.cell_centroid, weights);
        for (std::size_t c = 0; time % 4 == 3 && c < owner.size(); ++c) owner[c] = static_cast<int>(c / 23) % all.size();
        return owner;
    };
}

/// The scene of a rank that has a part: the whole mesh is on rank 0 alone.
template <int Dim>
run::Scene<Dim> of_rank(const ranks::Communicator& all, const run::Scene<Dim>& scene) {
    run::Scene<Dim> here = scene;
    if (all.rank() > 0) here.mesh = mesh::outline_of(scene.mesh);
    return here;
}

/// Looks every so often, and keeps what it sees.
template <int Dim>
class Watch : public run::Observer<Dim> {
public:
    explicit Watch(std::int64_t look_every = 5, std::int64_t keep_every = 0)
        : look_every_(look_every), keep_every_(keep_every) {}
    void see(const run::Sight<Dim>& sight) override {
        const auto keep = [&]<class T>(const std::vector<T>& values) {
            std::vector<double> numbers(values.size() * sizeof(T) / sizeof(double));
            std::memcpy(numbers.data(), values.data(), numbers.size() * sizeof(double));
            seen.push_back(std::move(numbers));
        };
        keep(sight.displacement_gradient);
        keep(sight.stress);
        keep(sight.out_of_plane_stress);
        keep(sight.plastic_strain);
        keep(sight.contact.pressure);
        keep(sight.bond);
        keep(sight.fragment);
        for (const solid::ActingPair<Dim>& pair : sight.pairs) {
            seen.push_back({static_cast<double>(pair.face_1), static_cast<double>(pair.face_2)});
            seen.emplace_back(pair.force.begin(), pair.force.end());
        }
        keep(sight.velocity);
        keep(sight.displacement);
    }
    [[nodiscard]] bool wants_sight(std::int64_t step) const override { return look_every_ > 0 && step % look_every_ == 0; }
    [[nodiscard]] bool wants_checkpoint(std::int64_t step, bool) const override {
        return keep_every_ > 0 && step % keep_every_ == 0;
    }
    void keep(const run::Checkpoint& checkpoint) override { kept.push_back(checkpoint); }
    void fail(const run::Failure& failure, const run::Sight<Dim>&) override { sound = failure.sound; }

    std::vector<std::vector<double>> seen;
    dynamics::IntegratorState sound;
    std::vector<run::Checkpoint> kept;

private:
    std::int64_t look_every_, keep_every_;
};

/// What two runs leave is the same, where all of it is known.
template <int Dim>
void require_same(const ranks::Communicator& all, const run::RunResult<Dim>& expected, const Watch<Dim>& of_expected,
                  const run::RunResult<Dim>& found, const Watch<Dim>& of_found) {
    bool same = expected.ledger.entries().size() == found.ledger.entries().size();
    for (std::size_t i = 0; same && i < expected.ledger.entries().size(); ++i)
        same = same_bits(dynamics::ledger_values(expected.ledger.entries()[i]),
                         dynamics::ledger_values(found.ledger.entries()[i]));
    REQUIRE(everywhere(all, same));
    CHECK(expected.contact.report.events == found.contact.report.events);
    CHECK(expected.run.evaluations == found.run.evaluations);
    CHECK(expected.bodies.local_rotations == found.bodies.local_rotations);
    if (all.rank() == 0) {
        same = of_expected.seen.size() == of_found.seen.size() && !of_found.seen.empty();
        for (std::size_t i = 0; same && i < of_found.seen.size(); ++i)
            same = same_bits(of_expected.seen[i], of_found.seen[i]);
    }
    REQUIRE(everywhere(all, same));
}

}  // namespace abut::test
