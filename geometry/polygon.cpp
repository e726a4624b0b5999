#include "abut/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::geometry {
namespace {

Vector<2> face_vector(FaceVertices<2> face) {
    const Vector<2> along = face[1] - face[0];
    return {along.y(), -along.x()};
}

// Newell: half the sum of the cross products, relative to the first vertex so that a distant origin costs no digits.
Vector<3> face_vector(FaceVertices<3> face) {
    Vector<3> twice = Vector<3>::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i) twice += (face[i] - face[0]).cross(face[i + 1] - face[0]);
    return 0.5 * twice;
}

template <int Dim>
Vector<Dim> mean_of(FaceVertices<Dim> face) {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const Vector<Dim>& vertex : face) sum += vertex - face[0];
    return face[0] + sum / static_cast<double>(face.size());
}

// Triangles about the mean of the vertices: a face that is not quite plane has its centroid in the middle of the warp.
Vector<3> centroid_of(FaceVertices<3> face) {
    const Vector<3> normal = face_normal<3>(face), mean = mean_of<3>(face);
    Vector<3> moment = Vector<3>::Zero();
    double area = 0.0;
    for (std::size_t i = 0; i < face.size(); ++i) {
        const Vector<3> a = face[i] - mean, b = face[(i + 1) % face.size()] - mean;
        const double part = 0.5 * normal.dot(a.cross(b));
        moment += part / 3.0 * (a + b);
        area += part;
    }
    return area > 0.0 ? Vector<3>(mean + moment / area) : mean;
}

bool lies_inside_every_edge(FaceVertices<3> face, const Vector<3>& normal, double tolerance) {
    for (std::size_t i = 0; i < face.size(); ++i) {
        const Vector<3> edge = face[(i + 1) % face.size()] - face[i];
        const Vector<3> inward = normal.cross(edge);
        const double allowed = -tolerance * inward.norm();
        if (std::any_of(face.begin(), face.end(),
                        [&](const Vector<3>& vertex) { return inward.dot(vertex - face[i]) < allowed; }))
            return false;
    }
    return true;
}

}  // namespace

template <int Dim>
double face_measure(FaceVertices<Dim> face) {
    return face_vector(face).norm();
}

template <>
Vector<2> face_centroid<2>(FaceVertices<2> face) {
    return mean_of<2>(face);
}

template <>
Vector<3> face_centroid<3>(FaceVertices<3> face) {
    return centroid_of(face);
}

template <int Dim>
double face_tolerance(const Vector<Dim>& centroid, double measure) {
    const double size = Dim == 2 ? measure : std::sqrt(measure);
    return 1e-10 + 16.0 * std::numeric_limits<double>::epsilon() * centroid.norm() / size;
}

template <int Dim>
Vector<Dim> face_normal(FaceVertices<Dim> face) {
    return face_vector(face).stableNormalized();
}

template <int Dim>
double planarity_deviation(FaceVertices<Dim> face) {
    const Vector<Dim> centroid = face_centroid<Dim>(face), normal = face_normal<Dim>(face);
    double largest = 0.0;
    for (const Vector<Dim>& vertex : face) largest = std::max(largest, std::abs(normal.dot(vertex - centroid)));
    return largest;
}

template <>
bool is_convex<2>(FaceVertices<2>, double) {
    return true;
}

template <>
bool is_convex<3>(FaceVertices<3> face, double tolerance) {
    return lies_inside_every_edge(face, face_normal<3>(face), tolerance);
}

template double face_measure<2>(FaceVertices<2>);
template double face_measure<3>(FaceVertices<3>);
template double face_tolerance<2>(const Vector<2>&, double);
template double face_tolerance<3>(const Vector<3>&, double);
template Vector<2> face_normal<2>(FaceVertices<2>);
template Vector<3> face_normal<3>(FaceVertices<3>);
template double planarity_deviation<2>(FaceVertices<2>);
template double planarity_deviation<3>(FaceVertices<3>);

}  // namespace abut::geometry
