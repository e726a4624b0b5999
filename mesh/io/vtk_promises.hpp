#pragma once
// Private to the layer; not installed.
#include <string>
#include <string_view>

namespace abut::mesh {

/// VTK makes room for all that the attributes of a .vtu or .vtp file promise before it reads a value. This looks at them
/// first: numbers of points, cells, components and tuples, what the offsets of a text file add up to, and the sizes that
/// stand before binary values. Throws MeshError with the line if one of them is more than a file of that size can hold:
/// - a value takes 2 bytes as text and those of its type in binary;
/// - compression can shrink that, at most by the ratio that its method can reach (see `compression_ratio`).
/// Values in text must be numbers and as many as promised. Binary values are not looked at, offsets among them; what VTK then
/// makes of them, it says itself.
void check_vtk_promises(const std::string& name, std::string_view contents);

}  // namespace abut::mesh
