#pragma once
// Private to the C layer.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/clocked_run.hpp"
#include "abut/solid/outside_view.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/stepped_run.hpp"
#include "abut_solid.h"
#include "body_values.hpp"

namespace abut::c_layer {

/// The parts that were added to an abut_solid so far, and then its run.
template <int Dim>
class SolidRun {
public:
    void add(mesh::Mesh<Dim> mesh, const abut_material& material, const double* velocity);
    void hold(const char* group, solid::Constraint constraint) {
        options_.boundary.dirichlet.push_back({.group = group, .constraint = constraint});
    }
    void load(const char* group, const double* traction) {
        options_.boundary.traction.push_back({.group = group, .value = vector_of(traction), .from_outside = true});
    }
    void bond(const char* side_1, const char* side_2, double strength, double fracture_energy) {
        bonds_.push_back({{side_1, side_2}, strength, fracture_energy});
    }
    /// Cuts the body into grains. Throws BadInput for one that is not there, not alone in its mesh or cut already, and for
    /// values that cannot be.
    void set_fracture(const std::string& body, const abut_fracture& fracture);
    using SetValues = std::function<void(BodyValues&)>;
    /// Tries at once what `set` throws for any body.
    void set_values(const std::string& body, SetValues set);
    void set_temperature(const std::string& body, solid::TemperatureRise<Dim> rise) {
        temperatures_.push_back({body, std::move(rise)});
    }
    void begin(const abut_solid_options& given);

    [[nodiscard]] bool has_begun() const { return run_.has_value(); }
    [[nodiscard]] solid::SteppedRun<Dim>& run() { return *run_; }
    [[nodiscard]] std::int64_t n_faces(const std::string& group) const {
        return std::ssize(run_->solid().outside(group).traction());
    }
    void write_faces(const std::string& group, const abut_solid_face_arrays& faces);
    void set_traction(const std::string& group, const abut_array& traction);
    [[nodiscard]] std::int64_t n_cells(const std::string& body) const;
    void write_cells(const std::string& body, const abut_solid_cell_arrays& cells);
    [[nodiscard]] std::int64_t n_fragments() const;
    void write_fragments(const abut_solid_fragment_arrays& fragments);
    void write_state(abut_solid_state& state);
    /// From the next step on. Throws BadInput for one above the stable step.
    void set_step(double dt, dynamics::StepChange change);
    void begin_clock(solid::LoadImpulse impulse) { clock_.emplace(*run_, impulse); }
    /// Throws Misuse where it has not begun.
    [[nodiscard]] solid::ClockedRun<Dim>& clock();
    void write_motion(const std::string& group, double d, const abut_array& motion);
    void keep() { kept_ = clock().state(); }
    /// Throws Misuse where nothing is kept.
    void go_back();
    /// A number of the ledger, by the name of its column.
    [[nodiscard]] double ledger_value(const std::string& column);

private:
    static Vector<Dim> vector_of(const double* given) { return given == nullptr ? Vector<Dim>::Zero() : Vector<Dim>(given); }

    struct NamedBond {
        std::array<std::string, 2> sides;
        double strength, fracture_energy;
    };
    template <class Value>
    struct OfBody {
        std::string body;
        Value value;
    };
    struct Fracture {
        std::string body;
        solid::Bond bond;  ///< of any two of its grains, without sides
    };
    /// The body of this name, or the grains of the one that had it, increasing. Throws BadInput if there are none.
    [[nodiscard]] std::vector<std::int32_t> bodies_called(const std::string& name) const;
    void bond_grains(solid::SolidOptions<Dim>& options) const;
    [[nodiscard]] std::int32_t side_of_bond(const std::string& name) const;
    void take_values(solid::SolidOptions<Dim>& options) const;
    [[nodiscard]] solid::SolidOptions<Dim> options_of(const abut_solid_options& given) const;

    std::vector<mesh::Mesh<Dim>> meshes_;
    std::vector<NamedBond> bonds_;
    std::vector<Fracture> fractures_;
    std::vector<std::int32_t> fracture_of_body_;  // position in fractures_; -1 of a body that stays whole
    std::vector<OfBody<SetValues>> values_;
    std::vector<OfBody<solid::TemperatureRise<Dim>>> temperatures_;
    solid::SolidOptions<Dim> options_;
    std::vector<Vector<Dim>> velocity_;
    mesh::Mesh<Dim> mesh_;
    std::optional<solid::SteppedRun<Dim>> run_;
    std::optional<solid::ClockedRun<Dim>> clock_;
    std::optional<typename solid::ClockedRun<Dim>::State> kept_;
    double stable_dt_ = 0.0;
    decltype(abut_solid_options::log) log_ = nullptr;
    void* user_ = nullptr;
};

}  // namespace abut::c_layer
