#include "abut/solid/operator/free_face_answers.hpp"

#include <utility>

#include "abut/base/dense_decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/solid/operator/boundary_reconstruction.hpp"
#include "abut/solid/operator/free_strains.hpp"

namespace abut::solid {

template <int Dim>
StressOfPushes<Dim> stress_of_gradient(const Matrix<Dim>& g, double lambda, double mu,
                                       const DirectedStiffness<Dim>* directed) {
    StressOfPushes<Dim> sigma{lambda * g.trace() * Matrix<Dim>::Identity() + mu * (g + g.transpose())};
    if (Dim == 2) sigma.out_of_plane = lambda * g.trace();
    if (!directed) return sigma;
    sigma.in_space += directed->stress(g);
    if constexpr (Dim == 2) sigma.out_of_plane += directed->out_of_plane_stress(g);
    return sigma;
}

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
StressOfPushes<Dim> FreeFaceAnswers<Dim>::stress(std::span<const Vector<Dim>> tractions) const {
    Eigen::VectorXd all(std::ssize(normals_) * Dim);
    for (std::size_t i = 0; i < tractions.size(); ++i)
        all.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = as_eigen(tractions[i]);
    const Eigen::VectorXd z = compliance_ * all;
    Matrix<Dim> g = Matrix<Dim>::Zero();
    for (std::size_t i = 0; i < normals_.size(); ++i)
        g += Vector<Dim>(z.segment<Dim>(static_cast<Eigen::Index>(i) * Dim)) * normals_[i].transpose();
    return stress_of_gradient<Dim>(g, lambda_, mu_, directed_);
}

template <int Dim>
double FreeFaceAnswers<Dim>::modulus(std::size_t face) const {
    const auto first = static_cast<Eigen::Index>(face) * Dim;
    const Matrix<Dim> of_face = compliance_.block<Dim, Dim>(first, first);
    return 1.0 / normals_[face].dot(of_face * normals_[face]);
}

template StressOfPushes<2> stress_of_gradient<2>(const Matrix<2>&, double, double, const DirectedStiffness<2>*);
template StressOfPushes<3> stress_of_gradient<3>(const Matrix<3>&, double, double, const DirectedStiffness<3>*);
template class FreeFaceAnswers<2>;
template class FreeFaceAnswers<3>;

}  // namespace abut::solid
