#include "apps/detect/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>

#include "abut/base/index.hpp"
#include "abut/mesh/io/write_vtp.hpp"
#include "abut/run/files/files.hpp"

namespace abut::apps {
namespace {

namespace fs = std::filesystem;
using contact::Overlap;

/// overlaps.vtp, surface_000012.vtp and what they are called while they are written
bool is_picture(std::string_view name) {
    if (name.starts_with('.')) name.remove_prefix(1);
    for (const std::string_view stem : {"overlaps", "surface"}) {
        if (!name.starts_with(stem)) continue;
        const std::string_view rest = name.substr(stem.size());
        const std::size_t end = rest.starts_with('_') ? std::min(rest.find_first_not_of("0123456789", 1), rest.size()) : 0;
        if ((end == 0 || end > 6) && (rest.substr(end) == ".vtp" || rest.substr(end) == ".part.vtp")) return true;
    }
    return false;
}

/// The polygons that pairs share, as a soup of faces.
struct Polygons {
    std::vector<Vector<3>> vertices;
    std::vector<std::int32_t> offsets{0};
    std::vector<std::int32_t> corners;

    void append(std::span<const Vector<3>> polygon) {
        for (const Vector<3>& x : polygon) {
            corners.push_back(static_cast<std::int32_t>(vertices.size()));
            vertices.push_back(x);
        }
        offsets.push_back(static_cast<std::int32_t>(corners.size()));
    }
};

/// Mean of the corners: a point of the patch.
Vector<3> middle(std::span<const Vector<3>> polygon) {
    Vector<3> sum = Vector<3>::Zero();
    for (const Vector<3>& x : polygon) sum += x;
    return polygon.empty() ? sum : Vector<3>(sum / static_cast<double>(polygon.size()));
}

/// The patches of all overlaps, their middle alone where rounding leaves nothing of one.
std::vector<std::vector<Vector<3>>> patches_of(const Bodies& bodies, std::span<const Overlap<3>> overlaps) {
    const std::vector<Vector<3>> at_rest(bodies.surface.body.size(), Vector<3>::Zero());
    std::vector<geometry::IndexPair> pairs;
    for (const Overlap<3>& overlap : overlaps) pairs.push_back({overlap.face_1, overlap.face_2});
    auto patches = contact::overlap_polygons<3>(bodies.surface.view(), at_rest, pairs);
    const auto& centroid = bodies.surface.centroid;
    for (std::size_t i = 0; i < patches.size(); ++i)
        if (patches[i].empty()) patches[i].assign(3, 0.5 * (centroid[at(pairs[i].first)] + centroid[at(pairs[i].second)]));
    return patches;
}

/// Values that every overlap shows in a picture.
struct OverlapFields {
    std::vector<double> area, gap, body_1, body_2, face_1, face_2;
    std::vector<Vector<3>> normal;
};

OverlapFields fields_of(const Bodies& bodies, std::span<const Overlap<3>> overlaps) {
    OverlapFields fields;
    const auto label = [&](std::int32_t face) { return static_cast<double>(bodies.face_label[at(face)]); };
    for (const Overlap<3>& overlap : overlaps) {
        fields.area.push_back(overlap.area);
        fields.gap.push_back(overlap.gap);
        fields.normal.push_back(overlap.normal);
        fields.body_1.push_back(bodies.surface.body[at(overlap.face_1)]);
        fields.body_2.push_back(bodies.surface.body[at(overlap.face_2)]);
        fields.face_1.push_back(label(overlap.face_1));
        fields.face_2.push_back(label(overlap.face_2));
    }
    return fields;
}

/// Values of every face in a picture of the bodies.
struct FaceFields {
    std::vector<double> body, label, area, gap, pairs;
};

FaceFields fields_of_faces(const Bodies& bodies, std::span<const Overlap<3>> overlaps) {
    const std::size_t n = bodies.surface.body.size();
    FaceFields fields{{bodies.surface.body.begin(), bodies.surface.body.end()},
                      {bodies.face_label.begin(), bodies.face_label.end()},
                      std::vector<double>(n, 0.0),
                      std::vector<double>(n, std::numeric_limits<double>::quiet_NaN()),
                      std::vector<double>(n, 0.0)};
    for (const Overlap<3>& overlap : overlaps)
        for (const std::int32_t face : {overlap.face_1, overlap.face_2}) {
            fields.area[at(face)] += overlap.area;
            fields.gap[at(face)] = std::fmin(fields.gap[at(face)], overlap.gap);
            fields.pairs[at(face)] += 1.0;
        }
    return fields;
}

/// Numbers that the array "problems" of a picture adds up for a face (docs/detection.md).
enum Problem {
    sliver = 1,
    at_boundary_edge = 2,
    at_non_manifold_edge = 4,
    at_inconsistent_edge = 8,
    flipped_duplicate = 16,
    self_intersection = 32,
};

std::vector<double> problems_of_input(const geometry::SurfaceReport& health) {
    std::vector<int> problems(at(health.n_faces), 0);
    const auto add = [&](std::int32_t face, Problem problem) { problems[at(face)] |= problem; };
    for (const std::int32_t face : health.slivers) add(face, sliver);
    for (const auto& edge : health.boundary_edges) add(edge.face, at_boundary_edge);
    for (const auto& edge : health.non_manifold_edges) add(edge.face, at_non_manifold_edge);
    for (const auto& edge : health.inconsistent_edges) add(edge.face, at_inconsistent_edge);
    for (const auto& [face, earlier] : health.flipped_duplicates)
        for (const std::int32_t twin : {face, earlier}) add(twin, flipped_duplicate);
    for (const auto& [first, second] : health.self_intersections)
        for (const std::int32_t face : {first, second}) add(face, self_intersection);
    return {problems.begin(), problems.end()};
}

std::vector<double> problems_of(const Bodies& bodies) {
    std::vector<std::vector<double>> of_inputs;
    for (const InputReport& input : bodies.inputs) of_inputs.push_back(problems_of_input(input.health));
    std::vector<double> problems;
    for (std::size_t face = 0; face < bodies.face_input.size(); ++face)
        problems.push_back(of_inputs[at(bodies.face_input[face])][at(bodies.face_of_input[face])]);
    return problems;
}

}  // namespace

run::FolderLock prepare_output(const fs::path& out) {
    run::FolderLock lock(out, detect_program.name);
    std::vector<std::string> names{"summary.json", "candidates.csv", "overlaps.csv",
                                   "contacts.csv", "nearest.csv",    "steps.csv"};
    for (const auto& entry : fs::directory_iterator(out))
        if (is_picture(entry.path().filename().string())) names.push_back(entry.path().filename().string());
    run::claim_results(out, names);
    return lock;
}

Output::Output(const Bodies& bodies, const fs::path& out, int every)
    : bodies_(bodies),
      out_(out),
      every_(every),
      steps_(out / "steps.csv"),
      candidates_(out / "candidates.csv"),
      overlaps_(out / "overlaps.csv"),
      contacts_(out / "contacts.csv"),
      nearest_(out / "nearest.csv") {
    for (std::size_t body = 0; body < bodies.names.size(); ++body) {
        names_.push_back(run::in_csv(bodies.names[body]));
        numbers_.push_back({"body: " + bodies.names[body], static_cast<std::int32_t>(body)});
    }
}

void Output::open() {
    for (run::PartialFile* file : files()) file->open();
    steps_.write("step,searched,box_pairs,candidates,overlaps,area [m^2],gap_min [m],gap_max [m]\n");
    candidates_.write("step,body_1,face_1,body_2,face_2\n");
    overlaps_.write(
        "step,body_1,face_1,body_2,face_2,area [m^2],gap [m],nx [-],ny [-],nz [-],x [m],y [m],z [m],distance [m]\n");
    contacts_.write("step,body_1,body_2,overlaps,area [m^2],gap_min [m],distance_min [m],crosses,depth [m],inside\n");
    nearest_.write("step,body_1,face_1,body_2,face_2,distance [m],x_1 [m],y_1 [m],z_1 [m],x_2 [m],y_2 [m],z_2 [m]\n");
}

void Output::add(const StepResult& result, std::span<const geometry::IndexPair> candidates, bool last) {
    if (!steps_.is_open()) open();
    add_row(result);
    if (last || writes_pairs(result.step)) add_pairs(result, candidates);
    for (run::PartialFile* file : files()) file->flush();
}

void Output::add_row(const StepResult& result) {
    const bool any = !result.overlaps.empty();
    const double none = std::numeric_limits<double>::quiet_NaN();
    steps_.write(fmt::format("{},{},{},{},{},{:.17g},{:.17g},{:.17g}\n", result.step, result.searched ? 1 : 0,
                             result.box_pairs, result.candidates, result.overlaps.size(), result.area,
                             any ? result.gap_min : none, any ? result.gap_max : none));
}

void Output::add_pairs(const StepResult& result, std::span<const geometry::IndexPair> candidates) {
    const Patches patches = patches_of(bodies_, result.overlaps);
    add_candidates(result.step, candidates);
    add_overlaps(result, patches);
    add_contacts(result);
    add_nearest(result);
    write_overlaps(result, patches);
    write_surface(result);
}

void Output::add_candidates(int step, std::span<const geometry::IndexPair> candidates) {
    const auto& body = bodies_.surface.body;
    fmt::memory_buffer rows;
    for (const auto& [face_1, face_2] : candidates)
        fmt::format_to(std::back_inserter(rows), "{},{},{},{},{}\n", step, body[at(face_1)], bodies_.face_label[at(face_1)],
                       body[at(face_2)], bodies_.face_label[at(face_2)]);
    candidates_.write({rows.data(), rows.size()});
}

void Output::add_overlaps(const StepResult& result, const Patches& patches) {
    fmt::memory_buffer rows;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const Overlap<3>& overlap = result.overlaps[i];
        const std::int32_t face_1 = overlap.face_1, face_2 = overlap.face_2;
        const Vector<3> x = middle(patches[i]);
        fmt::format_to(std::back_inserter(rows),
                       "{},{},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
                       result.step, bodies_.surface.body[at(face_1)], bodies_.face_label[at(face_1)],
                       bodies_.surface.body[at(face_2)], bodies_.face_label[at(face_2)], overlap.area, overlap.gap,
                       overlap.normal[0], overlap.normal[1], overlap.normal[2], x[0], x[1], x[2], result.distances[i]);
    }
    overlaps_.write({rows.data(), rows.size()});
}

void Output::add_contacts(const StepResult& result) {
    for (const auto& [pair, contact] : contacts_of(bodies_, result))
        contacts_.write(fmt::format("{},{},{},{},{:.17g},{:.17g},{:.17g},{:d},{:.17g},{}\n", result.step,
                                    names_[at(pair.first)], names_[at(pair.second)], contact.overlaps, contact.area,
                                    contact.gap_min, contact.distance_min, contact.crosses, contact.depth,
                                    contact.inner < 0 ? "" : names_[at(contact.inner)]));
}

void Output::add_nearest(const StepResult& result) {
    for (const auto& [body_1, body_2, faces] : result.neighbours.nearest) {
        const auto& [x_1, x_2, distance] = faces.points;
        nearest_.write(fmt::format("{},{},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", result.step,
                                   names_[at(body_1)], bodies_.face_label[at(faces.face_1)], names_[at(body_2)],
                                   bodies_.face_label[at(faces.face_2)], distance, x_1[0], x_1[1], x_1[2], x_2[0], x_2[1],
                                   x_2[2]));
    }
}

fs::path Output::path(const std::string& stem, int step) const {
    return out_ / (every_ > 0 ? fmt::format("{}_{:06}.vtp", stem, step) : stem + ".vtp");
}

void Output::write_overlaps(const StepResult& result, const Patches& patches) const {
    Polygons polygons;
    for (const auto& patch : patches) polygons.append(patch);
    const OverlapFields fields = fields_of(bodies_, result.overlaps);
    const std::vector<mesh::Field<3>> of_faces = {{"area [m^2]", fields.area},        {"gap [m]", fields.gap},
                                                  {"distance [m]", result.distances}, {"normal", fields.normal},
                                                  {"body_1", fields.body_1},          {"face_1", fields.face_1},
                                                  {"body_2", fields.body_2},          {"face_2", fields.face_2}};
    mesh::write_vtp({polygons.vertices, polygons.offsets, polygons.corners}, path("overlaps", result.step),
                    {.of_faces = of_faces, .numbers = numbers_});
}

void Output::write_surface(const StepResult& result) const {
    const FaceFields fields = fields_of_faces(bodies_, result.overlaps);
    const std::vector<double> problems = problems_of(bodies_);
    const std::vector<mesh::Field<3>> of_faces = {
        {"body", fields.body},         {"face", fields.label},     {"area in contact [m^2]", fields.area},
        {"least gap [m]", fields.gap}, {"overlaps", fields.pairs}, {"problems", problems}};
    const auto& surface = bodies_.surface;
    mesh::write_vtp({surface.vertices, surface.face_offsets, surface.face_vertices}, path("surface", result.step),
                    {.of_faces = of_faces, .numbers = numbers_});
}

void Output::finish() {
    for (run::PartialFile* file : files()) file->finish();
}

}  // namespace abut::apps
