#include "abut/contact/contact.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace abut::contact {
namespace {

template <int Dim>
const ContactOptions& checked(const ContactOptions& options) {
    const auto refuse = [](const std::string& what) { throw std::invalid_argument("contact options: " + what); };
    if (options.quadrature < 0 || options.quadrature > 3)
        refuse("quadrature is " + std::to_string(options.quadrature) + "; it must be 1, 2 or 3 points (0: as many as exactness needs).");
    if (!(options.facing_cosine >= -1.0 && options.facing_cosine < 0.0))
        refuse("facing_cosine is " + std::to_string(options.facing_cosine) + "; it must lie in [-1, 0).");
    if (!(options.skin >= 0.0)) refuse("skin is " + std::to_string(options.skin) + " m; it must be >= 0.");
    if (!(options.compression_limit > 0.0)) refuse("compression_limit is " + std::to_string(options.compression_limit) + "; it must be > 0.");
    return options;
}

/// Half the mean size of the deformable faces.
template <int Dim>
double default_skin(const SurfaceView<Dim>& surface) {
    double size = 0.0;
    std::int32_t n = 0;
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        if (surface.is_rigid(face)) continue;
        size += Dim == 2 ? surface.area[face] : std::sqrt(surface.area[face]);
        ++n;
    }
    return n > 0 ? 0.5 * size / n : 0.0;
}

template <int Dim>
void require_finite(std::span<const Vector<Dim>> displacement) {
    for (std::size_t face = 0; face < displacement.size(); ++face)
        if (!displacement[face].allFinite())
            throw std::runtime_error("contact: the displacement of face " + std::to_string(face) +
                                     " is not finite: the run has diverged. Take a smaller time step.");
}

template <int Dim>
bool before(const ContactPair<Dim>& a, const ContactPair<Dim>& b) {
    return std::pair(a.face_1, a.face_2) < std::pair(b.face_1, b.face_2);
}

}  // namespace

template <int Dim>
Contact<Dim>::Contact(SurfaceView<Dim> surface, const ContactOptions& options)
    : surface_(surface), options_(checked<Dim>(options)), local_face_(static_cast<std::size_t>(surface.size()), -1), integral_(options) {
    check(surface_);
    skin_ = options.skin > 0.0 ? options.skin : default_skin(surface_);
}

template <int Dim>
void Contact<Dim>::search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1, const CouplingOf& coupling_of) {
    require_finite(u_0);
    require_finite(u_1);
    const std::vector<ContactPair<Dim>> known(pairs_.pairs().begin(), pairs_.pairs().end());
    std::vector<geometry::IndexPair> found = find_candidates(surface_, u_0, u_1, options_, skin_);
    // A pair in contact stays in the list however deep it is.
    for (const ContactPair<Dim>& pair : known) {
        if (!pair.admitted) continue;
        const auto at = pairs_.position(surface_, pair, u_0[pair.face_1], u_0[pair.face_2]);
        if (at.gap < 0.0 && pairs_.shared_area(pair, at.shift, options_.area).area > 0.0) found.push_back({pair.face_1, pair.face_2});
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());

    pairs_.clear();
    for (const auto& [face_1, face_2] : found) pairs_.append(surface_, face_1, face_2, options_.weights);
    keep_admission(known, u_0);
    list_faces();
    coupling_ = coupling_of(faces_);
    searched_ = true;
    ++report_.rebuilds;
    report_.candidates = pairs_.size();
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
        const auto at = pairs_.position(surface_, pair, displacement[local_face_[pair.face_1]], displacement[local_face_[pair.face_2]]);
        const bool wanted = at.gap > -pair.depth;
        if (wanted == pair.admitted && wanted) continue;
        if (at.gap >= 0.0 || pairs_.stay_apart(pair, at.shift, at.shift) || pairs_.shared_area(pair, at.shift, options_.area).area == 0.0)
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
    std::sort(faces_.begin(), faces_.end());
    faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
    for (std::size_t i = 0; i < faces_.size(); ++i) local_face_[faces_[i]] = static_cast<std::int32_t>(i);
}

template <int Dim>
void Contact<Dim>::integrate(const FacePath<Dim>& path) {
    update_admission(path.displacement_0);
    integral_.integrate(surface_, pairs_, local_face_, coupling_, path);
    report_.active_pairs = static_cast<std::int64_t>(integral_.active_pairs().size());
    report_.active_pairs_max = std::max(report_.active_pairs_max, report_.active_pairs);
    report_.events += integral_.events();
    report_.compression_max = std::max(report_.compression_max, integral_.compression());
    if (integral_.compression() > options_.compression_warning) ++report_.compressed_steps;
    if (integral_.compression() > options_.compression_limit) {
        const ContactPair<Dim>& pair = pairs_.pairs()[integral_.most_compressed()];
        throw std::runtime_error("contact: faces " + std::to_string(pair.face_1) + " and " + std::to_string(pair.face_2) + " are pressed " +
                                 std::to_string(integral_.compression()) + " times the depth of their cells into each other, " +
                                 std::to_string(options_.compression_limit) +
                                 " is allowed. Refine the mesh at the contact, lower the speed or the load, or raise compression_limit.");
    }
}

template <int Dim>
void Contact<Dim>::evaluate(std::span<const Vector<Dim>> displacement, std::span<const Vector<Dim>> force) {
    integral_.integrate(surface_, pairs_, local_face_, coupling_, {displacement, displacement, force, force});
}

template class Contact<2>;
template class Contact<3>;

}  // namespace abut::contact
