#include "abut/solid/ccg/free_face_answers.hpp"

#include <utility>

#include "abut/base/dense_decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/solid/ccg/boundary_reconstruction.hpp"
#include "abut/solid/ccg/free_strains.hpp"

namespace abut::solid {
namespace {

constexpr double no_stiffness = 1e-10;  // of the largest eigenvalue: below it a combination of faces has none

}  // namespace

template <int Dim>
FreeFaceAnswers<Dim>::FreeFaceAnswers(std::vector<Vector<Dim>> normals, double lambda, double mu,
                                      const DirectedStiffness<Dim>* directed)
    : normals_(std::move(normals)), lambda_(lambda), mu_(mu), directed_(directed) {
    const auto size = std::ssize(normals_) * Dim;
    Eigen::MatrixXd stiffness(size, size);
    std::vector<FreeFaceOfCell<Dim>> faces;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
        faces.push_back({normals_[i], Matrix<Dim>::Identity()});
        for (std::size_t j = 0; j < normals_.size(); ++j) {
            Matrix<Dim> between = face_stiffness<Dim>(lambda, mu, 1.0, normals_[i], normals_[j]);
            if (directed) between += directed->between(normals_[i], normals_[j]);
            stiffness.block<Dim, Dim>(static_cast<Eigen::Index>(i) * Dim, static_cast<Eigen::Index>(j) * Dim) =
                as_eigen(between);
        }
    }
    const Eigen::MatrixXd kept = balancing_combinations<Dim>(faces).of_faces;
    compliance_ =
        kept * pseudo_inverse(Eigen::MatrixXd(kept.transpose() * stiffness * kept), no_stiffness) * kept.transpose();
}

template <int Dim>
Matrix<Dim> FreeFaceAnswers<Dim>::stress(std::span<const Vector<Dim>> tractions) const {
    Eigen::VectorXd all(std::ssize(normals_) * Dim);
    for (std::size_t i = 0; i < tractions.size(); ++i)
        all.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = as_eigen(tractions[i]);
    const Eigen::VectorXd z = compliance_ * all;
    Matrix<Dim> g = Matrix<Dim>::Zero();
    for (std::size_t i = 0; i < normals_.size(); ++i)
        g += Vector<Dim>(z.segment<Dim>(static_cast<Eigen::Index>(i) * Dim)) * normals_[i].transpose();
    Matrix<Dim> sigma = lambda_ * g.trace() * Matrix<Dim>::Identity() + mu_ * (g + g.transpose());
    if (directed_) sigma += directed_->stress(g);
    return sigma;
}

template <int Dim>
double FreeFaceAnswers<Dim>::modulus(std::size_t face) const {
    const auto first = static_cast<Eigen::Index>(face) * Dim;
    const Matrix<Dim> of_face = compliance_.block<Dim, Dim>(first, first);
    return 1.0 / normals_[face].dot(of_face * normals_[face]);
}

template class FreeFaceAnswers<2>;
template class FreeFaceAnswers<3>;

}  // namespace abut::solid
