#include "abut/solid/bond_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/contact/overlaps.hpp"
#include "abut/geometry/polygon.hpp"

namespace abut::solid {
namespace {

constexpr double facing = -0.7;       // n_1 . n_2 of faces that may be bonded is below it
constexpr double largest_gap = 0.1;   // between them, of the size of the smaller one
constexpr double least_share = 1e-9;  // of the smaller face: a smaller overlap is rounding

template <int Dim>
double size_of(double area) {
    return Dim == 2 ? area : std::sqrt(area);
}

template <int Dim>
bool is_of(const mesh::Mesh<Dim>& mesh, std::int32_t side, std::size_t n_obstacles, std::int32_t face) {
    const std::int32_t n = mesh.n_bodies();
    if (side < n) return mesh.cell_body[mesh.face_cells[face][0]] == side;
    const auto& faces = mesh.groups[static_cast<std::size_t>(side - n) - n_obstacles].faces;
    return std::ranges::binary_search(faces, face);
}

/// The boundary faces of both sides, as contact reads them: those of the first one, then those of the second.
template <int Dim>
struct Sides {
    contact::Surface<Dim> surface;
    std::array<std::vector<BoundaryFace>, 2> faces;
    std::array<std::vector<geometry::Box<Dim>>, 2> boxes;  // with the gap that is allowed

    Sides(const mesh::Mesh<Dim>& mesh, const Bond& bond, std::size_t n_obstacles) {
        for (std::size_t side = 0; side < 2; ++side)
            for (const BoundaryFace b : boundary_faces(mesh))
                if (is_of(mesh, bond.sides[side], n_obstacles, mesh_face(mesh, b))) append(mesh, b, side);
    }

    [[nodiscard]] BoundaryFace face(std::int32_t i) const {
        const auto k = static_cast<std::size_t>(i), n = faces[0].size();
        return k < n ? faces[0][k] : faces[1][k - n];
    }

private:
    void append(const mesh::Mesh<Dim>& mesh, BoundaryFace b, std::size_t side) {
        const std::int32_t face = mesh_face(mesh, b);
        std::vector<Vector<Dim>> corners;
        geometry::Box<Dim> box;
        for (const std::int32_t v : mesh.face_vertices[face]) {
            corners.push_back(mesh.vertices[v]);
            box.extend(corners.back());
        }
        surface.append(corners, cell_depth(mesh, face), 1.0, static_cast<std::int32_t>(side));
        faces[side].push_back(b);
        boxes[side].push_back(box.grown(largest_gap * size_of<Dim>(mesh.face_measure[face])));
    }
};

template <int Dim>
void check(const mesh::Mesh<Dim>& mesh, const Bond& bond, std::size_t n_obstacles) {
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
    if (!(bond.strength > 0.0))
        throw BadInput(mesh.name + ": the bond of " + side_in_words(mesh, bond.sides[0], n_obstacles) + " and " +
                           side_in_words(mesh, bond.sides[1], n_obstacles) + " has a strength of " + number(bond.strength) +
                           " Pa; > 0 is needed. Correct SolidOptions::bonds.",
                       {.value = bond.strength, .allowed = 0.0});
    if (!(bond.fracture_energy >= 0.0 && std::isfinite(bond.fracture_energy)) ||
        (bond.fracture_energy > 0.0 && std::isinf(bond.strength)))
        throw BadInput(
            mesh.name + ": the bond of " + side_in_words(mesh, bond.sides[0], n_obstacles) + " and " +
                side_in_words(mesh, bond.sides[1], n_obstacles) + " has a fracture energy of " +
                number(bond.fracture_energy) +
                " J/m^2; it is finite and >= 0, and 0 where the strength is infinite. Correct SolidOptions::bonds.",
            {.value = bond.fracture_energy, .allowed = 0.0});
}

template <int Dim>
void append_places(const mesh::Mesh<Dim>& mesh, const Bond& bond, std::size_t bond_number, std::size_t n_obstacles,
                   std::vector<BondPlace<Dim>>& places) {
    check(mesh, bond, n_obstacles);
    const Sides<Dim> sides(mesh, bond, n_obstacles);
    const contact::Surface<Dim>& surface = sides.surface;
    const auto n_first = static_cast<std::int32_t>(sides.faces[0].size());
    std::vector<geometry::IndexPair> pairs =
        geometry::overlapping_pairs<Dim>({}, sides.boxes[0], sides.boxes[1], [&](std::int32_t i, std::int32_t j) {
            return surface.normal[static_cast<std::size_t>(i)].dot(surface.normal[static_cast<std::size_t>(n_first + j)]) <
                   facing;
        });
    for (geometry::IndexPair& pair : pairs) pair.second += n_first;
    const std::vector<Vector<Dim>> at_rest(static_cast<std::size_t>(surface.size()), Vector<Dim>::Zero());
    const contact::SurfaceView<Dim> view = surface.view();
    const std::size_t before = places.size();
    for (const contact::Overlap<Dim>& overlap : contact::find_overlaps<Dim>(view, at_rest, pairs).found) {
        const double smaller = std::min(surface.area[static_cast<std::size_t>(overlap.face_1)],
                                        surface.area[static_cast<std::size_t>(overlap.face_2)]);
        if (overlap.area <= least_share * smaller || std::abs(overlap.gap) > largest_gap * size_of<Dim>(smaller)) continue;
        const auto corners = contact::overlap_polygon<Dim>(view, at_rest, {overlap.face_1, overlap.face_2});
        places.push_back({bond_number,
                          {sides.face(overlap.face_1), sides.face(overlap.face_2)},
                          overlap.area,
                          geometry::face_centroid<Dim>(corners),
                          overlap.normal});
    }
    if (places.size() == before)
        throw BadInput(mesh.name + ": " + side_in_words(mesh, bond.sides[0], n_obstacles) + " and " +
                       side_in_words(mesh, bond.sides[1], n_obstacles) +
                       " are to be bonded, but no face of one lies on one of the other: facing it, and not farther than " +
                       number(largest_gap) + " of the smaller face's size. Move them together, or leave the bond out.");
}

}  // namespace

template <int Dim>
std::string side_in_words(const mesh::Mesh<Dim>& mesh, std::int32_t side, std::size_t n_obstacles) {
    const std::int32_t n = mesh.n_bodies();
    if (side < n) return "body '" + mesh.body_names[static_cast<std::size_t>(side)] + "'";
    return "group '" + mesh.groups[static_cast<std::size_t>(side - n) - n_obstacles].name + "'";
}

template <int Dim>
std::vector<BondPlace<Dim>> find_bond_places(const mesh::Mesh<Dim>& mesh, std::span<const Bond> bonds,
                                             std::size_t n_obstacles) {
    std::vector<BondPlace<Dim>> places;
    for (std::size_t i = 0; i < bonds.size(); ++i) append_places(mesh, bonds[i], i, n_obstacles, places);
    return places;
}

#define ABUT_INSTANTIATE(Dim)                                                                                          \
    template std::vector<BondPlace<Dim>> find_bond_places(const mesh::Mesh<Dim>&, std::span<const Bond>, std::size_t); \
    template std::string side_in_words(const mesh::Mesh<Dim>&, std::int32_t, std::size_t);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
