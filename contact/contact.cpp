#include "abut/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/messages.hpp"

namespace abut::contact {
namespace {

template <int Dim>
const ContactOptions& checked(const ContactOptions& options) {
    const auto refuse = [](const std::string& what) { throw BadInput("contact options: " + what); };
    if (options.quadrature < 0 || options.quadrature > 3)
        refuse("quadrature is " + std::to_string(options.quadrature) +
               "; it must be 1, 2 or 3 points (0: as many as exactness needs).");
    if (!(options.search.facing_cosine < 0.0))
        refuse("facing_cosine is " + number(options.search.facing_cosine) +
               "; contact needs one between -1 and 0. -0.5 is the default.");
    if (!(options.compression_warning > 0.0))
        refuse("compression_warning is " + number(options.compression_warning) + "; it must be > 0. 0.3 is the default.");
    if (!(options.compression_limit > 0.0))
        refuse("compression_limit is " + number(options.compression_limit) + "; it must be > 0. 2 is the default.");
    return options;
}

template <int Dim>
void check_coupling(const FaceCoupling<Dim>& coupling, std::size_t n_faces) {
    const auto refuse = [](const std::string& what) { throw BadInput("contact: the coupling of the listed faces " + what); };
    const std::size_t n = coupling.columns.size();
    if (coupling.offsets.size() != n_faces + 1 || coupling.offsets.front() != 0 ||
        static_cast<std::size_t>(coupling.offsets.back()) != n ||
        !std::is_sorted(coupling.offsets.begin(), coupling.offsets.end()))
        refuse("has " + std::to_string(coupling.offsets.size()) + " offsets for " + std::to_string(n_faces) + " faces and " +
               std::to_string(n) + " columns; they must be one more than faces and rise from 0 to the number of columns.");
    if (coupling.blocks.size() != n)
        refuse("has " + std::to_string(coupling.blocks.size()) + " blocks for " + std::to_string(n) +
               " columns; give one each.");
    for (const std::int32_t column : coupling.columns)
        if (column < 0 || static_cast<std::size_t>(column) >= n_faces)
            refuse("names face " + std::to_string(column) + " of " + std::to_string(n_faces) +
                   "; columns are places in Contact::faces.");
}

template <int Dim>
void check_path(const SurfaceView<Dim>& surface, std::span<const std::int32_t> faces, const FacePath<Dim>& path) {
    const std::size_t n_faces = faces.size();
    for (const std::size_t size :
         {path.displacement_0.size(), path.displacement_1.size(), path.force_0.size(), path.force_1.size()})
        if (size != n_faces)
            throw BadInput("contact: the path of the listed faces has an array of " + std::to_string(size) +
                           " entries for " + std::to_string(n_faces) + " faces; give one for each of Contact::faces.");
    for (std::size_t i = 0; i < n_faces; ++i)
        if (!path.displacement_0[i].allFinite() || !path.displacement_1[i].allFinite() || !path.force_0[i].allFinite() ||
            !path.force_1[i].allFinite())
            throw Diverged("contact: displacement or force of " + face_name(surface, faces[i]) +
                           " is not finite: the run has diverged. Take a smaller time step.");
}

template <int Dim>
bool before(const ContactPair<Dim>& a, const ContactPair<Dim>& b) {
    return std::pair(a.face_1, a.face_2) < std::pair(b.face_1, b.face_2);
}

}  // namespace

template <int Dim>
Contact<Dim>::Contact(SurfaceView<Dim> surface, const ContactOptions& options)
    : surface_(surface),
      options_(checked<Dim>(options)),
      candidates_(surface, options.search),
      local_face_(static_cast<std::size_t>(surface.size()), -1),
      integral_(options) {}

template <int Dim>
void Contact<Dim>::search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1,
                          const CouplingOf& coupling_of) {
    list_holds_ = false;
    candidates_.search(u_0, u_1);
    const std::vector<ContactPair<Dim>> known(pairs_.pairs().begin(), pairs_.pairs().end());
    std::vector<geometry::IndexPair> found(candidates_.candidates().begin(), candidates_.candidates().end());
    // A pair in contact stays in the list however deep it is.
    for (const ContactPair<Dim>& pair : known) {
        if (!pair.admitted) continue;
        const auto at = pairs_.position(surface_, pair, u_0[pair.face_1], u_0[pair.face_2]);
        if (at.gap < 0.0 && pairs_.shared_area(pair, at.shift, options_.area).area > 0.0)
            found.push_back({pair.face_1, pair.face_2});
    }
    sort_unique(found);

    pairs_.clear();
    for (const auto& [face_1, face_2] : found) pairs_.append(surface_, face_1, face_2, options_.weights);
    keep_admission(known, u_0);
    list_faces();
    coupling_ = coupling_of(faces_);
    check_coupling(coupling_, faces_.size());
    list_holds_ = searched_ = true;
    ++report_.rebuilds;
    report_.candidates = pairs_.size();
    report_.candidates_max = std::max(report_.candidates_max, report_.candidates);
}

/// The flag outlives a rebuild. A pair that was not in the list before and already overlaps is no contact, unless the run
/// only begins.
template <int Dim>
void Contact<Dim>::keep_admission(std::span<const ContactPair<Dim>> known, std::span<const Vector<Dim>> u_0) {
    for (ContactPair<Dim>& pair : pairs_.pairs()) {
        const auto place = std::lower_bound(known.begin(), known.end(), pair, before<Dim>);
        if (place != known.end() && !before(pair, *place)) {
            pair.admitted = place->admitted;
            continue;
        }
        const auto at = pairs_.position(surface_, pair, u_0[pair.face_1], u_0[pair.face_2]);
        pair.admitted = at.gap > -pair.depth;
        if (!searched_ || at.gap >= 0.0 || pairs_.shared_area(pair, at.shift, options_.area).area == 0.0) continue;
        if (pair.admitted) ++report_.lost_contacts;
        pair.admitted = false;
    }
}

/// Where A min(g, 0) = 0 the flag may change without a change of the potential: there, and only there, it is set anew.
template <int Dim>
void Contact<Dim>::update_admission(std::span<const Vector<Dim>> displacement) {
    report_.not_admitted = 0;
    for (ContactPair<Dim>& pair : pairs_.pairs()) {
        const auto at =
            pairs_.position(surface_, pair, displacement[local_face_[pair.face_1]], displacement[local_face_[pair.face_2]]);
        const bool wanted = at.gap > -pair.depth;
        if (wanted == pair.admitted && wanted) continue;
        if (at.gap >= 0.0 || pairs_.stay_apart(pair, at.shift, at.shift) ||
            pairs_.shared_area(pair, at.shift, options_.area).area == 0.0)
            pair.admitted = wanted;
        else if (!pair.admitted)
            ++report_.not_admitted;
    }
}

template <int Dim>
void Contact<Dim>::list_faces() {
    for (const std::int32_t face : faces_) local_face_[face] = -1;
    faces_.clear();
    for (const ContactPair<Dim>& pair : pairs_.pairs()) {
        faces_.push_back(pair.face_1);
        faces_.push_back(pair.face_2);
    }
    sort_unique(faces_);
    for (std::size_t i = 0; i < faces_.size(); ++i) local_face_[faces_[i]] = static_cast<std::int32_t>(i);
}

template <int Dim>
void Contact<Dim>::require_list() const {
    if (!list_holds_) throw Misuse("contact: there is no candidate list. Call `search` first.");
}

template <int Dim>
void Contact<Dim>::integrate(const FacePath<Dim>& path) {
    require_list();
    check_path<Dim>(surface_, faces_, path);
    update_admission(path.displacement_0);
    integral_.integrate(surface_, pairs_, local_face_, coupling_, path);
    report_step();
}

template <int Dim>
void Contact<Dim>::follow(std::span<const Vector<Dim>> displacement_0, std::span<const Vector<Dim>> displacement_1,
                          std::span<const Vector<Dim>> force_1) {
    require_list();
    check_path<Dim>(surface_, faces_, {displacement_0, displacement_1, force_1, force_1});
    update_admission(displacement_0);
    integral_.integrate(surface_, pairs_, local_face_, coupling_, {displacement_1, displacement_1, force_1, force_1});
    report_step();
}

template <int Dim>
void Contact<Dim>::report_step() {
    report_.active_pairs = static_cast<std::int64_t>(integral_.active_pairs().size());
    report_.active_pairs_max = std::max(report_.active_pairs_max, report_.active_pairs);
    report_.events += integral_.events();
    report_.compression_max = std::max(report_.compression_max, integral_.compression());
    report_.sliding_ratio_max = std::max(report_.sliding_ratio_max, integral_.sliding_ratio());
    for (const SlippedPair& slipped : integral_.slipped()) {
        ++report_.slipped_pairs;
        report_.slipped_compression_max = std::max(report_.slipped_compression_max, slipped.compression);
    }
    if (integral_.compression() > options_.compression_warning) ++report_.compressed_steps;
    if (integral_.compression() > options_.compression_limit) {
        const ContactPair<Dim>& pair = pairs_.pairs()[integral_.most_compressed()];
        throw TooDeep("contact: " + face_name(surface_, pair.face_1) + " and " + face_name(surface_, pair.face_2) +
                      " are pressed " + number(integral_.compression()) +
                      " times the depth of their cells into each other, " + number(options_.compression_limit) +
                      " is allowed (compression_limit). Refine the mesh at the contact, or lower the speed or the load.");
    }
}

template <int Dim>
void Contact<Dim>::evaluate(std::span<const Vector<Dim>> displacement, std::span<const Vector<Dim>> force) {
    const FacePath<Dim> at_rest{displacement, displacement, force, force};
    require_list();
    check_path<Dim>(surface_, faces_, at_rest);
    integral_.integrate(surface_, pairs_, local_face_, coupling_, at_rest);
}

template class Contact<2>;
template class Contact<3>;

}  // namespace abut::contact
