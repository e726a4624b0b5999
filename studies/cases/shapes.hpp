#pragma once
#include <array>
#include <functional>
#include <string>

#include "abut/mesh/mesh.hpp"

/// Bodies that several studies are made of.
namespace abut::studies {

/// The same cells with their vertices elsewhere; groups are dropped. Throws MeshError where a cell is turned inside out.
template <int Dim>
[[nodiscard]] mesh::Mesh<Dim> mapped(const mesh::Mesh<Dim>& mesh, const std::string& name,
                                     const std::function<Vector<Dim>(const Vector<Dim>&)>& map);

/// A box of simplices about `centre`, turned.
template <int Dim>
struct TurnedBox {
    Vector<Dim> centre = Vector<Dim>::Zero();
    Vector<Dim> sides = Vector<Dim>::Ones();
    std::array<int, Dim> cells{};  ///< along each side
    Matrix<Dim> turn = Matrix<Dim>::Identity();
    std::string name = "block";
};
template <int Dim>
[[nodiscard]] mesh::Mesh<Dim> turned_box(const TurnedBox<Dim>& box);

/// By this angle [rad], counter-clockwise.
[[nodiscard]] Matrix<2> rotation(double angle);

/// A beam of length 2 along `axis`, with its lower or upper edge at the height of `middle`; its section is a rhombus of side
/// 0.5 with this angle [rad] above and below. All lengths times `unit`.
[[nodiscard]] mesh::Mesh<3> beam(const Vector<3>& axis, const Vector<3>& middle, double angle, bool is_upper,
                                 mesh::CellShape shape, double unit = 1.0);

}  // namespace abut::studies
