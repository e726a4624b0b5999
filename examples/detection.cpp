// Which faces of two meshes look at each other, how far apart, and how much area do they share?
//
// Two unit cubes, one of tetrahedra and one of hexahedra, are stacked 0.01 m apart; the upper one is shifted by 0.3 m along
// x. Seen along z they share 0.7 m^2, whatever their faces are: the areas of all pairs add up to that, to round-off, and
// each gap is 0.01 m. With two file names (OBJ, STL, PLY, OFF, VTP, VTU, MSH) it shows the pairs of those within 0.05 m
// instead.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "abut/mesh/io/read_surface.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/surface_mesh.hpp"

using namespace abut;

namespace {

constexpr double gap = 0.01, shift = 0.3;  // [m]

mesh::SurfaceMesh cube(const Vector<3>& corner, int n, mesh::CellShape shape) {
    return mesh::boundary_of(mesh::structured_box<3>(corner, corner + Vector<3>::Ones(), {n, n, n}, shape));
}

/// What contact sees of a mesh. Cells are as good as flat here: faces that lie behind others are of no interest.
void append(const mesh::SurfaceMesh& mesh, std::int32_t body, contact::Surface<3>& surface) {
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face) {
        std::vector<Vector<3>> corners;
        for (const std::int32_t v : mesh.faces[face]) corners.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
        surface.append(corners, 1e-6, 1.0, body);
    }
}

}  // namespace

int main(int argc, char** argv) try {
    const bool from_files = argc == 3;
    contact::Surface<3> surface;
    append(from_files ? mesh::read_surface(argv[1]) : cube(Vector<3>::Zero(), 7, mesh::CellShape::tetrahedron), 0, surface);
    append(from_files ? mesh::read_surface(argv[2]) : cube({shift, 0.0, 1.0 + gap}, 5, mesh::CellShape::hexahedron), 1,
           surface);

    // The list: a superset of all pairs within the distance, none missed. A host keeps it for many steps.
    contact::CandidateOptions options;
    options.distance = 0.05;
    contact::CandidateSearch<3> search(surface.view(), options);
    const std::vector<Vector<3>> displacement(static_cast<std::size_t>(surface.size()), Vector<3>::Zero());
    search.search(displacement, displacement);

    // The narrow phase: area, normal and gap of each pair; decisions are exact.
    const contact::Overlaps<3> overlaps = contact::find_overlaps<3>(surface.view(), displacement, search.candidates());
    double area = 0.0, least = INFINITY, largest = -INFINITY;
    for (const contact::Overlap<3>& overlap : overlaps.found) {
        area += overlap.area;
        least = std::min(least, overlap.gap);
        largest = std::max(largest, overlap.gap);
    }
    std::printf("%d faces, %zu candidates, %zu pairs share area\n", surface.size(), search.candidates().size(),
                overlaps.found.size());
    std::printf("area %.15g m^2, gaps from %.12g to %.12g m\n", area, least, largest);
    if (from_files) return 0;
    std::printf("exact %.15g m^2, gap %.12g m\n", 1.0 - shift, gap);
    const bool is_right =
        std::abs(area - (1.0 - shift)) < 1e-13 && std::abs(least - gap) < 1e-13 && std::abs(largest - gap) < 1e-13;
    return is_right ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
