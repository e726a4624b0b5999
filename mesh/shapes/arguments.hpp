#pragma once
// Private to the sources of this layer.
#include <string>

#include "abut/base/vector.hpp"

/// Checks of arguments of shapes. Each throws MeshError naming the argument, its value and what is needed.
namespace abut::mesh {

void require_length(const std::string& name, const char* argument, double value);
void require_length_or_zero(const std::string& name, const char* argument, double value);
void require_less(const std::string& name, const char* small, double less, const char* large, double more);
void require_count(const std::string& name, const char* argument, int value, int least);
void require_axis(const std::string& name, int axis);
template <int Dim>
void require_finite(const std::string& name, const char* argument, const Vector<Dim>& value);
void require_size(const std::string& name, double n_faces);

}  // namespace abut::mesh
