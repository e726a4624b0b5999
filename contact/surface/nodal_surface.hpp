#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/strided_points.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// The faces of a host whose surfaces are made of nodes, as it has them; read once.
template <int Dim>
struct NodalFaces {
    /// Corners of all faces, one face after the other: two, with the outside on the right of the line from the first to the
    /// second (2D); three or four, counter-clockwise seen from outside (3D)
    std::span<const std::int32_t> nodes;
    std::span<const std::int32_t> offsets;  ///< (n_faces + 1), into `nodes`; empty: every face has Dim corners
    std::span<const std::int32_t> body;     ///< (n_faces), from 0 on; those of one body touch if `self_contact` is on
    /// (n_faces) [m]: half the height of the element behind the face, and 0 for a rigid face. A contact is admitted as deep
    /// as both faces together
    std::span<const double> depth;
    /// (n_bodies) k [Pa/m]: `skin_stiffness` of a deformable body, infinity of a rigid one. Contact is the spring of the
    /// half elements behind both faces in series, no penalty: a larger k costs time steps and gains nothing
    std::span<const double> stiffness;
    /// (n_faces) k [Pa/m] of each face, for hosts whose faces give way by sigma/k each by itself, as cell-centred
    /// solids; that of its body then bounds it, or infinity of one that the host holds or moves on a path. Empty: that
    /// of its body. Not read for rigid bodies
    std::span<const double> face_stiffness = {};
    /// (n_bodies) [Pa/m], needed with friction alone, else empty: mu/(lambda + 2 mu) of `stiffness`, with the shear
    /// modulus mu; infinity of a rigid body. Faces that stick hold each other by it, with the depth that `stiffness`
    /// has
    std::span<const double> shear_stiffness = {};
    /// (n_faces) the same of `face_stiffness`; needed with friction where that is given
    std::span<const double> face_shear_stiffness = {};
};

/// One k for a whole body [Pa/m]: (lambda + 2 mu) over the mean of the given depths of its faces. A k for each face fails
/// the patch test where depths vary. On graded meshes give the depths of the faces that will touch alone: with those of all
/// faces, six times deeper far from the contact, the skin is too soft, and the pressure of Hertz off by 13 %
/// (docs/turning.md). docs/method.md, The potential of a pair. Throws BadInput for a modulus or a sum of depths that is not
/// finite and > 0.
[[nodiscard]] double skin_stiffness(double p_wave_modulus, std::span<const double> depth);

/// k of two springs one behind the other [Pa/m]; infinity is that of a rigid body.
[[nodiscard]] double series_stiffness(double k_1, double k_2);

template <int Dim>
struct Bevels;

/// The boundary of a host's bodies, for laws of contact on nodes: flat facets between nodes. A face with four corners is cut
/// in two along its shorter diagonal, or along that which lies inside it.
template <int Dim>
class NodalSurface {
public:
    /// `rest`: all nodes of the host at rest (n_nodes) [m], whether they belong to a face or not. Obstacles on a given path
    /// have nodes, too. Throws BadInput naming face, value, limit and remedy: array sizes that disagree, an index out of
    /// range, a number of corners that is not allowed, a corner that is not finite, a facet without area, a depth or
    /// stiffness that is not > 0 (a rigid body has depth >= 0), crossing edges; also lengths beyond 1e-75 to 1e75 m,
    /// stiffnesses beyond 1e-150 to 1e150 Pa/m.
    NodalSurface(PointsView<Dim> rest, const NodalFaces<Dim>& faces);

    [[nodiscard]] std::int32_t n_nodes() const { return static_cast<std::int32_t>(facets_.vertices.size()); }
    [[nodiscard]] std::int32_t n_faces() const { return n_faces_; }
    [[nodiscard]] std::int32_t n_bodies() const { return static_cast<std::int32_t>(stiffness_.size()); }
    [[nodiscard]] bool is_rigid(std::int32_t body) const;
    [[nodiscard]] double stiffness(std::int32_t body) const { return stiffness_[static_cast<std::size_t>(body)]; }
    /// The facets at rest; their vertices are the nodes.
    [[nodiscard]] const Surface<Dim>& facets() const { return facets_; }
    /// Face of the host that a facet belongs to.
    [[nodiscard]] Face face_of(Facet facet) const { return face_of_[static_cast<std::size_t>(facet)]; }
    /// Whether it has all that friction needs.
    [[nodiscard]] bool has_shear_stiffness() const { return facets_.shear_stiffness.size() == facets_.area.size(); }
    /// Facets of a face of the host: one, or two that follow each other.
    [[nodiscard]] std::span<const std::int32_t> facet_offsets() const { return facet_offsets_; }  ///< (n_faces + 1)
    /// Bodies whose faces close a volume and all look into it: the walls of a cavity that is filled, or faces with their
    /// corners the wrong way around, which nothing ever touches.
    [[nodiscard]] std::vector<std::int32_t> inward_bodies() const;
    /// Nodes that belong to a face, increasing.
    [[nodiscard]] std::span<const std::int32_t> nodes() const { return nodes_; }
    /// This surface with more facets, on nodes behind its own: facets across sharp corners, as the law has them. A face
    /// at the corner stands for them in `face_of`.
    [[nodiscard]] NodalSurface with(const Bevels<Dim>& bevels) const;

private:
    /// `facet`: which of the corners of its face, Dim of them.
    void append_facet(std::int32_t face, std::span<const std::int32_t> corners, const std::array<std::size_t, 3>& facet);

    Surface<Dim> facets_;
    std::vector<double> stiffness_;
    std::vector<Face> face_of_;
    std::vector<std::int32_t> facet_offsets_;
    std::vector<std::int32_t> nodes_;
    std::int32_t n_faces_ = 0;
};

}  // namespace abut::contact
