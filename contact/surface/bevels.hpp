#pragma once
// Private to the layer.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::contact {

/// Small facets across sharp corners, that stand alone: the surface stays as it is, and a bevel is one more partner of
/// what comes straight at the tip, which the flanks do not face. docs/method.md, Sharp corners.
template <int Dim>
struct Bevels {
    // Corners of bevels: fixed combinations of nodes of the host, y = A x, the rows of which sum to 1
    std::vector<std::int32_t> offsets{0};  ///< (n_nodes + 1), into the next two
    std::vector<std::int32_t> node;        ///< of the host
    std::vector<double> weight;

    // Each bevel
    std::vector<std::array<std::int32_t, Dim>> corners;  ///< counted from 0 among the above
    std::vector<std::array<std::int32_t, 2>> beside;     ///< facets of the host that meet there, the lower one first
    std::vector<double> stiffening;  ///< F >= 1 [-]: a narrow strip gives way less, for its pressure, than a wide face
    std::vector<geometry::FacingFade> facing;  ///< weight of its pairs, unless the other facet has a narrower one

    std::vector<Vector<Dim>> tips;  ///< sharp corners of the body at rest that have a bevel, of their own or of an edge [m]
    double width = 0.0;             ///< largest distance of a corner of a bevel from that of its body [m]

    [[nodiscard]] std::int32_t n_nodes() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(corners.size()); }
    /// Whether a corner of the body at exactly this position has a bevel.
    [[nodiscard]] bool is_at(const Vector<Dim>& position) const { return std::ranges::find(tips, position) != tips.end(); }
};

/// In 2D the bevels of all convex corners below 60 degrees. In 3D those of convex edges below 60 degrees, of edges
/// below 95 degrees that cross an edge of another body unseen where their flanks face each other too little, and of
/// corners which are sharper than the edges there tell. Their order is fixed; takes n log n.
template <int Dim>
[[nodiscard]] Bevels<Dim> bevels_of(const SurfaceView<Dim>& facets);

/// The surface of a host together with its bevels: facets behind all others, with corners behind all nodes. Without a sharp
/// corner it is the surface of the host itself.
template <int Dim>
class BevelledSurface {
public:
    BevelledSurface(NodalSurface<Dim> host);  // implicit: a surface as it acts

    [[nodiscard]] const NodalSurface<Dim>& host() const { return host_; }
    [[nodiscard]] const NodalSurface<Dim>& acting() const { return acting_ ? *acting_ : host_; }
    [[nodiscard]] const Bevels<Dim>& bevels() const { return bevels_; }

    // Pairs

    [[nodiscard]] bool is_bevel(std::int32_t facet) const { return facet >= host_.facets().size(); }
    [[nodiscard]] bool has_bevel(std::int32_t facet_1, std::int32_t facet_2) const {
        return is_bevel(facet_1) || is_bevel(facet_2);
    }
    /// A bevel meets no face of its own body; in the plane two of them, which are points, do not meet.
    [[nodiscard]] bool may_meet(std::int32_t facet_1, std::int32_t facet_2) const;
    /// Law of a pair with a bevel, made from that of its facets.
    [[nodiscard]] geometry::PairLaw<Dim> law_with_bevel(std::int32_t facet_1, std::int32_t facet_2,
                                                        geometry::PairLaw<Dim> law) const;

    // Nodes

    /// Appends the nodes of the host that the corners of bevels among `nodes` are made of.
    void append_host_nodes(std::vector<std::int32_t>& nodes) const;
    /// Positions of all nodes, or of `listed` ones (increasing) alone, from those of the host; without bevels these
    /// themselves.
    [[nodiscard]] PointsView<Dim> place(PointsView<Dim> x, std::vector<Vector<Dim>>& y) const;
    [[nodiscard]] PointsView<Dim> place(PointsView<Dim> x, std::span<const std::int32_t> listed,
                                        std::vector<Vector<Dim>>& y) const;
    /// Gives the gradients of corners of bevels, which are last of `nodes` (increasing), to nodes of the host: A^T.
    void fold(std::vector<std::int32_t>& nodes, std::vector<Vector<Dim>>& gradient) const;
    /// No corner of a bevel moves farther than this times the farthest motion of a node.
    [[nodiscard]] double stretch() const { return stretch_; }

private:
    [[nodiscard]] Vector<Dim> corner(PointsView<Dim> x, std::int32_t bevel_node) const;

    NodalSurface<Dim> host_;
    Bevels<Dim> bevels_;
    std::optional<NodalSurface<Dim>> acting_;  // with bevels
    double stretch_ = 1.0;
};

/// As `old_facets`, of the facets that act: a bevel was there before if both facets beside it were, and one was between
/// them.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> old_acting_facets(const BevelledSurface<Dim>& before,
                                                          const BevelledSurface<Dim>& after,
                                                          std::span<const std::int32_t> old_face_of);

}  // namespace abut::contact
