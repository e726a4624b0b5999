#include "abut/solid/bond/find_bond_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/overlap/overlaps.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/solid/options/number_tables.hpp"
#include "abut/solid/part/value_reader.hpp"

namespace abut::solid {
namespace {

constexpr double facing = -0.7;      // n_1 . n_2 of faces that may be bonded is below it
constexpr double largest_gap = 0.1;  // between them, of the size of the smaller one
constexpr double whole =
    0.9;  // bonded part of a face from which on nothing else of it is asked for: faces of curves lie askew
constexpr double farthest = 1.0;      // gap up to which faces lie opposite each other, of the size of the larger one
constexpr double least_share = 1e-9;  // of the smaller face: a smaller overlap is rounding

template <int Dim>
double size_of(double area) {
    return Dim == 2 ? area : std::sqrt(area);
}

template <int Dim>
std::string side_in_words(const mesh::Mesh<Dim>& mesh, std::int32_t side, std::size_t n_obstacles) {
    const std::int32_t n = mesh.n_bodies();
    if (side < n) return "body '" + mesh.body_names[static_cast<std::size_t>(side)] + "'";
    return "group '" + mesh.groups[static_cast<std::size_t>(side - n) - n_obstacles].name + "'";
}

template <int Dim>
bool is_on_side(const mesh::Mesh<Dim>& mesh, std::int32_t side, std::size_t n_obstacles, std::int32_t face) {
    const std::int32_t n = mesh.n_bodies();
    if (side < n) return mesh.cell_body[mesh.face_cells[face][0]] == side;
    const auto& faces = mesh.groups[static_cast<std::size_t>(side - n) - n_obstacles].faces;
    return std::ranges::binary_search(faces, face);
}

/// A boundary face as it is at rest, and the sides of bonds that it is on.
template <int Dim>
struct Side {
    std::size_t number;  // among all boundary faces of the bodies that deform, of all ranks; of a rigid body behind these
    std::int32_t body;   // in the mesh
    double depth, measure;
    double cell_size;  // edge of a square or cube as large as the cell [m]
    bool is_simplex;   // of a triangle or tetrahedron
    std::vector<Vector<Dim>> corners;
    std::vector<double> sides;  // 2 bond + side, increasing
};

/// The faces of all ranks that are on a side of a bond. A rigid body is on each rank: the first one brings it.
template <int Dim>
class AllSides {
public:
    AllSides(const Bodies<Dim>& bodies, const RankPart<Dim>& part) : bodies_(bodies), mesh_(bodies.mesh()) {
        const std::vector<BoundaryFace> in_mesh = bodies.boundary_in_mesh();
        for (std::size_t i = 0; i < part.own_faces().size(); ++i)
            append(in_mesh[static_cast<std::size_t>(part.own_faces()[i])], part.face_number(part.face_keys()[i]));
        if (part.ranks().rank() == 0)
            for (const BoundaryFace b : boundary_faces(mesh_))
                if (bodies.is_rigid(mesh_.cell_body[cell_of(mesh_, b)]))
                    append(b, part.n_all_faces() + static_cast<std::size_t>(b));
    }

    [[nodiscard]] std::vector<Side<Dim>> gather(const dynamics::Ranks& ranks) const {
        const std::vector<double> all = ranks.gather(mine_);
        std::vector<Side<Dim>> faces;
        for (ValueReader reader(all); !reader.is_done();) {
            Side<Dim>& face = faces.emplace_back();
            face.number = reader.next_as<std::size_t>();
            face.body = reader.next_as<std::int32_t>();
            face.depth = reader.next();
            face.measure = reader.next();
            face.cell_size = reader.next();
            face.is_simplex = reader.next() != 0.0;
            face.corners.resize(reader.next_as<std::size_t>());
            face.sides.resize(reader.next_as<std::size_t>());
            for (Vector<Dim>& corner : face.corners) corner = reader.next_array<Vector<Dim>>();
            for (double& side : face.sides) side = reader.next();
        }
        std::ranges::sort(faces, {}, &Side<Dim>::number);
        return faces;
    }

private:
    void append(BoundaryFace b, std::size_t number) {
        const std::int32_t face = mesh_face(mesh_, b), cell = cell_of(mesh_, b);
        const SolidOptions<Dim>& options = bodies_.options();
        std::vector<double> sides;
        for (std::size_t bond = 0; bond < options.bonds.size(); ++bond)
            for (std::size_t side = 0; side < 2; ++side)
                if (is_on_side(mesh_, options.bonds[bond].sides[side], options.obstacles.size(), face))
                    sides.push_back(static_cast<double>(2 * bond + side));
        if (sides.empty()) return;
        const auto corners = mesh_.face_vertices[face];
        mine_.insert(mine_.end(),
                     {static_cast<double>(number), static_cast<double>(mesh_.cell_body[cell]), cell_depth(mesh_, face),
                      mesh_.face_measure[face], std::pow(mesh_.cell_measure[cell], 1.0 / Dim),
                      mesh_.cell_faces[cell].size() == Dim + 1 ? 1.0 : 0.0, static_cast<double>(corners.size()),
                      static_cast<double>(sides.size())});
        for (const std::int32_t v : corners) mine_.insert(mine_.end(), mesh_.vertices[v].begin(), mesh_.vertices[v].end());
        mine_.insert(mine_.end(), sides.begin(), sides.end());
    }

    const Bodies<Dim>& bodies_;
    const mesh::Mesh<Dim>& mesh_;
    std::vector<double> mine_;
};

/// The faces of both sides of a bond, as contact reads them: those of the first one, then those of the second.
template <int Dim>
struct Sides {
    contact::Surface<Dim> surface;
    std::array<std::vector<const Side<Dim>*>, 2> faces;
    std::array<std::vector<geometry::Box<Dim>>, 2> boxes;  // with the gap that is allowed

    Sides(std::span<const Side<Dim>> all, std::size_t bond) {
        for (std::size_t side = 0; side < 2; ++side)
            for (const Side<Dim>& face : all)
                if (std::ranges::binary_search(face.sides, static_cast<double>(2 * bond + side))) append(face, side);
    }

    [[nodiscard]] const Side<Dim>& face(std::int32_t i) const {
        const auto k = static_cast<std::size_t>(i), n = faces[0].size();
        return k < n ? *faces[0][k] : *faces[1][k - n];
    }

private:
    void append(const Side<Dim>& face, std::size_t side) {
        surface.append(face.corners, face.depth, 1.0, static_cast<std::int32_t>(side));
        const double size = size_of<Dim>(face.measure);
        geometry::Box<Dim> box;
        for (const Vector<Dim>& corner : face.corners) {
            box.extend(corner);
            box.extend(corner + farthest * size * surface.normal.back());
        }
        faces[side].push_back(&face);
        boxes[side].push_back(box.grown(largest_gap * size));
    }
};

template <int Dim>
void check_bond(const mesh::Mesh<Dim>& mesh, const Bond& bond, std::size_t n_obstacles) {
    const auto n_bodies = static_cast<std::size_t>(mesh.n_bodies()), n_sides = n_bodies + n_obstacles + mesh.groups.size();
    for (const std::int32_t side : bond.sides)
        if (const auto i = static_cast<std::size_t>(side);
            side < 0 || i >= n_sides || (i >= n_bodies && i < n_bodies + n_obstacles))
            throw BadInput(mesh.name + ": a bond is given for side " + std::to_string(side) +
                               "; bodies are counted from 0 to " + std::to_string(n_bodies - 1) + ", groups from " +
                               std::to_string(n_bodies + n_obstacles) + " to " + std::to_string(n_sides - 1) +
                               ", and obstacles cannot be bonded. Correct SolidOptions::bonds.",
                           {.value = static_cast<double>(side), .allowed = static_cast<double>(n_sides - 1)});
    if (bond.sides[0] == bond.sides[1])
        throw BadInput(mesh.name + ": both sides of a bond are " + side_in_words(mesh, bond.sides[0], n_obstacles) +
                       ". Give two, in SolidOptions::bonds.");
    const std::string who = mesh.name + ": the bond of " + side_in_words(mesh, bond.sides[0], n_obstacles) + " and " +
                            side_in_words(mesh, bond.sides[1], n_obstacles) + " in SolidOptions::bonds: its ";
    require_allowed(who, bond_numbers, bond);
    if (bond.fracture_energy > 0.0 && std::isinf(bond.strength))
        throw BadInput(who + "fracture_energy is " + number(bond.fracture_energy) +
                           " J/m^2, but it never opens. Give its strength, or leave fracture_energy out.",
                       {.value = bond.fracture_energy, .allowed = 0.0});
}

/// Bits that look random, and depend on those of `bits` alone (splitmix64).
std::uint64_t mixed(std::uint64_t bits) {
    bits += 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

/// Strength drawn for two faces, from their numbers among all ranks.
double drawn_strength(const Bond& bond, const std::array<std::size_t, 2>& numbers) {
    if (std::isinf(bond.weibull_modulus)) return bond.strength;
    const std::uint64_t bits = mixed(mixed(mixed(bond.seed) ^ numbers[0]) ^ numbers[1]);
    const double share = (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;  // in (0, 1)
    return bond.strength * std::pow(-std::log1p(-share), 1.0 / bond.weibull_modulus);
}

template <int Dim>
class BondFinder {
public:
    BondFinder(const Bodies<Dim>& bodies, const RankPart<Dim>& part)
        : bodies_(bodies), mesh_(bodies.mesh()), part_(part), options_(bodies.options()) {}

    FoundBonds<Dim> find() {
        if (options_.bonds.empty()) return {};
        for (const Bond& bond : options_.bonds) check_bond(mesh_, bond, options_.obstacles.size());
        all_ = AllSides<Dim>(bodies_, part_).gather(part_.ranks());
        here_ = part_.faces_by_number(bodies_.deformable());
        in_mesh_ = bodies_.boundary_in_mesh();
        for (std::size_t i = 0; i < options_.bonds.size(); ++i) append_places(i);
        find_joined();
        find_glued();
        return std::move(found_);
    }

private:
    void append_places(std::size_t number_of_bond) {
        const Bond& bond = options_.bonds[number_of_bond];
        const Sides<Dim> sides(all_, number_of_bond);
        const contact::Surface<Dim>& surface = sides.surface;
        const auto n_first = static_cast<std::int32_t>(sides.faces[0].size());
        std::vector<geometry::IndexPair> pairs =
            geometry::overlapping_pairs<Dim>({}, sides.boxes[0], sides.boxes[1], [&](std::int32_t i, std::int32_t j) {
                return surface.normal[static_cast<std::size_t>(i)].dot(
                           surface.normal[static_cast<std::size_t>(n_first + j)]) < facing;
            });
        for (geometry::IndexPair& pair : pairs) pair.second += n_first;
        const std::vector<Vector<Dim>> at_rest(static_cast<std::size_t>(surface.size()), Vector<Dim>::Zero());
        const contact::SurfaceView<Dim> view = surface.view();
        const std::size_t before = found_.places.size();
        BondCoverage& coverage = found_.coverage.emplace_back();
        std::vector<contact::Overlap<Dim>> apart;
        std::vector<double> bonded(static_cast<std::size_t>(surface.size()), 0.0);  // area of each face
        for (const contact::Overlap<Dim>& overlap : contact::find_overlaps<Dim>(view, at_rest, pairs).found) {
            const Side<Dim>&face_1 = sides.face(overlap.face_1), &face_2 = sides.face(overlap.face_2);
            const auto [smaller, larger] = std::minmax({surface.area[static_cast<std::size_t>(overlap.face_1)],
                                                        surface.area[static_cast<std::size_t>(overlap.face_2)]});
            const double allowed = largest_gap * size_of<Dim>(smaller);
            if (overlap.area <= least_share * smaller || overlap.gap < -allowed ||
                overlap.gap > farthest * size_of<Dim>(larger))
                continue;
            if (overlap.gap > allowed) {
                apart.push_back(overlap);
                continue;
            }
            coverage.area += overlap.area;
            for (const std::int32_t face : {overlap.face_1, overlap.face_2})
                bonded[static_cast<std::size_t>(face)] += overlap.area;
            coverage.largest_gap = std::max(coverage.largest_gap, std::abs(overlap.gap));
            const auto corners = contact::overlap_polygon<Dim>(view, at_rest, {overlap.face_1, overlap.face_2});
            found_.places.push_back({number_of_bond,
                                     {face_here(face_1.number), face_here(face_2.number)},
                                     {face_1.number, face_2.number},
                                     {face_1.body, face_2.body},
                                     {face_1.measure, face_2.measure},
                                     overlap.area,
                                     geometry::face_centroid<Dim>(corners),
                                     overlap.normal,
                                     drawn_strength(bond, {face_1.number, face_2.number})});
        }
        if (bond.fracture_energy > 0.0)
            for (std::size_t p = before; p < found_.places.size(); ++p)
                coverage.cohesive_length = std::min(coverage.cohesive_length, cohesive_length(bond, found_.places[p]));
        if (found_.places.size() == before)
            throw BadInput(
                mesh_.name + ": " + side_in_words(mesh_, bond.sides[0], options_.obstacles.size()) + " and " +
                side_in_words(mesh_, bond.sides[1], options_.obstacles.size()) +
                " are to be bonded, but no face of one lies on one of the other: facing it, and not farther than " +
                number(largest_gap) + " of the smaller face's size. Move them together, or leave the bond out.");
        coverage.opposite = coverage.area;
        for (const contact::Overlap<Dim>& overlap : apart) {
            const auto left = [&](std::int32_t face) {
                const double area = surface.area[static_cast<std::size_t>(face)],
                             done = bonded[static_cast<std::size_t>(face)];
                return done < whole * area ? area - done : 0.0;
            };
            coverage.opposite += std::min({overlap.area, left(overlap.face_1), left(overlap.face_2)});
        }
        coverage.smaller_side = std::min(asked_of_side(sides, 0, before), asked_of_side(sides, 1, before));
    }

    /// E G/strength^2 of a place, of the softer body, over the size of the larger cell [-].
    [[nodiscard]] double cohesive_length(const Bond& bond, const BondPlace<Dim>& place) const {
        double young = std::numeric_limits<double>::infinity(), size = 0.0;
        for (std::size_t side = 0; side < 2; ++side) {
            young = std::min(young, options_.materials[static_cast<std::size_t>(place.bodies[side])].mean_young());
            size = std::max(size, std::ranges::lower_bound(all_, place.numbers[side], {}, &Side<Dim>::number)->cell_size);
        }
        return young * bond.fracture_energy / (place.strength * place.strength) / size;
    }

    /// The area of a side that may be bonded: of a group all of it, of a body what looks along the bond as its faces
    /// that are bonded do.
    [[nodiscard]] double asked_of_side(const Sides<Dim>& sides, std::size_t side, std::size_t first_place) const {
        const std::size_t bond = found_.coverage.size() - 1;
        const bool is_body = options_.bonds[bond].sides[side] < mesh_.n_bodies();
        Vector<Dim> mean = Vector<Dim>::Zero();  // outwards
        for (std::size_t p = first_place; p < found_.places.size(); ++p)
            mean += (side == 0 ? 1.0 : -1.0) * found_.places[p].area * found_.places[p].normal;
        double all = 0.0;
        for (std::size_t i = 0; i < sides.faces[side].size(); ++i) {
            const std::size_t face = side == 0 ? i : sides.faces[0].size() + i;
            const bool looks_along = mean.dot(sides.surface.normal[face]) > -facing * mean.norm();
            if (!is_body || looks_along) all += sides.surface.area[face];
        }
        return all;
    }

    /// In the mesh of all bodies.
    [[nodiscard]] BoundaryFace face_here(std::size_t number) const {
        if (number >= here_.size() || here_[number] == no_face) return no_face;
        return in_mesh_[static_cast<std::size_t>(here_[number])];
    }

    /// Joins faces of small bodies that hold for ever and cover each other, and all of finite ones. Triangles and
    /// tetrahedra of small bodies have the gradient of their faces, which would be loose where no face of the cell is
    /// balanced.
    void find_joined() {
        std::vector<int> n_places(part_.n_all_faces(), 0);
        for (const BondPlace<Dim>& place : found_.places)
            for (const std::size_t face : place.numbers)
                if (face < n_places.size()) ++n_places[face];
        const auto fills = [&](const BondPlace<Dim>& place, std::size_t side) {
            constexpr double rounding = 1e-6;
            const auto face = std::ranges::lower_bound(all_, place.numbers[side], {}, &Side<Dim>::number);
            return !bodies_.turns(face->body) && !face->is_simplex && n_places[face->number] == 1 &&
                   std::abs(place.area - face->measure) <= rounding * face->measure;
        };
        for (const BondPlace<Dim>& place : found_.places)
            if (std::isinf(options_.bonds[place.bond].strength) && fills(place, 0) && fills(place, 1))
                for (const std::size_t face : place.numbers)
                    if (here_[face] != no_face) found_.joined.push_back(here_[face]);
        for (const BondPlace<Dim>& place : found_.places)
            for (std::size_t side = 0; side < 2; ++side)
                if (bodies_.is_finite(place.bodies[side]) && here_[place.numbers[side]] != no_face)
                    found_.joined.push_back(here_[place.numbers[side]]);
        sort_unique(found_.joined);
    }

    void find_glued() {
        for (const BondPlace<Dim>& place : found_.places) {
            if (!bodies_.have_one_frame(place)) continue;
            for (const std::size_t face : place.numbers)
                if (here_[face] != no_face) found_.glued.push_back(here_[face]);
        }
        sort_unique(found_.glued);
    }

    const Bodies<Dim>& bodies_;
    const mesh::Mesh<Dim>& mesh_;
    const RankPart<Dim>& part_;
    const SolidOptions<Dim>& options_;
    std::vector<Side<Dim>> all_;         // by number
    std::vector<BoundaryFace> here_;     // of bodies that deform, by number
    std::vector<BoundaryFace> in_mesh_;  // of these in the mesh of all
    FoundBonds<Dim> found_;
};

}  // namespace

template <int Dim>
FoundBonds<Dim> find_bond_places(const Bodies<Dim>& bodies, const RankPart<Dim>& part) {
    return BondFinder<Dim>(bodies, part).find();
}

template FoundBonds<2> find_bond_places(const Bodies<2>&, const RankPart<2>&);
template FoundBonds<3> find_bond_places(const Bodies<3>&, const RankPart<3>&);

}  // namespace abut::solid
