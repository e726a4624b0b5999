#include "abut.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/option_table.hpp"
#include "arguments.hpp"
#include "handle.hpp"
#include "option_values.hpp"

using namespace abut;
using namespace abut::c_layer;

namespace {

void set_value(abut_options& options, const OptionField& field, const OptionValue& value) {
    std::visit(
        [&](auto member) {
            using Field = std::remove_reference_t<decltype(options.*member)>;
            std::visit(
                [&](const auto& held) {
                    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(held)>>)
                        options.*member = static_cast<Field>(held);
                },
                value);
        },
        field.field);
}

contact::Friction law_of(const abut_friction_law& given, const std::string& whose) {
    const double values[] = {given.friction,   given.sliding_friction, given.decay_speed,
                             given.decay_slip, given.shear_strength,   given.relaxation_time};
    contact::Friction law;
    for (std::size_t i = 0; i < std::size(values); ++i) {
        const Option<contact::Friction>& option = contact::friction_options()[i];
        check_value(whose, option, values[i], option.get(contact::Friction{}));
        option.set(law, values[i]);
    }
    return law;
}

/// The law of all pairs is in `friction` already. Laws that never act are left out.
void add_laws(const abut_options& given, std::int32_t index_base, contact::FrictionOptions& friction) {
    std::vector<contact::Friction> all{friction.any() ? friction.laws.front() : contact::Friction{}};
    if (given.own_coefficient != nullptr)
        all.front().own_coefficient = [given](const contact::Sliding& at) {
            return call_host([&] { return given.own_coefficient(at.speed, at.slid, at.pressure, given.user); });
        };
    for (const abut_friction_law& law : span_of(given.laws, given.n_laws, "abut_options.laws"))
        all.push_back(law_of(law, "abut_options: laws: "));
    if (all.size() > 1 && given.law_of == nullptr)
        throw BadInput("abut_options: there are `laws`, but no `law_of`. Give one that tells which two faces have.");
    friction.laws.clear();
    std::vector<std::int32_t> index;
    for (contact::Friction& law : all) {
        index.push_back(law.acts() ? static_cast<std::int32_t>(friction.laws.size()) : -1);
        if (law.acts()) friction.laws.push_back(std::move(law));
    }
    if (given.law_of == nullptr) return;
    friction.law_of = [given, index_base, index](contact::Face face_1, contact::Face face_2) {
        const std::int32_t law = call_host(
            [&] { return given.law_of(number_of(face_1) + index_base, number_of(face_2) + index_base, given.user); });
        if (law >= std::ssize(index))
            throw BadInput("abut_options: law_of gives " + std::to_string(law) + " for faces " +
                               std::to_string(number_of(face_1)) + " and " + std::to_string(number_of(face_2)) +
                               "; give at most n_laws, which is " + std::to_string(given.n_laws) + ".",
                           {.face_1 = number_of(face_1),
                            .face_2 = number_of(face_2),
                            .value = static_cast<double>(law),
                            .allowed = static_cast<double>(given.n_laws)});
        return law < 0 ? -1 : index[static_cast<std::size_t>(law)];
    };
}

void add_interference(const abut_options& given, std::int32_t index_base, contact::InterferenceOptions& interference) {
    if (given.interference_time == 0.0) {
        if (given.interferes != nullptr)
            throw BadInput("abut_options: `interferes` is given, but no `interference_time`. Give it, or leave both out.");
        return;
    }
    interference.times = {given.interference_time};
    if (given.interferes == nullptr) return;
    interference.of = [given, index_base](contact::Face face_1, contact::Face face_2) {
        return call_host([&] {
            return given.interferes(number_of(face_1) + index_base, number_of(face_2) + index_base, given.user) != 0 ? 0
                                                                                                                     : -1;
        });
    };
}

contact::NodalOptions nodal_options(const abut_options& given, std::int32_t index_base) {
    contact::NodalOptions options;
    const contact::NodalOptions plain;
    for (const OptionField& field : option_fields) {
        const Option<contact::NodalOptions>& option = named(contact::nodal_options(), field.name);
        const OptionValue value = value_of(given, field);
        check_value("abut_options: ", option, value, option.get(plain));
        option.set(options, value);
    }
    add_laws(given, index_base, options.friction);
    add_interference(given, index_base, options.interference);
    if (given.wanted != nullptr)
        options.wanted = [given, index_base](contact::Face face_1, contact::Face face_2) {
            return call_host([&] {
                return given.wanted(number_of(face_1) + index_base, number_of(face_2) + index_base, given.user) != 0;
            });
        };
    return options;
}

template <int Dim>
void tell_of_surface(const abut_contact& handle, const contact::NodalContact<Dim>& contact) {
    if (handle.options.log == nullptr) return;
    for (const std::int32_t body : contact.surface().inward_bodies())
        handle.tell(ABUT_WARNING,
                    "the faces of body " + std::to_string(body + handle.index_base) +
                        " close a volume and all look into it: nothing outside ever touches it. Turn the order of "
                        "their corners, unless it is a cavity that is filled.");
    if (const auto corners = contact.blind_corners(); !corners.empty()) {
        std::string at;
        for (const double x : corners.front().position) at += (at.empty() ? "" : ", ") + number(x);
        handle.tell(ABUT_WARNING, std::to_string(corners.size()) + " corners, one of them of body " +
                                      std::to_string(corners.front().body + handle.index_base) + " at (" + at +
                                      "), are so sharp that contact hardly sees them meet a flat face: bodies go through "
                                      "each other there. Blunt them, or take a facing_none nearer to 0.");
    }
    if (const auto edges = contact.unseen_edges())
        handle.tell(ABUT_WARNING,
                    "edges of bodies " + std::to_string(edges->edge_1.body + handle.index_base) + " and " +
                        std::to_string(edges->edge_2.body + handle.index_base) +
                        " are so sharp that they may pass through each other where they cross. Blunt them, or take "
                        "a facing_none nearer to 0.");
}

template <int Dim>
void tell_after_step(abut_contact& handle, const contact::NodalContact<Dim>& contact) {
    const contact::ContactReport& report = contact.report();
    if (report.compressed_steps > 0 && !handle.told_of_compression) {
        handle.told_of_compression = true;
        handle.tell(ABUT_WARNING,
                    "faces are pressed " + std::to_string(report.compression_max) +
                        " times the depth of their elements into each other; finer elements or a lower speed make it less.");
    }
    if (report.missed_contacts > handle.told_of_missed) {
        handle.tell(
            ABUT_WARNING,
            std::to_string(report.missed_contacts - handle.told_of_missed) +
                " pairs were first seen pressed in and do not act until they have parted: steps were too long for the "
                "list, and the energy is not exact.");
        handle.told_of_missed = report.missed_contacts;
    }
}

/// Array into which forces go, checked before anything happens; nothing if they are not asked for.
template <int Dim>
std::optional<PointsSpan<Dim>> force_of(const abut_array& force, const contact::NodalContact<Dim>& contact) {
    if (force.data == nullptr) return std::nullopt;
    const std::int32_t count = checked_count(force.count, "force");
    contact::detail::check_force_size(count, contact.last().least_force_size);
    return PointsSpan<Dim>{force.data, count, static_cast<std::ptrdiff_t>(force.item),
                           static_cast<std::ptrdiff_t>(force.component)};
}

}  // namespace

void abut_options_init(abut_options* options) {
    if (options == nullptr) return;
    const contact::NodalOptions defaults;
    *options = {};
    options->struct_size = sizeof(abut_options);
    for (const OptionField& field : option_fields)
        set_value(*options, field, named(contact::nodal_options(), field.name).get(defaults));
}

const char* abut_version(void) { return ABUT_VERSION; }

int abut_limit_threads(int32_t n, abut_error* error) {
    return guarded(error, 0, [&] {
        using oneapi::tbb::global_control;
        static std::mutex mutex;
        static std::optional<global_control> limit;
        if (n < 0)
            throw BadInput("threads: " + std::to_string(n) + "; give 1 or more, or 0 for all cores.", {.value = double(n)});
        const std::scoped_lock lock(mutex);
        limit.reset();
        if (n > 0) limit.emplace(global_control::max_allowed_parallelism, static_cast<std::size_t>(n));
    });
}

int abut_skin_stiffness(double modulus, const double* depth, int64_t n, double* stiffness, abut_error* error) {
    return guarded(error, 0, [&] {
        check_pointer(stiffness, "stiffness");
        *stiffness = contact::skin_stiffness(modulus, span_of(depth, n, "depth"));
    });
}

int abut_create(int32_t dim, abut_array rest, const abut_faces* faces, const abut_options* options, abut_contact** contact,
                abut_error* error) {
    return guarded(error, faces == nullptr ? 0 : faces->index_base, [&] {
        check_pointer(contact, "contact");
        *contact = nullptr;
        check_dim(dim);
        check_struct(faces, "abut_faces");
        abut_options given;
        abut_options_init(&given);
        if (options != nullptr) {
            check_struct(options, "abut_options");
            given = *options;
        }
        const auto make = [&]<int Dim>(std::integral_constant<int, Dim>) {
            auto handle = std::unique_ptr<abut_contact>(new abut_contact{
                contact::NodalContact<Dim>(surface_of<Dim>(rest, *faces), nodal_options(given, faces->index_base)), given,
                faces->index_base});
            tell_of_surface<Dim>(*handle, std::get<contact::NodalContact<Dim>>(handle->contact));
            *contact = handle.release();
        };
        if (dim == 2)
            make(std::integral_constant<int, 2>{});
        else
            make(std::integral_constant<int, 3>{});
    });
}

void abut_destroy(abut_contact* contact) { delete contact; }

int abut_step(abut_contact* handle, double dt, abut_array x_0, abut_array x_1, int32_t take, abut_array force,
              abut_step_result* result, abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        with_contact(handle, [&](auto& contact) {
            constexpr int Dim = dimension_of<decltype(contact)>;
            if (take != ABUT_MEAN && take != ABUT_END)
                throw BadInput("take is " + std::to_string(take) + "; ABUT_MEAN and ABUT_END are allowed.");
            if (result != nullptr) check_struct(result, "abut_step_result");
            const abut_options& options = handle->options;
            if (options.cancel != nullptr && call_host([&] { return options.cancel(options.user) != 0; })) throw Cancelled{};
            const auto forces = force_of<Dim>(force, contact);
            const auto& step = contact.step(dt, view_of<Dim>(x_0, "x_0"), view_of<Dim>(x_1, "x_1"),
                                            take == ABUT_MEAN ? contact::TakenForce::mean : contact::TakenForce::end);
            if (forces) step.add_force_to(*forces);
            if (result != nullptr)
                *result = {sizeof(abut_step_result),
                           step.energy_0,
                           step.energy,
                           step.work,
                           static_cast<std::int64_t>(step.pairs.size()),
                           step.report.events,
                           step.report.compression,
                           step.report.correction,
                           step.report.friction.energy,
                           step.report.friction.dissipated,
                           step.report.friction.sticking,
                           step.report.friction.sliding,
                           step.interference_work};
            tell_after_step<Dim>(*handle, contact);
        });
    });
}

int abut_evaluate(abut_contact* handle, abut_array x, abut_array force, double* energy, abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        with_contact(handle, [&](auto& contact) {
            constexpr int Dim = dimension_of<decltype(contact)>;
            const auto forces = force_of<Dim>(force, contact);
            const auto& step = contact.evaluate(view_of<Dim>(x, "x"));
            if (forces) step.add_force_to(*forces);
            if (energy != nullptr) *energy = step.energy;
        });
    });
}

int abut_save(const abut_contact* handle, void* bytes, int64_t capacity, int64_t* n, abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        check_pointer(n, "n");
        with_contact(handle, [&](const auto& contact) {
            const std::vector<std::byte> state = contact.state();
            *n = static_cast<std::int64_t>(state.size());
            if (capacity < *n) return;
            check_pointer(bytes, "bytes");
            std::memcpy(bytes, state.data(), state.size());
        });
    });
}

int abut_restore(abut_contact* handle, const void* bytes, int64_t n, abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        with_contact(handle, [&](auto& contact) {
            contact.restore(span_of(static_cast<const std::byte*>(bytes), n, "bytes"));
            handle->told_of_missed = contact.report().missed_contacts;
        });
    });
}

int abut_replace_surface(abut_contact* handle, abut_array rest, const abut_faces* faces, const int32_t* old_face_of,
                         abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        check_struct(faces, "abut_faces");
        with_contact(handle, [&](auto& contact) {
            constexpr int Dim = dimension_of<decltype(contact)>;
            if (faces->index_base != handle->index_base)
                throw BadInput("abut_faces: index_base is " + std::to_string(faces->index_base) +
                               ", that of the contact is " + std::to_string(handle->index_base) + "; it must stay.");
            auto old = from_zero(span_of(old_face_of, faces->n_faces, "old_face_of"), handle->index_base);
            for (std::int32_t& face : old) face = std::max(face, -1);
            contact.surface_replaced(surface_of<Dim>(rest, *faces), old);
            tell_of_surface<Dim>(*handle, contact);
        });
    });
}
