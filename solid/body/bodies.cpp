#include "abut/solid/body/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/mesh/extract.hpp"
#include "abut/solid/material/law_check.hpp"
#include "abut/solid/material/orthotropic.hpp"
#include "abut/solid/material/warm_laws.hpp"
#include "abut/solid/part/body_cells.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {
namespace {

/// dt omega of the hardest bounce is at most 0.34: it takes nine steps, and fewer feed the alternating mode.
constexpr double frequency_margin = 5.0;

/// Area of the faces of a body by their normals, which are one where rounding alone sets them apart.
template <int Dim>
class FacesByNormal {
public:
    void add(const Vector<Dim>& normal, double area) {
        constexpr double resolution = 1e-6;
        std::array<std::int64_t, Dim> key;
        for (int d = 0; d < Dim; ++d) key[static_cast<std::size_t>(d)] = std::llround(normal[d] / resolution);
        const auto [place, is_new] = index_.try_emplace(key, sides_.size());
        if (is_new) sides_.push_back({normal, 0.0});
        sides_[place->second].area += area;
    }
    /// The largest area that the body shows to a plane on which one of its faces lies [m^(Dim-1)]: a body that is
    /// turned shows what it did. Of bodies that are rounder than the number of directions tells the largest faces stand
    /// for the others.
    [[nodiscard]] double largest_silhouette() const {
        constexpr std::size_t most_directions = 2000;
        double least_area = 0.0;
        if (sides_.size() > most_directions) {
            std::vector<double> areas;
            for (const Side& side : sides_) areas.push_back(side.area);
            const auto last = areas.begin() + most_directions;
            std::ranges::nth_element(areas, last, std::greater<>{});
            least_area = (1.0 - 1e-9) * *last;  // faces of one size are taken together
        }
        double largest = 0.0;
        for (const Side& along : sides_) {
            if (along.area < least_area) continue;
            double silhouette = 0.0;
            for (const Side& side : sides_) silhouette += 0.5 * side.area * std::abs(side.normal.dot(along.normal));
            largest = std::max(largest, silhouette);
        }
        return largest;
    }

private:
    struct Side {
        Vector<Dim> normal;
        double area;
    };
    std::map<std::array<std::int64_t, Dim>, std::size_t> index_;
    std::vector<Side> sides_;
};

/// One value per body that is chosen; none where none are given.
template <class Value>
std::vector<Value> chosen(const std::vector<Value>& values, std::span<const std::int32_t> bodies) {
    std::vector<Value> result;
    if (values.empty()) return result;
    for (const std::int32_t body : bodies) result.push_back(values[static_cast<std::size_t>(body)]);
    return result;
}

/// The law of space of a material whose law in this dimension is given; null: it is St. Venant and Kirchhoff's.
template <int Dim>
std::shared_ptr<const StoredEnergy<3>> law_of_space(const Material& material,
                                                    const std::shared_ptr<const StoredEnergy<Dim>>& law) {
    if (!law) return std::make_shared<OrthotropicEnergy<3>>(material);  // of isotropic constants
    if constexpr (Dim == 3)
        return law;
    else
        return stored_energy<3>(material);
}
template <int Dim>
std::shared_ptr<const InelasticLaw<3>> law_of_space(const Material& material,
                                                    const std::shared_ptr<const InelasticLaw<Dim>>& law) {
    if constexpr (Dim == 3)
        return law;
    else
        return inelastic_law<3>(material);
}

/// Puts the law of a body of Kinematics::finite that is warm behind its thermal stretch.
template <int Dim>
void put_behind_stretch(const Material& material, std::shared_ptr<const StoredEnergy<Dim>>& stored,
                        std::shared_ptr<const InelasticLaw<Dim>>& inelastic) {
    const ThermalStretch stretch(thermal_strain(material));
    if (inelastic)
        inelastic = std::make_shared<WarmInelastic<Dim>>(law_of_space<Dim>(material, inelastic), stretch);
    else
        stored = std::make_shared<WarmEnergy<Dim>>(law_of_space<Dim>(material, stored), stretch);
}

}  // namespace

template <int Dim>
Bodies<Dim>::Bodies(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, std::vector<TractionHold> holds)
    : mesh_(mesh), options_(options), traction_holds_(std::move(holds)) {
    check();
    std::vector<std::int32_t> rigid;
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body)
        (is_rigid(body) ? rigid : deformable_bodies_).push_back(body);
    if (!rigid.empty()) part_ = mesh::extract_bodies<Dim>(mesh, deformable_bodies_);
    part_options_ = options;
    part_options_.materials = chosen(options.materials, deformable_bodies_);
    part_options_.kinematics = chosen(options.kinematics, deformable_bodies_);
    part_options_.acceleration = chosen(options.acceleration, deformable_bodies_);
    part_options_.temperature_rise = chosen(options.temperature_rise, deformable_bodies_);
    set_laws();
    for (std::size_t i = 0; i < part_options_.temperature_rise.size(); ++i)
        if (part_options_.temperature_rise[i].value && is_finite(deformable_bodies_[i]))
            put_behind_stretch<Dim>(part_options_.materials[i], part_options_.finite.stored_energy[i],
                                    part_options_.finite.inelastic[i]);
    part_options_.boundary.traction.clear();
    for (std::size_t i = 0; i < options.boundary.traction.size(); ++i)
        if (traction_holds_[i] != TractionHold::points)
            part_options_.boundary.traction.push_back(options.boundary.traction[i]);
        else  // its faces are no free ones for cells of finite bodies
            part_options_.boundary.traction.push_back({.group = options.boundary.traction[i].group});
    if (part_) keep_groups();
    join_pulled_faces();
    rigid_.emplace(mesh, rigid, options.materials, n_cells());

    const mesh::Mesh<Dim>& part = deformable();
    rest_ = part.cell_centroid;
    for (std::int32_t c = 0; c < part.n_cells(); ++c) {
        masses_.push_back(part_options_.materials[part.cell_body[c]].density * part.cell_measure[c]);
        body_.push_back(deformable_bodies_[part.cell_body[c]]);
    }
    for (std::size_t i = 0; i < rigid_->size(); ++i)
        for (const Vector<Dim>& point : rigid_->rest_points(i)) {
            rest_.push_back(point);
            masses_.push_back(rigid_->mass(i) / RigidBodies<Dim>::points_per_body);
            body_.push_back(rigid_->mesh_body(i));
        }
    for (const double mass : masses_) inverse_masses_.insert(inverse_masses_.end(), Dim, 1.0 / mass);
}

template <int Dim>
SolidPoints<Dim> Bodies<Dim>::points() const {
    std::vector<std::int32_t> rigid;
    for (std::size_t i = 0; i < rigid_->size(); ++i) rigid.push_back(rigid_->first_point(i));
    return {mesh_.name, deformable(), rest_, masses_, inverse_masses_, body_, std::move(rigid)};
}

template <int Dim>
void Bodies<Dim>::take_bonds(std::vector<BondPlace<Dim>> places, std::vector<BondCoverage> coverage,
                             std::span<const BoundaryFace> joined, std::span<const BoundaryFace> glued) {
    bond_places_ = std::move(places);
    bond_coverage_ = std::move(coverage);
    for (const BoundaryFace b : joined) part_options_.boundary.joined_faces.push_back(mesh_face(deformable(), b));
    for (const BoundaryFace b : glued) part_options_.boundary.glued_faces.push_back(mesh_face(deformable(), b));
}

/// Metal behind a joint would flow by its cells alone, as if nothing pulled.
template <int Dim>
bool Bodies<Dim>::have_one_frame(const BondPlace<Dim>& place) const {
    const auto fits = [&](std::int32_t body) {
        const bool is_metal = options_.materials[static_cast<std::size_t>(body)].law == MaterialLaw::j2;
        return properties(body).has_frame && !is_metal;
    };
    return options_.bonds[place.bond].of_grains && std::ranges::all_of(place.bodies, fits);
}

template <int Dim>
std::vector<BoundaryFace> Bodies<Dim>::boundary_in_mesh() const {
    std::vector<BoundaryFace> in_mesh;
    for (const BoundaryFace b : boundary_faces(mesh_))
        if (!is_rigid(mesh_.cell_body[cell_of(mesh_, b)])) in_mesh.push_back(b);
    return in_mesh;
}

template <int Dim>
void Bodies<Dim>::place_cell_points(const RankPart<Dim>& part) {
    cell_points_.resize(deformable_bodies_.size());
    for (std::size_t i = 0; i < deformable_bodies_.size(); ++i) {
        if (!properties(deformable_bodies_[i]).has_frame) continue;
        const auto body = static_cast<std::int32_t>(i);
        const auto cells = cells_of_body(deformable(), body);
        cell_points_[i] = find_cell_points<Dim>(deformable(), body, cells, part_options_.materials[i].density, part);
        if (!cell_points_[i]) continue;
        if (!part_) part_ = mesh_;
        std::vector<Vector<Dim>> places;
        for (std::int32_t c = cells.first; c < cells.second; ++c) places.push_back(cell_points_[i]->place(*part_, c));
        std::ranges::copy(places, part_->cell_centroid.begin() + cells.first);
        std::ranges::copy(places, rest_.begin() + cells.first);
    }
}

/// The group of a condition may have no face in the part of a rank, and mesh::extract_bodies leaves such groups out.
template <int Dim>
void Bodies<Dim>::keep_groups() {
    const auto keep = [&](const auto& conditions) {
        for (const auto& condition : conditions)
            if (std::ranges::find(part_->groups, condition.group, &mesh::BoundaryGroup::name) == part_->groups.end())
                part_->groups.push_back({condition.group, {}});
    };
    keep(part_options_.boundary.dirichlet);
    keep(part_options_.boundary.traction);
}

/// Faces of floating bodies that a traction pulls at as places: their row in the operators is that of the place.
template <int Dim>
void Bodies<Dim>::join_pulled_faces() {
    part_options_.boundary.joined_faces.clear();
    for (std::size_t i = 0; i < options_.boundary.traction.size(); ++i) {
        if (traction_holds_[i] != TractionHold::points) continue;
        for (const std::int32_t face : deformable().group(options_.boundary.traction[i].group).faces)
            if (properties(deformable_bodies_[deformable().cell_body[deformable().face_cells[face][0]]]).has_frame)
                part_options_.boundary.joined_faces.push_back(face);
    }
}

template <int Dim>
void Bodies<Dim>::set_laws() {
    auto& stored = part_options_.finite.stored_energy;
    auto& inelastic = part_options_.finite.inelastic;
    stored = chosen(options_.finite.stored_energy, deformable_bodies_);
    inelastic = chosen(options_.finite.inelastic, deformable_bodies_);
    stored.resize(deformable_bodies_.size());
    inelastic.resize(deformable_bodies_.size());
    for (std::size_t i = 0; i < stored.size(); ++i) {
        const Material& material = part_options_.materials[i];
        if (!stored[i] && !inelastic[i]) {
            const bool is_linear = !material.is_isotropic() && !is_finite(deformable_bodies_[i]);  // the operators know it
            if (!is_linear) stored[i] = stored_energy<Dim>(material);
            if (is_finite(deformable_bodies_[i])) inelastic[i] = inelastic_law<Dim>(material);
        }
        if (!stored[i] && !inelastic[i]) continue;
        const std::int32_t body = deformable_bodies_[i];
        const std::string who = mesh_.name + ": body '" + mesh_.body_names[static_cast<std::size_t>(body)] + "' ";
        if (stored[i] && inelastic[i]) throw BadInput(who + "is given an elastic law and an inelastic one. Leave one out.");
        const LawCheck<Dim> check(material, who);
        if (stored[i])
            check.require(*stored[i]);
        else
            check.require(*inelastic[i]);
    }
}

template <int Dim>
BodyFrames<Dim> Bodies<Dim>::frames(const RankPart<Dim>& part) const {
    std::vector<std::int32_t> begin{0};
    std::vector<bool> have_frames;
    for (const std::int32_t body : deformable_bodies_) {
        have_frames.push_back(properties(body).has_frame);
        begin.push_back(cells_of_body(deformable(), static_cast<std::int32_t>(begin.size()) - 1).second);
    }
    return BodyFrames<Dim>(deformable().cell_centroid, std::span(masses_).first(static_cast<std::size_t>(n_cells())),
                           std::move(begin), std::move(have_frames), deformable().body_names, part);
}

template <int Dim>
std::vector<Vector<Dim>> Bodies<Dim>::rigid_forces() const {
    std::vector<Vector<Dim>> forces(rest_.size(), Vector<Dim>::Zero());
    if (options_.acceleration.empty() && !options_.body_load) return forces;
    for (std::size_t i = 0; i < rigid_->size(); ++i) {
        const std::int32_t body = rigid_->mesh_body(i);
        Vector<Dim> sum = Vector<Dim>::Zero();
        Matrix<Dim> moment = Matrix<Dim>::Zero();
        if (!options_.acceleration.empty()) sum = rigid_->mass(i) * options_.acceleration[static_cast<std::size_t>(body)];
        const auto [begin, end] = cells_of_body(mesh_, body);
        for (std::int32_t c = begin; options_.body_load && c < end; ++c) {
            const Vector<Dim> force = mesh_.cell_measure[c] * options_.body_load(mesh_.cell_centroid[c]);
            if (!force.allFinite())
                throw BadInput(mesh_.name + ": the force on cell " + std::to_string(mesh_.cell_label[c]) +
                                   " is not finite. Correct SolidOptions::body_load.",
                               {.cell = c});
            sum += force;
            moment += force * (mesh_.cell_centroid[c] - rigid_->rest_centre(i)).transpose();
        }
        rigid_->set_gradient(i, sum, moment, forces);
    }
    return forces;
}

/// The skin of one side as a spring: k of its stiffest face over the largest area that lies on a plane; a corner has at
/// most 4 times the inverse mass of the whole.
template <int Dim>
std::vector<double> Bodies<Dim>::rigid_stiffness() const {
    std::vector<double> stiffness(rest_.size(), 0.0);
    for (std::size_t i = 0; options_.contact && i < rigid_->size(); ++i) {
        double skin = 0.0;
        FacesByNormal<Dim> faces;
        for (const std::int32_t f : mesh_.boundary_faces) {
            const std::int32_t cell = mesh_.face_cells[f][0];
            if (mesh_.cell_body[cell] != rigid_->mesh_body(i)) continue;
            skin = std::max(skin, rigid_skin(i) * mesh_.face_measure[f] / mesh_.cell_measure[cell]);
            faces.add(mesh_.face_normal[f], mesh_.face_measure[f]);
        }
        const double square = 4.0 * skin * faces.largest_silhouette() / rigid_->mass(i);
        for (int k = 0; k < RigidBodies<Dim>::points_per_body; ++k) {
            const auto point = static_cast<std::size_t>(rigid_->first_point(i) + k);
            stiffness[point] = frequency_margin * frequency_margin * square * masses_[point];
        }
    }
    return stiffness;
}

template <int Dim>
Matrix<Dim> Bodies<Dim>::mean_turn(std::int32_t body, const BodyFrames<Dim>& frames) const {
    for (std::size_t i = 0; i < rigid_->size(); ++i)
        if (rigid_->mesh_body(i) == body) return rigid_->mean_turn(i);
    return frames.step(static_cast<std::size_t>(deformable_body(body))).mean_turn();
}

template <int Dim>
std::int32_t Bodies<Dim>::deformable_body(std::int32_t body) const {
    const auto found = std::ranges::find(deformable_bodies_, body);
    return found == deformable_bodies_.end() ? -1 : static_cast<std::int32_t>(found - deformable_bodies_.begin());
}

template <int Dim>
std::pair<std::int32_t, std::int32_t> Bodies<Dim>::points_of(std::int32_t body) const {
    const auto found = std::ranges::find(body_, body);
    const auto end = std::find_if(found, body_.end(), [&](std::int32_t of_point) { return of_point != body; });
    return {static_cast<std::int32_t>(found - body_.begin()), static_cast<std::int32_t>(end - body_.begin())};
}

template <int Dim>
std::pair<std::int32_t, std::int32_t> Bodies<Dim>::deformable_cell(std::int32_t cell) const {
    const std::int32_t body = deformable_body(mesh_.cell_body[cell]);
    if (body < 0) return {-1, -1};
    return {cell - cells_of_body(mesh_, mesh_.cell_body[cell]).first + cells_of_body(deformable(), body).first, body};
}

template <int Dim>
std::int32_t Bodies<Dim>::mesh_cell(std::int32_t cell) const {
    const std::int32_t body = deformable().cell_body[cell];
    return cell - cells_of_body(deformable(), body).first + cells_of_body(mesh_, deformable_bodies_[body]).first;
}

template class Bodies<2>;
template class Bodies<3>;

}  // namespace abut::solid
