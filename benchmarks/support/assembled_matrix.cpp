#include "support/assembled_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace abut::benchmark {
namespace {

using Block = Matrix<3>;
using Elasticity = SmallMatrix<9, 9>;

/// sum_j coefficients[j] u_cells[j] with blocks of Rows x 3.
template <int Rows>
struct LinearForm {
    using Coefficient = SmallMatrix<Rows, 3>;
    std::vector<std::int32_t> cells;
    std::vector<Coefficient> coefficients;

    void add(std::int32_t cell, const Coefficient& coefficient) {
        if (coefficient.isZero(0.0)) return;
        const auto at = std::find(cells.begin(), cells.end(), cell);
        if (at != cells.end()) {
            coefficients[static_cast<std::size_t>(at - cells.begin())] += coefficient;
            return;
        }
        cells.push_back(cell);
        coefficients.push_back(coefficient);
    }
};

using Displacement = LinearForm<3>;  // of a face, or a jump
using Gradient = LinearForm<9>;      // G by columns

/// A term 1/2 F(u) . S F(u) of the energy.
template <int Rows>
struct Term {
    LinearForm<Rows> form;
    LinearForm<Rows> image;  // S times the coefficients
};

std::vector<Displacement> face_displacements(const mesh::Mesh<3>& mesh, const solid::Ccg<3>& ccg) {
    std::vector<Displacement> forms(static_cast<std::size_t>(mesh.n_faces()));
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f)
        if (!mesh.is_boundary(f))
            for (int j = 0; j < 4; ++j)
                forms[f].add(ccg.stencils()[f].cells[j], ccg.stencils()[f].weights[j] * Block::Identity());
    const auto& boundary = ccg.boundary();
    for (std::int32_t b = 0; b < boundary.size(); ++b)
        for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
            forms[mesh.boundary_faces[b]].add(boundary.cells[i], boundary.weights[i]);
    return forms;
}

/// a (x) v as a map of a: column j of the tensor is v_j a.
Gradient::Coefficient tensor_with(const Vector<3>& v, const Block& a) {
    Gradient::Coefficient map;
    for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i) map(3 * j + i, k) = v[j] * a(i, k);
    return map;
}

Gradient cell_gradient(const mesh::Mesh<3>& mesh, std::int32_t c, std::span<const Displacement> faces) {
    Gradient gradient;
    for (const std::int32_t f : mesh.cell_faces[c]) {
        const double side = mesh.face_cells[f][0] == c ? 1.0 : -1.0;
        const Vector<3> area = side * mesh.face_measure[f] / mesh.cell_measure[c] * mesh.face_normal[f];
        for (std::size_t i = 0; i < faces[f].cells.size(); ++i)
            gradient.add(faces[f].cells[i], tensor_with(area, faces[f].coefficients[i]));
    }
    return gradient;
}

Elasticity elasticity(const solid::Material& material) {
    Elasticity c = Elasticity::Zero();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            c(3 * i + i, 3 * j + j) += material.lambda();
            c(3 * j + i, 3 * j + i) += material.mu();
            c(3 * j + i, 3 * i + j) += material.mu();
        }
    return c;
}

Term<9> elastic_term(Gradient gradient, const Elasticity& stiffness, double measure) {
    Term<9> term{gradient, std::move(gradient)};
    for (auto& coefficient : term.image.coefficients) coefficient = measure * (stiffness * coefficient);
    return term;
}

/// Adds sign (u_c + G_c (x_f - x_c)) to the jump.
void add_value_at_face(Displacement& jump, double sign, std::int32_t c, const Gradient& gradient, const Vector<3>& arm) {
    jump.add(c, sign * Block::Identity());
    for (std::size_t i = 0; i < gradient.cells.size(); ++i) {
        Block value = Block::Zero();
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) value.col(k) += arm[j] * gradient.coefficients[i].col(k).segment<3>(3 * j);
        jump.add(gradient.cells[i], sign * value);
    }
}

Term<3> jump_term(const mesh::Mesh<3>& mesh, std::int32_t f, std::span<const Gradient> gradients, double eta) {
    Term<3> term;
    double sign = 1.0;
    for (const std::int32_t c : mesh.face_cells[f]) {
        add_value_at_face(term.form, sign, c, gradients[c], mesh.face_centroid[f] - mesh.cell_centroid[c]);
        sign = -1.0;
    }
    term.image = term.form;
    for (auto& coefficient : term.image.coefficients) coefficient *= eta * std::sqrt(mesh.face_measure[f]);  // |f| eta / h_f
    return term;
}

/// For each cell the terms that depend on it, and its place in them.
struct Uses {
    struct Use {
        std::int32_t term;
        std::int32_t place;
    };
    std::vector<std::vector<Use>> of_cell;

    template <int Rows>
    Uses(std::int32_t n_cells, const std::vector<Term<Rows>>& terms) : of_cell(static_cast<std::size_t>(n_cells)) {
        for (std::size_t t = 0; t < terms.size(); ++t)
            for (std::size_t i = 0; i < terms[t].form.cells.size(); ++i)
                of_cell[terms[t].form.cells[i]].push_back({static_cast<std::int32_t>(t), static_cast<std::int32_t>(i)});
    }
};

/// One row of K while it is added up.
class Row {
public:
    explicit Row(std::int32_t n_cells) : place_(static_cast<std::size_t>(n_cells), -1) {}

    template <int Rows>
    void add(const std::vector<Term<Rows>>& terms, const std::vector<Uses::Use>& uses) {
        for (const auto& [t, i] : uses) {
            const Term<Rows>& term = terms[t];
            for (std::size_t j = 0; j < term.form.cells.size(); ++j)
                block(term.form.cells[j]) += term.image.coefficients[i].transpose() * term.form.coefficients[j];
        }
    }

    /// Hands the blocks over in the order of their columns and starts again.
    void move_to(std::vector<std::int32_t>& columns, std::vector<double>& blocks) {
        std::vector<std::int32_t> sorted = columns_;
        std::sort(sorted.begin(), sorted.end());
        for (const std::int32_t column : sorted) {
            columns.push_back(column);
            const Block& values = blocks_[place_[column]];
            blocks.insert(blocks.end(), values.data(), values.data() + 9);
            place_[column] = -1;
        }
        columns_.clear();
        blocks_.clear();
    }

private:
    Block& block(std::int32_t column) {
        if (place_[column] < 0) {
            place_[column] = static_cast<std::int32_t>(columns_.size());
            columns_.push_back(column);
            blocks_.push_back(Block::Zero());
        }
        return blocks_[place_[column]];
    }

    std::vector<std::int32_t> place_;
    std::vector<std::int32_t> columns_;
    std::vector<Block> blocks_;
};

using Four = double __attribute__((vector_size(32)));

/// y += column times x, four numbers at a time: the fourth belongs to the next column and is never used.
inline void add_column(Four& y, const double* column, double x) {
    Four values;
    std::memcpy(&values, column, sizeof values);
    y += values * x;
}

}  // namespace

AssembledMatrix::AssembledMatrix(const mesh::Mesh<3>& mesh, std::span<const solid::Material> materials,
                                 const solid::Ccg<3>& ccg) {
    const auto faces = face_displacements(mesh, ccg);
    std::vector<Gradient> gradients;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) gradients.push_back(cell_gradient(mesh, c, faces));
    std::vector<Term<3>> jumps;
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f)
        if (!mesh.is_boundary(f))
            jumps.push_back(jump_term(mesh, f, gradients, materials[mesh.cell_body[mesh.face_cells[f][0]]].stabilisation()));
    std::vector<Term<9>> elastic;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        elastic.push_back(
            elastic_term(std::move(gradients[c]), elasticity(materials[mesh.cell_body[c]]), mesh.cell_measure[c]));

    const Uses of_elastic(mesh.n_cells(), elastic), of_jumps(mesh.n_cells(), jumps);
    Row row(mesh.n_cells());
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        row.add(elastic, of_elastic.of_cell[c]);
        row.add(jumps, of_jumps.of_cell[c]);
        row.move_to(columns_, blocks_);
        offsets_.push_back(static_cast<std::int64_t>(columns_.size()));
    }
    blocks_.insert(blocks_.end(), 3, 0.0);
    blocks_.shrink_to_fit();
    columns_.shrink_to_fit();
}

void AssembledMatrix::multiply(std::span<const Vector<3>> x, std::span<Vector<3>> result) const {
    for (std::size_t row = 0; row + 1 < offsets_.size(); ++row) {
        Four by_0{}, by_1{}, by_2{};  // three independent sums hide the latency of the additions
        for (std::int64_t i = offsets_[row]; i < offsets_[row + 1]; ++i) {
            const double* block = blocks_.data() + 9 * i;
            const Vector<3>& value = x[columns_[i]];
            add_column(by_0, block, value[0]);
            add_column(by_1, block + 3, value[1]);
            add_column(by_2, block + 6, value[2]);
        }
        const Four sum = by_0 + (by_1 + by_2);
        result[row] = {sum[0], sum[1], sum[2]};
    }
}

Eigen::SparseMatrix<double, Eigen::RowMajor> AssembledMatrix::scalar_matrix() const {
    const auto n = 3 * n_rows();
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(n, n);
    matrix.reserve(Eigen::VectorXi::NullaryExpr(
        n, [&](Eigen::Index i) { return static_cast<int>(3 * (offsets_[i / 3 + 1] - offsets_[i / 3])); }));
    for (std::int64_t row = 0; row < n_rows(); ++row)
        for (int i = 0; i < 3; ++i)
            for (std::int64_t k = offsets_[row]; k < offsets_[row + 1]; ++k)
                for (int j = 0; j < 3; ++j) matrix.insert(3 * row + i, 3 * columns_[k] + j) = blocks_[9 * k + 3 * j + i];
    matrix.makeCompressed();
    return matrix;
}

}  // namespace abut::benchmark
