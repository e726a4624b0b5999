#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/run/forward.hpp"

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
};

/// What is drawn of the bodies of a run: in 2D their cells, in 3D their boundary faces.
struct BodyPolygons {
    bool in_space = false;   ///< 3D
    std::string value_name;  ///< "von Mises stress"
    std::string value_unit;
    double least_end = 0.0;               ///< of the scale of colours: values far below it are rounding
    std::vector<std::int32_t> vertex;     ///< of the mesh, of each position of a snapshot
    std::vector<std::size_t> offsets{0};  ///< of the corners of polygon i: offsets[i] to offsets[i + 1]
    std::vector<std::int32_t> corners;    ///< numbers of positions
    std::vector<char> is_rim;             ///< whether the edge from a corner to the next is one of the boundary; 2D
    std::vector<std::int32_t> cell;       ///< whose value a polygon has
};

/// Pictures of the bodies in a report: the snapshots that were taken, in order of time.
struct BodyPictures {
    BodyPolygons polygons;
    std::vector<Snapshot> snapshots;
};

/// Takes snapshots of a run: at the start, near the largest force of contact and at the end. For the second the forces of
/// contact are looked at in about 60 records, and a snapshot replaces the one before where they are larger by a twentieth. What it
/// keeps and does is proportional to the cells in 2D, to the boundary in 3D, and evaluations of the solid; between snapshots
/// it does nothing.
template <int Dim>
class Snapshots {
public:
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result);
    void record(const dynamics::LedgerEntry<Dim>& entry);
    [[nodiscard]] bool wants_look(std::int64_t step) const;
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid);
    /// The last state, evaluated.
    void end(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid);
    /// The last sound state of a run that has failed, which this evaluates, stands for the end.
    void fail(const Failure& failure, solid::Solid<Dim>& solid);
    void save(StateWriter& state) const;
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state);

    /// Those taken so far.
    [[nodiscard]] BodyPictures pictures() const;

private:
    [[nodiscard]] Snapshot taken(std::string what, const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) const;
    [[nodiscard]] std::vector<double> values(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) const;

    BodyPolygons polygons_;
    std::vector<char> is_rigid_;  // by body
    bool all_rigid_ = false;
    std::int64_t every_ = 1;  // steps between looks at forces
    bool in_contact_ = false;
    double last_impulse_ = 0.0;  // of all contacts [N s], at the last look
    double last_time_ = 0.0;
    std::optional<Snapshot> start_, largest_, end_;
};

}  // namespace abut::run
