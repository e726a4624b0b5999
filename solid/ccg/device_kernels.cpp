#include "abut/solid/ccg/device_kernels.hpp"

#include <Kokkos_Core.hpp>

#include <cstddef>
#include <exception>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/solid/cells/simplex_elements.hpp"
#include "abut/solid/operator/components.hpp"

// The only source that sees Kokkos; compiled by the compiler that Kokkos was built with. From Kokkos 3.4 on.

namespace abut::solid {
namespace device {

using Execution = Kokkos::DefaultExecutionSpace;
using Memory = Execution::memory_space;
#ifdef KOKKOS_HAS_SHARED_HOST_PINNED_SPACE
using Staging = Kokkos::SharedHostPinnedSpace;
#else
using Staging = Kokkos::HostSpace;
#endif
using Range = Kokkos::RangePolicy<Execution, Kokkos::IndexType<std::int32_t>>;

template <class T, class Space>
using Array = Kokkos::View<T*, Space>;
/// Memory of somebody else on the host.
template <class T>
using HostArray = Kokkos::View<T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

/// Runtime of the process; left alone where the program has set Kokkos up itself.
class Runtime {
public:
    static void need() { static const Runtime runtime; }
    Runtime(const Runtime&) = delete;
    Runtime& operator=(const Runtime&) = delete;

private:
    Runtime() {
        if (Kokkos::is_initialized()) return;
#ifdef KOKKOS_ENABLE_CUDA
        // Kokkos itself ends the program where there is none; of its other devices nobody has tried what they do.
        int n_devices = 0;
        if (const cudaError_t error = cudaGetDeviceCount(&n_devices); error != cudaSuccess || n_devices == 0)
            throw BadInput(std::string("this machine has no device for Kokkos, which was built for ") + Execution::name() +
                           " (" + cudaGetErrorString(error) + "). Take StepDevice::host (--device host).");
#endif
        Kokkos::initialize();
        is_ours_ = true;
    }
    ~Runtime() {
        if (is_ours_) Kokkos::finalize();
    }

    bool is_ours_ = false;
};

/// Arrays on the device.
class Arrays {
public:
    template <class T>
    [[nodiscard]] Table<T> zeros(std::ptrdiff_t n) {
        const auto bytes = static_cast<std::size_t>(n) * sizeof(T);
        blocks_.emplace_back("abut", bytes);
        return {reinterpret_cast<T*>(blocks_.back().data()), n};
    }
    template <class T>
    void copy(Table<const T>& table) {
        const auto bytes = static_cast<std::size_t>(table.size) * sizeof(T);
        const HostArray<const std::byte> from(reinterpret_cast<const std::byte*>(table.data), bytes);
        table = zeros<const T>(table.size);
        Kokkos::deep_copy(blocks_.back(), from);
    }

private:
    std::vector<Array<std::byte, Memory>> blocks_;
};

/// An array with its copy on the device, both for as long as its tables are used.
struct Staged {
    Array<double, Memory> on_device;
    Array<double, Staging> on_host;

    Staged() = default;
    Staged(const std::string& name, std::ptrdiff_t n)
        : on_device(name, static_cast<std::size_t>(n)), on_host(name, static_cast<std::size_t>(n)) {}

    void send(const Execution& execution) const { Kokkos::deep_copy(execution, on_device, on_host); }
    [[nodiscard]] Table<double> table() const { return {on_device.data(), static_cast<std::ptrdiff_t>(on_device.size())}; }
    [[nodiscard]] Table<double> host_table() const { return {on_host.data(), static_cast<std::ptrdiff_t>(on_host.size())}; }
};

/// body(i) for i from 0 to before n. Bodies are handed over as arguments of the kernel: "light weight" tells Kokkos so,
/// which would go by way of memory for constants, and wait for it.
template <class Body>
void for_each(const Execution& execution, std::ptrdiff_t n, const char* name, const Body& body) {
    using Kokkos::Experimental::WorkItemProperty;
    if (n > 0)
        Kokkos::parallel_for(name,
                             Kokkos::Experimental::require(Range(execution, 0, static_cast<std::int32_t>(n)),
                                                           WorkItemProperty::HintLightWeight),
                             body);
}

template <class V>
void reconstruct(const Execution& execution, const SweepElements<V>& element) {
    for_each(
        execution, element.tables.faces.size, "reconstruct", KOKKOS_LAMBDA(std::int32_t f) {
            const auto& t = element.tables;
            if (t.boundary_index[f] == no_face) store(element.reconstructed(t.u.data, f), t.of_face.data, f);
        });
    for_each(
        execution, element.tables.row_faces.size, "reconstruct rows", KOKKOS_LAMBDA(std::int32_t i) {
            const auto& t = element.tables;
            const BoundaryFace b = t.row_faces[i];
            store(element.reconstructed_row(t.u.data, b), t.of_face.data, t.face_of(b));
        });
}

template <class V>
void set_stresses(const Execution& execution, const SweepElements<V>& element, Table<const std::int32_t> moment_cells,
                  Table<const double> moments) {
    for_each(
        execution, element.tables.cells.size, "displacement gradients",
        KOKKOS_LAMBDA(std::int32_t c) { element.set_any_displacement_gradient(c); });
    for_each(
        execution, element.tables.affine_cells.size, "affine traces",
        KOKKOS_LAMBDA(std::int32_t i) { element.set_any_affine_traces(element.tables.affine_cells[i]); });
    for_each(
        execution, element.tables.cells.size, "stresses", KOKKOS_LAMBDA(std::int32_t c) { element.set_any_stress(c); });
    for_each(
        execution, moment_cells.size, "moments", KOKKOS_LAMBDA(std::int32_t i) {
            double* const s = element.tables.s.data;
            TensorOf<V> sum = load_tensor<V>(s, moment_cells[i]);
            const TensorOf<V> added = load_tensor<V>(moments.data, i);
            for (int j = 0; j < V::dim; ++j) sum.col[j] += added.col[j];
            store_tensor(sum, s, moment_cells[i]);
        });
    for_each(
        execution, element.tables.condensed.size, "condense",
        KOKKOS_LAMBDA(std::int32_t i) { element.condense(element.tables.condensed[i]); });
}

template <class V>
void set_gradients(const Execution& execution, const SweepElements<V>& element, double* result) {
    for_each(
        execution, element.tables.faces.size, "face gradients", KOKKOS_LAMBDA(std::int32_t f) {
            if (element.tables.boundary_index[f] == no_face) element.set_any_face_gradient(f);
        });
    for_each(
        execution, element.tables.row_faces.size, "row gradients", KOKKOS_LAMBDA(std::int32_t i) {
            const BoundaryFace b = element.tables.row_faces[i];
            store(element.boundary_gradient(b), element.tables.boundary_y.data, number_of(b));
        });
    for_each(
        execution, element.tables.cells.size, "cell gradients", KOKKOS_LAMBDA(std::int32_t c) {
            V sum = element.cell_gradient(c);
            if (const std::int32_t position = element.tables.boundary_cell_position[c]; position >= 0)
                sum += element.boundary_cell_gradient(position);
            for (int j = 0; j < V::dim; ++j) result[V::dim * c + j] = sum[j];
        });
}

}  // namespace device

std::string kokkos_device() { return device::Execution::name(); }

template <int Dim>
struct DeviceKernels<Dim>::Impl {
    using Vectors = Components<Dim>;

    device::Execution execution;
    device::Arrays arrays;
    device::Staged u, correction, pair_gradient, load_displacement, traction, gradient;
    SweepTables<Dim, double> staged;  // on the host
    SweepElements<Vectors> element;   // on the device
    bool corrected = false;           // the last call had corrections

    explicit Impl(const SweepTables<Dim, double>& host)
        : u("u", host.u.size),
          correction("correction", host.correction.size),
          pair_gradient("pair_gradient", host.pair_gradient.size),
          load_displacement("load_displacement", Dim * host.boundary_faces.size),
          traction("traction", Dim * host.boundary_faces.size),
          gradient("gradient", Dim * host.cells.size) {
        staged.u = u.host_table();
        staged.correction = correction.host_table();
        staged.pair_gradient = pair_gradient.host_table();
        SweepTables<Dim, double> tables = host;
        for_each_fixed_table(tables, [&](auto& table) { arrays.copy(table); });
        tables.u = u.table();
        tables.correction = correction.table();
        tables.pair_gradient = pair_gradient.table();
        for (Table<double>* work : {&tables.of_face, &tables.g, &tables.trace, &tables.s, &tables.deviation, &tables.direct,
                                    &tables.boundary_y, &tables.affine_y})
            *work = arrays.template zeros<double>(work->size);
        tables.load_displacement = tables.traction = {};
        element = {tables, {}};
    }

    /// Empty where nothing is given.
    [[nodiscard]] Table<const double> send_load(const device::Staged& to, Table<const double> given) const {
        if (given.size == 0) return {};
        std::copy(given.data, given.data + given.size, to.on_host.data());
        to.send(execution);
        return {to.on_device.data(), given.size};
    }

    void fetch(const Table<double>& table, std::span<double> into) const {
        const Kokkos::View<const double*, device::Memory, Kokkos::MemoryTraits<Kokkos::Unmanaged>> from(table.data,
                                                                                                        into.size());
        Kokkos::deep_copy(device::HostArray<double>(into.data(), into.size()), from);
    }
};

template <int Dim>
DeviceKernels<Dim>::DeviceKernels(const SweepTables<Dim, double>& host) {
    device::Runtime::need();
    try {
        impl_ = std::make_unique<Impl>(host);
    } catch (const std::exception& error) {
        throw LimitExceeded(std::string("the device of Kokkos (") + device::Execution::name() + ") has no room for " +
                            std::to_string(host.cells.size) +
                            " cells: take StepDevice::host (--device host) or a coarser mesh. Kokkos says: " + error.what());
    }
}

template <int Dim>
DeviceKernels<Dim>::~DeviceKernels() = default;

template <int Dim>
const SweepTables<Dim, double>& DeviceKernels<Dim>::staged() const {
    return impl_->staged;
}

template <int Dim>
std::span<const double> DeviceKernels<Dim>::gradient(Table<const double> load_displacement, Table<const double> traction,
                                                     bool with_corrections, const Moments& moments) {
    Impl& m = *impl_;
    m.u.send(m.execution);
    if (with_corrections || m.corrected) {
        m.correction.send(m.execution);
        m.pair_gradient.send(m.execution);
    }
    m.corrected = with_corrections;
    m.element.tables.load_displacement = m.send_load(m.load_displacement, load_displacement);
    m.element.tables.traction = m.send_load(m.traction, traction);

    device::Arrays for_moments;
    Table<const std::int32_t> cells(moments.cells.data(), std::ssize(moments.cells));
    Table<const double> stresses(moments.stresses.data(), std::ssize(moments.stresses));
    if (cells.size > 0) {
        for_moments.copy(cells);
        for_moments.copy(stresses);
    }
    device::reconstruct(m.execution, m.element);
    device::set_stresses(m.execution, m.element, cells, stresses);
    device::set_gradients(m.execution, m.element, m.gradient.on_device.data());
    Kokkos::deep_copy(m.execution, m.gradient.on_host, m.gradient.on_device);
    m.execution.fence();
    return {m.gradient.on_host.data(), m.gradient.on_host.size()};
}

template <int Dim>
void DeviceKernels<Dim>::fetch_boundary_y(std::span<double> into) const {
    impl_->fetch(impl_->element.tables.boundary_y, into);
}

template <int Dim>
void DeviceKernels<Dim>::fetch_of_face(std::span<double> into) const {
    impl_->fetch(impl_->element.tables.of_face, into);
}

template <int Dim>
void DeviceKernels<Dim>::fetch_g(std::span<double> into) const {
    impl_->fetch(impl_->element.tables.g, into);
}

template class DeviceKernels<2>;
template class DeviceKernels<3>;

}  // namespace abut::solid
