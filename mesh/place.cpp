#include "abut/mesh/place.hpp"

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::mesh {
namespace {

constexpr double rotation_tolerance = 1e-12;

template <int Dim>
void require_rotation(const Mesh<Dim>& mesh, const Matrix<Dim>& turn, const Vector<Dim>& offset) {
    const double off = (turn * turn.transpose() - Matrix<Dim>::Identity()).cwiseAbs().maxCoeff();
    if (!(off <= rotation_tolerance) || !(turn.determinant() > 0.0))
        throw BadInput(mesh.name + ": the turn of a mesh is no rotation, it is off by " + number(off) +
                       "; 1e-12 is allowed.");
    if (!offset.allFinite()) throw BadInput(mesh.name + ": the offset of a mesh is not finite. Give numbers.");
}

}  // namespace

template <int Dim>
void place(Mesh<Dim>& mesh, const Matrix<Dim>& turn, const Vector<Dim>& offset) {
    require_rotation(mesh, turn, offset);
    const auto move = [&](std::vector<Vector<Dim>>& points) {
        for (Vector<Dim>& x : points) x = Vector<Dim>(turn * x + offset);
    };
    move(mesh.vertices);
    move(mesh.cell_centroid);
    move(mesh.face_centroid);
    for (Vector<Dim>& normal : mesh.face_normal) normal = Vector<Dim>(turn * normal).normalized();
}

template void place<2>(Mesh<2>&, const Matrix<2>&, const Vector<2>&);
template void place<3>(Mesh<3>&, const Matrix<3>&, const Vector<3>&);

}  // namespace abut::mesh
