#include "abut/solid/material/orthotropic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/rotation.hpp"
#include "abut/solid/material/refuse_material.hpp"

namespace abut::solid {
namespace {

using Stiffness = SmallMatrix<6, 6>;  // of 11, 22, 33 and sqrt 2 times 23, 13, 12
constexpr std::array<std::pair<int, int>, 6> components_in_space{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
constexpr double least_determinant = 1e-9;  // of the compliances of tension, over those without Poisson's ratios
constexpr double right_angle = 1e-6;        // of the cosine between axes

Matrix<3> compliance_of_tension(const Material& material) {
    const Orthotropy& of = material.orthotropic;
    const double e_1 = material.young, e_2 = of.young_2, e_3 = of.young_3;
    return {{1.0 / e_1, -material.poisson / e_1, -of.poisson_13 / e_1},
            {-material.poisson / e_1, 1.0 / e_2, -of.poisson_23 / e_2},
            {-of.poisson_13 / e_1, -of.poisson_23 / e_2, 1.0 / e_3}};
}

/// In the axes of the material.
Stiffness stiffness_of(const Material& material) {
    Stiffness stiffness = Stiffness::Zero();
    const Matrix<3> tension = compliance_of_tension(material).inverse();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) stiffness(i, j) = 0.5 * (tension(i, j) + tension(j, i));
    stiffness(3, 3) = 2.0 * material.orthotropic.shear_23;
    stiffness(4, 4) = 2.0 * material.orthotropic.shear_13;
    stiffness(5, 5) = 2.0 * material.orthotropic.shear_12;
    return stiffness;
}

/// In columns, of unit length and at right angles; those of the plane are turned about z.
Matrix<3> axes_of(const Orthotropy& of) {
    const auto given = [](const std::array<double, 3>& axis) { return Vector<3>(axis[0], axis[1], axis[2]); };
    Matrix<3> axes;
    axes.col(0) = given(of.axis_1).normalized();
    const Vector<3> second = given(of.axis_2);
    axes.col(1) = (second - axes.col(0).dot(second) * axes.col(0)).normalized();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return rotation_about(Vector<3>::UnitZ(), of.axis_angle) * axes;
}

/// How the components of symmetric tensors turn with their axes; its inverse is its transpose.
Stiffness turn_of(const Matrix<3>& axes) {
    Stiffness turn;
    for (int column = 0; column < 6; ++column) {
        const auto [k, l] = components_in_space[static_cast<std::size_t>(column)];
        const double weight = k == l ? 0.5 : 1.0 / std::numbers::sqrt2;
        const Matrix<3> tensor = weight * (axes.col(k) * axes.col(l).transpose() + axes.col(l) * axes.col(k).transpose());
        for (int row = 0; row < 6; ++row) {
            const auto [i, j] = components_in_space[static_cast<std::size_t>(row)];
            turn(row, column) = (i == j ? 1.0 : std::numbers::sqrt2) * tensor(i, j);
        }
    }
    return turn;
}

Stiffness isotropic(const Lame& moduli) {
    Stiffness stiffness = 2.0 * moduli.mu * Stiffness::Identity();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) stiffness(i, j) += moduli.lambda;
    return stiffness;
}

/// Of those in space, the components in the plane: x, y and xy.
template <int Dim>
constexpr auto components = [] {
    if constexpr (Dim == 2)
        return std::array{0, 1, 5};
    else
        return std::array{0, 1, 2, 3, 4, 5};
}();
constexpr int out_of_plane = 2;

void check_ratio(int body, const char* name, double ratio, const char* along, double young, const char* across,
                 double young_across) {
    const double limit = std::sqrt(young / young_across);
    if (!(std::abs(ratio) < limit))
        refuse_material(body, name, ratio,
                        "it must be between -r and r, r = sqrt(" + std::string(along) + "/" + across +
                            ") = " + number(limit) +
                            ", or stretching would release energy. It is the contraction along the "
                            "second axis over the stretch along the first, under tension along the first.");
}

}  // namespace

Lame mean_moduli(const Material& material) {
    const Stiffness stiffness = stiffness_of(material);
    const double volume = stiffness.topLeftCorner<3, 3>().sum();
    const double mu = (stiffness.trace() - volume / 3.0) / 10.0;
    return {volume / 9.0 - 2.0 / 3.0 * mu, mu};
}

double largest_wave_modulus(const Material& material) {
    const Stiffness stiffness = stiffness_of(material);
    return std::max(stiffness.diagonal().head<3>().maxCoeff(), 0.5 * stiffness.diagonal().tail<3>().maxCoeff());
}

Matrix<3> thermal_strain(const Material& material) {
    if (material.is_isotropic()) return material.expansion.along_1 * Matrix<3>::Identity();
    const Vector<3> along(material.expansion.along_1, material.expansion.along_2, material.expansion.along_3);
    const Matrix<3> axes = axes_of(material.orthotropic);
    return axes * along.asDiagonal() * axes.transpose();
}

void check_orthotropic(const Material& material, int body) {
    const Orthotropy& of = material.orthotropic;
    for (const auto& [name, value] :
         {std::pair{"young_2", of.young_2}, std::pair{"young_3", of.young_3}, std::pair{"shear_12", of.shear_12},
          std::pair{"shear_13", of.shear_13}, std::pair{"shear_23", of.shear_23}})
        if (!(value > 0.0)) refuse_material(body, name, value, "it must be above 0 Pa: orthotropic needs it.");
    check_ratio(body, "poisson", material.poisson, "young", material.young, "young_2", of.young_2);
    check_ratio(body, "poisson_13", of.poisson_13, "young", material.young, "young_3", of.young_3);
    check_ratio(body, "poisson_23", of.poisson_23, "young_2", of.young_2, "young_3", of.young_3);
    const double determinant = compliance_of_tension(material).determinant() * material.young * of.young_2 * of.young_3;
    if (!(determinant > least_determinant))
        refuse_material(body, "1 - nu_12 nu_21 - nu_13 nu_31 - nu_23 nu_32 - 2 nu_21 nu_32 nu_13", determinant,
                        "it must be above " + number(least_determinant) +
                            ", or some stretch would cost no energy. Make poisson, poisson_13 or poisson_23 smaller.");
    const Vector<3> first = Vector<3>(of.axis_1.data()), second = Vector<3>(of.axis_2.data());
    for (const auto& [name, axis] : {std::pair{"axis_1", first}, std::pair{"axis_2", second}})
        if (!(axis.norm() > 0.0) || !axis.allFinite())
            refuse_material(body, std::string("the length of ") + name, axis.norm(), "it must be finite and above 0.");
    const double cosine = first.normalized().dot(second.normalized());
    if (!(std::abs(cosine) <= right_angle))
        refuse_material(body, "the cosine between axis_1 and axis_2", cosine,
                        "they must be at right angles, to " + number(right_angle) + ".");
}

template <int Dim>
DirectedStiffness<Dim>::DirectedStiffness(const Material& material) : any_(material.law == MaterialLaw::orthotropic) {
    stiffness_.setZero();
    out_of_plane_.setZero();
    if (!any_) return;
    const Stiffness turn = turn_of(axes_of(material.orthotropic));
    const Stiffness beyond = stiffness_of(material) - isotropic(mean_moduli(material));  // which no turn changes
    const Stiffness in_space = turn * beyond * turn.transpose();
    for (int i = 0; i < n_components; ++i) {
        const int row = components<Dim>[static_cast<std::size_t>(i)];
        out_of_plane_[i] = in_space(out_of_plane, row);
        for (int j = 0; j < n_components; ++j) {
            const int column = components<Dim>[static_cast<std::size_t>(j)];
            stiffness_(i, j) = 0.5 * (in_space(row, column) + in_space(column, row));
        }
    }
}

template <int Dim>
auto DirectedStiffness<Dim>::packed(const Matrix<Dim>& tensor) -> Packed {
    Packed strain;
    for (int k = 0; k < n_components; ++k) {
        const auto [i, j] = components_in_space[static_cast<std::size_t>(components<Dim>[static_cast<std::size_t>(k)])];
        strain[k] = i == j ? tensor(i, i) : (tensor(i, j) + tensor(j, i)) / std::numbers::sqrt2;
    }
    return strain;
}

template <int Dim>
Matrix<Dim> DirectedStiffness<Dim>::stress(const Matrix<Dim>& g) const {
    const Packed of_strain = stiffness_ * packed(g);
    Matrix<Dim> result;
    for (int k = 0; k < n_components; ++k) {
        const auto [i, j] = components_in_space[static_cast<std::size_t>(components<Dim>[static_cast<std::size_t>(k)])];
        result(i, j) = result(j, i) = i == j ? of_strain[k] : of_strain[k] / std::numbers::sqrt2;
    }
    return result;
}

template <int Dim>
double DirectedStiffness<Dim>::out_of_plane_stress(const Matrix<Dim>& g) const {
    return out_of_plane_.dot(packed(g));
}

template <int Dim>
Matrix<Dim> DirectedStiffness<Dim>::between(const Vector<Dim>& first, const Vector<Dim>& second) const {
    Matrix<Dim> result;
    for (int j = 0; j < Dim; ++j) result.col(j) = stress(Vector<Dim>::Unit(j) * second.transpose()) * first;
    return result;
}

template <int Dim>
double wave_modulus_along(const Material& material, const DirectedStiffness<Dim>& directed, const Vector<Dim>& n) {
    if (!directed.any()) return material.wave_modulus();
    return material.lambda() + 2.0 * material.mu() + n.dot(directed.between(n, n) * n);
}

template <int Dim>
Matrix<Dim> OrthotropicEnergy<Dim>::stress_of(const Matrix<Dim>& strain) const {
    return 2.0 * mu_ * strain + lambda_ * strain.trace() * Matrix<Dim>::Identity() + directed_.stress(strain);
}

template <int Dim>
Response<Dim> OrthotropicEnergy<Dim>::at(const Matrix<Dim>& g) const {
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g, strain = 0.5 * (g + g.transpose() + g.transpose() * g);
    const Matrix<Dim> stress = stress_of(strain);
    const bool is_inside_out = !(f.determinant() > 0.0);
    return {is_inside_out ? std::numeric_limits<double>::infinity() : 0.5 * stress.cwiseProduct(strain).sum(), f * stress};
}

template <int Dim>
Matrix<Dim> OrthotropicEnergy<Dim>::stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const {
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g, strain = 0.5 * (g + g.transpose() + g.transpose() * g);
    const Matrix<Dim> turned = f.transpose() * change;
    return change * stress_of(strain) + f * stress_of(0.5 * (turned + turned.transpose()));
}

#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template class DirectedStiffness<Dim>;                                                                       \
    template double wave_modulus_along<Dim>(const Material&, const DirectedStiffness<Dim>&, const Vector<Dim>&); \
    template class OrthotropicEnergy<Dim>;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
