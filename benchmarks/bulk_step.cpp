// One step of the bulk, matrix-free, against one product with the assembled sparse matrix of the same operator.
//
// Mesh: Gmsh's cylinder (tetrahedra, numbered in layers one cell thick), free, one material, no contact. Step: position
// update, force at the midpoint, momentum update of MEMM. Rival: y = K x alone, K in 3 x 3 blocks in compressed rows;
// Eigen's scalar RowMajor matrix beside it; STREAM's triad in the same rounds says what the memory gives. One thread,
// processor time. Expected: the answers agree to 1e-12; the step is several times faster than the product, below
// 90 ns per cell. The same step in single precision (Precision) beside it: its forces within 1e-5 of the largest.
// The product of the form for cells of any shape (CellForm::general) is timed beside that of simplices.
// Other shapes, `--shape`: steps and products alone, hexahedra and squares of structured boxes, triangles of Gmsh's disc;
// `boxed_tetrahedra`: a structured box of them with all rivals, without Gmsh. `--alone`: one set of operators, checked on a rigid
// motion, and its steps beside the triad, for meshes that leave no memory for more.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <array>
#include <cmath>
#include <random>

#include "abut/dynamics/memm.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/solid.hpp"
#include "support/assembled_matrix.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;

struct Choices {
    std::vector<double> sizes{0.05};
    int repetitions = 15;
    int threads = 1;
    std::string shape = "tetrahedra";
    bool alone = false;
    std::string json;
};

const solid::Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};

std::vector<double> random_field(std::size_t n) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<double> field(n);
    for (double& x : field) x = value(generator);
    return field;
}

double largest(std::span<const double> values) {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
}

double relative_difference(std::span<const double> a, std::span<const double> b) {
    double difference = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
    return difference / largest(a);
}

/// Forces of the bulk in single precision, against double.
template <int Dim>
double single_difference(solid::Ccg<Dim>& ccg, const std::vector<double>& x) {
    std::vector<double> single(x.size()), expected(x.size());
    const auto u = as_vectors<Dim>(std::span<const double>(x));
    ccg.step_gradient(u, {}, {}, as_vectors<Dim>(std::span<double>(single)));
    ccg.gradient(u, {}, {}, as_vectors<Dim>(std::span<double>(expected)));
    const double difference = relative_difference(expected, single);
    benchmark::require_small("forces in single precision against double", difference, 1e-5);
    return difference;
}

/// Bytes a cell that the product cannot but move: the matrix and both vectors once.
double product_bytes(const benchmark::AssembledMatrix& matrix) {
    return static_cast<double>(matrix.bytes() + matrix.n_rows() * 2 * 24) / static_cast<double>(matrix.n_rows());
}

/// Bytes a cell that a step touches, from the sizes of the arrays of solid/ccg/sweeps.hpp, arrays.hpp, simplices.hpp and
/// memm.hpp, for a body of simplices.
struct Traffic {
    double touched;  ///< every array counted once in each sweep that reads or writes it
    double memory;   ///< what cannot stay in cache from one sweep to the next: constant data and the state, once each way
};

/// Weights of R in rows that the sweeps use: of cells with several boundary faces.
std::size_t n_row_weights(const mesh::Mesh<3>& mesh, const solid::BoundaryReconstruction<3>& boundary) {
    std::vector<int> n_boundary(mesh.cell_measure.size(), 0);
    for (const std::int32_t f : mesh.boundary_faces) ++n_boundary[mesh.face_cells[f][0]];
    std::size_t n = 0;
    for (std::size_t b = 0; b < mesh.boundary_faces.size(); ++b)
        if (n_boundary[mesh.face_cells[mesh.boundary_faces[b]][0]] > 1)
            n += static_cast<std::size_t>(boundary.offsets[b + 1] - boundary.offsets[b]);
    return n;
}

Traffic step_traffic(const mesh::Mesh<3>& mesh, const solid::BoundaryReconstruction<3>& boundary) {
    const auto per_cell = [&](std::size_t n) { return static_cast<double>(n) / mesh.n_cells(); };
    constexpr double vector = 24, lane = 32, tensor = 3 * lane, id = 4, number = 8;
    const double faces = per_cell(static_cast<std::size_t>(mesh.n_faces()));
    const double on_boundary = per_cell(mesh.boundary_faces.size());
    // Constant
    const double sides = faces * 2 * id, stencils = faces * 4 * (id + number), face_geometry = faces * 4 * number;
    const double simplex = 8 * id, cell_geometry = 3 * number;
    const double transposed = id + (faces - on_boundary) * 4 * (id + number);
    const double boundary_rows = per_cell(n_row_weights(mesh, boundary)) * (id + tensor);  // R, and R^T once more
    // Work
    const double displacement = lane, of_faces = faces * lane, corrections = on_boundary * lane;

    const double load = 2 * vector + displacement;
    const double reconstruction = sides + stencils + displacement + boundary_rows + of_faces;
    const double stresses = simplex + cell_geometry + of_faces + displacement + face_geometry + corrections + tensor + lane;
    const double jumps = simplex + face_geometry + lane + lane;
    const double face_forces = sides + tensor + lane + face_geometry + corrections + of_faces;
    const double cell_gradients = transposed + of_faces + lane + boundary_rows + vector;
    const double state = 4 * vector                  // q^{n+1} from q, p, 1/m
                         + 2 * vector + 3 * vector;  // sign of the force; momentum from p and F
    const double constant = sides + stencils + face_geometry + simplex + cell_geometry + transposed + 2 * boundary_rows;
    return {load + reconstruction + stresses + jumps + face_forces + cell_gradients + state,
            constant + 2 * vector + vector + state};
}

struct Result {
    std::int32_t cells;
    double blocks_a_row, matrix_bytes, difference, single_difference;
    benchmark::Samples step, single, stiffness, general, product, eigen, triad;
    double product_bytes, triad_bytes;
    Traffic traffic;
};

Result measure(const mesh::Mesh<3>& mesh, double size, const Choices& choices) {
    solid::SolidOptions<3> options;
    options.materials = {material};
    solid::Solid<3> solid(mesh, options);
    const benchmark::AssembledMatrix matrix(mesh, options.materials, solid.ccg());
    const auto scalar = matrix.scalar_matrix();

    const std::vector<double> x = random_field(solid.size());
    std::vector<double> ours(x.size()), theirs(x.size());
    const auto x_rows = as_vectors<3>(std::span<const double>(x));
    const auto y_rows = as_vectors<3>(std::span<double>(theirs));
    const Eigen::Map<const Eigen::VectorXd> x_eigen(x.data(), static_cast<Eigen::Index>(x.size()));
    Eigen::VectorXd y_eigen(x_eigen.size());
    solid.stiffness_product(x, ours);
    matrix.multiply(x_rows, y_rows);
    y_eigen.noalias() = scalar * x_eigen;
    const double difference =
        std::max(relative_difference(ours, theirs), relative_difference(ours, {y_eigen.data(), x.size()}));
    benchmark::require_small("stiffness product, matrix-free against assembled", difference, 1e-12);
    solid::Ccg<3> general(mesh, options.materials, {}, {}, solid::CellForm::general);

    options.precision = solid::Precision::single_precision;
    solid::Solid<3> single(mesh, options);
    const double of_single = single_difference(single.ccg(), x);

    const std::vector<double> at_rest(x.size(), 0.0);
    dynamics::Memm<solid::Solid<3>> integrator(solid, at_rest, x, 0.01 * size), in_single(single, at_rest, x, 0.01 * size);
    benchmark::Triad triad;
    auto samples = benchmark::time_in_turn(
        choices.repetitions, benchmark::clock_for(choices.threads),
        {[&] { integrator.step(); }, [&] { in_single.step(); }, [&] { solid.stiffness_product(x, ours); },
         [&] { general.gradient(x_rows, {}, {}, as_vectors<3>(std::span<double>(ours))); },
         [&] { matrix.multiply(x_rows, y_rows); }, [&] { y_eigen.noalias() = scalar * x_eigen; }, [&] { triad.run(); }});
    const double rows = mesh.n_cells();
    return {mesh.n_cells(),
            static_cast<double>(matrix.n_blocks()) / rows,
            static_cast<double>(matrix.bytes()),
            difference,
            of_single,
            std::move(samples[0]),
            std::move(samples[1]),
            std::move(samples[2]),
            std::move(samples[3]),
            std::move(samples[4]),
            std::move(samples[5]),
            std::move(samples[6]),
            product_bytes(matrix),
            triad.bytes(),
            step_traffic(mesh, solid.ccg().boundary())};
}

nlohmann::json to_json(const Result& r) {
    const double cells = r.cells;
    const auto nanoseconds_a_cell = [&](const benchmark::Samples& s) {
        return nlohmann::json{{"least", 1e9 * s.least() / cells}, {"median", 1e9 * s.median() / cells}};
    };
    const auto gigabytes_a_second = [&](double bytes_a_cell, const benchmark::Samples& s) {
        return 1e-9 * bytes_a_cell * cells / s.least();
    };
    return {
        {"cells", r.cells},
        {"blocks_a_row", r.blocks_a_row},
        {"matrix_bytes", r.matrix_bytes},
        {"difference", r.difference},
        {"single_difference", r.single_difference},
        {"ns_a_cell",
         {{"step", nanoseconds_a_cell(r.step)},
          {"single_step", nanoseconds_a_cell(r.single)},
          {"stiffness_product", nanoseconds_a_cell(r.stiffness)},
          {"general_form", nanoseconds_a_cell(r.general)},
          {"block_product", nanoseconds_a_cell(r.product)},
          {"eigen_product", nanoseconds_a_cell(r.eigen)}}},
        {"single_over_double",
         {{"least", r.single.least() / r.step.least()}, {"median", r.single.median() / r.step.median()}}},
        {"product_over_step",
         {{"least", r.product.least() / r.step.least()}, {"median", r.product.median() / r.step.median()}}},
        {"bytes_a_cell",
         {{"step_touched", r.traffic.touched}, {"step_from_memory", r.traffic.memory}, {"block_product", r.product_bytes}}},
        {"GB_a_second",
         {{"step_touched", gigabytes_a_second(r.traffic.touched, r.step)},
          {"step_from_memory", gigabytes_a_second(r.traffic.memory, r.step)},
          {"block_product", gigabytes_a_second(r.product_bytes, r.product)},
          {"triad", 1e-9 * r.triad_bytes / r.triad.least()}}}};
}

void print(const nlohmann::json& r) {
    const auto number = [&](const char* pointer) { return r.at(nlohmann::json::json_pointer(pointer)).get<double>(); };
    fmt::print("{} cells, {:.1f} blocks a row, matrix {:.0f} MB, largest relative difference of the answers {:.1e}\n",
               r.at("cells").get<int>(), number("/blocks_a_row"), 1e-6 * number("/matrix_bytes"), number("/difference"));
    for (const char* name : {"step", "single_step", "stiffness_product", "general_form", "block_product", "eigen_product"})
        fmt::print("  {:<18} {:8.1f} ns per cell (median {:.1f})\n", name,
                   number(fmt::format("/ns_a_cell/{}/least", name).c_str()),
                   number(fmt::format("/ns_a_cell/{}/median", name).c_str()));
    fmt::print("  single step / step: {:.2f} (median {:.2f}); its forces differ by {:.1e} of the largest\n",
               number("/single_over_double/least"), number("/single_over_double/median"), number("/single_difference"));
    fmt::print("  block product / step: {:.2f} (median {:.2f})\n", number("/product_over_step/least"),
               number("/product_over_step/median"));
    fmt::print("  step: {:.0f} bytes a cell touched, {:.1f} GB/s; {:.0f} from memory, {:.1f} GB/s\n",
               number("/bytes_a_cell/step_touched"), number("/GB_a_second/step_touched"),
               number("/bytes_a_cell/step_from_memory"), number("/GB_a_second/step_from_memory"));
    fmt::print("  block product: {:.0f} bytes a cell, {:.1f} GB/s; triad {:.1f} GB/s\n",
               number("/bytes_a_cell/block_product"), number("/GB_a_second/block_product"), number("/GB_a_second/triad"));
}

/// Steps and products alone, checked against the form for cells of any shape.
template <int Dim>
nlohmann::json measure_shape(const mesh::Mesh<Dim>& mesh, double size, const Choices& choices) {
    solid::SolidOptions<Dim> options;
    options.materials = {material};
    solid::Solid<Dim> solid(mesh, options);
    solid::Ccg<Dim> general(mesh, options.materials, {}, {}, solid::CellForm::general);
    const std::vector<double> x = random_field(solid.size());
    std::vector<double> ours(x.size()), theirs(x.size());
    const auto multiply = [&] { solid.stiffness_product(x, ours); };
    const auto multiply_general = [&] {
        general.gradient(as_vectors<Dim>(std::span<const double>(x)), {}, {}, as_vectors<Dim>(std::span<double>(theirs)));
    };
    multiply();
    multiply_general();
    const double difference = relative_difference(ours, theirs);
    benchmark::require_small("stiffness product, against the form for any cells", difference, 1e-12);
    options.precision = solid::Precision::single_precision;
    solid::Solid<Dim> single(mesh, options);
    single_difference(single.ccg(), x);
    const std::vector<double> at_rest(x.size(), 0.0);
    dynamics::Memm<solid::Solid<Dim>> integrator(solid, at_rest, x, 0.01 * size), in_single(single, at_rest, x, 0.01 * size);
    const auto samples =
        benchmark::time_in_turn(choices.repetitions, benchmark::clock_for(choices.threads),
                                {[&] { integrator.step(); }, [&] { in_single.step(); }, multiply, multiply_general});
    nlohmann::json result{{"cells", mesh.n_cells()}, {"shape", choices.shape}, {"difference", difference}};
    fmt::print("{} {}, largest relative difference of the answers {:.1e}\n", mesh.n_cells(), choices.shape, difference);
    const std::array names{"step", "single_step", "stiffness_product", "general_form"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double least = 1e9 * samples[i].least() / mesh.n_cells(), median = 1e9 * samples[i].median() / mesh.n_cells();
        result["ns_a_cell"][names[i]] = {{"least", least}, {"median", median}};
        fmt::print("  {:<18} {:8.1f} ns per cell (median {:.1f})\n", names[i], least, median);
    }
    return result;
}

/// A translation and a rotation about the origin, of the size of 1.
template <int Dim>
std::vector<double> rigid_motion(const mesh::Mesh<Dim>& mesh) {
    std::vector<double> field;
    for (const Vector<Dim>& x : mesh.cell_centroid) {
        Vector<Dim> u = Vector<Dim>::Ones();
        u[0] -= x[1];
        u[1] += x[0];
        field.insert(field.end(), u.begin(), u.end());
    }
    return field;
}

/// Steps alone, beside the triad.
template <int Dim>
nlohmann::json measure_alone(const mesh::Mesh<Dim>& mesh, double size, const Choices& choices) {
    solid::SolidOptions<Dim> options;
    options.materials = {material};
    solid::Solid<Dim> solid(mesh, options);
    const std::vector<double> x = random_field(solid.size());
    std::vector<double> forces(x.size()), of_rigid(x.size());
    solid.stiffness_product(x, forces);
    solid.stiffness_product(rigid_motion(mesh), of_rigid);
    const double difference = largest(of_rigid) / largest(forces);
    benchmark::require_small("forces of a rigid motion, over those of a random one", difference, 1e-12);

    dynamics::Memm<solid::Solid<Dim>> integrator(solid, std::vector<double>(x.size(), 0.0), x, 0.01 * size);
    benchmark::Triad triad;
    const auto samples = benchmark::time_in_turn(choices.repetitions, benchmark::clock_for(choices.threads),
                                                 {[&] { integrator.step(); }, [&] { triad.run(); }});
    const double least = 1e9 * samples[0].least() / mesh.n_cells(), median = 1e9 * samples[0].median() / mesh.n_cells(),
                 gigabytes = 1e-9 * triad.bytes() / samples[1].least();
    fmt::print("{} {}, forces of a rigid motion {:.1e} of those of a random one\n", mesh.n_cells(), choices.shape,
               difference);
    fmt::print("  step {:.1f} ns per cell (median {:.1f}); triad {:.1f} GB/s\n", least, median, gigabytes);
    return {{"cells", mesh.n_cells()},
            {"shape", choices.shape},
            {"rigid_motion", difference},
            {"ns_a_cell", {{"step", {{"least", least}, {"median", median}}}}},
            {"GB_a_second", {{"triad", gigabytes}}}};
}

nlohmann::json measure_with_rivals(const mesh::Mesh<3>& mesh, double size, const Choices& choices) {
    nlohmann::json result = to_json(measure(mesh, size, choices));
    print(result);
    return result;
}

nlohmann::json measure_of_shape(double size, const Choices& choices) {
    const int n = static_cast<int>(std::lround(1.0 / size));
    const auto box = [&](mesh::CellShape shape) {
        return mesh::structured_box<3>({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {n, n, n}, shape);
    };
    const auto with_rivals = [&](const mesh::Mesh<3>& mesh) {
        return choices.alone ? measure_alone(mesh, size, choices) : measure_with_rivals(mesh, size, choices);
    };
    const auto without = [&](const auto& mesh) {
        return choices.alone ? measure_alone(mesh, size, choices) : measure_shape(mesh, size, choices);
    };
    if (choices.shape == "tetrahedra") return with_rivals(mesh::cylinder({.radius = 1.0, .length = 1.0, .size = size}));
    if (choices.shape == "boxed_tetrahedra") return with_rivals(box(mesh::CellShape::tetrahedron));
    if (choices.shape == "hexahedra") return without(box(mesh::CellShape::hexahedron));
    if (choices.shape == "squares")
        return without(mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {n, n}, mesh::CellShape::quadrangle));
    return without(mesh::disc({.radius = 1.0, .size = size}));
}

int run(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("Matrix-free bulk step against the product with the assembled matrix.");
    options.add("--size", choices.sizes, "edge lengths of the cells of a cylinder of radius and length 1 [m]");
    options.add("--repetitions", choices.repetitions, "rounds; the least and the median are shown").positive();
    options.add("--threads", choices.threads, "of the matrix-free step; the product has one").positive();
    options.add("--shape", choices.shape, "tetrahedra: with all rivals; others: steps and products alone")
        .one_of({"tetrahedra", "boxed_tetrahedra", "hexahedra", "triangles", "squares"});
    options.flag("--alone", choices.alone, "one set of operators and its steps alone, for large meshes");
    options.add("--json", choices.json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;

    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    nlohmann::json result = benchmark::circumstances(argc, argv);
    for (const double size : choices.sizes) result["results"].push_back(measure_of_shape(size, choices));
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run); }
