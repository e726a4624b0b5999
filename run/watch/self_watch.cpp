#include "abut/run/watch/self_watch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/rotation.hpp"
#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/solid/body/body_frame.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::run {
namespace {

constexpr double near = 0.1;              // gap over the depth of both cells
constexpr double crossed = -0.3;          // the same
constexpr double come_nearer = 0.5;       // distance of two faces over that at rest
constexpr double sizes_ahead = 4.0;       // how far a look sees, in mean sizes of faces
constexpr double square = 1e-9;           // cosine of two normals: what is below may still look at each other
constexpr std::int64_t least_steps = 20;  // from one look to the next
constexpr std::size_t pairs_at_once = std::size_t{1} << 18;

}  // namespace

/// One body.
template <int Dim>
class SelfWatch<Dim>::Body {
public:
    Body(const mesh::Mesh<Dim>& mesh, std::int32_t body)
        : body_(body), name_(mesh.body_names[static_cast<std::size_t>(body)]) {
        for (const std::int32_t face : mesh.boundary_faces)
            if (const std::int32_t cell = mesh.face_cells[face][0]; mesh.cell_body[cell] == body)
                append(mesh, face, solid::cell_depth(mesh, face));
        double size = 0.0;
        for (const double area : surface_.area) size += Dim == 2 ? area : std::sqrt(area);
        ahead_ = surface_.size() > 0 ? sizes_ahead * size / surface_.size() : 0.0;
    }

    [[nodiscard]] bool is_due(const solid::AllPoints<Dim>& points, std::int64_t step) {
        is_due_ = false;
        if (is_done_ || (has_looked_ && step < last_look_ + least_steps)) return false;
        deform(points);
        is_due_ = !has_looked_ || 2.0 * farthest_since_look() >= least_gap_;
        return is_due_;
    }

    void look(const std::vector<Vector<Dim>>& of_vertices, const Moment<Dim>& now, Sightings<Dim>& found) {
        if (!is_due_) return;
        is_due_ = false;
        has_looked_ = true;
        last_look_ = now.steps;
        deformed_at_look_ = deformed_;
        std::optional<NearItself<Dim>> crossing;
        try {
            crossing = look_at_surface(of_vertices, now.time, found.near_themselves);
        } catch (const Error& error) {  // a face without a plane, or more pairs than a search may find
            is_done_ = true;
            if (std::ranges::find(found.looks_ended, name_, &LookEnded::body) == found.looks_ended.end())
                found.looks_ended.push_back({name_, now.time, error.what()});
        }
        if (crossing) refuse(*crossing);
    }

private:
    void append(const mesh::Mesh<Dim>& mesh, std::int32_t face, double depth) {
        const auto corners = mesh.face_vertices[face];
        std::vector<std::int32_t> vertices(corners.begin(), corners.end());
        std::vector<Vector<Dim>> points;
        for (const std::int32_t v : vertices) points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
        if (geometry::face_normal<Dim>(points).dot(mesh.face_normal[face]) < 0.0) {
            std::ranges::reverse(vertices);
            std::ranges::reverse(points);
        }
        const auto append_facet = [&](std::span<const std::size_t> facet) {
            std::vector<Vector<Dim>> of_facet;
            for (const std::size_t i : facet) {
                of_facet.push_back(points[i]);
                vertices_.push_back(vertices[i]);
            }
            surface_.append(of_facet, depth, 1.0, 0);
        };
        if constexpr (Dim == 2) append_facet(std::array<std::size_t, 2>{0, 1});
        if constexpr (Dim == 3)
            for (std::size_t i = 1; i + 1 < points.size(); ++i) append_facet(std::array<std::size_t, 3>{0, i, i + 1});
    }

    /// The displacement of the points as seen from the rotation that fits them best.
    void deform(const solid::AllPoints<Dim>& points) {
        const auto of_body = points.body();
        const auto first = static_cast<std::size_t>(std::ranges::find(of_body, body_) - of_body.begin());
        std::size_t last = first;
        while (last < of_body.size() && of_body[last] == body_) ++last;
        const auto u = as_vectors<Dim>(points.q()).subspan(first, last - first);
        const auto rest = points.rest().subspan(first, last - first);
        const auto mass = points.mass().subspan(first, last - first);
        Vector<Dim> rest_centre = Vector<Dim>::Zero(), moved = Vector<Dim>::Zero();
        double whole = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i) {
            whole += mass[i];
            rest_centre += mass[i] * rest[i];
            moved += mass[i] * u[i];
        }
        rest_centre /= whole;
        moved /= whole;
        Matrix<Dim> moment = Matrix<Dim>::Zero();
        for (std::size_t i = 0; i < u.size(); ++i) {
            const Vector<Dim> arm = rest[i] - rest_centre;
            moment += mass[i] * (arm + u[i] - moved) * arm.transpose();
        }
        const Matrix<Dim> back = nearest_rotation(moment).transpose();
        deformed_.resize(u.size());
        for (std::size_t i = 0; i < u.size(); ++i) {
            const Vector<Dim> arm = rest[i] - rest_centre;
            deformed_[i] = back * (arm + u[i] - moved) - arm;
        }
    }

    [[nodiscard]] double farthest_since_look() const {
        double farthest = 0.0;
        for (std::size_t i = 0; i < deformed_.size(); ++i)
            farthest = std::max(farthest, (deformed_[i] - deformed_at_look_[i]).squaredNorm());
        return std::sqrt(farthest);
    }

    [[noreturn]] void refuse(const NearItself<Dim>& crossing) const {
        throw Diverged(
            fmt::format("t = {:.4g} s: body '{}' goes through itself at ({:.4g}): two parts of its surface, {:.3g} m "
                        "apart at rest, are {:.3g} m inside each other, and no contact acts within a body. Set "
                        "contact.self = true (--self-contact), which lets it act.",
                        crossing.time, name_, fmt::join(crossing.position, ", "), crossing.gap_at_rest, -crossing.gap),
            {.value = crossing.gap, .allowed = 0.0});
    }

    /// Whether two faces look at each other across an opening of the body at rest, so that one that is behind the other
    /// has gone through it: faces of one tip or of both sides of a plate are behind each other from the start.
    [[nodiscard]] bool are_apart_at_rest(std::int32_t face_1, std::int32_t face_2) const {
        const Vector<Dim> between = rest_middle(face_2) - rest_middle(face_1);
        return between.dot(surface_.normal[static_cast<std::size_t>(face_1)]) > 0.0 &&
               between.dot(surface_.normal[static_cast<std::size_t>(face_2)]) < 0.0;
    }

    /// Adds a body that comes near itself; returns where it has gone through itself.
    [[nodiscard]] std::optional<NearItself<Dim>> look_at_surface(const std::vector<Vector<Dim>>& u, double time,
                                                                 std::vector<NearItself<Dim>>& found) {
        std::vector<Vector<Dim>> x(surface_.vertices);
        for (std::size_t v = 0; v < x.size(); ++v) x[v] += u[static_cast<std::size_t>(vertices_[v])];
        least_gap_ = ahead_;
        std::optional<NearItself<Dim>> nearest, crossing;
        each_overlap(x, [&](const contact::Overlap<Dim>& pair) {
            const double depth = surface_.cell_depth[static_cast<std::size_t>(pair.face_1)] +
                                 surface_.cell_depth[static_cast<std::size_t>(pair.face_2)];
            const double at_rest = (rest_middle(pair.face_2) - rest_middle(pair.face_1)).norm();
            const Vector<Dim> from_1 = middle(x, pair.face_1), from_2 = middle(x, pair.face_2);
            if (pair.gap < -depth || (pair.gap < near * depth && (from_2 - from_1).norm() > come_nearer * at_rest)) return;
            least_gap_ = std::min(least_gap_, std::max(pair.gap - near * depth, near * depth));
            if (pair.gap >= near * depth) return;
            const Vector<Dim>& normal = surface_.normal[static_cast<std::size_t>(pair.face_1)];
            const double gap_at_rest = std::abs((rest_middle(pair.face_2) - rest_middle(pair.face_1)).dot(normal));
            const NearItself<Dim> here{name_, time, pair.gap, gap_at_rest, 0.5 * (from_1 + from_2)};
            const auto is_deeper = [&](const auto& than) { return !than || here.gap < than->gap; };
            if (is_deeper(nearest)) nearest = here;
            if (here.gap < crossed * depth && is_deeper(crossing) && are_apart_at_rest(pair.face_1, pair.face_2))
                crossing = here;
        });
        // A run that goes on knows what was found before.
        if (nearest && std::ranges::find(found, name_, &NearItself<Dim>::body) == found.end()) found.push_back(*nearest);
        return crossing;
    }

    /// Calls use(overlap) for all overlaps of pairs in sight. Boxes alone would list faces of one side, too, by the million.
    /// What is left may still be many: it is listed for this look alone, and evaluated piece by piece.
    template <class Use>
    void each_overlap(const std::vector<Vector<Dim>>& x, const Use& use) const {
        contact::CandidateOptions options;
        options.self_contact = true;
        options.distance = ahead_;
        options.skin = 1e-3 * ahead_;
        options.largest_motion = std::numeric_limits<double>::max();
        contact::CandidateSearch<Dim> search(surface_.view(), options);
        const std::vector<Vector<Dim>> normals = normals_at(x);
        search.search_moved(x, x, contact::GapOf::centroids, [&](std::int32_t face_1, std::int32_t face_2) {
            return normals[static_cast<std::size_t>(face_1)].dot(normals[static_cast<std::size_t>(face_2)]) < square;
        });
        std::span<const geometry::IndexPair> left = search.candidates();
        for (contact::Overlaps<Dim> overlaps; !left.empty(); left = left.subspan(std::min(left.size(), pairs_at_once))) {
            contact::find_overlaps_moved<Dim>(surface_.view(), x, left.first(std::min(left.size(), pairs_at_once)),
                                              geometry::AreaMethod::fast, overlaps);
            for (const contact::Overlap<Dim>& pair : overlaps.found) use(pair);
        }
    }

    [[nodiscard]] std::vector<Vector<Dim>> normals_at(const std::vector<Vector<Dim>>& x) const {
        std::vector<Vector<Dim>> normals(static_cast<std::size_t>(surface_.size()));
        parallel_each(std::ssize(normals), [&](std::ptrdiff_t facet) {
            normals[static_cast<std::size_t>(facet)] =
                geometry::face_normal<Dim>(std::span(x).subspan(static_cast<std::size_t>(Dim * facet), Dim));
        });
        return normals;
    }
    [[nodiscard]] Vector<Dim> rest_middle(std::int32_t face) const {
        return surface_.centroid[static_cast<std::size_t>(face)];
    }
    [[nodiscard]] static Vector<Dim> middle(const std::vector<Vector<Dim>>& x, std::int32_t facet) {
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (int i = 0; i < Dim; ++i) sum += x[static_cast<std::size_t>(Dim * facet + i)];
        return sum / Dim;
    }

    std::int32_t body_;
    std::string name_;
    contact::Surface<Dim> surface_;       // facets of Dim corners, each with vertices of its own
    std::vector<std::int32_t> vertices_;  // of the mesh, of each vertex of the surface
    std::vector<Vector<Dim>> deformed_, deformed_at_look_;
    double ahead_ = 0.0;      // how far a look sees [m]
    double least_gap_ = 0.0;  // that the last look found, at most `ahead_` [m]
    std::int64_t last_look_ = 0;
    bool has_looked_ = false;
    bool is_due_ = false;
    bool is_done_ = false;
};

template <int Dim>
SelfWatch<Dim>::SelfWatch(const Scene<Dim>& scene, const solid::Solid<Dim>& solid) {
    const auto& contact = solid.options().contact;
    if (!contact) return;
    const auto& kinematics = solid.options().kinematics;
    const auto touches_itself = [&](std::int32_t body) {
        return contact->search.self_contact && std::ranges::find(solid.options().ignored_pairs, std::array{body, body}) ==
                                                   solid.options().ignored_pairs.end();
    };
    for (std::int32_t body = 0; body < scene.mesh.n_bodies(); ++body) {
        if (touches_itself(body)) continue;
        if (!solid::properties_of(kinematics, static_cast<std::size_t>(body)).deforms) continue;
        is_on_ = true;
        if (solid.ranks().rank() == 0) bodies_.push_back(std::make_unique<Body>(scene.mesh, body));
    }
}

template <int Dim>
SelfWatch<Dim>::~SelfWatch() = default;

template <int Dim>
bool SelfWatch<Dim>::is_due(const solid::AllPoints<Dim>& points, std::int64_t step) {
    bool any = false;
    for (const auto& body : bodies_) any = body->is_due(points, step) || any;
    return any;
}

template <int Dim>
void SelfWatch<Dim>::look(const Sight<Dim>& sight, Sightings<Dim>& found) {
    const std::vector<Vector<Dim>> of_vertices = sight.vertex_displacement();
    for (const auto& body : bodies_) body->look(of_vertices, sight.moment, found);
}

template class SelfWatch<2>;
template class SelfWatch<3>;

}  // namespace abut::run
