#include <algorithm>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/base/index.hpp"
#include "abut/base/messages.hpp"
#include "abut/geometry/health/surface_health.hpp"

namespace abut::geometry {
namespace {

constexpr std::size_t most_faces = 3;  // that one line names

std::string point(const Vector<3>& x) { return "(" + number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]) + ")"; }

class Description {
public:
    Description(const FaceSoup& soup, const SurfaceReport& report, std::span<const std::int64_t> labels)
        : soup_(soup), report_(report), labels_(labels) {}

    std::vector<std::string> lines() && {
        add_size();
        add_closed();
        add_unusable();
        add_vertices();
        add_edges();
        add_flipped();
        add_components();
        add_shapes();
        add_self_intersections();
        return std::move(lines_);
    }

private:
    [[nodiscard]] std::string face(std::int32_t index) const {
        return "face " + std::to_string(labels_.empty() ? index : labels_[at(index)]);
    }
    /// "face 3, face 7, face 9 and 5 more"
    [[nodiscard]] std::string first_of(std::span<const std::int32_t> faces) const {
        std::string text;
        for (std::size_t i = 0; i < std::min(faces.size(), most_faces); ++i) text += (i > 0 ? ", " : "") + face(faces[i]);
        return text + (faces.size() > most_faces ? " and " + std::to_string(faces.size() - most_faces) + " more" : "");
    }

    void add_size() {
        lines_.push_back(counted(report_.n_faces, "face", "faces") + ", " +
                         counted(report_.n_vertices, "vertex", "vertices") + ", " +
                         counted(static_cast<std::int64_t>(report_.components.size()), "component", "components"));
        if (report_.n_usable() == 0) return;
        lines_.push_back("from " + point(report_.box.lower) + " to " + point(report_.box.upper) + " m, area " +
                         number(report_.area) + " m^2, edges of " + number(report_.shortest_edge) + " to " +
                         number(report_.longest_edge) + " m");
    }

    void add_closed() {
        if (report_.n_usable() == 0) return;
        if (report_.boundary_edges.empty() && report_.closed()) return lines_.push_back("closed" + volume());
        if (report_.boundary_edges.empty()) return lines_.push_back("not closed: edges with an odd number of faces");
        lines_.push_back("open: " + counted(report_.n_holes, "hole or rim", "holes or rims") + " of " +
                         counted(static_cast<std::int64_t>(report_.boundary_edges.size()), "edge", "edges") +
                         ", the first edge at " + face(report_.boundary_edges.front().face));
    }
    [[nodiscard]] std::string volume() const {
        double sum = 0.0;
        for (const SurfaceComponent& component : report_.components) {
            if (!component.oriented) return "";
            sum += component.volume;
        }
        return ", volume " + number(sum) + " m^3";
    }

    void add_unusable() {
        if (report_.unusable_faces.empty()) return lines_.push_back("every face can be used");
        std::string reasons;
        for (std::size_t fault = 1; fault < report_.n_faults.size(); ++fault)
            if (report_.n_faults[fault] > 0)
                reasons += (reasons.empty() ? "" : ", ") + std::to_string(report_.n_faults[fault]) + " " +
                           std::string(name(static_cast<FaceFault>(fault)));
        const auto n = static_cast<std::int64_t>(report_.unusable_faces.size());
        lines_.push_back(counted(n, "face", "faces") + " cannot be used: " + reasons);
        for (std::size_t i = 0; i < std::min(report_.unusable_faces.size(), most_faces); ++i) {
            const std::int32_t bad = report_.unusable_faces[i];
            lines_.push_back("  " + face(bad) + " " + describe(soup_, bad, report_.faults[at(bad)]));
        }
        if (n > static_cast<std::int64_t>(most_faces))
            lines_.push_back("  and " + std::to_string(n - static_cast<std::int64_t>(most_faces)) + " more");
    }

    void add_vertices() {
        const auto unreferenced = static_cast<std::int64_t>(report_.unreferenced_vertices.size());
        if (unreferenced > 0) lines_.push_back(counted(unreferenced, "vertex", "vertices") + " that no face names");
        if (report_.n_unwelded_vertices > 0)
            lines_.push_back(counted(report_.n_unwelded_vertices, "vertex", "vertices") +
                             " at the place of an earlier one (counted as one)");
        if (report_.n_bad_vertices > 0)
            lines_.push_back(counted(report_.n_bad_vertices, "vertex", "vertices") +
                             " with a coordinate that is not finite");
    }

    void add_edges() {
        const auto add = [&](const std::vector<SurfaceEdge>& edges, const std::string& what) {
            if (edges.empty()) return;
            lines_.push_back(counted(static_cast<std::int64_t>(edges.size()), "edge ", "edges ") + what + ", the first at " +
                             face(edges.front().face));
        };
        add(report_.non_manifold_edges, "of three faces or more (not manifold)");
        add(report_.inconsistent_edges, "along which two faces run the same way (orientation not consistent)");
    }

    void add_flipped() {
        if (report_.flipped_duplicates.empty()) return;
        const auto& [later, earlier] = report_.flipped_duplicates.front();
        lines_.push_back(
            counted(static_cast<std::int64_t>(report_.flipped_duplicates.size()), "face repeats", "faces repeat") +
            " an earlier one the other way round: first " + face(later) + " that of " + face(earlier));
    }

    void add_components() {
        const auto inside_out = [](const SurfaceComponent& component) { return component.inside_out; };
        const auto first = std::ranges::find_if(report_.components, inside_out);
        if (first == report_.components.end()) return;
        lines_.push_back(counted(std::ranges::count_if(report_.components, inside_out), "component is", "components are") +
                         " inside out (turned round, or the wall of a cavity), the first from " + face(first->first_face) +
                         " on");
    }

    void add_shapes() {
        if (report_.n_usable() == 0) return;
        lines_.push_back("worst aspect ratio " + number(report_.worst_aspect) + " (" + face(report_.worst_aspect_face) +
                         "), " + counted(static_cast<std::int64_t>(report_.slivers.size()), "sliver", "slivers") +
                         (report_.slivers.empty() ? "" : ": " + first_of(report_.slivers)));
        if (!report_.repeated_corner_faces.empty())
            lines_.push_back("a corner twice in a row: " + first_of(report_.repeated_corner_faces));
        if (!report_.non_planar_faces.empty())
            lines_.push_back("not flat: " + first_of(report_.non_planar_faces) + "; at worst " +
                             number(report_.worst_planarity) + " face sizes (" + face(report_.worst_planarity_face) + ")");
    }

    void add_self_intersections() {
        if (!report_.looked_for_self_intersections) return;
        if (report_.n_self_intersections == 0) return lines_.push_back("no self-intersection");
        std::string line = counted(report_.n_self_intersections, "pair of faces intersects", "pairs of faces intersect");
        if (!report_.self_intersections.empty())
            line += ": first " + face(report_.self_intersections.front().first) + " and " +
                    face(report_.self_intersections.front().second);
        lines_.push_back(line);
    }

    const FaceSoup& soup_;
    const SurfaceReport& report_;
    std::span<const std::int64_t> labels_;
    std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> describe(const FaceSoup& soup, const SurfaceReport& report, std::span<const std::int64_t> labels) {
    if (report.n_faces != soup.size() || (!labels.empty() && labels.size() != at(soup.size())))
        throw BadInput("surface health: a report of " + std::to_string(report.n_faces) + " faces and " +
                       std::to_string(labels.size()) + " labels are given for " + std::to_string(soup.size()) +
                       " faces; give those of this surface.");
    return Description(soup, report, labels).lines();
}

}  // namespace abut::geometry
