#include "abut/base/error.hpp"
#include "abut/solid/ccg/device_kernels.hpp"

// Where Abut is built without Kokkos.

namespace abut::solid {
namespace {

[[noreturn]] void refuse_device() {
    throw BadInput(
        "this build of Abut has no Kokkos, which steps on a device need. Take StepDevice::host (--device host), or "
        "install the package libtrilinos-kokkos-dev (scripts/setup scripts/packages-devices.txt) and build it again.");
}

}  // namespace

std::string kokkos_device() { refuse_device(); }

template <int Dim>
struct DeviceKernels<Dim>::Impl {};

template <int Dim>
DeviceKernels<Dim>::DeviceKernels(const SweepTables<Dim, double>&) {
    refuse_device();
}

template <int Dim>
DeviceKernels<Dim>::~DeviceKernels() = default;

template <int Dim>
const SweepTables<Dim, double>& DeviceKernels<Dim>::staged() const {
    refuse_device();
}

template <int Dim>
std::span<const double> DeviceKernels<Dim>::gradient(Table<const double>, Table<const double>, bool, const Moments&) {
    refuse_device();
}

template <int Dim>
void DeviceKernels<Dim>::fetch_boundary_y(std::span<double>) const {
    refuse_device();
}

template <int Dim>
void DeviceKernels<Dim>::fetch_of_face(std::span<double>) const {
    refuse_device();
}

template <int Dim>
void DeviceKernels<Dim>::fetch_g(std::span<double>) const {
    refuse_device();
}

template class DeviceKernels<2>;
template class DeviceKernels<3>;

}  // namespace abut::solid
