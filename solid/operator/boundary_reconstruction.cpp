#include "abut/solid/operator/boundary_reconstruction.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "abut/base/dense_decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/operator/directed_cells.hpp"
#include "abut/solid/operator/free_strains.hpp"

namespace abut::solid {
namespace {

inline constexpr double least_free_part = 1e-12;  // of a unit normal: below it a face cannot move along its normal

/// One boundary face's displacement as a sum over cells, prescribed displacements and tractions.
template <int Dim>
struct Row {
    template <class Index>
    struct Term {
        Index index;
        Matrix<Dim> weight;
    };
    std::vector<Term<std::int32_t>> cells;
    std::vector<Term<BoundaryFace>> displacement;
    std::vector<Term<BoundaryFace>> traction;
    std::vector<Term<BoundaryFace>> answers;
    double normal_stiffness = 0.0;

    template <class Index>
    static void add(std::vector<Term<Index>>& terms, Index index, const Matrix<Dim>& weight) {
        const auto position =
            std::lower_bound(terms.begin(), terms.end(), index, [](const Term<Index>& t, Index i) { return t.index < i; });
        if (position != terms.end() && position->index == index)
            position->weight += weight;
        else
            terms.insert(position, {index, weight});
    }
    void add_stencil(const FaceStencil<Dim>& stencil, const Matrix<Dim>& weight) {
        for (int j = 0; j <= Dim; ++j) add(cells, stencil.cells[j], stencil.weights[j] * weight);
    }
    /// Adds the displacement of another face, without its answers.
    void add_row(const Row& other, const Matrix<Dim>& weight) {
        for (const auto& term : other.cells) add(cells, term.index, weight * term.weight);
        for (const auto& term : other.displacement) add(displacement, term.index, weight * term.weight);
        for (const auto& term : other.traction) add(traction, term.index, weight * term.weight);
    }
};

template <int Dim>
class Builder {
public:
    Builder(const mesh::Mesh<Dim>& mesh, std::span<const FaceStencil<Dim>> interior, std::span<const Material> materials,
            const FaceConditions<Dim>& conditions, FreeFaceRule rule, CornerRule corner_rule,
            std::span<const Kinematics> kinematics)
        : mesh_(mesh),
          interior_(interior),
          materials_(materials),
          directed_(mesh, materials),
          conditions_(conditions),
          rule_(rule),
          corner_rule_(corner_rule),
          kinematics_(kinematics),
          index_(static_cast<std::size_t>(mesh.n_faces()), no_face),
          affine_(mesh.boundary_faces.size()),
          rows_(mesh.boundary_faces.size()) {
        for (const BoundaryFace b : boundary_faces(mesh)) index_[mesh_face(mesh, b)] = b;
    }

    BoundaryReconstruction<Dim> build() {
        select_affine_stencils();
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell) reconstruct(cell);
        return pack();
    }

private:
    /// Boundary faces of a cell.
    std::vector<BoundaryFace> boundary_of(std::int32_t cell) const {
        std::vector<BoundaryFace> boundary;
        for (const std::int32_t face : mesh_.cell_faces[cell])
            if (index_[face] != no_face) boundary.push_back(index_[face]);
        return boundary;
    }

    const Vector<Dim>& normal_of(BoundaryFace b) const { return mesh_.face_normal[mesh_face(mesh_, b)]; }
    /// Projector onto the directions that are not prescribed.
    Matrix<Dim> free_part(BoundaryFace b) const { return Matrix<Dim>::Identity() - conditions_.prescribed[b]; }
    static Eigen::Index first_row(std::size_t face) { return static_cast<Eigen::Index>(face) * Dim; }

    bool is_joined(BoundaryFace b) const { return conditions_.joined[b] != 0; }
    bool is_glued(BoundaryFace b) const { return conditions_.glued[b] != 0; }
    bool is_free(BoundaryFace b) const { return !conditions_.prescribed[b].isIdentity(1e-12); }
    /// The part of a unit displacement along the normal that is not prescribed, in the direction of the normal.
    double free_along_normal(BoundaryFace b) const { return normal_of(b).dot(free_part(b) * normal_of(b)); }

    /// k of a face that `among` resists [Pa/m]: where directions are prescribed that with which it gives way along its
    /// normal in the others.
    double normal_stiffness(BoundaryFace b, const Matrix<Dim>& among) const {
        const Vector<Dim>& normal = normal_of(b);
        const double measure = mesh_.face_measure[mesh_face(mesh_, b)];
        if (conditions_.prescribed[b].isZero(0.0)) return normal.dot(among * normal) / measure;
        const Vector<Dim> moved = free_part(b) * normal;
        const double along_normal = moved.dot(normal);
        return moved.dot(among * moved) / (along_normal * along_normal * measure);
    }

    double wave_modulus(std::int32_t cell, const Vector<Dim>& along) const {
        const Material& material = materials_[mesh_.cell_body[cell]];
        return directed_.any() ? wave_modulus_along(material, directed_[cell], along) : material.wave_modulus();
    }

    FreeFaceRule rule_of(std::int32_t cell) const {
        const bool finite = properties_of(kinematics_, mesh_.cell_body[cell]).finite_strains;
        return finite ? FreeFaceRule::extrapolate : rule_;
    }

    /// Whether the traces of a cell do without the balance of its free faces: one of them has no support. Jumps of
    /// tips, which are thin and bear nothing, stay as they are.
    bool has_affine_traces(std::int32_t cell) const {
        if (conditions_.is_thick.empty() || conditions_.is_thick[static_cast<std::size_t>(cell)] == 0) return false;
        if (rule_of(cell) != FreeFaceRule::local_equilibrium) return false;
        std::vector<FreeFaceOfCell<Dim>> free;
        for (const BoundaryFace b : boundary_of(cell))
            if (conditions_.prescribed[b].isZero(0.0) && !is_joined(b)) free.push_back({normal_of(b), free_part(b)});
        return !free.empty() && !is_tip<Dim>(free);
    }

    /// An affine extrapolation is wanted where the equilibrium of the cell alone may not fix the faces, and where
    /// traces ask for it.
    void select_affine_stencils() {
        std::vector<BoundaryFace> wanted;
        for (const BoundaryFace b : boundary_faces(mesh_)) {
            const FreeFaceRule rule = rule_of(cell_of(mesh_, b));
            if (!is_free(b) || rule == FreeFaceRule::adjacent) continue;
            const auto others = boundary_of(cell_of(mesh_, b));
            const auto n_free =
                std::count_if(others.begin(), others.end(), [&](BoundaryFace other) { return is_free(other); });
            if (rule == FreeFaceRule::extrapolate || is_joined(b) || is_glued(b) || n_free > 1 ||
                !conditions_.prescribed[b].isZero(0.0) || has_affine_traces(cell_of(mesh_, b)))
                wanted.push_back(b);
        }
        std::vector<std::int32_t> faces;
        for (const BoundaryFace b : wanted) faces.push_back(mesh_face(mesh_, b));
        const auto stencils = select_stencils<Dim>(mesh_, faces, report_);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            affine_[wanted[i]] = stencils[i];
            lowest_weights_.emplace_back(wanted[i], std::ranges::min(stencils[i].weights));
        }
    }

    void reconstruct(std::int32_t cell) {
        const auto boundary = boundary_of(cell);
        if (boundary.empty()) return;
        for (const BoundaryFace b : boundary) {
            Row<Dim>::add(rows_[b].displacement, b, conditions_.prescribed[b]);
            rows_[b].normal_stiffness =
                wave_modulus(cell, normal_of(b)) * mesh_.face_measure[mesh_face(mesh_, b)] / mesh_.cell_measure[cell];
            if (!conditions_.prescribed[b].isZero(0.0)) hold(cell, b);
        }
        const FreeFaceRule rule = rule_of(cell);
        if (rule == FreeFaceRule::local_equilibrium) {
            if (std::ranges::any_of(boundary, [&](BoundaryFace b) { return is_glued(b); }))
                return stand_beside_glue(cell, boundary);
            auto alone = boundary;
            std::erase_if(alone, [&](BoundaryFace b) { return is_joined(b); });
            if (!alone.empty()) balance(cell, alone);
            for (const BoundaryFace b : boundary)
                if (is_joined(b)) rows_[b].add_stencil(affine_[b], free_part(b));
            if (corner_rule_ == CornerRule::relaxed)
                for (const BoundaryFace b : boundary) relax_corners(cell, b, boundary);
            return;
        }
        for (const BoundaryFace b : boundary) {
            const Matrix<Dim> free = free_part(b);
            if (free.isZero(1e-12)) continue;
            if (rule == FreeFaceRule::extrapolate)
                rows_[b].add_stencil(affine_[b], free);
            else
                Row<Dim>::add(rows_[b].cells, cell, free);
        }
    }

    /// Of a correction of contact the directions that are prescribed take nothing: the face answers to it itself.
    void hold(std::int32_t cell, BoundaryFace b) {
        if (free_along_normal(b) <= least_free_part) {
            rows_[b].normal_stiffness = std::numeric_limits<double>::infinity();
            return;
        }
        rows_[b].normal_stiffness = normal_stiffness(b, stiffness(cell, b, b));
        Row<Dim>::add(rows_[b].answers, b, -conditions_.prescribed[b]);
    }

    Matrix<Dim> stiffness(std::int32_t cell, std::int32_t f, std::int32_t g) const {
        const auto outward = [&](std::int32_t face) -> Vector<Dim> {
            return (mesh_.face_cells[face][0] == cell ? 1.0 : -1.0) * mesh_.face_measure[face] * mesh_.face_normal[face];
        };
        const Material& material = materials_[mesh_.cell_body[cell]];
        const double measure = mesh_.cell_measure[cell];
        Matrix<Dim> between = face_stiffness<Dim>(material.lambda(), material.mu(), measure, outward(f), outward(g));
        if (directed_.contains(cell)) between += directed_[cell].between(outward(f), outward(g)) / measure;
        return between;
    }

    Matrix<Dim> stiffness(std::int32_t cell, BoundaryFace f, BoundaryFace g) const {
        return stiffness(cell, mesh_face(mesh_, f), mesh_face(mesh_, g));
    }

    /// The other faces of the cell that turn away from b by a right angle or so, and are free in some direction.
    std::vector<BoundaryFace> corners_with(BoundaryFace b, const std::vector<BoundaryFace>& boundary) const {
        std::vector<BoundaryFace> corners;
        for (const BoundaryFace other : boundary)
            if (other != b && is_free(other) && !is_joined(other) && meet_at_corner<Dim>(normal_of(b), normal_of(other)))
                corners.push_back(other);
        return corners;
    }

    /// The stiffness among some faces in their free directions, and that with b: A and the columns A_b.
    struct Condensed {
        Eigen::MatrixXd among;
        Eigen::MatrixXd with_b;
    };
    Condensed stiffness_of(const std::vector<BoundaryFace>& faces, std::int32_t cell, BoundaryFace b) const {
        const auto n = static_cast<Eigen::Index>(faces.size()) * Dim;
        Eigen::MatrixXd among(n, n), with_b(n, Dim);
        for (std::size_t i = 0; i < faces.size(); ++i) {
            with_b.block<Dim, Dim>(first_row(i), 0) = as_eigen(free_part(faces[i]) * stiffness(cell, faces[i], b));
            for (std::size_t j = 0; j < faces.size(); ++j)
                among.block<Dim, Dim>(first_row(i), first_row(j)) =
                    as_eigen(free_part(faces[i]) * stiffness(cell, faces[i], faces[j]) * free_part(faces[j]));
        }
        return {std::move(among), std::move(with_b)};
    }

    /// (n_faces Dim)^2, of balancing combinations of free faces alone: B (B^T A B)^-1 B^T, A the stiffness among what
    /// is free of them [m/N]. Where these are all that strains the cell it is the pseudo-inverse of A.
    Eigen::MatrixXd compliance_of(std::int32_t cell, const std::vector<BoundaryFace>& faces, const Eigen::MatrixXd& among) {
        std::vector<FreeFaceOfCell<Dim>> free;
        for (const BoundaryFace b : faces) free.push_back({normal_of(b), free_part(b)});
        BalancingCombinations kept = balancing_combinations<Dim>(free);
        if (!kept.leaves_strains) return pseudo_inverse(among, no_stiffness);
        Eigen::MatrixXd& b = kept.of_faces;  // of û, which is |c|/|f| z
        for (std::size_t i = 0; i < faces.size(); ++i)
            b.middleRows<Dim>(first_row(i)) *= mesh_.cell_measure[cell] / mesh_.face_measure[mesh_face(mesh_, faces[i])];
        return b * pseudo_inverse(Eigen::MatrixXd(b.transpose() * among * b), no_stiffness) * b.transpose();
    }

    /// Static condensation: the minimum of the cell's energy over its corner faces when b is displaced by delta,
    /// N A N z = -N A_b delta, delta in the free directions of b.
    void relax_corners(std::int32_t cell, BoundaryFace b, const std::vector<BoundaryFace>& boundary) {
        if (free_along_normal(b) <= least_free_part) return;  // no correction moves it
        const std::vector<BoundaryFace> corners = corners_with(b, boundary);
        if (corners.empty()) return;
        Condensed of_corners = stiffness_of(corners, cell, b);
        if (!conditions_.prescribed[b].isZero(0.0)) of_corners.with_b = of_corners.with_b * as_eigen(free_part(b));
        const Eigen::MatrixXd answers = -compliance_of(cell, corners, of_corners.among) * of_corners.with_b;
        const Matrix<Dim> relaxed = stiffness(cell, b, b) + Matrix<Dim>(of_corners.with_b.transpose() * answers);
        const double left = normal_stiffness(b, relaxed), measure = mesh_.face_measure[mesh_face(mesh_, b)];
        const double young = materials_[mesh_.cell_body[cell]].mean_young();
        if (left < least_stiffness * young * measure / mesh_.cell_measure[cell]) return;
        for (std::size_t i = 0; i < corners.size(); ++i)
            Row<Dim>::add(rows_[b].answers, corners[i], answers.block<Dim, Dim>(first_row(i), 0));
        rows_[b].normal_stiffness = left;
    }

    /// Faces of a cell that bonds glue to others: each is where it has no traction while all others that nothing holds are
    /// extrapolated, which those that are not glued stay,
    ///   û_f = û_affine - A_ff^-1 (sum over all faces of A_fg û_g - |f| t)
    /// In a uniform stress the cell has it, whatever its other faces bear, and its glued faces are as far from where they
    /// are extrapolated as their half cells give way.
    void stand_beside_glue(std::int32_t cell, const std::vector<BoundaryFace>& boundary) {
        auto held = boundary;
        std::erase_if(held, [&](BoundaryFace b) { return conditions_.prescribed[b].isZero(0.0); });
        if (!held.empty()) balance(cell, held);
        for (const BoundaryFace b : boundary) {
            if (!conditions_.prescribed[b].isZero(0.0)) continue;
            rows_[b].add_stencil(affine_[b], Matrix<Dim>::Identity());
            if (is_glued(b)) take_traction_off(cell, b, held);
        }
        for (const BoundaryFace b : boundary)  // loads of both kinds have the same faces
            for (const BoundaryFace other : boundary) {
                Row<Dim>::add(rows_[b].displacement, other, Matrix<Dim>::Zero());
                Row<Dim>::add(rows_[b].traction, other, Matrix<Dim>::Zero());
            }
    }

    void take_traction_off(std::int32_t cell, BoundaryFace b, const std::vector<BoundaryFace>& held) {
        const std::int32_t face = mesh_face(mesh_, b);
        const Matrix<Dim> compliance = stiffness(cell, face, face).inverse();
        Row<Dim>& row = rows_[b];
        Row<Dim>::add(row.traction, b, mesh_.face_measure[face] * compliance);
        for (const std::int32_t g : mesh_.cell_faces[cell]) {
            const Matrix<Dim> weight = -compliance * stiffness(cell, face, g);
            if (index_[g] == no_face)
                row.add_stencil(interior_[g], weight);
            else if (std::ranges::find(held, index_[g]) != held.end())
                row.add_row(rows_[index_[g]], weight);
            else
                row.add_stencil(affine_[index_[g]], weight);
        }
    }

    /// Minimum of the cell's energy over the balancing combinations of these boundary faces, joined and glued ones
    /// standing where they are extrapolated, as what is free of these faces does in all other combinations:
    ///   û = K (|f| t - A_interior u_g - A P u_D) + (N - K A N) û_affine,  K the compliance of these combinations
    void balance(std::int32_t cell, const std::vector<BoundaryFace>& boundary) {
        const auto n = static_cast<Eigen::Index>(boundary.size()) * Dim;
        const auto block = [](Eigen::MatrixXd& m, std::size_t i, std::size_t j) {
            return m.block<Dim, Dim>(first_row(i), first_row(j));
        };
        Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
        Eigen::MatrixXd free = Eigen::MatrixXd::Zero(n, n);
        for (std::size_t i = 0; i < boundary.size(); ++i) {
            block(free, i, i) = as_eigen(free_part(boundary[i]));
            for (std::size_t j = 0; j < boundary.size(); ++j)
                block(a, i, j) = as_eigen(stiffness(cell, mesh_face(mesh_, boundary[i]), mesh_face(mesh_, boundary[j])));
        }
        Eigen::MatrixXd compliance = free * compliance_of(cell, boundary, free * a * free) * free;
        Eigen::MatrixXd undetermined = free - compliance * a * free;
        Eigen::MatrixXd from_prescribed = -compliance * a;

        for (std::size_t i = 0; i < boundary.size(); ++i) {
            Row<Dim>& row = rows_[boundary[i]];
            for (std::size_t j = 0; j < boundary.size(); ++j) {
                const BoundaryFace b = boundary[j];
                const std::int32_t face = mesh_face(mesh_, b);
                const Matrix<Dim> answer = block(compliance, i, j);
                Row<Dim>::add(row.displacement, b, Matrix<Dim>(block(from_prescribed, i, j)) * conditions_.prescribed[b]);
                Row<Dim>::add(row.traction, b, mesh_.face_measure[face] * answer);
                if (!block(undetermined, i, j).isZero(1e-9)) row.add_stencil(affine_[b], block(undetermined, i, j));
                for (const std::int32_t g : mesh_.cell_faces[cell])
                    if (index_[g] == no_face)
                        row.add_stencil(interior_[g], -answer * stiffness(cell, face, g));
                    else if (std::ranges::find(boundary, index_[g]) == boundary.end())
                        row.add_stencil(affine_[index_[g]], -answer * stiffness(cell, face, g));
            }
        }
    }

    BoundaryReconstruction<Dim> pack() {
        BoundaryReconstruction<Dim> packed;
        packed.report = report_;
        packed.lowest_weights = std::move(lowest_weights_);
        for (const BoundaryFace b : boundary_faces(mesh_))
            if (is_free(b) && has_affine_traces(cell_of(mesh_, b))) packed.affine.push_back({b, affine_[b], free_part(b)});
        for (const Row<Dim>& row : rows_) {
            Matrix<Dim> sum = Matrix<Dim>::Zero();
            for (const auto& [cell, weight] : row.cells) {
                packed.cells.push_back(cell);
                packed.weights.push_back(weight);
                sum += weight;
            }
            packed.offsets.push_back(static_cast<std::int32_t>(packed.cells.size()));
            const bool prescribed = std::any_of(row.displacement.begin(), row.displacement.end(),
                                                [](const auto& term) { return !term.weight.isZero(0.0); });
            packed.deficit.push_back(prescribed ? Matrix<Dim>(Matrix<Dim>::Identity() - sum) : Matrix<Dim>::Zero());
            for (std::size_t i = 0; i < row.displacement.size(); ++i) {
                const auto& [face, weight] = row.displacement[i];
                packed.load_faces.push_back(face);
                packed.from_displacement.push_back(weight);
                packed.from_traction.push_back(row.traction.empty() ? Matrix<Dim>::Zero() : row.traction[i].weight);
            }
            packed.load_offsets.push_back(static_cast<std::int32_t>(packed.load_faces.size()));
            for (const auto& [face, answer] : row.answers) {
                packed.answer_faces.push_back(face);
                packed.answers.push_back(answer);
            }
            packed.answer_offsets.push_back(static_cast<std::int32_t>(packed.answer_faces.size()));
            packed.normal_stiffness.push_back(row.normal_stiffness);
        }
        return packed;
    }

    const mesh::Mesh<Dim>& mesh_;
    std::span<const FaceStencil<Dim>> interior_;
    std::span<const Material> materials_;
    DirectedCells<Dim> directed_;
    const FaceConditions<Dim>& conditions_;
    FreeFaceRule rule_;
    CornerRule corner_rule_;
    std::span<const Kinematics> kinematics_;
    std::vector<BoundaryFace> index_;                  // by face; none inside
    IdVector<BoundaryFace, FaceStencil<Dim>> affine_;  // where wanted
    IdVector<BoundaryFace, Row<Dim>> rows_;
    StencilReport report_;
    std::vector<std::pair<BoundaryFace, double>> lowest_weights_;  // of the affine extrapolations
};

}  // namespace

template <int Dim>
Matrix<Dim> face_stiffness(double lambda, double mu, double cell_measure, const Vector<Dim>& area_f,
                           const Vector<Dim>& area_g) {
    return (lambda * area_f * area_g.transpose() +
            mu * (area_f.dot(area_g) * Matrix<Dim>::Identity() + area_g * area_f.transpose())) /
           cell_measure;
}

template <int Dim>
BoundaryReconstruction<Dim> reconstruct_boundary(const mesh::Mesh<Dim>& mesh, std::span<const FaceStencil<Dim>> interior,
                                                 std::span<const Material> materials, const FaceConditions<Dim>& conditions,
                                                 FreeFaceRule rule, CornerRule corner_rule,
                                                 std::span<const Kinematics> kinematics) {
    return Builder<Dim>(mesh, interior, materials, conditions, rule, corner_rule, kinematics).build();
}

#define ABUT_INSTANTIATE(Dim)                                                                                             \
    template Matrix<Dim> face_stiffness<Dim>(double, double, double, const Vector<Dim>&, const Vector<Dim>&);             \
    template BoundaryReconstruction<Dim> reconstruct_boundary<Dim>(                                                       \
        const mesh::Mesh<Dim>&, std::span<const FaceStencil<Dim>>, std::span<const Material>, const FaceConditions<Dim>&, \
        FreeFaceRule, CornerRule, std::span<const Kinematics>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
