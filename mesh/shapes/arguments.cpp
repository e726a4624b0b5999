#include "abut/mesh/shapes/arguments.hpp"

#include <cmath>

#include "abut/base/messages.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"

namespace abut::mesh {

void require_length(const std::string& name, const char* argument, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
        throw MeshError(name + ": " + argument + " is " + number(value) +
                        " m, a finite length above 0 is needed. Change the argument.");
}

void require_length_or_zero(const std::string& name, const char* argument, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
        throw MeshError(name + ": " + argument + " is " + number(value) +
                        " m, a finite length of 0 or more is needed. Change the argument.");
}

void require_less(const std::string& name, const char* small, double less, const char* large, double more) {
    if (!(less < more))
        throw MeshError(name + ": " + small + " is " + number(less) + " m, less than " + large + ", " + number(more) +
                        " m, is needed. Change the argument.");
}

void require_count(const std::string& name, const char* argument, int value, int least) {
    if (value < least)
        throw MeshError(name + ": " + argument + " is " + std::to_string(value) + ", at least " + std::to_string(least) +
                        " is needed. Change the argument.");
}

void require_axis(const std::string& name, int axis) {
    if (axis < 0 || axis > 2)
        throw MeshError(name + ": axis is " + std::to_string(axis) + ", 0, 1 or 2 is needed. Change the argument.");
}

template <int Dim>
void require_finite(const std::string& name, const char* argument, const Vector<Dim>& value) {
    for (int i = 0; i < Dim; ++i)
        if (!std::isfinite(value[i]))
            throw MeshError(name + ": the " + "xyz"[i] + " coordinate of " + argument + " is " + number(value[i]) +
                            ", a finite number is needed. Change the argument.");
}
template void require_finite<2>(const std::string&, const char*, const Vector<2>&);
template void require_finite<3>(const std::string&, const char*, const Vector<3>&);

void require_size(const std::string& name, double n_faces) {
    if (!(n_faces <= max_surface_faces))
        throw MeshError(name + ": has " + number(n_faces) + " triangles, at most " + std::to_string(max_surface_faces) +
                        " are allowed. Lower the counts.");
}

}  // namespace abut::mesh
