#include "apps/detect/report.hpp"

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/base/index.hpp"
#include "apps/support/choices.hpp"
#include "apps/support/standard_streams.hpp"

namespace abut::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_lines = 10;  // bodies, or pairs of them, that are printed

/// Largest memory of this process so far [MB].
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss) / 1e6;
}

Json gap_or_null(const DetectReport& report, double gap) { return report.last.overlaps.empty() ? Json() : Json(gap); }

Json health_json(const InputReport& input) {
    const auto& health = input.health;
    Json faults = Json::object();
    for (std::size_t fault = 1; fault < health.n_faults.size(); ++fault)
        if (health.n_faults[fault] > 0)
            faults[std::string(geometry::name(static_cast<geometry::FaceFault>(fault)))] = health.n_faults[fault];
    return {{"faces", health.n_faces},
            {"vertices", health.n_vertices},
            {"components", health.components.size()},
            {"closed", health.closed()},
            {"sound", health.sound()},
            {"area", health.area},
            {"holes", health.n_holes},
            {"boundary_edges", health.boundary_edges.size()},
            {"non_manifold_edges", health.non_manifold_edges.size()},
            {"inconsistent_edges", health.inconsistent_edges.size()},
            {"flipped_duplicates", health.flipped_duplicates.size()},
            {"unusable_faces", health.unusable_faces.size()},
            {"unusable_by_reason", faults},
            {"slivers", health.slivers.size()},
            {"worst_aspect", health.worst_aspect},
            {"worst_aspect_face", health.worst_aspect_face},
            {"non_planar_faces", health.non_planar_faces.size()},
            {"unreferenced_vertices", health.unreferenced_vertices.size()},
            {"unwelded_vertices", health.n_unwelded_vertices},
            {"self_intersections", health.looked_for_self_intersections ? Json(health.n_self_intersections) : Json()}};
}

Json inputs_json(const Bodies& bodies) {
    Json inputs = Json::array();
    for (const InputReport& input : bodies.inputs)
        inputs.push_back({{"name", input.name},
                          {"health", health_json(input)},
                          {"in_words", input.lines},
                          {"used_faces", input.n_used_faces},
                          {"skipped_faces", input.n_skipped_faces},
                          {"cut_faces", input.n_cut_faces},
                          {"flat_pieces_left_out", input.n_flat_pieces},
                          {"ignored_elements", input.n_ignored_elements},
                          {"warnings", input.warnings}});
    return inputs;
}

Json contacts_json(const DetectReport& report) {
    Json contacts = Json::array();
    for (const auto& [pair, contact] : contacts_of(report.bodies, report.last))
        contacts.push_back({{"body_1", pair.first},
                            {"body_2", pair.second},
                            {"overlaps", contact.overlaps},
                            {"area", contact.area},
                            {"gap_min", contact.gap_min},
                            {"distance_min", contact.distance_min},
                            {"crosses", contact.crosses},
                            {"depth", contact.depth},
                            {"inside", contact.inner < 0 ? Json() : Json(contact.inner)}});
    return contacts;
}

Json nearest_json(const DetectReport& report) {
    const auto point = [](const Vector<3>& x) { return Json{x[0], x[1], x[2]}; };
    Json nearest = Json::array();
    for (const auto& [body_1, body_2, faces] : report.last.neighbours.nearest)
        nearest.push_back({{"body_1", body_1},
                           {"face_1", report.bodies.face_label[at(faces.face_1)]},
                           {"point_1", point(faces.points.point_1)},
                           {"body_2", body_2},
                           {"face_2", report.bodies.face_label[at(faces.face_2)]},
                           {"point_2", point(faces.points.point_2)},
                           {"distance", faces.points.distance}});
    return nearest;
}

Json inside_json(const DetectReport& report) {
    Json inside = Json::array();
    for (const auto& [inner, outer, distance] : report.last.neighbours.inside)
        inside.push_back({{"inner", inner}, {"outer", outer}, {"distance", distance}});
    return inside;
}

Json search_json(const DetectReport& report) {
    const auto& search = report.search;
    return {{"lists_made", search.searches},
            {"skin", report.skin},
            {"box_pairs", search.box_pairs},
            {"neighbours", search.neighbours},
            {"both_rigid", search.both_rigid},
            {"not_facing", search.not_facing},
            {"out_of_reach", search.too_far_apart},
            {"candidates", search.candidates},
            {"candidates_max", search.candidates_max},
            {"seconds_boxes", search.seconds_boxes},
            {"seconds_broad_phase", search.seconds_broad_phase}};
}

Json last_json(const DetectReport& report) {
    const StepResult& last = report.last;
    return {{"step", last.step},
            {"overlaps", last.overlaps.size()},
            {"too_far", last.too_far},
            {"too_deep", last.too_deep},
            {"too_steep", last.too_steep},
            {"area", last.area},
            {"gap_min", gap_or_null(report, last.gap_min)},
            {"gap_max", gap_or_null(report, last.gap_max)},
            {"distance_min", last.distances.empty() ? Json() : Json(*std::ranges::min_element(last.distances))}};
}

Json verification_json(const Verification& verification) {
    return {{"faces", verification.faces},
            {"sampled", verification.sampled},
            {"pairs_tested", verification.tested},
            {"required", verification.required},
            {"on_limit", verification.on_limit},
            {"missed_candidates", verification.missed_candidates},
            {"missed_overlaps", verification.missed_overlaps},
            {"wrong_overlaps", verification.wrong_overlaps},
            {"area_error_max", verification.area_error},
            {"gap_error_max", verification.gap_error},
            {"first_fault", verification.first_fault.empty() ? Json() : Json(verification.first_fault)}};
}

Json seconds_json(const DetectTimes& seconds) {
    return {{"reading", seconds.input.reading}, {"health", seconds.input.health},
            {"setup", seconds.setup},           {"motion", seconds.motion},
            {"search", seconds.search},         {"narrow", seconds.narrow},
            {"nearest", seconds.nearest},       {"verification", seconds.verification},
            {"writing", seconds.writing}};
}

void print_line(const std::string& name, const std::string& value) { say(fmt::format("  {:<43} {}\n", name, value)); }

/// The health of the files, and what was done about it.
void print_inputs(const Bodies& bodies) {
    for (const InputReport& input : bodies.inputs) {
        say(input.name + ":\n");
        for (const std::string& line : input.lines) say("  " + line + "\n");
        if (input.n_cut_faces > 0)
            say(fmt::format("  {} cut into triangles, {} of them without area left out\n",
                            counted(input.n_cut_faces, "face that is not flat is", "faces that are not flat are"),
                            input.n_flat_pieces));
    }
}

void print_bodies(const Bodies& bodies) {
    std::vector<std::int64_t> n_faces(bodies.names.size(), 0);
    for (const std::int32_t body : bodies.surface.body) ++n_faces[at(body)];
    for (std::size_t body = 0; body < std::min(n_faces.size(), most_lines); ++body)
        print_line(fmt::format("body {}", body), fmt::format("{}, {}", bodies.names[body], counted(n_faces[body], "face")));
    if (n_faces.size() > most_lines)
        print_line("", "and " + counted(std::ssize(n_faces) - std::int64_t{most_lines}, "more body"));
}

void print_search(const DetectReport& report) {
    const auto& search = report.search;
    print_line("lists made", fmt::format("{}, the last with a skin of {:.4g} m", search.searches, report.skin));
    print_line("pairs of boxes, last list", fmt::format("{}", search.box_pairs));
    print_line("  left out: not facing, reach, neighbours",
               fmt::format("{}, {}, {}", search.not_facing, search.too_far_apart, search.neighbours));
    print_line("candidates", fmt::format("{} (at most {})", search.candidates, search.candidates_max));
}

void print_last(const DetectReport& report) {
    const StepResult& last = report.last;
    print_line("overlaps", fmt::format("{} ({} more are too far apart, {} too deep, {} too steep)", last.overlaps.size(),
                                       last.too_far, last.too_deep, last.too_steep));
    if (last.overlaps.empty()) return;
    print_line("area in contact", fmt::format("{:.9g} m^2", last.area));
    print_line("gap, least and largest", fmt::format("{:.9g} to {:.9g} m", last.gap_min, last.gap_max));
    print_line("distance of faces in space, least", fmt::format("{:.6g} m", *std::ranges::min_element(last.distances)));
    std::size_t line = 0;
    const BodyContacts contacts = contacts_of(report.bodies, report.last);
    for (const auto& [pair, contact] : contacts) {
        if (contact.overlaps == 0) continue;
        if (++line > most_lines) break;
        print_line(fmt::format("  {} - {}", report.bodies.names[at(pair.first)], report.bodies.names[at(pair.second)]),
                   fmt::format("{}, {:.6g} m^2, least gap {:.6g} m, faces {:.6g} m apart",
                               counted(contact.overlaps, "overlap"), contact.area, contact.gap_min, contact.distance_min));
    }
    if (line > most_lines) print_line("", "and more pairs of bodies, in contacts.csv");
}

std::string in_words(const Bodies& bodies, std::int32_t body, std::int32_t face, const Vector<3>& x) {
    return fmt::format("'{}', face {} at ({:.6g}, {:.6g}, {:.6g})", bodies.names[at(body)], bodies.face_label[at(face)],
                       x[0], x[1], x[2]);
}

/// Bodies and the nearest to each, the nearest of all first.
std::vector<NearestBodies> by_distance(const DetectReport& report) {
    std::vector<NearestBodies> nearest = report.last.neighbours.nearest;
    std::ranges::stable_sort(nearest, {}, [](const NearestBodies& pair) { return pair.faces.points.distance; });
    return nearest;
}

/// "0.2 m^2 lie opposite each other within 0.1 m"
std::string facing_text(const DetectReport& report, const BodyContact* contact) {
    if (!contact || contact->overlaps == 0)
        return fmt::format("no faces within {:.4g} m lie opposite each other", report.near.distance);
    return fmt::format("{:.4g} m^2 lie opposite each other within {:.4g} m", contact->area, report.near.distance);
}

/// "are 0.2 m apart", "touch each other", "cross each other, 0.1 m deep"
std::string meeting_text(double distance, const BodyContact* contact) {
    if (distance > 0.0) return fmt::format("are {:.4g} m apart", distance);
    if (!contact || !contact->crosses) return "touch each other";
    return fmt::format("cross each other, {:.4g} m deep,", contact->depth);
}

/// The answer, before how it was found: which bodies are inside of others, how near each is to its nearest one, and
/// which others have faces that lie opposite.
void print_answer(const DetectReport& report) {
    constexpr std::size_t most_answers = 5;
    const std::vector<std::string>& names = report.bodies.names;
    const BodyContacts contacts = contacts_of(report.bodies, report.last);
    std::set<std::pair<std::int32_t, std::int32_t>> told;
    std::vector<std::string> answers;
    for (const InsideBody& body : report.last.neighbours.inside) {
        told.insert(std::minmax(body.inner, body.outer));
        answers.push_back(fmt::format("'{}' is wholly inside of '{}', {:.4g} m from its surface", names[at(body.inner)],
                                      names[at(body.outer)], body.distance));
    }
    for (const auto& [body_1, body_2, faces] : by_distance(report)) {
        if (!told.insert({body_1, body_2}).second) continue;
        const auto& [x_1, x_2, distance] = faces.points;
        const auto found = contacts.find({body_1, body_2});
        const BodyContact* contact = found == contacts.end() ? nullptr : &found->second;
        answers.push_back(fmt::format("'{}' and '{}' {} at ({:.4g}, {:.4g}, {:.4g}); {}", names[at(body_1)],
                                      names[at(body_2)], meeting_text(distance, contact), x_1[0], x_1[1], x_1[2],
                                      facing_text(report, contact)));
    }
    for (const auto& [pair, contact] : contacts) {
        if (told.contains(pair)) continue;
        const std::string other = pair.first == pair.second ? "itself" : "'" + names[at(pair.second)] + "'";
        const std::string crossing = contact.crosses ? meeting_text(0.0, &contact) + " " : "";
        answers.push_back(
            fmt::format("'{}' and {}: {}{}", names[at(pair.first)], other, crossing, facing_text(report, &contact)));
    }
    if (answers.empty()) answers.push_back(facing_text(report, nullptr));
    for (std::size_t i = 0; i < std::min(answers.size(), most_answers); ++i) say(answers[i] + "\n");
    if (answers.size() > most_answers) say(fmt::format("and {} more\n", answers.size() - most_answers));
    for (const InputReport& input : report.bodies.inputs)
        if (input.n_skipped_faces > 0)
            say(fmt::format("warning: {}: {} left out\n", input.name,
                            counted(input.n_skipped_faces, "unusable face is", "unusable faces are")));
}

void print_nearest(const DetectReport& report) {
    const std::vector<NearestBodies> nearest = by_distance(report);
    for (std::size_t i = 0; i < std::min(nearest.size(), most_lines); ++i) {
        const auto& [body_1, body_2, faces] = nearest[i];
        const auto& [x_1, x_2, distance] = faces.points;
        print_line(i == 0 ? "nearest bodies" : "",
                   fmt::format("{:.9g} m: {}, and {}", distance, in_words(report.bodies, body_1, faces.face_1, x_1),
                               in_words(report.bodies, body_2, faces.face_2, x_2)));
    }
    if (nearest.size() > most_lines)
        print_line("", "and " + counted(std::ssize(nearest) - std::int64_t{most_lines}, "more pair of bodies",
                                        "more pairs of bodies"));
    if (const std::size_t n = report.bodies.names.size(); n > most_nearest_bodies)
        print_line("nearest bodies", fmt::format("not looked for: {} bodies, at most {}", n, most_nearest_bodies));
}

/// Surfaces that do not meet, and bodies that do.
void print_inside(const DetectReport& report) {
    const std::vector<InsideBody>& inside = report.last.neighbours.inside;
    for (std::size_t i = 0; i < std::min(inside.size(), most_lines); ++i)
        print_line(i == 0 ? "wholly inside of another body" : "",
                   fmt::format("'{}' is inside of '{}', {:.6g} m from its surface", report.bodies.names[at(inside[i].inner)],
                               report.bodies.names[at(inside[i].outer)], inside[i].distance));
    if (inside.size() > most_lines)
        print_line("", "and " + counted(std::ssize(inside) - std::int64_t{most_lines}, "more body"));
}

void print_verification(const DetectReport& report) {
    if (!report.verified) return;
    const Verification& found = report.verification;
    print_line("verified against all pairs",
               fmt::format("{} tested, {} required, {} missed, {} wrong, {} within rounding of a limit",
                           counted(found.tested, "pair"), found.required, found.missed_candidates + found.missed_overlaps,
                           found.wrong_overlaps, found.on_limit));
    if (found.sampled) print_line("  by a sample of faces against all", fmt::format("{}", found.faces));
    print_line("  largest error of area and gap",
               fmt::format("{:.2g} of the smaller face, {:.2g} m", found.area_error, found.gap_error));
}

void print_costs(const DetectReport& report) {
    const auto& [by_doubles, by_scalar_path, by_exact] = report.decided;
    print_line("decided by doubles, one by one, exactly", fmt::format("{}, {}, {}", by_doubles, by_scalar_path, by_exact));
    const DetectTimes& s = report.seconds;
    print_line("time",
               fmt::format("reading {:.2f} s, health {:.2f}, setup {:.2f}, motion {:.2f}, search {:.3f}, narrow phase "
                           "{:.3f}, nearest {:.2f}, verification {:.2f}, writing {:.2f}",
                           s.input.reading, s.input.health, s.setup, s.motion, s.search, s.narrow, s.nearest, s.verification,
                           s.writing));
    print_line("memory at most", fmt::format("{:.1f} MB", peak_memory()));
}

}  // namespace

Json summary(const DetectReport& report, const DetectOptions& options) {
    Json json = {{"program", detect_program.name},        {"version", ABUT_VERSION},
                 {"inputs", inputs_json(report.bodies)},  {"bodies", report.bodies.names},
                 {"faces", report.bodies.surface.size()}, {"steps", report.steps},
                 {"complete", report.complete},           {"mean_face_size", report.bodies.mean_face_size()},
                 {"distance", report.near.distance},      {"depth", report.near.depth}};
    json["search"] = search_json(report);
    json["last_step"] = last_json(report);
    json["overlaps_max"] = report.overlaps_max;
    json["contacts"] = contacts_json(report);
    json["nearest"] = nearest_json(report);
    json["inside"] = inside_json(report);
    json["decided"] = {{"by_doubles", report.decided.by_doubles},
                       {"by_scalar_path", report.decided.by_scalar_path},
                       {"by_exact_arithmetic", report.decided.by_exact_arithmetic}};
    json["verification"] = report.verified ? verification_json(report.verification) : Json();
    json["seconds"] = seconds_json(report.seconds);
    json["memory_peak_mb"] = peak_memory();
    json["options"] = to_json(options);
    return json;
}

void print(const DetectReport& report, const DetectOptions& options) {
    const Bodies& bodies = report.bodies;
    print_answer(report);
    print_inputs(bodies);
    say(fmt::format("detect: {}, {}, step {}{}\n", counted(std::ssize(bodies.names), "body"),
                    counted(bodies.surface.size(), "face"), report.last.step,
                    report.complete ? fmt::format(" of {}", report.steps) : ", asked to stop before the end"));
    print_bodies(bodies);
    print_line("mean size of a face, sqrt(area)", fmt::format("{:.6g} m", bodies.mean_face_size()));
    print_line("gaps kept", fmt::format("above {:.6g} m, up to {:.6g} m", -report.near.depth, report.near.distance));
    print_search(report);
    print_last(report);
    print_nearest(report);
    print_inside(report);
    print_verification(report);
    print_costs(report);
    if (!options.no_files) print_line("files in", options.out.string());
}

}  // namespace abut::apps
