#include "abut/contact/surface/nodal_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/surface/bevels.hpp"
#include "abut/geometry/polygon.hpp"

namespace abut::contact {
namespace {

constexpr double rigid = std::numeric_limits<double>::infinity();

/// Lengths and stiffnesses, in any unit, whose products in the law of contact are numbers with all their digits.
constexpr double least_length = 1e-75, largest_length = 1e75;
constexpr double least_stiffness = 1e-150, largest_stiffness = 1e150;

bool is_stiffness(double k) { return k >= least_stiffness && k <= largest_stiffness; }
std::string stiffness_range() { return number(least_stiffness) + " to " + number(largest_stiffness) + " Pa/m"; }
bool is_length(double length) { return length >= least_length && length <= largest_length; }
std::string length_range() { return number(least_length) + " to " + number(largest_length) + " m"; }

[[noreturn]] void refuse(const std::string& what, const ErrorFacts& facts = {}) {
    throw BadInput("nodal surface: " + what, facts);
}

[[noreturn]] void refuse_face(std::int32_t face, const std::string& what, const ErrorFacts& facts = {}) {
    ErrorFacts of_face = facts;
    of_face.face_1 = face;
    refuse("face " + std::to_string(face) + " " + what, of_face);
}

/// Corners of the faces of a host, checked as they are read.
template <int Dim>
class HostFaces {
public:
    HostFaces(PointsView<Dim> rest, const NodalFaces<Dim>& faces) : rest_(rest), faces_(faces) {
        const std::size_t n = faces.body.size();
        if (faces.depth.size() != n)
            refuse("`depth` has " + std::to_string(faces.depth.size()) + " entries for " + std::to_string(n) +
                   " faces in `body`; give one each.");
        if (!faces.face_stiffness.empty() && faces.face_stiffness.size() != n)
            refuse("`face_stiffness` has " + std::to_string(faces.face_stiffness.size()) + " entries for " +
                   std::to_string(n) + " faces in `body`; give one each, or none.");
        const auto require_all = [](const std::string& name, std::size_t size, std::size_t wanted, const std::string& of) {
            if (size != 0 && size != wanted)
                refuse("`" + name + "` has " + std::to_string(size) + " entries for " + std::to_string(wanted) + " " + of +
                       "; give one each, or none.");
        };
        require_all("shear_stiffness", faces.shear_stiffness.size(), faces.stiffness.size(), "bodies");
        require_all("face_shear_stiffness", faces.face_shear_stiffness.size(), n, "faces in `body`");
        if (faces.offsets.empty() ? faces.nodes.size() != Dim * n : faces.offsets.size() != n + 1)
            refuse(faces.offsets.empty()
                       ? "`nodes` has " + std::to_string(faces.nodes.size()) + " entries, " + std::to_string(Dim * n) +
                             " are needed for " + std::to_string(n) + " faces. Give `offsets` where faces differ."
                       : "`offsets` has " + std::to_string(faces.offsets.size()) + " entries, " + std::to_string(n + 1) +
                             " are needed: one per face, and one more.");
        if (!faces.offsets.empty() &&
            (faces.offsets.front() != 0 || static_cast<std::size_t>(faces.offsets.back()) != faces.nodes.size()))
            refuse("`offsets` goes from " + std::to_string(faces.offsets.front()) + " to " +
                   std::to_string(faces.offsets.back()) + "; it must rise from 0 to the size of `nodes`, " +
                   std::to_string(faces.nodes.size()) + ".");
    }

    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(faces_.body.size()); }

    [[nodiscard]] std::span<const std::int32_t> corners(std::int32_t face) const {
        const std::int32_t begin = faces_.offsets.empty() ? Dim * face : faces_.offsets[face];
        const std::int32_t end = faces_.offsets.empty() ? Dim * (face + 1) : faces_.offsets[face + 1];
        if (begin < 0 || end < begin || static_cast<std::size_t>(end) > faces_.nodes.size())
            refuse_face(face, "goes from " + std::to_string(begin) + " to " + std::to_string(end) +
                                  " in `nodes`, which has " + std::to_string(faces_.nodes.size()) +
                                  " entries. `offsets` must rise from 0 to its size.");
        if (end - begin != Dim && !(Dim == 3 && end - begin == 4))
            refuse_face(face, "has " + std::to_string(end - begin) + " corners; " +
                                  (Dim == 2 ? "2 are needed." : "3 or 4 are allowed. Cut it into triangles."));
        const auto corners = faces_.nodes.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
        for (const std::int32_t node : corners) check_node(face, node);
        return corners;
    }

    [[nodiscard]] std::int32_t body(std::int32_t face) const {
        const std::int32_t body = faces_.body[face];
        if (body < 0 || static_cast<std::size_t>(body) >= faces_.stiffness.size())
            refuse_face(face, "belongs to body " + std::to_string(body) + ", but `stiffness` is given for " +
                                  std::to_string(faces_.stiffness.size()) + " bodies, counted from 0.");
        return body;
    }

    [[nodiscard]] double stiffness(std::int32_t face) const {
        const double of_body = faces_.stiffness[body(face)];
        if (of_body == rigid || faces_.face_stiffness.empty()) return of_body;
        const double stiffness = faces_.face_stiffness[face];
        if (!(stiffness >= least_stiffness && stiffness <= of_body) && stiffness != rigid)
            refuse_face(face,
                        "has the stiffness " + number(stiffness) + " Pa/m; it must be > 0, at least " +
                            number(least_stiffness) + " Pa/m, and at most that of its body, " + number(of_body) +
                            " Pa/m, or infinity.",
                        {.value = stiffness, .allowed = of_body});
        return stiffness;
    }

    [[nodiscard]] bool has_shear_stiffness() const {
        return !faces_.face_shear_stiffness.empty() || (!faces_.shear_stiffness.empty() && faces_.face_stiffness.empty());
    }
    [[nodiscard]] double shear_stiffness(std::int32_t face) const {
        if (stiffness(face) == rigid) return rigid;
        const double shear =
            faces_.face_shear_stiffness.empty() ? faces_.shear_stiffness[body(face)] : faces_.face_shear_stiffness[face];
        if (!is_stiffness(shear))
            refuse_face(face,
                        "has the shear stiffness " + number(shear) + " Pa/m; it must be > 0, from " + stiffness_range() +
                            ". Give mu/(lambda + 2 mu) of its stiffness.",
                        {.value = shear});
        return shear;
    }

    [[nodiscard]] double depth(std::int32_t face) const {
        const double depth = faces_.depth[face];
        const bool is_rigid = stiffness(face) == rigid;
        if (!is_length(depth) && !(is_rigid && depth == 0.0))
            refuse_face(face,
                        "has the depth " + number(depth) + " m; it must be > 0, from " + length_range() +
                            " (or 0 if rigid). Give half the height of the element behind it.",
                        {.value = depth});
        return depth;
    }

private:
    void check_node(std::int32_t face, std::int32_t node) const {
        if (node < 0 || node >= rest_.size())
            refuse_face(face, "names node " + std::to_string(node) + ", but there are " + std::to_string(rest_.size()) +
                                  " nodes. Correct `nodes`.");
        if (!rest_[node].allFinite())
            refuse_face(face, "has a corner (node " + std::to_string(node) + ") that is not finite. Correct it.");
        if (const double farthest = rest_[node].cwiseAbs().maxCoeff(); farthest > largest_length)
            refuse_face(face, "has a corner (node " + std::to_string(node) + ") at " + number(farthest) + " m; up to " +
                                  number(largest_length) + " m can be computed with. Correct it, or take another unit.");
    }

    PointsView<Dim> rest_;
    const NodalFaces<Dim>& faces_;
};

/// The corners of a facet, as indices into those of its face.
using FacetCorners = std::array<std::size_t, 3>;

using Halves = std::array<FacetCorners, 2>;

/// Whether two triangles look the same way.
bool agree(PointsView<3> rest, std::span<const std::int32_t> corners, const Halves& halves) {
    std::array<Vector<3>, 2> normal;
    for (std::size_t i = 0; i < 2; ++i) {
        const Vector<3> start = rest[corners[halves[i][0]]];
        normal[i] = moment<3>(rest[corners[halves[i][1]]] - start, rest[corners[halves[i][2]]] - start);
    }
    return normal[0].dot(normal[1]) > 0.0;
}

/// Two triangles of a face with four corners, along the shorter diagonal, the first one of equals; of a concave face along
/// that inside.
Halves halves_of(PointsView<3> rest, std::int32_t face, std::span<const std::int32_t> corners) {
    Halves shorter{FacetCorners{0, 1, 2}, FacetCorners{0, 2, 3}}, longer{FacetCorners{0, 1, 3}, FacetCorners{1, 2, 3}};
    const double first = (rest[corners[2]] - rest[corners[0]]).norm(), second = (rest[corners[3]] - rest[corners[1]]).norm();
    if (first > second * (1.0 + 1e-9)) std::swap(shorter, longer);
    if (agree(rest, corners, shorter)) return shorter;
    if (agree(rest, corners, longer)) return longer;
    refuse_face(face,
                "has edges that cross, or halves that look opposite ways along both diagonals. Put its corners in order, "
                "or cut it into triangles.");
}

}  // namespace

double skin_stiffness(double p_wave_modulus, std::span<const double> depth) {
    if (!(p_wave_modulus > 0.0) || !std::isfinite(p_wave_modulus))
        refuse("the modulus of P waves is " + number(p_wave_modulus) + " Pa; it must be finite and > 0. Give lambda + 2 mu.",
               {.value = p_wave_modulus});
    double sum = 0.0;
    for (const double d : depth) sum += d;
    if (!(sum > 0.0) || !std::isfinite(sum))
        refuse("the depths of the faces of a body add up to " + number(sum) + " m; give one > 0 for each face.",
               {.value = sum});
    return p_wave_modulus * static_cast<double>(depth.size()) / sum;
}

double series_stiffness(double k_1, double k_2) {
    if (k_1 == rigid) return k_2;
    if (k_2 == rigid) return k_1;
    return k_1 * k_2 / (k_1 + k_2);
}

template <int Dim>
NodalSurface<Dim>::NodalSurface(PointsView<Dim> rest, const NodalFaces<Dim>& faces)
    : stiffness_(faces.stiffness.begin(), faces.stiffness.end()), facet_offsets_{0} {
    for (std::size_t body = 0; body < stiffness_.size(); ++body)
        if (!is_stiffness(stiffness_[body]) && stiffness_[body] != rigid)
            refuse("body " + std::to_string(body) + " has the stiffness " + number(stiffness_[body]) +
                       " Pa/m; it must be > 0, from " + stiffness_range() +
                       ". Take contact::skin_stiffness, or infinity for a rigid body.",
                   {.value = stiffness_[body]});
    for (std::int32_t node = 0; node < rest.size(); ++node) facets_.vertices.push_back(rest[node]);

    const HostFaces<Dim> host(rest, faces);
    n_faces_ = host.size();
    for (std::int32_t face = 0; face < n_faces_; ++face) {
        const auto corners = host.corners(face);
        nodes_.insert(nodes_.end(), corners.begin(), corners.end());
        const auto append = [&](const FacetCorners& facet) {
            append_facet(face, corners, facet);
            facets_.cell_depth.push_back(host.depth(face));
            facets_.body.push_back(host.body(face));
            facets_.stiffness.push_back(host.stiffness(face));
            if (host.has_shear_stiffness()) facets_.shear_stiffness.push_back(host.shear_stiffness(face));
        };
        if (corners.size() == Dim) append({0, 1, 2});
        if (corners.size() != Dim)
            if constexpr (Dim == 3)
                for (const FacetCorners& half : halves_of(rest, face, corners)) append(half);
        facet_offsets_.push_back(static_cast<std::int32_t>(face_of_.size()));
    }
    sort_unique(nodes_);
}

template <int Dim>
void NodalSurface<Dim>::append_facet(std::int32_t face, std::span<const std::int32_t> corners,
                                     const std::array<std::size_t, 3>& facet) {
    std::array<Vector<Dim>, Dim> points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        facets_.face_vertices.push_back(corners[facet[i]]);
        points[i] = facets_.vertices[static_cast<std::size_t>(corners[facet[i]])];
    }
    const double area = geometry::face_measure<Dim>(points);
    const double size = Dim == 2 ? area : std::sqrt(area);
    if (!(area > 0.0)) refuse_face(face, "has no area: its corners lie on a line or in a point. Leave it out.");
    if (!is_length(size))
        refuse_face(face, "has an area of " + number(area) + "; faces of a size from " + length_range() +
                              " can be computed with. Leave it out, or take another unit.");
    facets_.face_offsets.push_back(static_cast<std::int32_t>(facets_.face_vertices.size()));
    facets_.centroid.push_back(geometry::face_centroid<Dim>(points));
    facets_.normal.push_back(geometry::face_normal<Dim>(points));
    facets_.area.push_back(area);
    face_of_.push_back(Face{face});
}

template <int Dim>
NodalSurface<Dim> NodalSurface<Dim>::with(const Bevels<Dim>& bevels) const {
    NodalSurface both = *this;
    Surface<Dim>& facets = both.facets_;
    for (std::int32_t i = 0; i < bevels.n_nodes(); ++i) {
        Vector<Dim> y = Vector<Dim>::Zero();
        for (std::int32_t j = bevels.offsets[i]; j < bevels.offsets[i + 1]; ++j)
            y += bevels.weight[j] * facets_.vertices[static_cast<std::size_t>(bevels.node[j])];
        both.nodes_.push_back(static_cast<std::int32_t>(facets.vertices.size()));
        facets.vertices.push_back(y);
    }
    for (std::int32_t i = 0; i < bevels.size(); ++i) {
        const auto [facet_1, facet_2] = bevels.beside[i];
        std::array<std::int32_t, Dim> corners = bevels.corners[i];
        for (std::int32_t& corner : corners) corner += n_nodes();
        both.append_facet(number_of(face_of(Facet{facet_1})), corners, {0, 1, 2});
        const auto append_least = [facet_1 = facet_1, facet_2 = facet_2](std::vector<double>& values) {
            values.push_back(std::min(values[facet_1], values[facet_2]));
        };
        append_least(facets.cell_depth);
        append_least(facets.stiffness);
        if (has_shear_stiffness()) append_least(facets.shear_stiffness);
        facets.body.push_back(facets.body[facet_1]);
    }
    return both;
}

template <int Dim>
bool NodalSurface<Dim>::is_rigid(std::int32_t body) const {
    return stiffness(body) == rigid;
}

template <int Dim>
std::vector<std::int32_t> NodalSurface<Dim>::inward_bodies() const {
    const auto n = static_cast<std::size_t>(n_bodies());
    std::vector<Vector<Dim>> opening(n, Vector<Dim>::Zero()), origin(n);  // 0 where the faces of a body close it
    std::vector<double> area(n, 0.0), content(n, 0.0);
    for (std::int32_t facet = 0; facet < facets_.size(); ++facet) {
        const auto body = static_cast<std::size_t>(facets_.body[facet]);
        if (area[body] == 0.0) origin[body] = facets_.centroid[facet];
        const Vector<Dim> face = facets_.area[facet] * facets_.normal[facet];
        opening[body] += face;
        area[body] += facets_.area[facet];
        content[body] += face.dot(facets_.centroid[facet] - origin[body]);
    }
    std::vector<std::int32_t> inward;
    for (std::size_t body = 0; body < n; ++body)
        if (content[body] < 0.0 && opening[body].norm() <= 1e-9 * area[body])
            inward.push_back(static_cast<std::int32_t>(body));
    return inward;
}

template class NodalSurface<2>;
template class NodalSurface<3>;

}  // namespace abut::contact
