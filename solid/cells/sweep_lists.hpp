#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/simplices.hpp"

namespace abut::solid {

/// Elements [begin, end).
struct Run {
    std::int32_t begin, end;
};

/// A list for each chunk.
template <class T>
class OfChunks {
public:
    [[nodiscard]] std::span<const T> operator[](std::int32_t chunk) const {
        return std::span(items_).subspan(begin_[chunk], begin_[chunk + 1] - begin_[chunk]);
    }
    /// To the list of the chunk that is being made.
    void push_back(const T& item) { items_.push_back(item); }
    [[nodiscard]] std::size_t n_of_chunk() const { return items_.size() - begin_.back(); }
    [[nodiscard]] T& back() { return items_.back(); }
    void end_chunk() { begin_.push_back(items_.size()); }

private:
    std::vector<T> items_;
    std::vector<std::size_t> begin_ = {0};
};

/// The runs of `wanted` elements in [begin, end) become those of the next chunk.
template <class Wanted>
void append_runs(OfChunks<Run>& runs, std::int32_t begin, std::int32_t end, const Wanted& wanted) {
    for (std::int32_t i = begin; i < end; ++i) {
        if (!wanted(i)) continue;
        if (runs.n_of_chunk() > 0 && runs.back().end == i)
            runs.back().end = i + 1;
        else
            runs.push_back({i, i + 1});
    }
    runs.end_chunk();
}

/// body(i) for the elements of all runs.
template <class Body>
void for_runs(std::span<const Run> runs, const Body& body) {
    for (const Run& run : runs)
        for (std::int32_t i = run.begin; i < run.end; ++i) body(i);
}

/// Items that each sweep computes of each chunk. Faces are of the chunk that has their first side.
struct SweepLists {
    OfChunks<Run> loaded;                         // cells
    OfChunks<Run> reconstructed;                  // interior faces
    OfChunks<BoundaryFace> reconstructed_rows;    // faces with rows of R
    OfChunks<Run> displacement_gradients;         // cells
    OfChunks<CondensedCell> condensed_gradients;  // among them
    OfChunks<AffineCell> affine_traces;           // among them
    OfChunks<Run> stresses;                       // cells
    OfChunks<CondensedCell> condensed_stresses;   // among them
    OfChunks<AffineCell> affine_gradients;        // among them
    OfChunks<Run> face_gradients;                 // interior faces
    OfChunks<BoundaryFace> row_gradients;         // faces with rows of R
    OfChunks<Run> cell_gradients;                 // cells
    OfChunks<Run> boundary_cell_gradients;        // among them, positions in CcgArrays::boundary_cells
};

/// Which elements the sweeps compute.
struct WantedElements {
    std::vector<bool> loaded, displacement_gradients, stresses, cell_gradients;  // by cell
    std::vector<bool> reconstructed, face_gradients;                             // by face
};

}  // namespace abut::solid
