// What check_vtk_files.py compares with VTK and meshio: vtk_files write FOLDER; vtk_files read FILES.
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "abut/mesh/io/point_series.hpp"
#include "abut/mesh/io/write_pieces.hpp"
#include "abut/mesh/io/write_vtp.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"
#include "mesh/vtk_arrays.hpp"

using namespace abut;
using namespace abut::mesh;

namespace {

template <int Dim>
struct Values {
    std::vector<double> numbers;
    std::vector<Vector<Dim>> vectors;
    std::vector<Matrix<Dim>> tensors;

    explicit Values(std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
            const double x = std::sin(1.0 + static_cast<double>(i));
            numbers.push_back(i == 3 ? std::numeric_limits<double>::denorm_min() : std::exp(300.0 * x));
            vectors.push_back(Vector<Dim>::Constant(x));
            tensors.push_back(x * Matrix<Dim>::Constant(0.7) + Matrix<Dim>::Identity());
        }
    }
};

template <int Dim>
void write_series(const std::filesystem::path& folder, const std::string& name, const Mesh<Dim>& mesh) {
    const Values<Dim> of_cells(static_cast<std::size_t>(mesh.n_cells())), of_faces(mesh.boundary_faces.size());
    VtuSeries<Dim> series(folder, name, mesh);
    series.write({.time = 1.0 / 3.0,
                  .displacement = of_cells.vectors,
                  .cell_fields = {{"a < b & \"c\" [J]", of_cells.numbers}, {"stress [Pa]", of_cells.tensors}},
                  .boundary_fields = {{"pressure [Pa]", of_faces.numbers}}});
}

/// The first cells of a mesh in one piece, the others, whose faces are left out, in another one.
void write_pieces(const std::filesystem::path& folder, const Mesh<3>& mesh) {
    PieceSeries series(folder, "pieces");
    std::vector<std::int32_t> vertices(mesh.vertices.size()), faces(mesh.boundary_faces.size()), no_faces;
    std::iota(vertices.begin(), vertices.end(), 0);
    std::iota(faces.begin(), faces.end(), 0);
    const Values<3> at_vertices(vertices.size()), of_faces(faces.size());
    for (const int piece : {0, 1}) {
        std::vector<std::int32_t> cells;
        for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
            if ((cell < 5) == (piece == 0)) cells.push_back(cell);
        const Values<3> of_cells(cells.size());
        const PieceFrame<3> frame{
            .time = 1.0 / 3.0,
            .cells = cells,
            .cell_number = cells,
            .vertices = vertices,
            .boundary = piece == 0 ? faces : no_faces,
            .face_number = piece == 0 ? faces : no_faces,
            .displacement = of_cells.vectors,
            .vertex_displacement = at_vertices.vectors,
            .cell_fields = {{"stress [Pa]", of_cells.tensors}},
            .boundary_fields = {{"gap [m]", std::span(of_faces.numbers).first(piece == 0 ? faces.size() : 0)}}};
        write_piece(folder, "pieces", 0, piece, mesh, frame);
        if (piece == 1) series.publish(2, mesh, frame);
    }
}

void write_files(const std::filesystem::path& folder) {
    for (const CellShape shape : {CellShape::tetrahedron, CellShape::hexahedron, CellShape::prism, CellShape::pyramid})
        write_series(folder, "solid_" + std::to_string(static_cast<int>(shape)),
                     structured_box<3>({0, 0, 0}, {1, 2, 3}, {9, 8, 7}, shape));
    for (const CellShape shape : {CellShape::triangle, CellShape::quadrangle})
        write_series(folder, "plane_" + std::to_string(static_cast<int>(shape)),
                     structured_box<2>({0, 0}, {1, 2}, {9, 8}, shape));
    write_pieces(folder, structured_box<3>({0, 0, 0}, {1, 2, 3}, {2, 2, 3}, CellShape::hexahedron));
    const SurfaceMesh gear = gear_surface({.n_teeth = 5});
    const Values<3> of_vertices(gear.vertices.size());
    const std::vector<Field<3>> fields = {{"u", of_vertices.vectors}};
    write_vtp(gear.soup(), folder / "gear.vtp", {.of_vertices = fields});
    PointSeries<2> points(folder, "points");
    const Values<2> of_points(20);
    points.write({.time = 1.0 / 3.0, .position = of_points.vectors, .fields = {{"force [N]", of_points.numbers}}});
    points.write({.time = 1.0 / 3.0, .fields = {{"force [N]", std::span<const double>()}}});
}

void print_data(const char* kind, const std::vector<VtkArray>& arrays) {
    for (const VtkArray& array : arrays) {
        std::printf("%s\t%s\t%zu\t", kind, array.name.c_str(), array.n_components);
        for (const double value : array.values) std::printf("%a ", value);
        std::printf("\n");
    }
}

void print_file(const std::filesystem::path& path) {
    std::printf("file\t%s\n", path.c_str());
    try {
        const VtkGrid grid = mesh::test::read_grid(path);
        std::printf("points\t");
        for (const Vector<3>& point : grid.points) std::printf("%a %a %a ", point[0], point[1], point[2]);
        std::printf("\n");
        for (std::size_t cell = 0; cell < grid.n_cells(); ++cell) {
            std::printf("cell\t%d", static_cast<int>(grid.cell_types[cell]));
            for (const std::int64_t corner : grid.corners_of(cell)) std::printf(" %d", static_cast<int>(corner));
            std::printf("\n");
        }
        print_data("point_data", grid.point_data);
        print_data("cell_data", grid.cell_data);
    } catch (const std::exception& error) {
        std::printf("error\t%s\n", error.what());
    }
}

}  // namespace

int main(int n_arguments, char** arguments) {
    const std::vector<std::string> words(arguments + 1, arguments + n_arguments);
    if (words.size() < 2) return 2;
    if (words[0] == "write") write_files(words[1]);
    for (std::size_t i = 1; words[0] == "read" && i < words.size(); ++i) print_file(words[i]);
    return 0;
}
