#include "abut.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/overlaps.hpp"
#include "abut/contact/search/candidate_search.hpp"

namespace {

using namespace abut;

/// An exception that came out of a callback of the host.
struct CallbackFailed {};
/// The host has cancelled a step.
struct Cancelled {};

int status_of(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::bad_input:
            return ABUT_BAD_INPUT;
        case ErrorKind::misuse:
            return ABUT_MISUSE;
        case ErrorKind::diverged:
            return ABUT_DIVERGED;
        case ErrorKind::too_deep:
            return ABUT_TOO_DEEP;
        case ErrorKind::limit_exceeded:
            return ABUT_LIMIT_EXCEEDED;
    }
    return ABUT_INTERNAL;
}

template <std::size_t N>
void copy_text(const std::string& text, char (&to)[N]) {
    const std::size_t n = std::min(text.size(), N - 1);
    std::memcpy(to, text.data(), n);
    to[n] = '\0';
}

/// A struct of another size is of another version of the header: it is not written to.
int report(int status, const std::string& what, const ErrorFacts& facts, int index_base, abut_error* error) noexcept {
    if (error == nullptr || error->struct_size != sizeof(abut_error)) return status;
    const auto in_base = [&](std::int64_t face) { return face == ErrorFacts::none ? face : face + index_base; };
    error->status = status;
    error->face_1 = in_base(facts.face_1);
    error->face_2 = in_base(facts.face_2);
    error->value = facts.value;
    error->allowed = facts.allowed;
    copy_text(what, error->message);
    return status;
}

/// Turns what is thrown into a status.
template <class Call>
int guarded(abut_error* error, int index_base, const Call& call) noexcept {
    try {
        if (error != nullptr && error->struct_size != sizeof(abut_error))
            throw Misuse("abut_error: struct_size is not that of this library; begin with ABUT_ERROR_INIT.");
        call();
        return report(ABUT_OK, "", {}, 0, error);
    } catch (const Error& thrown) {
        return report(status_of(thrown.kind()), thrown.what(), thrown.facts(), index_base, error);
    } catch (const Cancelled&) {
        return report(ABUT_CANCELLED, "cancelled by the host; the step did not happen.", {}, 0, error);
    } catch (const CallbackFailed&) {
        return report(ABUT_CALLBACK, "an exception came out of a callback of the host; the call did not happen.", {}, 0,
                      error);
    } catch (const std::bad_alloc&) {
        return report(ABUT_OUT_OF_MEMORY, "out of memory.", {}, 0, error);
    } catch (const std::exception& thrown) {
        return report(ABUT_INTERNAL, thrown.what(), {}, 0, error);
    } catch (...) {
        return report(ABUT_INTERNAL, "an unknown exception.", {}, 0, error);
    }
}

template <class Struct>
void check_struct(const Struct* given, const char* name) {
    if (given == nullptr) throw Misuse(std::string(name) + " is NULL; give one.");
    if (given->struct_size != sizeof(Struct))
        throw Misuse(std::string(name) + ": struct_size is " + std::to_string(given->struct_size) +
                     ", that of this library is " + std::to_string(sizeof(Struct)) +
                     ". Begin with its INIT, and compile against the header of this version.");
}

void check_pointer(const void* given, const char* name) {
    if (given == nullptr) throw Misuse(std::string(name) + " is NULL; give one.");
}

std::int32_t checked_count(std::int64_t n, const char* name) {
    if (n < 0 || n > std::numeric_limits<std::int32_t>::max())
        throw BadInput(std::string(name) + " has " + std::to_string(n) + " entries; 0 to 2147483647 are allowed.",
                       {.value = static_cast<double>(n)});
    return static_cast<std::int32_t>(n);
}

template <int Dim>
PointsView<Dim> view_of(const abut_array& array, const char* name) {
    const std::int32_t count = checked_count(array.count, name);
    if (count > 0) check_pointer(array.data, name);
    return {array.data, count, static_cast<std::ptrdiff_t>(array.item), static_cast<std::ptrdiff_t>(array.component)};
}

template <class T>
std::span<const T> span_of(const T* data, std::int64_t n, const char* name) {
    const std::int32_t count = checked_count(n, name);
    if (count > 0) check_pointer(data, name);
    return {data, static_cast<std::size_t>(count)};
}

/// A copy that counts from 0.
std::vector<std::int32_t> from_zero(std::span<const std::int32_t> values, std::int32_t index_base) {
    std::vector<std::int32_t> copy(values.begin(), values.end());
    for (std::int32_t& value : copy)
        value = value < std::numeric_limits<std::int32_t>::min() + index_base ? value : value - index_base;
    return copy;
}

/// Faces of a host, counted from 0.
template <int Dim>
contact::NodalSurface<Dim> surface_of(const abut_array& rest, const abut_faces& faces) {
    if (faces.index_base != 0 && faces.index_base != 1)
        throw BadInput("abut_faces: index_base is " + std::to_string(faces.index_base) + "; 0 and 1 are allowed.");
    const auto nodes = from_zero(span_of(faces.nodes, faces.n_nodes, "abut_faces.nodes"), faces.index_base);
    const auto body = from_zero(span_of(faces.body, faces.n_faces, "abut_faces.body"), faces.index_base);
    std::vector<std::int32_t> offsets;
    if (faces.offsets != nullptr)
        offsets = from_zero(span_of(faces.offsets, faces.n_faces + 1, "abut_faces.offsets"), faces.index_base);
    return {view_of<Dim>(rest, "rest"),
            {.nodes = nodes,
             .offsets = offsets,
             .body = body,
             .depth = span_of(faces.depth, faces.n_faces, "abut_faces.depth"),
             .stiffness = span_of(faces.stiffness, faces.n_bodies, "abut_faces.stiffness")}};
}

void check_dim(std::int32_t dim) {
    if (dim != 2 && dim != 3) throw BadInput("dim is " + std::to_string(dim) + "; 2 and 3 are allowed.");
}

template <int Dim>
void copy_vector(const Vector<Dim>& from, double (&to)[3]) {
    to[2] = 0.0;
    for (int d = 0; d < Dim; ++d) to[d] = from[d];
}
void copy_moment(const AxialVector<2>& from, double (&to)[3]) { to[0] = to[1] = 0.0, to[2] = from[0]; }
void copy_moment(const AxialVector<3>& from, double (&to)[3]) { copy_vector<3>(from, to); }

/// Writes the number of entries, and as many of them as there is room for.
template <class Entry, class Value, class Convert>
void copy_entries(const std::vector<Value>& values, Entry* entries, std::size_t entry_size, std::int64_t capacity,
                  std::int64_t* n, const Convert& convert) {
    check_pointer(n, "n");
    if (entry_size != sizeof(Entry))
        throw Misuse("entry_size is " + std::to_string(entry_size) + ", that of this library is " +
                     std::to_string(sizeof(Entry)) + ". Compile against the header of this version.");
    if (capacity > 0) check_pointer(entries, "the array of entries");
    *n = static_cast<std::int64_t>(values.size());
    for (std::int64_t i = 0; i < std::min(capacity, *n); ++i) entries[i] = convert(values[static_cast<std::size_t>(i)]);
}

template <class Call>
auto call_host(const Call& call) {
    try {
        return call();
    } catch (...) {
        throw CallbackFailed{};
    }
}

}  // namespace

struct abut_contact {
    std::variant<contact::NodalContact<2>, contact::NodalContact<3>> contact;
    abut_options options;
    std::int32_t index_base;
    bool told_of_compression = false;
    std::int64_t told_of_missed = 0;
    mutable std::atomic_flag in_use{};  // by a call; another one meanwhile is refused

    /// What the host's own log throws is dropped: what is told has happened already.
    void tell(int severity, const std::string& text) const noexcept {
        if (options.log == nullptr) return;
        try {
            options.log(severity, text.c_str(), options.user);
        } catch (...) {
        }
    }
};

namespace {

/// What is wrong with the options is left to NodalContact.
contact::NodalOptions nodal_options(const abut_options& given, std::int32_t index_base) {
    contact::NodalOptions options;
    options.search.skin = given.skin;
    options.search.largest_motion = given.largest_motion;
    options.search.limits.pairs = given.max_pairs;
    options.compression_warning = given.compression_warning;
    options.compression_limit = given.compression_limit;
    options.facing = {.full = given.facing_full, .none = given.facing_none};
    options.events = given.events != 0;
    if (given.wanted != nullptr)
        options.wanted = [given, index_base](contact::SurfaceFace face_1, contact::SurfaceFace face_2) {
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
                " pairs were first seen pressed in: they are no contacts until they have parted. Where no faces have come "
                "anew, steps were too long for the list, and the energy is not exact.");
        handle.told_of_missed = report.missed_contacts;
    }
}

/// Where forces go, checked before anything happens; nothing if they are not asked for.
template <int Dim>
std::optional<PointsSpan<Dim>> force_of(const abut_array& force, const contact::NodalContact<Dim>& contact) {
    if (force.data == nullptr) return std::nullopt;
    const std::int32_t count = checked_count(force.count, "force");
    contact::detail::check_force_size(count, contact.last().n_deformable_nodes);
    return PointsSpan<Dim>{force.data, count, static_cast<std::ptrdiff_t>(force.item),
                           static_cast<std::ptrdiff_t>(force.component)};
}

template <class Contact>
constexpr int dimension_of = std::is_same_v<std::remove_cvref_t<Contact>, contact::NodalContact<2>> ? 2 : 3;

/// A handle while a call has it to itself.
class Use {
public:
    explicit Use(std::atomic_flag& in_use) : in_use_(in_use) {
        if (in_use_.test_and_set(std::memory_order_acquire))
            throw Misuse(
                "this contact is in use: by a callback's own caller, or by another thread. Use one thread at a time, and "
                "call nothing of it from its callbacks.");
    }
    ~Use() { in_use_.clear(std::memory_order_release); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

private:
    std::atomic_flag& in_use_;
};

/// Calls with the contact of the right dimension.
template <class Handle, class Call>
void with_contact(Handle* handle, const Call& call) {
    check_pointer(handle, "the handle `contact`");
    const Use use(handle->in_use);
    std::visit([&](auto& contact) { call(contact); }, handle->contact);
}

int index_base_of(const abut_contact* handle) { return handle == nullptr ? 0 : handle->index_base; }

/// Faces whose bodies are numbered without gaps, with depths and stiffnesses that nobody looks at.
struct SurfaceForOverlaps {
    explicit SurfaceForOverlaps(const abut_faces& given) : faces(given) {
        const auto of_host = span_of(given.body, given.n_faces, "abut_faces.body");
        std::vector<std::int32_t> numbers(of_host.begin(), of_host.end());
        sort_unique(numbers);
        for (const std::int32_t number : of_host)
            body.push_back(static_cast<std::int32_t>(std::ranges::lower_bound(numbers, number) - numbers.begin()) +
                           given.index_base);
        depth.assign(body.size(), 1.0);
        stiffness.assign(numbers.size(), 1.0);
        faces.body = body.data();
        faces.depth = depth.data();
        faces.stiffness = stiffness.data();
        faces.n_bodies = static_cast<std::int64_t>(numbers.size());
    }
    SurfaceForOverlaps(const SurfaceForOverlaps&) = delete;

    abut_faces faces;
    std::vector<std::int32_t> body;
    std::vector<double> depth, stiffness;
};

template <int Dim>
void find_all_overlaps(const abut_array& x, const abut_faces& faces, double distance, abut_overlap* overlaps,
                       std::size_t entry_size, std::int64_t capacity, std::int64_t* n) {
    const SurfaceForOverlaps of_bodies(faces);
    const contact::NodalSurface<Dim> surface = surface_of<Dim>(x, of_bodies.faces);
    contact::CandidateOptions options;
    options.distance = distance;
    contact::CandidateSearch<Dim> search(surface.facets().view(), options);
    const PointsView<Dim> positions(surface.facets().vertices);
    search.search_moved(positions, positions, contact::GapOf::centroids);
    const auto found = contact::find_overlaps_moved<Dim>(surface.facets().view(), positions, search.candidates());
    std::vector<contact::Overlap<Dim>> near;
    for (const contact::Overlap<Dim>& overlap : found.found)
        if (std::abs(overlap.gap) <= distance) near.push_back(overlap);
    copy_entries(near, overlaps, entry_size, capacity, n, [&](const contact::Overlap<Dim>& overlap) {
        abut_overlap entry{};
        entry.face_1 = number_of(surface.face_of(overlap.face_1)) + faces.index_base;
        entry.face_2 = number_of(surface.face_of(overlap.face_2)) + faces.index_base;
        entry.area = overlap.area;
        entry.gap = overlap.gap;
        copy_vector<Dim>(overlap.normal, entry.normal);
        return entry;
    });
}

}  // namespace

void abut_options_init(abut_options* options) {
    if (options == nullptr) return;
    const contact::NodalOptions defaults;
    *options = {.struct_size = sizeof(abut_options),
                .skin = defaults.search.skin,
                .largest_motion = defaults.search.largest_motion,
                .max_pairs = defaults.search.limits.pairs,
                .compression_warning = defaults.compression_warning,
                .compression_limit = defaults.compression_limit,
                .facing_full = defaults.facing.full,
                .facing_none = defaults.facing.none,
                .events = defaults.events ? 1 : 0,
                .wanted = nullptr,
                .cancel = nullptr,
                .log = nullptr,
                .user = nullptr};
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

int abut_skin_stiffness(double p_wave_modulus, const double* depth, int64_t n, double* stiffness, abut_error* error) {
    return guarded(error, 0, [&] {
        check_pointer(stiffness, "stiffness");
        *stiffness = contact::skin_stiffness(p_wave_modulus, span_of(depth, n, "depth"));
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

int abut_step(abut_contact* handle, abut_array x_0, abut_array x_1, int32_t take, abut_array force, abut_step_result* result,
              abut_error* error) {
    return guarded(error, index_base_of(handle), [&] {
        with_contact(handle, [&](auto& contact) {
            constexpr int Dim = dimension_of<decltype(contact)>;
            if (take != ABUT_MEAN && take != ABUT_END)
                throw BadInput("take is " + std::to_string(take) + "; ABUT_MEAN and ABUT_END are allowed.");
            if (result != nullptr) check_struct(result, "abut_step_result");
            const abut_options& options = handle->options;
            if (options.cancel != nullptr && call_host([&] { return options.cancel(options.user) != 0; })) throw Cancelled{};
            const auto forces = force_of<Dim>(force, contact);
            const auto& step = contact.step(view_of<Dim>(x_0, "x_0"), view_of<Dim>(x_1, "x_1"),
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
                           step.report.correction};
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
            *report = {sizeof(abut_report),        from.candidates,       from.candidates_max,   from.active_pairs,
                       from.active_pairs_max,      from.events,           from.rebuilds,         from.missed_contacts,
                       from.inadmissible_overlaps, from.compressed_steps, from.tilted_pairs_max, from.compression_max,
                       from.correction_max};
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

int abut_find_overlaps(int32_t dim, abut_array x, const abut_faces* faces, double distance, abut_overlap* overlaps,
                       size_t entry_size, int64_t capacity, int64_t* n, abut_error* error) {
    return guarded(error, faces == nullptr ? 0 : faces->index_base, [&] {
        check_dim(dim);
        check_struct(faces, "abut_faces");
        if (dim == 2)
            find_all_overlaps<2>(x, *faces, distance, overlaps, entry_size, capacity, n);
        else
            find_all_overlaps<3>(x, *faces, distance, overlaps, entry_size, capacity, n);
    });
}
