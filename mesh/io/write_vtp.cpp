#include "abut/mesh/io/write_vtp.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/io/vtk_output.hpp"

namespace abut::mesh {
namespace {

OutputGrid grid_of(const geometry::FaceSoup& faces) {
    geometry::check_offsets(faces);
    std::vector<std::int64_t> corners, ends;
    for (std::int32_t face = 0; face < faces.size(); ++face) {
        for (const std::int32_t vertex : faces.vertices_of(face)) {
            if (vertex < 0 || static_cast<std::size_t>(vertex) >= faces.vertices.size())
                throw BadInput("write_vtp: face " + std::to_string(face) + " names vertex " + std::to_string(vertex) +
                               ", but there are " + std::to_string(faces.vertices.size()) + ". Leave it out.");
            corners.push_back(vertex);
        }
        ends.push_back(std::ssize(corners));
    }
    return output_grid<3>("PolyData", "Polys", faces.vertices, corners, ends);
}

}  // namespace

void write_vtp(const geometry::FaceSoup& faces, const std::filesystem::path& path, const SurfaceFields& fields) {
    OutputGrid grid = grid_of(faces);
    add_fields<3>(grid.cell_data, fields.of_faces, grid.n_cells, "faces", "write_vtp");
    add_fields<3>(grid.point_data, fields.of_vertices, grid.n_points, "vertices", "write_vtp");
    for (const NamedNumber& number : fields.numbers) grid.field_data += field_number(number.name, number.value);
    prepared_grid(grid, path).move_into_place();
}

}  // namespace abut::mesh
