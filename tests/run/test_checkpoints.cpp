// A run that is stopped and goes on leaves the files of the run that was not.
#include <H5Cpp.h>
#include <hdf5.h>

#include <catch2/catch.hpp>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <span>
#include <sstream>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/run/files/checkpoint_file.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "run/folder.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using test::Folder;
namespace fs = std::filesystem;

/// Asks to stop after some step.
class StopAfter : public run::Observer<2> {
public:
    explicit StopAfter(std::int64_t step) : step_(step) {}
    void look(const dynamics::RunView<2>& view, solid::Solid<2>&) override { now_ = view.steps + 1; }
    [[nodiscard]] bool asks_to_stop() const override { return now_ == step_; }

private:
    std::int64_t step_;
    std::int64_t now_ = 0;
};

/// Runs the block, from the start or from the last checkpoint, until a step or to its end.
run::RunResult<2> run_block(run::RunOptions options, std::int64_t stop_after = -1) {
    const run::Scene<2> scene = test::block_on_plane(0.05);
    run::ResultFiles<2> files(options, "block", "bodies");
    StopAfter stop(stop_after);
    run::Observers<2> observers{files, stop};
    run::RunResult<2> result = [&] {
        if (!options.resume) return run::simulate<2>(scene, options, observers);
        const auto found = files.last_checkpoint();
        return run::simulate<2>(scene, options, observers, &found.checkpoint);
    }();
    files.finish(scene, result);
    return result;
}

/// Contents of the files of a folder by name; of summary.json without times and lists of candidates, which begin again.
std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file() || name == "report.html") continue;
        std::string text = test::read_text(entry.path());
        if (name.ends_with(".vtp")) text.clear();  // gaps of faces that nothing is near depend on the last search
        contents[name] = text;
    }
    const std::string report = test::read_text(folder / "report.html");
    const std::size_t pictures = report.find("<div class=\"pictures\">");
    REQUIRE(pictures != std::string::npos);
    contents["pictures"] = report.substr(pictures, report.find("</section>", pictures) - pictures);
    auto summary = nlohmann::json::parse(contents.at("summary.json"));
    for (const char* other : {"seconds", "contact_share", "resumed_after", "rebuilds", "candidates"}) summary.erase(other);
    for (const char* other : {"out", "threads", "skin"}) summary["options"].erase(other);
    contents["summary.json"] = summary.dump(1);
    return contents;
}

}  // namespace

TEST_CASE("a run that was stopped and goes on leaves the files of the run that was not", "[run][checkpoint]") {
    using run::SolidIntegrator;
    run::RunOptions options{.steps = 60, .interval = 7, .frames = 5, .animation = 4};
    SECTION("MEMM") {}
    SECTION("MEMM with filter and neutral restarts") {
        options.filter = true;
        options.restart = 9;
    }
    SECTION("leapfrog") { options.integrator = SolidIntegrator::leapfrog; }
    SECTION("Bilbao") {
        options.integrator = SolidIntegrator::bilbao;
        options.gauge = 1.0;
    }
    SECTION("local steps") {
        options.integrator = SolidIntegrator::memm_async;
        options.law = solid::ContactLaw::reconstruction;
    }
    SECTION("bodies that turn") { options.kinematics = run::BodyKinematics::floating; }
    SECTION("rigid bodies") { options.kinematics = run::BodyKinematics::rigid; }
    const Folder folder;
    options.out = folder.path() / "whole";
    const run::RunResult<2> whole = run_block(options);
    REQUIRE(whole.contact.report.active_pairs_max > 0);
    const auto expected = contents(options.out);
    CHECK_FALSE(fs::exists(options.out / "checkpoints"));

    options.out = folder.path() / "in_parts";
    CHECK_FALSE(run_block(options, 13).run.complete);
    options.resume = true;
    CHECK_FALSE(run_block(options, 29).run.complete);
    options.threads = 1;
    const run::RunResult<2> rest = run_block(options);
    CHECK(rest.run.complete);
    CHECK(rest.run.resumed_after == 29);
    const auto found = contents(options.out);
    CHECK(found.size() == expected.size());
    for (const auto& [name, text] : expected) {
        CAPTURE(name);
        REQUIRE(found.contains(name));
        if (name == "summary.json")
            CHECK(found.at(name) == text);
        else
            CHECK((found.at(name) == text));
    }
    CHECK_FALSE(fs::exists(options.out / "checkpoints"));
}

TEST_CASE("a damaged checkpoint is refused, and the one before it is taken", "[run][checkpoint][errors]") {
    const Folder folder;
    run::RunOptions options{.steps = 40, .out = folder.path(), .frames = 0, .checkpoint_steps = 4};
    static_cast<void>(run_block(options, 30));
    const fs::path checkpoints = folder.path() / "checkpoints", last = checkpoints / "step_000000000030.h5",
                   before = checkpoints / "step_000000000028.h5";
    REQUIRE(std::distance(fs::directory_iterator(checkpoints), fs::directory_iterator()) == 2);
    REQUIRE(run::read_checkpoint(last).motion.steps == 30);

    const std::string good = test::read_text(last);
    std::mt19937 random(5);
    std::uniform_int_distribution<std::size_t> place(0, good.size() - 1);
    for (int i = 0; i < 300; ++i) {
        std::string bad = good;
        const std::size_t at = i < 150 ? static_cast<std::size_t>(i) : place(random);
        bad[at] = static_cast<char>(bad[at] ^ (1 << (i % 8)));
        test::write_text(last, bad);
        CAPTURE(i);
        REQUIRE_THROWS_AS(run::read_checkpoint(last), BadInput);
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{100}, std::size_t{512}, good.size() - 1}) {
        test::write_text(last, good.substr(0, size));
        REQUIRE_THROWS_AS(run::read_checkpoint(last), BadInput);
    }
    const auto found = run::CheckpointFolder(checkpoints).last();
    CHECK(found.path == before);
    run::CheckpointFolder(checkpoints).add(found.checkpoint);  // by a run that has gone on from there
    CHECK_FALSE(fs::exists(last));
    CHECK(fs::exists(before));
    REQUIRE(found.refused.size() == 1);
    CHECK_THAT(found.refused[0], Catch::Contains("step_000000000030.h5") && Catch::Contains("damaged"));
    test::write_text(before, "nothing");
    CHECK_THROWS_WITH(run::CheckpointFolder(checkpoints).last(),
                      Catch::Contains("step_000000000028.h5") && Catch::Contains("no checkpoint of Abut"));
}

TEST_CASE("a checkpoint whose parts promise more numbers than its file has bytes is refused before memory is taken",
          "[run][checkpoint][errors]") {
    const Folder folder;
    static_cast<void>(run_block({.steps = 40, .out = folder.path(), .frames = 0, .checkpoint_steps = 4}, 30));
    const fs::path path = folder.path() / "checkpoints" / "step_000000000030.h5";
    const std::string good = test::read_text(path);
    // 2^45 numbers, of which none is stored: a sound file of HDF5 of some hundred bytes
    const fs::path forged = folder.path() / "forged.h5";
    {
        H5::H5File file(forged.string(), H5F_ACC_TRUNC);
        const hsize_t size = hsize_t{1} << 45, chunk = 1024;
        H5::DSetCreatPropList in_chunks;
        in_chunks.setChunk(1, &chunk);
        file.createDataSet("q", H5::PredType::NATIVE_DOUBLE, H5::DataSpace(1, &size), in_chunks);
    }
    const std::string content = test::read_text(forged);
    Checksum checksum;
    checksum.add(std::as_bytes(std::span(content)));
    const std::string version = good.substr(0, good.find("checksum"));
    std::ostringstream text;
    text << version << "checksum " << std::hex << std::setw(16) << std::setfill('0') << checksum.value() << std::dec
         << " of " << content.size() << " bytes after the first 512\n";
    std::string head = text.str();
    head.resize(512, ' ');
    test::write_text(path, head + content);
    CHECK_THROWS_WITH(run::read_checkpoint(path), Catch::Contains("step_000000000030.h5") &&
                                                      Catch::Contains("'q' promises 35184372088832 numbers of 8 bytes"));
}

TEST_CASE("what was being written when a run was killed goes with the next checkpoint, and at the end",
          "[run][checkpoint]") {
    const Folder folder;
    const fs::path checkpoints = folder.path() / "checkpoints", half = checkpoints / "step_000000000012.h5.partial";
    run::RunOptions options{.steps = 40, .out = folder.path(), .frames = 0};
    static_cast<void>(run_block(options, 10));
    test::write_text(half, "half");
    options.resume = true;
    static_cast<void>(run_block(options, 20));
    CHECK_FALSE(fs::exists(half));
    test::write_text(half, "half");
    CHECK(run_block(options).run.complete);
    CHECK_FALSE(fs::exists(checkpoints));
}

TEST_CASE("checkpoints of another format, version or run are refused by name", "[run][checkpoint][errors]") {
    const Folder folder;
    run::RunOptions options{.steps = 40, .out = folder.path(), .frames = 0, .checkpoint_steps = 4};
    static_cast<void>(run_block(options, 30));
    const fs::path last = folder.path() / "checkpoints" / "step_000000000030.h5";
    const std::string good = test::read_text(last);
    const auto with = [&](const std::string& text, const std::string& other) {
        std::string changed = good;
        changed.replace(changed.find(text), text.size(), other);
        return changed;
    };
    test::write_text(last, with("format 2", "format 7"));
    CHECK_THROWS_WITH(run::read_checkpoint(last), Catch::Contains("format 2"));
    test::write_text(last, with("Abut 0.", "Abut 9."));
    CHECK_THROWS_WITH(run::read_checkpoint(last), Catch::Contains("another version"));
    test::write_text(last, good);
    options.resume = true;
    options.filter = true;
    CHECK_THROWS_WITH(run_block(options), Catch::Contains("filter") && Catch::Contains("neutral"));
    options.filter = false;
    options.steps = 50;
    CHECK_THROWS_WITH(run_block(options), Catch::Contains("steps") && Catch::Contains("50"));
    options.steps = 40;
    CHECK(run_block(options).run.complete);
}

TEST_CASE("HDF5 opens a checkpoint, and finds the positions in it", "[run][checkpoint]") {
    const Folder folder;
    const run::RunOptions options{.steps = 40, .out = folder.path(), .frames = 0};
    static_cast<void>(run_block(options, 30));
    const fs::path path = folder.path() / "checkpoints" / "step_000000000030.h5";
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    REQUIRE(file >= 0);
    const hid_t set = H5Dopen2(file, "q", H5P_DEFAULT);
    std::vector<double> q(8);
    REQUIRE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, q.data()) >= 0);
    H5Dclose(set);
    H5Fclose(file);
    CHECK(q == run::read_checkpoint(path).motion.q);
}

TEST_CASE("no checkpoint is kept where none is asked for", "[run][checkpoint]") {
    const Folder folder;
    static_cast<void>(run_block({.steps = 40, .out = folder.path(), .frames = 0, .checkpoint = 0.0}, 30));
    CHECK_FALSE(fs::exists(folder.path() / "checkpoints"));
    CHECK_THROWS_WITH(run_block({.steps = 40, .out = folder.path(), .frames = 0, .resume = true}),
                      Catch::Contains("no checkpoint"));
}
