#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/run/files/picture_marks.hpp"
#include "abut/run/values/forward.hpp"

namespace abut::run {

/// Bodies of a run at one time, as pictures show them.
struct Snapshot {
    using Position = std::array<double, 3>;  ///< in 2D the third is 0 [m]

    std::string what;                ///< "At the start", for its caption
    double time = 0.0;               ///< [s]
    double force = 0.0;              ///< of all contacts along their normals, the mean since the look before [N]
    std::vector<Position> position;  ///< of the vertices of BodyPolygons
    std::vector<double> value;       ///< by polygon; NaN: none, as of a rigid body
    std::vector<std::vector<Position>>
        obstacles;  ///< their faces; in 2D the outside is on the right of a segment, in 3D seen counter-clockwise

    static auto fields(auto& self) {
        return std::tie(self.what, self.time, self.force, self.position, self.value, self.obstacles);
    }
};

/// Style in which an edge of a polygon is drawn.
enum class Edge : std::int8_t {
    inner,   ///< between cells
    rim,     ///< a boundary face in 2D
    held,    ///< of a face whose displacement is prescribed, in part at least
    loaded,  ///< of a face under a traction
};

/// Polygons drawn of the bodies of a run: in 2D their cells, in 3D their boundary faces, and of bodies that cells may leave
/// all faces. Where one is not there it has no positions (NaN) and no value.
struct BodyPolygons {
    bool in_space = false;   ///< 3D
    std::string value_name;  ///< "von Mises stress"
    std::string value_unit;
    double least_end = 0.0;               ///< of the scale of colours: values far below it are rounding
    std::vector<std::int32_t> vertex;     ///< of the scene's mesh, of each position of a snapshot
    std::vector<std::size_t> offsets{0};  ///< of the corners of polygon i: offsets[i] to offsets[i + 1]
    std::vector<std::int32_t> corners;    ///< numbers of positions
    std::vector<Edge> edges;              ///< from a corner to the next one of its polygon; as many as `corners`
    std::vector<std::int32_t> cell;       ///< whose value a polygon has
    std::vector<std::int32_t> body;       ///< of a polygon; empty: all of one
    std::vector<std::string> body_names;
    PictureMarks marks;
};

/// Takes snapshots of the bodies of a scene: von Mises stress, or the speed where all bodies are rigid.
template <int Dim>
class SnapshotMaker {
public:
    /// The scene must outlive it.
    SnapshotMaker(const Scene<Dim>& scene, const RunResult<Dim>& result);

    [[nodiscard]] const BodyPolygons& polygons() const { return polygons_; }
    /// Goes on with the rest of the scene's mesh, once cells have left; `first_cells`: the numbers of its cells there.
    void take_cells(const mesh::Mesh<Dim>& left, std::span<const std::int32_t> first_cells);
    /// Snapshot of what is seen. Its cost is proportional to the cells.
    [[nodiscard]] Snapshot taken(std::string what, const Sight<Dim>& sight) const;

private:
    [[nodiscard]] std::vector<double> values(const Sight<Dim>& sight) const;
    /// Present number of the cell that a polygon shows; -1: it is not to be seen.
    [[nodiscard]] std::int32_t shown_cell(std::size_t polygon) const;

    const Scene<Dim>& scene_;
    BodyPolygons polygons_;
    std::vector<std::int32_t> face_;        // of the scene's mesh, by polygon; in 2D none
    std::vector<std::int32_t> owner_;       // by position: the polygon that it is of alone; -1: several share it
    std::vector<std::int32_t> cell_now_;    // by cell of the scene's mesh: its number now; -1: it has left
    std::vector<std::int32_t> vertex_now_;  // the same of vertices
    std::vector<char> is_rigid_;            // by body
    bool all_rigid_ = false;
};

/// Above all but the highest two hundredths of some values; those that are not finite do not count. 0 where there are none.
[[nodiscard]] double upper_end(const std::vector<double>& values);

/// With 0 for what a plane does not have.
template <int Dim>
[[nodiscard]] Snapshot::Position in_space(const Vector<Dim>& x) {
    Snapshot::Position result{};
    for (int i = 0; i < Dim; ++i) result[static_cast<std::size_t>(i)] = x[i];
    return result;
}

}  // namespace abut::run
