// What a solid tells of its contact.
#include "abut/solid/contact_view.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <variant>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/contact/contact_driver.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

/// Contact of a law; null where contact is by another one.
template <class OfLaw, int Dim>
const OfLaw* by_law(const ContactDriver<Dim>& driver) {
    const auto contact = driver.contact();
    const auto* found = std::get_if<std::reference_wrapper<const OfLaw>>(&contact);
    return found ? &found->get() : nullptr;
}

}  // namespace

template <int Dim>
contact::ContactReport ContactView<Dim>::report() const {
    return solid_.contact_ ? solid_.contact_->report() : contact::ContactReport{};
}

template <int Dim>
double ContactView<Dim>::compression() const {
    return solid_.contact_ ? solid_.contact_->compression() : 0.0;
}

template <int Dim>
void ContactView<Dim>::require_depth() const {
    if (!solid_.contact_ || solid_.contact_->pairs().empty()) return;
    const auto pair = std::ranges::max_element(solid_.contact_->pairs(), {}, &contact::PairStep<Dim>::compression);
    const double deepest = pair->compression, limit = solid_.options_.contact->compression_limit;
    if (!(deepest > limit)) return;
    const auto name_of = [&](contact::Face face) -> std::string {
        const BoundaryFace boundary = solid_.contact_->mesh_boundary(face);
        if (boundary == no_face) return "an obstacle";
        const std::int32_t of_mesh = mesh_face(solid_.mesh_, boundary);
        std::string name = "the face of body '" +
                           solid_.mesh_.body_names[solid_.mesh_.cell_body[solid_.mesh_.face_cells[of_mesh][0]]] + "' at (";
        for (int i = 0; i < Dim; ++i) name += (i > 0 ? ", " : "") + number(solid_.mesh_.face_centroid[of_mesh][i]);
        return name + ") m";
    };
    throw TooDeep(
        solid_.mesh_.name + ": " + name_of(pair->face_1) + " and " + name_of(pair->face_2) + " are pressed " +
            number(deepest) + " times the depth of their cells into each other, " + number(limit) +
            " is allowed (compression_limit). Load them less, or refine the mesh at the contact.",
        {.face_1 = number_of(pair->face_1), .face_2 = number_of(pair->face_2), .value = deepest, .allowed = limit});
}

template <int Dim>
Vector<Dim> ContactView<Dim>::obstacle_force(std::size_t obstacle) const {
    if (obstacle >= solid_.options_.obstacles.size())
        throw Misuse("solid: the force on obstacle " + std::to_string(obstacle) + " is asked for, but there are " +
                     std::to_string(solid_.options_.obstacles.size()) + " obstacles, counted from 0.");
    return solid_.contact_->obstacles().force(obstacle);
}

template <int Dim>
std::span<const BodyImpulse<Dim>> ContactView<Dim>::impulses() const {
    return solid_.contact_ ? solid_.contact_->impulses() : std::span<const BodyImpulse<Dim>>{};
}

template <int Dim>
const contact::Contact<Dim>* ContactView<Dim>::reconstruction() const {
    return solid_.contact_ ? by_law<contact::Contact<Dim>>(*solid_.contact_) : nullptr;
}

template <int Dim>
const contact::NodalContact<Dim>* ContactView<Dim>::pair_potential() const {
    return solid_.contact_ ? by_law<contact::NodalContact<Dim>>(*solid_.contact_) : nullptr;
}

template <int Dim>
double ContactView<Dim>::skin() const {
    return solid_.contact_ ? solid_.contact_->skin() : 0.0;
}

template <int Dim>
BoundaryFace ContactView<Dim>::boundary_of_face(std::int64_t face) const {
    if (!solid_.contact_ || face < 0 || face > std::numeric_limits<std::int32_t>::max()) return no_face;
    return solid_.contact_->mesh_boundary(contact::Face{static_cast<std::int32_t>(face)});
}

template <int Dim>
std::vector<contact::BlindCorner<Dim>> ContactView<Dim>::blind_corners() const {
    return solid_.contact_ ? solid_.contact_->blind_corners() : std::vector<contact::BlindCorner<Dim>>{};
}

template <int Dim>
std::optional<contact::EdgePair<Dim>> ContactView<Dim>::unseen_edges() const {
    return solid_.contact_ ? solid_.contact_->unseen_edges() : std::nullopt;
}

// In a state --------------------------------------------------------------------------------------------------------

template <int Dim>
ContactField ContactState<Dim>::field() const {
    if (solid_.contact_) return solid_.contact_->field();
    const std::size_t n = solid_.mesh_.boundary_faces.size();
    return {std::vector<double>(n, 0.0), std::vector<double>(n, std::numeric_limits<double>::infinity())};
}

template <int Dim>
std::vector<TouchingPair<Dim>> ContactState<Dim>::touching_pairs(double gap) const {
    if (!solid_.contact_) return {};
    return solid_.contact_->touching_pairs(gap);
}

template <int Dim>
std::vector<ActingPair<Dim>> ContactState<Dim>::acting_pairs() const {
    if (!solid_.contact_) return {};
    std::vector<ActingPair<Dim>> acting;
    for (const contact::PairStep<Dim>& pair : solid_.contact_->pairs())
        if (pair.force != Vector<Dim>::Zero())
            acting.push_back({solid_.contact_->mesh_boundary(pair.face_1), solid_.contact_->mesh_boundary(pair.face_2),
                              pair.normal, pair.gap_1, pair.area, pair.normal_force, pair.force, pair.friction, pair.slip});
    return acting;
}

template class ContactView<2>;
template class ContactView<3>;
template class ContactState<2>;
template class ContactState<3>;

}  // namespace abut::solid
