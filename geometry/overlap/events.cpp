#include <cmath>
#include <limits>

#include "abut/geometry/overlap/kernels.hpp"

namespace abut::geometry {
namespace {

// How far beyond the ends of an edge, in parts of its length, a crossing still counts: one event too many costs a
// little, one too few breaks the exactness of the quadrature.
constexpr double slack = 1e-9;

// tau of the zero of the linear function with the values `start` and `start + change`, if it lies in (0, 1).
void append_root(double start, double change, std::vector<double>& events) {
    if ((start < 0.0) == (start + change < 0.0) || start == 0.0) return;
    const double tau = -start / change;
    if (tau > 0.0 && tau < 1.0) events.push_back(tau);
}

// The vertices of one face move by `motion` past the fixed edges of the other.
// `offset` is added to the vertices first.
void append_vertex_edge_events(ProjectedFace<3> moving, ProjectedFace<3> fixed, const PlaneVector<3>& offset,
                               const PlaneVector<3>& motion, std::vector<double>& events) {
    for (std::size_t i = 0; i < fixed.size(); ++i) {
        const PlaneVector<3>& start = fixed[i];
        const PlaneVector<3> edge = fixed[i + 1 == fixed.size() ? 0 : i + 1] - start;
        const double change = cross(edge, motion);
        const double parallel = 4 * std::numeric_limits<double>::epsilon() * edge.cwiseAbs().sum() * motion.cwiseAbs().sum();
        if (std::abs(change) <= parallel) continue;
        for (const PlaneVector<3>& vertex : moving) {
            const PlaneVector<3> arm = (vertex - start) + offset;
            const double height = cross(edge, arm);
            if ((height < 0.0) == (height + change < 0.0)) continue;
            const double position = edge.dot(arm - height / change * motion);
            const double room = slack * edge.squaredNorm();
            if (position >= -room && position <= edge.squaredNorm() + room) append_root(height, change, events);
        }
    }
}

}  // namespace

template <>
void append_overlap_events<3>(ProjectedFace<3> face_1, ProjectedFace<3> face_2, const PlaneVector<3>& shift_0,
                              const PlaneVector<3>& shift_1, std::vector<double>& events) {
    const PlaneVector<3> motion = shift_1 - shift_0;
    append_vertex_edge_events(face_2, face_1, shift_0, motion, events);
    append_vertex_edge_events(face_1, face_2, -shift_0, -motion, events);
}

template <>
void append_overlap_events<2>(ProjectedFace<2> face_1, ProjectedFace<2> face_2, const PlaneVector<2>& shift_0,
                              const PlaneVector<2>& shift_1, std::vector<double>& events) {
    for (const PlaneVector<2>& end_1 : face_1)
        for (const PlaneVector<2>& end_2 : face_2)
            append_root((end_2.x() - end_1.x()) + shift_0.x(), shift_1.x() - shift_0.x(), events);
}

}  // namespace abut::geometry
