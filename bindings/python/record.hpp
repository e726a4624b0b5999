#pragma once
// What a run keeps for Python, and what it shows while it goes on.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/without_cells.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/files/contact_forces.hpp"
#include "abut/run/files/probes.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/sight.hpp"
#include "states.hpp"
#include "vectors.hpp"

namespace abut::python {

using namespace py::literals;

/// Keeps what the files of a run hold of its probes, forces and frames. A run that goes on is kept from there.
template <int Dim>
class Record : public run::Observer<Dim> {
public:
    void begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) override {
        first_mesh_ = &scene.mesh;
        has_probes_ = !scene.outputs.probes.empty();
        probes_ = run::Probes<Dim>(scene, result);
        for (const run::Probe<Dim>& probe : scene.outputs.probes) {
            probe_names_.push_back(probe.name);
            probe_columns_.push_back(run::Probes<Dim>::columns(probe));
        }
        probe_values_.resize(probe_names_.size());
        forces_ = run::ContactForces<Dim>(scene, result);
        names_ = scene.mesh.body_names;
        for (std::size_t i = 0; i < scene.solid.obstacles.size(); ++i) names_.push_back(run::name_of_obstacle(scene, i));
        n_steps_ = result.run.steps;
        n_frames_ = result.options.times.empty() ? result.options.frames : 0;
    }
    void cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) override {
        if (has_probes_) probes_.take_cells(first_cells);
        const mesh::Mesh<Dim>&first = *first_mesh_, &left = solid.mesh();
        const auto faces = mesh::old_faces(first, left, first_cells);
        cells_.assign(first_cells.begin(), first_cells.end());
        points_ = mesh::old_vertices(first, left, first_cells);
        faces_.clear();
        for (const std::int32_t face : left.boundary_faces) {
            const auto at = std::ranges::lower_bound(first.boundary_faces, faces[static_cast<std::size_t>(face)]);
            const bool was_there = at != first.boundary_faces.end() && *at == faces[static_cast<std::size_t>(face)];
            faces_.push_back(was_there ? static_cast<std::int32_t>(at - first.boundary_faces.begin()) : -1);
        }
    }
    [[nodiscard]] bool wants_look(std::int64_t step) const override {
        return wants_frame(step) || forces_.wants_look(step) || (has_probes_ && probes_.wants_look(step));
    }
    void look(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) override {
        if (has_probes_ && probes_.wants_look(view.steps)) add_probes(view, solid);
        if (forces_.wants_look(view.steps))
            for (const run::ForceRow<Dim>& row :
                 forces_.rows(run::Moment<Dim>{view.steps, view.time, solid.contact().impulses()}))
                force_rows_.push_back(row);
        if (wants_frame(view.steps)) add_frame(view, solid);
    }

    void look_at_time(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) override { add_frame(view, solid); }

    /// {name: {column: array}}
    [[nodiscard]] py::dict probes() const {
        py::dict tables;
        for (std::size_t probe = 0; probe < probe_names_.size(); ++probe) {
            py::dict table("step"_a = copy_of(probe_steps_), "time"_a = copy_of(probe_times_));
            const std::vector<std::string>& columns = probe_columns_[probe];
            for (std::size_t i = 0; i < columns.size(); ++i) {
                std::vector<double> column;
                for (const std::vector<double>& values : probe_values_[probe]) column.push_back(values[i]);
                table[columns[i].c_str()] = copy_of(column);
            }
            tables[text_of(probe_names_[probe])] = table;
        }
        return tables;
    }
    /// {column: array}
    [[nodiscard]] py::dict forces() const {
        std::vector<std::int64_t> step;
        std::vector<double> time, normal, rubbing;
        std::vector<std::string> body_1, body_2;
        std::array<std::vector<double>, Dim> force, friction, slip;
        for (const run::ForceRow<Dim>& row : force_rows_) {
            step.push_back(row.step);
            time.push_back(row.time);
            body_1.push_back(names_[static_cast<std::size_t>(row.body_1)]);
            body_2.push_back(names_[static_cast<std::size_t>(row.body_2)]);
            for (std::size_t i = 0; i < Dim; ++i) {
                force[i].push_back(row.force[static_cast<int>(i)]);
                friction[i].push_back(row.friction[static_cast<int>(i)]);
                slip[i].push_back(row.slip_velocity[static_cast<int>(i)]);
            }
            normal.push_back(row.normal_force);
            rubbing.push_back(row.rubbing_force);
        }
        py::dict table("step"_a = copy_of(step), "time"_a = copy_of(time), "body_1"_a = texts_of(body_1),
                       "body_2"_a = texts_of(body_2));
        const auto add = [&](const char* name, const auto& of_axes) {
            for (std::size_t i = 0; i < Dim; ++i) table[(std::string(name) + "_" + "xyz"[i]).c_str()] = copy_of(of_axes[i]);
        };
        add("force_on_2", force);
        table["normal_force"] = copy_of(normal);
        add("friction_on_2", friction);
        table["rubbing_force"] = copy_of(rubbing);
        add("slip_velocity_of_2", slip);
        return table;
    }
    /// {name: [array of each frame, ...]}
    [[nodiscard]] py::dict frames() const {
        return py::dict("step"_a = frame_steps_, "time"_a = frame_times_, "displacement"_a = displacement_,
                        "velocity"_a = velocity_, "stress"_a = stress_, "von_mises"_a = von_mises_,
                        "plastic_strain"_a = plastic_strain_, "contact_pressure"_a = pressure_,
                        "point_displacement"_a = point_displacement_);
    }

private:
    /// As run::Frames has it.
    [[nodiscard]] bool wants_frame(std::int64_t step) const {
        const auto written = static_cast<std::int64_t>(frame_steps_.size());
        return written < n_frames_ && step * std::max<std::int64_t>(1, n_frames_ - 1) >= written * n_steps_;
    }
    void add_probes(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) {
        probe_steps_.push_back(view.steps);
        probe_times_.push_back(view.time);
        const auto rows = probes_.values(run::sight_of<Dim>(view, solid));
        for (std::size_t probe = 0; probe < rows.size(); ++probe) probe_values_[probe].push_back(rows[probe]);
    }
    void add_frame(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) {
        const State<Dim> state(view, solid);
        const py::gil_scoped_acquire lock;
        frame_steps_.push_back(view.steps);
        frame_times_.push_back(view.time);
        const auto n_cells = static_cast<std::size_t>(first_mesh_->n_cells());
        displacement_.append(in_scene(state.displacement(), cells_, n_cells));
        velocity_.append(in_scene(state.velocity(), cells_, n_cells));
        stress_.append(in_scene(state.stress(), cells_, n_cells));
        von_mises_.append(in_scene(state.von_mises(), cells_, n_cells));
        plastic_strain_.append(in_scene(state.plastic_strain(), cells_, n_cells));
        pressure_.append(in_scene(state.contact_pressure(), faces_, first_mesh_->boundary_faces.size()));
        point_displacement_.append(in_scene(state.point_displacement(), points_, first_mesh_->vertices.size()));
    }
    /// Rows by the numbers that they have in the scene, NaN where nothing is left; as they are where nothing has left.
    [[nodiscard]] static py::array_t<double> in_scene(const py::array_t<double>& rows,
                                                      const std::vector<std::int32_t>& numbers, std::size_t n) {
        if (numbers.empty()) return rows;
        std::vector<py::ssize_t> shape(rows.shape(), rows.shape() + rows.ndim());
        const py::ssize_t width = rows.size() / std::max<py::ssize_t>(1, shape[0]);
        shape[0] = static_cast<py::ssize_t>(n);
        py::array_t<double> all(shape);
        std::fill_n(all.mutable_data(), all.size(), std::numeric_limits<double>::quiet_NaN());
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (numbers[i] >= 0)
                std::copy_n(rows.data() + static_cast<py::ssize_t>(i) * width, width,
                            all.mutable_data() + numbers[i] * width);
        return all;
    }

    bool has_probes_ = false;
    run::Probes<Dim> probes_;
    std::vector<std::string> probe_names_;
    std::vector<std::vector<std::string>> probe_columns_;  // of each
    std::vector<std::int64_t> probe_steps_;
    std::vector<double> probe_times_;
    std::vector<std::vector<std::vector<double>>> probe_values_;  // by probe and row
    run::ContactForces<Dim> forces_;
    std::vector<std::string> names_;  // of bodies, then of obstacles
    std::vector<run::ForceRow<Dim>> force_rows_;
    std::int64_t n_steps_ = 0, n_frames_ = 0;           // frames that are equally far apart
    const mesh::Mesh<Dim>* first_mesh_ = nullptr;       // of the scene, whose run this keeps
    std::vector<std::int32_t> cells_, points_, faces_;  // numbers in it; -1: a new face. Empty: nothing has left
    std::vector<std::int64_t> frame_steps_;
    std::vector<double> frame_times_;
    py::list displacement_, velocity_, stress_, von_mises_, plastic_strain_, pressure_, point_displacement_;
};

}  // namespace abut::python
