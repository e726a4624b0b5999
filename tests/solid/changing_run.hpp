#pragma once
// Runs that go on with another mesh, and all that they may remember.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/mesh/without_cells.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/stepped_run.hpp"
#include "solid/stacked_scenes.hpp"

namespace abut::test {

using solid::MaterialLaw;
using solid::Solid;
using solid::SolidOptions;

template <int Dim>
struct NewMesh {
    mesh::Mesh<Dim> mesh;
    std::vector<std::int32_t> old_cells;
};

template <int Dim>
NewMesh<Dim> same_mesh(const mesh::Mesh<Dim>& mesh) {
    NewMesh<Dim> same{mesh, std::vector<std::int32_t>(mesh.cell_measure.size())};
    std::iota(same.old_cells.begin(), same.old_cells.end(), 0);
    return same;
}

template <int Dim>
NewMesh<Dim> mesh_without(const mesh::Mesh<Dim>& mesh, const std::vector<std::int32_t>& cells) {
    auto [left, old_cells] = mesh::without_cells<Dim>(mesh, cells);
    return {std::move(left), std::move(old_cells)};
}

/// Its cells and vertices by new numbers, from the old ones of each.
template <int Dim>
mesh::Mesh<Dim> rebuilt(const mesh::Mesh<Dim>& mesh, const std::vector<std::int32_t>& old_cells,
                        const std::vector<std::int32_t>& old_vertices, const std::vector<Vector<Dim>>& vertices) {
    std::vector<std::int32_t> new_vertex(old_vertices.size());
    for (std::size_t v = 0; v < old_vertices.size(); ++v) new_vertex[old_vertices[v]] = static_cast<std::int32_t>(v);
    const auto of = [&](std::span<const std::int32_t> old) {
        std::vector<std::int32_t> numbers;
        for (const std::int32_t v : old) numbers.push_back(new_vertex[v]);
        return numbers;
    };
    mesh::CellSoup<Dim> soup;
    soup.name = mesh.name;
    for (const std::int32_t old : old_vertices) soup.vertices.push_back(vertices[old]);
    for (const std::int32_t old : old_cells) {
        soup.cell_shape.push_back(mesh.cell_shape[old]);
        soup.cell_vertices.append(of(mesh.cell_vertices[old]));
        soup.cell_body.push_back(mesh.cell_body[old]);
    }
    soup.body_names = mesh.body_names;
    for (const mesh::BoundaryGroup& group : mesh.groups) {
        for (const std::int32_t face : group.faces)
            soup.named_faces.push_back({of(mesh.face_vertices[face]), static_cast<std::int32_t>(soup.group_names.size())});
        soup.group_names.push_back(group.name);
    }
    return mesh::build_mesh(std::move(soup), {.reorder = false});
}

inline std::vector<std::int32_t> in_order(std::size_t n) {
    std::vector<std::int32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

/// No two cells are alike any more: of equally good stencils the numbers of their cells decide which is taken.
template <int Dim>
mesh::Mesh<Dim> without_ties(const mesh::Mesh<Dim>& mesh) {
    std::vector<Vector<Dim>> vertices = mesh.vertices;
    const std::vector<Vector<Dim>> shifts = random_vectors<Dim>(vertices.size(), 11);
    for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] += 0.004 * shifts[v];
    return rebuilt<Dim>(mesh, in_order(mesh.cell_measure.size()), in_order(vertices.size()), vertices);
}

template <int Dim>
class ChangingRun {
public:
    ChangingRun(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, const std::vector<Motion<Dim>>& motion,
                const solid::RunRemedies& remedies = {})
        : mesh_(std::make_unique<mesh::Mesh<Dim>>(mesh)) {
        auto solid = std::make_unique<Solid<Dim>>(*mesh_, options);
        const double dt = 0.7 * dynamics::stable_step(*solid).dt;
        const std::vector<double> at_rest(solid->size(), 0.0), p = momentum_of(*solid, motion);
        run_.emplace(std::move(solid), at_rest, p, dt, remedies);
    }

    void run(std::int64_t until) {
        while (memm().steps() < until) {
            push(solid(), memm().steps());
            run_->step();
            pairs_ += solid().contact_counts().active_pairs;
        }
    }

    solid::Left<Dim> change(NewMesh<Dim> next) {
        auto mesh = std::make_unique<mesh::Mesh<Dim>>(std::move(next.mesh));
        const solid::Left<Dim> left = run_->change(std::make_unique<Solid<Dim>>(*mesh, solid().options()), next.old_cells);
        mesh_ = std::move(mesh);
        pairs_ = 0;
        return left;
    }

    [[nodiscard]] const mesh::Mesh<Dim>& mesh() const { return *mesh_; }
    [[nodiscard]] Solid<Dim>& solid() { return run_->solid(); }
    [[nodiscard]] const Solid<Dim>& solid() const { return run_->solid(); }
    [[nodiscard]] auto& memm() { return run_->memm(); }
    [[nodiscard]] const auto& memm() const { return run_->memm(); }
    [[nodiscard]] dynamics::RestartReport restarts() const { return run_->restarts(); }
    [[nodiscard]] std::int64_t pairs() const { return pairs_; }  ///< in contact in the steps since the last change, together
    /// What is to stay [J].
    [[nodiscard]] double balance() {
        return memm().pseudo_energy() - solid().work() + solid().dissipated().total() +
               solid().contact().report().friction_dissipated;
    }

private:
    std::unique_ptr<mesh::Mesh<Dim>> mesh_;
    std::optional<solid::SteppedRun<Dim>> run_;
    std::int64_t pairs_ = 0;
};

template <int Dim>
SolidOptions<Dim> of_metal(Kinematics kinematics) {
    SolidOptions<Dim> options = falling<Dim>({kinematics, kinematics});
    options.law = solid::ContactLaw::pair_potential;
    for (solid::Material& material : options.materials) {
        material.law = MaterialLaw::j2;
        material.flow.yield_stress = 2e-3 * material.young;
        material.flow.hardening = 0.05 * material.young;
        material.damping.mass = 0.01;
        material.damping.stiffness = 0.01;
        material.damping.quadratic_viscosity = 1.0;
    }
    return options;
}

template <int Dim>
SolidOptions<Dim> rubbing(solid::ContactLaw law) {
    SolidOptions<Dim> options = falling<Dim>({Kinematics::small, Kinematics::small});
    options.law = law;
    options.friction.coefficient = 0.3;
    return options;
}

template <int Dim>
SolidOptions<Dim> touching_itself() {
    SolidOptions<Dim> options = falling<Dim>({Kinematics::floating, Kinematics::finite});
    options.contact->search.self_contact = true;
    return options;
}

template <int Dim>
struct NamedOptions {
    std::string name;
    SolidOptions<Dim> options;
};

/// Bodies whose temperature varies in place and time.
template <int Dim>
SolidOptions<Dim> warming(Kinematics kinematics) {
    SolidOptions<Dim> options =
        kinematics == Kinematics::finite ? of_metal<Dim>(kinematics) : falling<Dim>({kinematics, kinematics});
    for (solid::Material& material : options.materials) material.expansion.along_1 = 0.01;
    const auto swing = [](double t, const Vector<Dim>& x) { return (1.0 + 0.3 * x[0]) * std::sin(2.0 * t); };
    options.temperature_rise.assign(2, {.value = swing, .varies = true});
    return options;
}

/// All that a run may remember.
template <int Dim>
std::vector<NamedOptions<Dim>> all_that_remembers() {
    using enum Kinematics;
    return {{"small", falling<Dim>({small, small})},
            {"floating", falling<Dim>({floating, floating})},
            {"finite", falling<Dim>({finite, finite})},
            {"rigid and floating", falling<Dim>({floating, rigid})},
            {"floating and rigid", falling<Dim>({rigid, floating})},
            {"a wall that moves, tractions", driven<Dim>({small, small})},
            {"dashpots, a brake", tied<Dim>({floating, floating})},
            {"a load from outside", pushed<Dim>({small, small})},
            {"small metal", of_metal<Dim>(small)},
            {"floating metal", of_metal<Dim>(floating)},
            {"finite metal", of_metal<Dim>(finite)},
            {"friction on nodes", rubbing<Dim>(solid::ContactLaw::pair_potential)},
            {"friction on faces", rubbing<Dim>(solid::ContactLaw::reconstruction)},
            {"bodies that touch themselves", touching_itself<Dim>()},
            {"temperatures", warming<Dim>(floating)},
            {"temperatures of finite metal", warming<Dim>(finite)}};
}

/// Two blocks that are bonded, and pull: within 100 steps some places break, and others are left half open.
template <int Dim>
struct Bonded {
    mesh::Mesh<Dim> mesh;
    SolidOptions<Dim> options = bodies<Dim>(2);
    std::vector<Motion<Dim>> motion;

    Bonded() {
        Vector<Dim> low = Vector<Dim>::Constant(-0.5), high = Vector<Dim>::Constant(0.5), left = high, right = low;
        low[0] = -1.0;
        left[0] = right[0] = 0.0;
        std::array<int, Dim> coarse, fine;
        coarse.fill(3);
        fine.fill(4);
        const CellShape shape = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
        mesh = together(mesh::structured_box<Dim>(low, left, coarse, shape, "left"),
                        mesh::structured_box<Dim>(right, high, fine, shape, "right"));
        options.law = solid::ContactLaw::pair_potential;
        options.bonds = {{.sides = {0, 1}, .strength = 0.01, .fracture_energy = Dim == 2 ? 2e-4 : 4e-4}};
        motion.resize(2);
        motion[1] = moving<Dim>(0.05 * Vector<Dim>::Unit(0), AxialVector<Dim>::Constant(0.05));
    }
};

}  // namespace abut::test
