#pragma once
// What runs give back as tables and dicts.
#include <algorithm>
#include <string>
#include <vector>

#include "abut/contact/report.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/outside_faces.hpp"
#include "vectors.hpp"

namespace abut::python {

using namespace py::literals;

/// The columns of energy.csv, one row for each record.
template <int Dim>
py::object table_of(const dynamics::Ledger<Dim>& ledger) {
    const auto columns = dynamics::ledger_columns<Dim>();
    const auto& entries = ledger.entries();
    py::array_t<double> numbers({static_cast<py::ssize_t>(entries.size()), static_cast<py::ssize_t>(columns.size())});
    double* row = numbers.mutable_data();
    for (const auto& entry : entries) row = std::ranges::copy(dynamics::ledger_values<Dim>(entry), row).out;
    py::list fields;
    for (const std::string& column : columns) fields.append(py::make_tuple(column, "f8"));
    return numbers.attr("view")(py::dtype::from_args(fields)).attr("reshape")(-1);
}

template <int Dim>
py::list motions_of(const std::vector<solid::BodyMotion<Dim>>& motions) {
    py::list bodies;
    for (const auto& motion : motions)
        bodies.append(py::dict("mass"_a = motion.mass,
                               "velocity"_a = py::array_t<double>(py::ssize_t{Dim}, motion.velocity.data()),
                               "rotation"_a = motion.rotation));
    return bodies;
}

inline py::dict report_of(const contact::ContactReport& report) {
    return py::dict("candidates_max"_a = report.candidates_max, "active_pairs_max"_a = report.active_pairs_max,
                    "events"_a = report.events, "rebuilds"_a = report.rebuilds, "missed_contacts"_a = report.missed_contacts,
                    "inadmissible_overlaps"_a = report.inadmissible_overlaps, "compressed_steps"_a = report.compressed_steps,
                    "compression_max"_a = report.compression_max, "tilted_pairs_max"_a = report.tilted_pairs_max,
                    "slipped_pairs"_a = report.slipped_pairs, "sliding_ratio_max"_a = report.sliding_ratio_max,
                    "friction_dissipated"_a = report.friction_dissipated, "least_dissipated"_a = report.least_dissipated,
                    "friction_ratio_max"_a = report.friction_ratio_max, "sliding_force"_a = report.sliding_force,
                    "sliding_limit"_a = report.sliding_limit, "sticking_faces_max"_a = report.sticking_faces_max,
                    "sliding_faces_max"_a = report.sliding_faces_max);
}

/// `motion`: of the centroids over the next step [m].
template <int Dim>
py::dict faces_of(const solid::OutsideFaces<Dim>& faces, const std::vector<Vector<Dim>>& motion) {
    return py::dict("position"_a = copy_of_vectors<Dim>(faces.position), "velocity"_a = copy_of_vectors<Dim>(faces.velocity),
                    "normal"_a = copy_of_vectors<Dim>(faces.normal), "area"_a = copy_of(faces.area),
                    "bonded"_a = copy_of(faces.bonded), "traction"_a = copy_of_vectors<Dim>(faces.traction),
                    "motion"_a = copy_of_vectors<Dim>(motion));
}

}  // namespace abut::python
