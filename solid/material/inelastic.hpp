#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/solid/material/stored_energy.hpp"

namespace abut::solid {

/// The result of a step in a cell.
template <int Dim>
struct Advance {
    Response<Dim> response;   ///< the least of W + what the step dissipates, as a function of G, and its slope: P at the end
    bool dissipates = false;  ///< whether the step may have taken energy out of the cell
};

/// A material that remembers: its stored energy W(F, z) depends on numbers z, of each cell, that steps change. What a
/// step takes out of W is booked as dissipated (docs/method.md, Bodies that bend).
///
/// Only `advance` changes z, and only a step that has ended keeps what it has changed: an energy, a force or a picture
/// of a state never does. W and P of a state follow from G and z alone, so that a run that goes on from saved numbers
/// has the same bits.
///
/// One object serves all cells of a body, from several threads at once.
template <int Dim>
class InelasticLaw {
public:
    InelasticLaw() = default;
    InelasticLaw(const InelasticLaw&) = delete;
    InelasticLaw& operator=(const InelasticLaw&) = delete;
    virtual ~InelasticLaw() = default;

    /// z of a cell that nothing has happened to. Its size is that of every z.
    [[nodiscard]] virtual std::vector<double> initial_memory() const = 0;
    /// W and dW/dF while z stays as it is, by the rules of StoredEnergy::at.
    [[nodiscard]] virtual Response<Dim> at(const Matrix<Dim>& g, std::span<const double> memory) const = 0;
    /// Changes z by a step of length `dt` [s] that ends at G. Afterwards `at` has the stress that is returned, up to
    /// rounding.
    [[nodiscard]] virtual Advance<Dim> advance(const Matrix<Dim>& g, double dt, std::span<double> memory) const = 0;
    /// Sets `results` to the changes of the stress of `at` for changes of F at G. False: there is no closed form, and
    /// differences are taken. Free faces of cells ask for it.
    [[nodiscard]] virtual bool stress_changes(const Matrix<Dim>& g, std::span<const double> memory,
                                              std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const {
        (void)g, (void)memory, (void)changes, (void)results;
        return false;
    }
    /// Like `stress_changes`, for the stress at the end of a step that begins with this memory.
    [[nodiscard]] virtual bool advanced_changes(const Matrix<Dim>& g, double dt, std::span<const double> memory,
                                                std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const {
        (void)g, (void)dt, (void)memory, (void)changes, (void)results;
        return false;
    }
    /// In the plane: Cauchy's stress out of it [Pa].
    [[nodiscard]] virtual std::optional<double> out_of_plane_stress(const Matrix<Dim>& g,
                                                                    std::span<const double> memory) const {
        (void)g, (void)memory;
        return std::nullopt;
    }
    /// The equivalent plastic strain that z holds [-], or 0.
    [[nodiscard]] virtual double plastic_strain(std::span<const double> memory) const {
        (void)memory;
        return 0.0;
    }
};

/// An inelastic material while it remembers what it does now: it stores energy as an elastic one.
template <int Dim>
class FrozenLaw final : public StoredEnergy<Dim> {
public:
    FrozenLaw() = default;
    /// Both must outlive it.
    FrozenLaw(const InelasticLaw<Dim>& law, std::span<const double> memory) : law_(&law), memory_(memory) {}
    void set(const InelasticLaw<Dim>& law, std::span<const double> memory) {
        law_ = &law;
        memory_ = memory;
    }

    [[nodiscard]] Response<Dim> at(const Matrix<Dim>& g) const override { return law_->at(g, memory_); }
    [[nodiscard]] Matrix<Dim> stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const override {
        Matrix<Dim> result;
        stress_changes(g, std::span(&change, 1), std::span(&result, 1));
        return result;
    }
    void stress_changes(const Matrix<Dim>& g, std::span<const Matrix<Dim>> changes,
                        std::span<Matrix<Dim>> results) const override {
        if (law_->stress_changes(g, memory_, changes, results)) return;
        for (std::size_t i = 0; i < changes.size(); ++i) results[i] = StoredEnergy<Dim>::stress_change(g, changes[i]);
    }

private:
    const InelasticLaw<Dim>* law_ = nullptr;
    std::span<const double> memory_;
};

/// An inelastic material in one step: what the step stores and dissipates is what an elastic one would store.
template <int Dim>
class SteppedLaw final : public StoredEnergy<Dim> {
public:
    /// All must outlive it. `changed` is what the memory becomes in the state that was asked for last, of the same size.
    SteppedLaw(const InelasticLaw<Dim>& law, double dt, std::span<const double> memory, std::span<double> changed)
        : law_(law), dt_(dt), memory_(memory), changed_(changed) {}

    [[nodiscard]] Response<Dim> at(const Matrix<Dim>& g) const override {
        std::ranges::copy(memory_, changed_.begin());
        return law_.advance(g, dt_, changed_).response;
    }
    void stress_changes(const Matrix<Dim>& g, std::span<const Matrix<Dim>> changes,
                        std::span<Matrix<Dim>> results) const override {
        if (law_.advanced_changes(g, dt_, memory_, changes, results)) return;
        StoredEnergy<Dim>::stress_changes(g, changes, results);
    }

private:
    const InelasticLaw<Dim>& law_;
    double dt_;
    std::span<const double> memory_;
    std::span<double> changed_;
};

}  // namespace abut::solid
