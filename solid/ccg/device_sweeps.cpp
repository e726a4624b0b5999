#include "abut/solid/ccg/device_sweeps.hpp"

#include "abut/base/parallel.hpp"
#include "abut/solid/cells/simplex_elements.hpp"

namespace abut::solid {

template <int Dim>
DeviceSweeps<Dim>::DeviceSweeps(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite, const CcgSweeps<Dim>& sweeps)
    : arrays_(arrays), finite_(finite), kernels_(sweeps.tables()), element_(sweeps.tables(), {}) {
    SweepTables<Dim, double>& tables = element_.tables;
    boundary_y_.resize(static_cast<std::size_t>(tables.boundary_y.size));
    of_face_.resize(static_cast<std::size_t>(tables.of_face.size));
    g_.resize(static_cast<std::size_t>(tables.g.size));
    tables.u = kernels_.staged().u;
    tables.of_face = Table<double>(of_face_);
    tables.g = Table<double>(g_);
}

template <int Dim>
void DeviceSweeps<Dim>::gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                 const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    run([&](std::ptrdiff_t c) { return load_packed<Dim>(u[c]); }, load, corrections, result);
}

template <int Dim>
void DeviceSweeps<Dim>::mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load,
                                      const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    const auto midpoint = [&](std::ptrdiff_t c) {
        return 0.5 * (load_packed<Dim>(ends.start[c]) + load_packed<Dim>(ends.end[c]));
    };
    run(midpoint, load, corrections, result);
}

template <int Dim>
void DeviceSweeps<Dim>::gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load,
                                           const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    run([&](std::ptrdiff_t c) { return load_packed<Dim>(u, c); }, load, corrections, result);
}

/// load_cell(c): u_c.
template <int Dim>
template <class LoadCell>
void DeviceSweeps<Dim>::run(const LoadCell& load_cell, const BoundaryLoad<Dim>& load,
                            const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    const SweepTables<Dim, double>& staged = kernels_.staged();
    const PlacedCorrections<Dim, double> placed(arrays_, finite_, element_.units, staged, moments_, corrections);
    moment_cells_.clear();
    moment_stresses_.clear();
    moments_.for_each(0, arrays_.n_cells(), [&](std::int32_t c, const CellPush<Dim>& push) {
        moment_cells_.push_back(c);
        moment_stresses_.resize(moment_cells_.size() * Dim * Vectors::width);
        store_tensor(load_packed<Dim>(push.affine), moment_stresses_, std::ssize(moment_cells_) - 1);
    });
    parallel_each(arrays_.n_cells(), [&](std::ptrdiff_t c) { store(load_cell(c), staged.u.data, c); });
    const auto gradient = kernels_.gradient(plain<double>(load.displacement), plain<double>(load.traction),
                                            !corrections.faces.empty(), {moment_cells_, moment_stresses_});
    parallel_each(arrays_.n_cells(), [&](std::ptrdiff_t c) { result[c] = Vector<Dim>(gradient.data() + Dim * c); });
    has_boundary_y_ = has_state_ = false;
}

template <int Dim>
Vector<Dim> DeviceSweeps<Dim>::face_gradient(BoundaryFace b) {
    if (!has_boundary_y_) kernels_.fetch_boundary_y(boundary_y_);
    has_boundary_y_ = true;
    return unload<Dim>(load_packed<Dim>(boundary_y_, number_of(b)));
}

template <int Dim>
LaneTensor<Dim> DeviceSweeps<Dim>::present_gradient(std::int32_t c) {
    if (!has_state_) {
        kernels_.fetch_of_face(of_face_);
        kernels_.fetch_g(g_);
    }
    has_state_ = true;
    return element_.present_gradient(c);
}

template <int Dim>
Matrix<Dim> DeviceSweeps<Dim>::displacement_gradient(std::int32_t c) {
    return unload(present_gradient(c));
}

template <int Dim>
Matrix<Dim> DeviceSweeps<Dim>::stress(std::int32_t c) {
    return unload(elastic_stress(arrays_.cells[c], present_gradient(c)));
}

template class DeviceSweeps<2>;
template class DeviceSweeps<3>;

}  // namespace abut::solid
