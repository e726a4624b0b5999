// What abut_step and abut_evaluate leave behind.
#include <vector>

#include "abut.h"
#include "abut/contact/nodal_contact.hpp"
#include "arguments.hpp"
#include "handle.hpp"

using namespace abut;
using namespace abut::c_layer;

int abut_pairs(const abut_contact* handle, abut_pair* pairs, size_t entry_size, int64_t capacity, int64_t* n,
               abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        with_contact(handle, [&](const auto& contact) {
            constexpr int Dim = dimension_of<decltype(contact)>;
            copy_entries(contact.last().pairs, pairs, entry_size, capacity, n, [&](const contact::PairStep<Dim>& pair) {
                abut_pair entry{};
                entry.face_1 = number_of(pair.face_1) + handle->index_base;
                entry.face_2 = number_of(pair.face_2) + handle->index_base;
                copy_vector<Dim>(pair.normal, entry.normal);
                copy_vector<Dim>(pair.force, entry.force);
                entry.gap_0 = pair.gap_0;
                entry.gap_1 = pair.gap_1;
                entry.area = pair.area;
                entry.normal_force = pair.normal_force;
                entry.events = pair.events;
                entry.active_share = pair.active_share;
                entry.compression = pair.compression;
                copy_vector<Dim>(pair.friction, entry.friction);
                copy_vector<Dim>(pair.slip, entry.slip);
                copy_vector<Dim>(pair.point, entry.point);
                return entry;
            });
        });
    });
}

int abut_friction(const abut_contact* handle, abut_face_friction* faces, size_t entry_size, int64_t capacity, int64_t* n,
                  abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        with_contact(handle, [&](const auto& contact) {
            copy_entries(contact.last().friction, faces, entry_size, capacity, n, [&](const contact::FaceFriction& face) {
                abut_face_friction entry{};
                entry.face = number_of(face.face) + handle->index_base;
                entry.normal_force = face.normal_force;
                entry.force = face.force;
                entry.limit = face.limit;
                entry.slip = face.slip;
                entry.dissipated = face.dissipated;
                return entry;
            });
        });
    });
}

int abut_bodies(const abut_contact* handle, abut_body* bodies, size_t entry_size, int64_t capacity, int64_t* n,
                abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        with_contact(handle, [&](const auto& contact) {
            constexpr int Dim = dimension_of<decltype(contact)>;
            copy_entries(contact.last().bodies, bodies, entry_size, capacity, n, [&](const contact::BodyStep<Dim>& body) {
                abut_body entry{};
                entry.body = body.body + handle->index_base;
                copy_vector<Dim>(body.force, entry.force);
                copy_moment(body.moment, entry.moment);
                entry.work = body.work;
                return entry;
            });
        });
    });
}

int abut_body_pairs(const abut_contact* handle, abut_body_pair* pairs, size_t entry_size, int64_t capacity, int64_t* n,
                    abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        with_contact(handle, [&](const auto& contact) {
            constexpr int Dim = dimension_of<decltype(contact)>;
            copy_entries(contact.last().body_pairs, pairs, entry_size, capacity, n,
                         [&](const contact::BodyPairStep<Dim>& pair) {
                             abut_body_pair entry{};
                             entry.body_1 = pair.body_1 + handle->index_base;
                             entry.body_2 = pair.body_2 + handle->index_base;
                             entry.active_pairs = pair.active_pairs;
                             copy_vector<Dim>(pair.force, entry.force);
                             entry.normal_force = pair.normal_force;
                             return entry;
                         });
        });
    });
}

int abut_get_report(const abut_contact* handle, abut_report* report, abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        check_struct(report, "abut_report");
        with_contact(handle, [&](const auto& contact) {
            const contact::ContactReport& from = contact.report();
            *report = {.struct_size = sizeof(abut_report),
                       .candidates = from.candidates,
                       .candidates_max = from.candidates_max,
                       .active_pairs = from.active_pairs,
                       .active_pairs_max = from.active_pairs_max,
                       .events = from.events,
                       .rebuilds = from.rebuilds,
                       .missed_contacts = from.missed_contacts,
                       .inadmissible_overlaps = from.inadmissible_overlaps,
                       .compressed_steps = from.compressed_steps,
                       .tilted_pairs_max = from.tilted_pairs_max,
                       .compression_max = from.compression_max,
                       .correction_max = from.correction_max,
                       .friction_dissipated = from.friction_dissipated,
                       .least_dissipated = from.least_dissipated,
                       .friction_ratio_max = from.friction_ratio_max,
                       .sliding_force = from.sliding_force,
                       .sliding_limit = from.sliding_limit,
                       .sticking_faces = from.sticking_faces,
                       .sliding_faces = from.sliding_faces,
                       .sticking_faces_max = from.sticking_faces_max,
                       .sliding_faces_max = from.sliding_faces_max};
        });
    });
}

int abut_stable_step(const abut_contact* handle, const double* mass, int64_t n, double omega_free, abut_stable* stable,
                     abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        check_struct(stable, "abut_stable");
        with_contact(handle, [&](const auto& contact) {
            const contact::NodalStableStep step = contact.stable_step(span_of(mass, n, "mass"), omega_free);
            stable->dt = step.dt;
            stable->omega = step.omega;
            stable->omega_free = step.omega_free;
            stable->node = step.node < 0 ? -1 : step.node + handle->index_base;
            copy_text(step.reason, stable->reason);
        });
    });
}
