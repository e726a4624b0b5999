#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <memory>
#include <span>
#include <typeinfo>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/cells/finite_cell.hpp"
#include "abut/solid/cells/finite_options.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/stored_energy.hpp"
#include "abut/solid/material/warm_laws.hpp"

namespace abut::solid {

/// Which cells are of bodies of Kinematics::finite, and those among them that have free faces.
template <int Dim>
class FiniteCells {
public:
    /// None.
    FiniteCells() = default;
    /// `kinematics`: one per body; empty: none is finite.
    FiniteCells(const mesh::Mesh<Dim>& mesh, const FaceConditions<Dim>& conditions, std::span<const Kinematics> kinematics,
                const FiniteOptions<Dim>& options);

    [[nodiscard]] bool any() const { return !position_.empty(); }
    /// Whether their mean force is that of both ends; else it is the discrete gradient.
    [[nodiscard]] bool takes_ends() const { return takes_ends_; }
    /// Whether a body has a StoredEnergy or an InelasticLaw.
    [[nodiscard]] bool any_law() const { return !laws_.empty() || any_inelastic(); }
    /// Whether a cell has one of these; false: its material is St. Venant and Kirchhoff's.
    [[nodiscard]] bool has_law(std::ptrdiff_t cell) const { return elastic_law(cell) || inelastic(cell) >= 0; }
    /// Whether its material is St. Venant and Kirchhoff's, warm or not: for strains that are not large.
    [[nodiscard]] bool is_linear_in_strain(std::ptrdiff_t cell) const {
        const WarmEnergy<Dim>* warm = warm_energy(cell);
        return warm ? warm->is_linear_in_strain() : !has_law(cell);
    }
    /// The stored energy of a cell; null where its material is inelastic or St. Venant and Kirchhoff's.
    [[nodiscard]] const StoredEnergy<Dim>* elastic_law(std::ptrdiff_t cell) const {
        return laws_.empty() ? nullptr : law_[static_cast<std::size_t>(cell)];
    }

    /// Whether a body has an InelasticLaw, on any rank.
    [[nodiscard]] bool any_inelastic() const { return !inelastic_laws_.empty(); }
    [[nodiscard]] std::size_t n_inelastic() const { return inelastic_.size(); }
    /// Index of a cell among those that remember, increasing; -1: it does not.
    [[nodiscard]] std::int32_t inelastic(std::ptrdiff_t cell) const {
        return inelastic_index_.empty() ? -1 : inelastic_index_[static_cast<std::size_t>(cell)];
    }
    /// By this index.
    struct Inelastic {
        const InelasticLaw<Dim>* law;
        const std::type_info* kind;  // of the law, of space where the cell is warm
        std::int32_t cell;
        std::int32_t size;     // of z
        std::ptrdiff_t begin;  // of the memory of the cell: z, and where it has free faces their LeastEnergy::shape
        std::ptrdiff_t end;
    };
    [[nodiscard]] const Inelastic& inelastic_cell(std::int32_t index) const {
        return inelastic_[static_cast<std::size_t>(index)];
    }
    /// Whether a body has a WarmEnergy or a WarmInelastic, on any rank.
    [[nodiscard]] bool any_warm() const { return any_warm_; }
    /// A of a cell of such a body; null: it is none.
    [[nodiscard]] const ThermalStretch* stretch(std::ptrdiff_t cell) const {
        return stretch_.empty() ? nullptr : stretch_[static_cast<std::size_t>(cell)];
    }
    /// The law of a cell that is warm and elastic; null: it is not.
    [[nodiscard]] const WarmEnergy<Dim>* warm_energy(std::ptrdiff_t cell) const {
        return stretch(cell) && inelastic(cell) < 0 ? static_cast<const WarmEnergy<Dim>*>(elastic_law(cell)) : nullptr;
    }
    /// From now on the laws of warm cells answer for this rise of the temperature of each cell (n_cells); empty: 0 [K].
    void set_temperature(std::span<const double> rise) const;
    /// The memory of all cells that nothing has happened to.
    [[nodiscard]] std::vector<double> initial_memory() const;
    [[nodiscard]] bool contains(std::ptrdiff_t cell) const {
        return any() && position_[static_cast<std::size_t>(cell)] != linear;
    }
    /// Position of a cell of such a body in `free`; -1 where it has no free face.
    [[nodiscard]] std::int32_t free_position(std::ptrdiff_t cell) const { return position_[static_cast<std::size_t>(cell)]; }
    [[nodiscard]] std::span<const FreeCell<Dim>> free() const { return free_; }
    /// The cell with free faces, of whose gradient contact sees F_cond; null for others.
    [[nodiscard]] const FreeCell<Dim>* free_cell(std::ptrdiff_t cell) const {
        const std::int32_t position = any() ? position_[static_cast<std::size_t>(cell)] : linear;
        return position >= 0 ? &free_[position] : nullptr;
    }
    /// A free cell all of whose normals are one; null for others, those at edges and corners, too.
    [[nodiscard]] const FreeCell<Dim>* of_one_normal(std::ptrdiff_t cell) const {
        const FreeCell<Dim>* free = free_cell(cell);
        return free && free->has_one_normal() ? free : nullptr;
    }
    /// Whether F_cond is that of its traces, too: it has one normal, and is not of FaceConditions::is_thick or remembers
    /// what happens to it. Else they have that of the affine faces.
    [[nodiscard]] bool has_condensed_traces(std::ptrdiff_t cell) const {
        const bool is_thick = !is_thick_.empty() && is_thick_[static_cast<std::size_t>(cell)] != 0;
        return of_one_normal(cell) && (!is_thick || inelastic(cell) >= 0);
    }
    /// Whether it is one of the free faces of a FreeCell.
    [[nodiscard]] bool is_free(BoundaryFace face) const { return is_free_[face] != 0; }
    /// Whether contact sees F_cond at the free faces of a cell. At edges and corners of a material that flows it does not:
    /// a cell that bears nothing there has no memory of how it has flowed.
    [[nodiscard]] bool shows_condensed(std::ptrdiff_t cell) const {
        const FreeCell<Dim>* free = free_cell(cell);
        return free && (free->has_one_normal() || inelastic(cell) < 0);
    }
    /// The free cell behind a boundary face if contact and bonds at this face see F_cond: at an edge or a corner only
    /// where the face is free itself. Null: they see F of the affine faces.
    [[nodiscard]] const FreeCell<Dim>* condensed_behind(BoundaryFace face, std::ptrdiff_t cell) const {
        const FreeCell<Dim>* free = free_cell(cell);
        return shows_condensed(cell) && (free->has_one_normal() || is_free(face)) ? free : nullptr;
    }

private:
    void set_elastic(const mesh::Mesh<Dim>& mesh, const FiniteOptions<Dim>& options);
    void set_inelastic(const mesh::Mesh<Dim>& mesh, const FiniteOptions<Dim>& options);
    template <class WarmLaw, class Law>
    [[nodiscard]] const Law* law_of_cell(std::int32_t cell, const Law* of_body,
                                         std::vector<std::unique_ptr<WarmLaw>>& warm_laws);

    static constexpr std::int32_t linear = -2, inside = -1;

    std::vector<std::int32_t> position_;  // of each cell; empty where no body is finite
    std::vector<FreeCell<Dim>> free_;
    IdVector<BoundaryFace, char> is_free_;
    std::vector<char> is_thick_;
    bool takes_ends_ = false;
    std::vector<std::shared_ptr<const StoredEnergy<Dim>>> laws_;  // by body; empty without any
    std::vector<const StoredEnergy<Dim>*> law_;                   // of each cell; the same
    std::vector<std::shared_ptr<const InelasticLaw<Dim>>> inelastic_laws_;
    std::vector<std::int32_t> inelastic_index_;  // of each cell; empty without any
    std::vector<Inelastic> inelastic_;
    bool any_warm_ = false;
    std::vector<ThermalStretch*> stretch_;  // of each cell; empty without any
    std::vector<std::unique_ptr<WarmEnergy<Dim>>> warm_energies_;
    std::vector<std::unique_ptr<WarmInelastic<Dim>>> warm_inelastic_;
};

}  // namespace abut::solid
