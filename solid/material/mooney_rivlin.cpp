#include "abut/solid/material/mooney_rivlin.hpp"

#include <cmath>

namespace abut::solid {
namespace {

/// x - ln(1 + x), to rounding for small x, too.
double less_log(double x) {
    constexpr double small = 0.05;
    if (!(std::abs(x) < small)) return x - std::log1p(x);
    constexpr int last = 16;  // 0.05^15 is below rounding
    double sum = 0.0;
    for (int n = last; n >= 2; --n) sum = 1.0 / n - x * sum;
    return x * x * sum;
}

/// Strain of F = I + G: E and what of it the energy is made of.
template <int Dim>
struct Strain {
    Matrix<Dim> e, inverse;        // Green's strain, C^-1
    double trace, second, volume;  // tr E, its second invariant, det C - 1
    double log;                    // ln J

    explicit Strain(const Matrix<Dim>& g) {
        e = 0.5 * (g + g.transpose() + g.transpose() * g);
        trace = e.trace();
        second = 0.5 * (trace * trace - e.squaredNorm());
        volume = 2.0 * trace + 4.0 * second;
        if constexpr (Dim == 3) volume += 8.0 * e.determinant();
        log = 0.5 * std::log1p(volume);
        inverse = (Matrix<Dim>::Identity() + 2.0 * e).inverse();
    }
    /// tr E - ln J
    [[nodiscard]] double isochoric() const {
        double sum = 0.5 * less_log(volume) - 2.0 * second;
        if constexpr (Dim == 3) sum -= 4.0 * e.determinant();
        return sum;
    }
};

template <int Dim>
Matrix<Dim> second_stress(const Strain<Dim>& strain, double mu, double share, double of_volume) {
    const Matrix<Dim> unit = Matrix<Dim>::Identity();
    return strain.inverse * (2.0 * mu * (1.0 + share) * strain.e + of_volume * strain.log * unit) +
           2.0 * mu * share * (strain.trace * unit - strain.e);
}

}  // namespace

template <int Dim>
Response<Dim> MooneyRivlin<Dim>::at(const Matrix<Dim>& g) const {
    const Strain<Dim> strain(g);
    return {.energy = mu_ * (1.0 + share_) * strain.isochoric() + 2.0 * mu_ * share_ * strain.second +
                      0.5 * of_volume_ * strain.log * strain.log,
            .stress = (Matrix<Dim>::Identity() + g) * second_stress(strain, mu_, share_, of_volume_)};
}

template <int Dim>
Matrix<Dim> MooneyRivlin<Dim>::stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const {
    const Strain<Dim> strain(g);
    const Matrix<Dim> unit = Matrix<Dim>::Identity(), f = unit + g, turned = f.transpose() * change;
    const Matrix<Dim> of_e = 0.5 * (turned + turned.transpose());
    const double of_log = strain.inverse.cwiseProduct(of_e).sum();
    const Matrix<Dim> of_second =
        2.0 * (mu_ * (1.0 + share_) - of_volume_ * strain.log) * strain.inverse * of_e * strain.inverse +
        of_volume_ * of_log * strain.inverse + 2.0 * mu_ * share_ * (of_e.trace() * unit - of_e);
    return change * second_stress(strain, mu_, share_, of_volume_) + f * of_second;
}

template class MooneyRivlin<2>;
template class MooneyRivlin<3>;

}  // namespace abut::solid
