#pragma once
// Private to the C layer.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "abut/contact/surface/nodal_surface.hpp"
#include "guarded.hpp"

namespace abut::c_layer {

template <int Dim>
PointsView<Dim> view_of(const abut_array& array, const char* name) {
    const std::int32_t count = checked_count(array.count, name);
    if (count > 0) check_pointer(array.data, name);
    return {array.data, count, static_cast<std::ptrdiff_t>(array.item), static_cast<std::ptrdiff_t>(array.component)};
}

template <class T>
std::span<const T> span_of(const T* data, std::int64_t n, const char* name) {
    const std::int32_t count = checked_count(n, name);
    if (count > 0) check_pointer(data, name);
    return {data, static_cast<std::size_t>(count)};
}

/// A copy that counts from 0.
inline std::vector<std::int32_t> from_zero(std::span<const std::int32_t> values, std::int32_t index_base) {
    std::vector<std::int32_t> copy(values.begin(), values.end());
    for (std::int32_t& value : copy)
        value = value < std::numeric_limits<std::int32_t>::min() + index_base ? value : value - index_base;
    return copy;
}

/// Faces of a host, counted from 0.
template <int Dim>
contact::NodalSurface<Dim> surface_of(const abut_array& rest, const abut_faces& faces) {
    if (faces.index_base != 0 && faces.index_base != 1)
        throw BadInput("abut_faces: index_base is " + std::to_string(faces.index_base) + "; 0 and 1 are allowed.");
    const auto nodes = from_zero(span_of(faces.nodes, faces.n_nodes, "abut_faces.nodes"), faces.index_base);
    const auto body = from_zero(span_of(faces.body, faces.n_faces, "abut_faces.body"), faces.index_base);
    std::vector<std::int32_t> offsets;
    if (faces.offsets != nullptr)
        offsets = from_zero(span_of(faces.offsets, faces.n_faces + 1, "abut_faces.offsets"), faces.index_base);
    return {view_of<Dim>(rest, "rest"),
            {.nodes = nodes,
             .offsets = offsets,
             .body = body,
             .depth = span_of(faces.depth, faces.n_faces, "abut_faces.depth"),
             .stiffness = span_of(faces.stiffness, faces.n_bodies, "abut_faces.stiffness"),
             .shear_stiffness = faces.shear_stiffness == nullptr ? std::span<const double>()
                                                                 : span_of(faces.shear_stiffness, faces.n_bodies, "")}};
}

inline void check_dim(std::int32_t dim) {
    if (dim != 2 && dim != 3) throw BadInput("dim is " + std::to_string(dim) + "; 2 and 3 are allowed.");
}

template <int Dim>
inline void copy_vector(const Vector<Dim>& from, double (&to)[3]) {
    to[2] = 0.0;
    for (int d = 0; d < Dim; ++d) to[d] = from[d];
}
inline void copy_moment(const AxialVector<2>& from, double (&to)[3]) { to[0] = to[1] = 0.0, to[2] = from[0]; }
inline void copy_moment(const AxialVector<3>& from, double (&to)[3]) { copy_vector<3>(from, to); }

/// Writes the number of entries, and as many of them as there is room for.
template <class Entry, class Value, class Convert>
inline void copy_entries(const std::vector<Value>& values, Entry* entries, std::size_t entry_size, std::int64_t capacity,
                         std::int64_t* n, const Convert& convert) {
    check_pointer(n, "n");
    if (entry_size != sizeof(Entry))
        throw Misuse("entry_size is " + std::to_string(entry_size) + ", that of this library is " +
                     std::to_string(sizeof(Entry)) + ". Compile against the header of this version.");
    if (capacity > 0) check_pointer(entries, "the array of entries");
    *n = static_cast<std::int64_t>(values.size());
    for (std::int64_t i = 0; i < std::min(capacity, *n); ++i) entries[i] = convert(values[static_cast<std::size_t>(i)]);
}

}  // namespace abut::c_layer
