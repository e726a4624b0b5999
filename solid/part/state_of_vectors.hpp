#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/base/vector.hpp"

namespace abut::solid {

template <int Dim>
void put_all(StateWriter& state, const std::vector<Vector<Dim>>& vectors) {
    state.put_all(std::span<const double>(vectors.empty() ? nullptr : vectors.data()->data(), vectors.size() * Dim));
}
/// As many as there are. Throws BadInput for another number.
template <int Dim>
void take_all(StateReader& state, std::vector<Vector<Dim>>& vectors) {
    const std::vector<double> values = state.get_all<double>();
    if (values.size() != vectors.size() * Dim)
        throw BadInput("state of a solid: it has " + std::to_string(values.size()) + " values of loads, " +
                       std::to_string(vectors.size() * Dim) + " are needed. It is of another solid.");
    for (std::size_t i = 0; i < vectors.size(); ++i)
        for (int k = 0; k < Dim; ++k) vectors[i][k] = values[Dim * i + k];
}

}  // namespace abut::solid
