#include <catch2/catch.hpp>
#include <string>

#include "abut/run/user_words.hpp"

using namespace abut::run;

TEST_CASE("names of C++ and numbers of bodies become words of the scene", "[run][words]") {
    const SceneNames names{{"left", "ball"}, {"floor"}};
    CHECK(in_user_words("mesh: the acceleration of body 1 ('ball') is not finite. Correct SolidOptions::acceleration.",
                        names) == "mesh: the acceleration of body 'ball' is not finite. Correct gravity.");
    CHECK(in_user_words("obstacle 0: its displacement at t = 1 s is not finite. Correct RigidObstacle::path.", names) ==
          "obstacle 'floor': its displacement at t = 1 s is not finite. Correct its path.");
    CHECK(in_user_words("body 7 and rigid body 0 of 2 bodies, somebody 1", names) ==
          "body 7 and rigid body 'left' of 2 bodies, somebody 1");
    CHECK(in_user_words("nodal contact: node 3 of body 1", names) == "nodal contact: node 3 of body 1");
    CHECK(in_user_words("only bodies of Kinematics::small and Kinematics::floating can") ==
          "only bodies of kinematics \"small\" and kinematics \"floating\" can");
}

TEST_CASE("options of a command line become keys, once", "[run][words]") {
    CHECK(with_keys("lower --cfl or --dt.") == "lower run.cfl (--cfl) or run.dt (--dt).");
    CHECK(with_keys("--filter neutral: take --filter none.") ==
          "run.filter = \"neutral\" (--filter neutral): take run.filter = \"none\" (--filter none).");
    CHECK(with_keys("with --restart 50 and") == "with run.restart = 50 (--restart 50) and");
    CHECK(with_keys("take a --facing-cosine nearer to 0") ==
          "take a laboratory.facing_cosine (--lab facing_cosine) nearer to 0");
    for (const char* kept : {"--out DIR, --verify, a--cfl, --", "", "run.cfl (--cfl)", "StepDevice (--device host)"})
        CHECK(with_keys(kept) == kept);
    const std::string once = with_keys("--filter neutral, --time, --levels 3.");
    CHECK(with_keys(once) == once);
}
