#include "abut/solid/material/warm_laws.hpp"

#include <algorithm>
#include <array>

#include "abut/solid/material/orthotropic.hpp"

namespace abut::solid {
namespace {

constexpr std::size_t most_changes = 6;  // free faces ask for five at most

/// Sets `results` by what `of_law` says of the changes of F_e. False: it says nothing.
template <int Dim, class OfLaw>
bool changes_of(const ThermalStretch& stretch, std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results,
                const OfLaw& of_law) {
    std::array<Matrix<3>, most_changes> elastic, of_stress;
    for (std::size_t begin = 0; begin < changes.size(); begin += most_changes) {
        const std::size_t n = std::min(most_changes, changes.size() - begin);
        for (std::size_t i = 0; i < n; ++i) elastic[i] = stretch.elastic_change<Dim>(changes[begin + i]);
        if (!of_law(std::span<const Matrix<3>>(elastic).first(n), std::span(of_stress).first(n))) return false;
        for (std::size_t i = 0; i < n; ++i) results[begin + i] = stretch.stress<Dim>(of_stress[i]);
    }
    return true;
}

}  // namespace

template <int Dim>
WarmEnergy<Dim>::WarmEnergy(std::shared_ptr<const StoredEnergy<3>> law, const ThermalStretch& stretch)
    : law_(std::move(law)), is_linear_(dynamic_cast<const OrthotropicEnergy<3>*>(law_.get())), stretch_(stretch) {}

template <int Dim>
Response<Dim> WarmEnergy<Dim>::at(const Matrix<Dim>& g) const {
    return stretch_.response<Dim>(law_->at(stretch_.elastic_gradient<Dim>(g)));
}

template <int Dim>
Matrix<Dim> WarmEnergy<Dim>::stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const {
    return stretch_.stress<Dim>(
        law_->stress_change(stretch_.elastic_gradient<Dim>(g), stretch_.elastic_change<Dim>(change)));
}

template <int Dim>
double WarmEnergy<Dim>::out_of_plane_stress(const Matrix<Dim>& g) const {
    if constexpr (Dim == 3) return 0.0;
    if constexpr (Dim == 2) return stretch_.out_of_plane_stress(g, law_->at(stretch_.elastic_gradient<2>(g)).stress);
}

template <int Dim>
Response<Dim> WarmInelastic<Dim>::at(const Matrix<Dim>& g, std::span<const double> memory) const {
    return stretch_.response<Dim>(law_->at(stretch_.elastic_gradient<Dim>(g), memory));
}

template <int Dim>
Advance<Dim> WarmInelastic<Dim>::advance(const Matrix<Dim>& g, double dt, std::span<double> memory) const {
    const Advance<3> advance = law_->advance(stretch_.elastic_gradient<Dim>(g), dt, memory);
    return {stretch_.response<Dim>(advance.response), advance.dissipates};
}

template <int Dim>
bool WarmInelastic<Dim>::stress_changes(const Matrix<Dim>& g, std::span<const double> memory,
                                        std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const {
    const Matrix<3> elastic = stretch_.elastic_gradient<Dim>(g);
    return changes_of<Dim>(stretch_, changes, results, [&](std::span<const Matrix<3>> of_f, std::span<Matrix<3>> of_stress) {
        return law_->stress_changes(elastic, memory, of_f, of_stress);
    });
}

template <int Dim>
bool WarmInelastic<Dim>::advanced_changes(const Matrix<Dim>& g, double dt, std::span<const double> memory,
                                          std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const {
    const Matrix<3> elastic = stretch_.elastic_gradient<Dim>(g);
    return changes_of<Dim>(stretch_, changes, results, [&](std::span<const Matrix<3>> of_f, std::span<Matrix<3>> of_stress) {
        return law_->advanced_changes(elastic, dt, memory, of_f, of_stress);
    });
}

template <int Dim>
std::optional<double> WarmInelastic<Dim>::out_of_plane_stress(const Matrix<Dim>& g, std::span<const double> memory) const {
    if constexpr (Dim == 3) return std::nullopt;
    if constexpr (Dim == 2) return stretch_.out_of_plane_stress(g, law_->at(stretch_.elastic_gradient<2>(g), memory).stress);
}

template class WarmEnergy<2>;
template class WarmEnergy<3>;
template class WarmInelastic<2>;
template class WarmInelastic<3>;

}  // namespace abut::solid
