#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "abut/run/options.hpp"
#include "studies/table/columns.hpp"
#include "studies/table/study.hpp"

namespace {

using namespace abut;
using namespace abut::studies;

struct Body {
    std::string name;
    double mass = run::not_given;
    std::int64_t cells = 0;
    bool is_rigid = false;
};

const Columns<Body> columns{{"name", "body", -6, &Body::name, "", true},
                            {"mass", "m", 8, &Body::mass},
                            {"", "doubled", 9, [](const Body& body) { return 2.0 * body.mass; }, "{:.3f}"},
                            {"cells", "", 0, &Body::cells},
                            {"rigid", "", 0, &Body::is_rigid}};
const std::vector<Body> bodies{{"a,\"b\"", 0.1, 7, true}, {"c"}};

}  // namespace

TEST_CASE("a column has the same place in heads and lines, as wide as it is asked to be", "[programs][table]") {
    CHECK(heads(columns) == "body         m  doubled");
    CHECK(line(columns, bodies[0]) == "a,\"b\"      0.1    0.200");
    CHECK(line(columns, bodies[0], 2) == "a,\"b\"      0.1");
}

TEST_CASE("what is not known is a dash for people, an empty field and null", "[programs][table]") {
    CHECK(line(columns, bodies[1]) == "c            -        -");
    CHECK(csv_text(columns, bodies) == "name,mass,cells,rigid\n\"a,\"\"b\"\"\",0.10000000000000001,7,1\n\"c\",,0,0\n");
    CHECK(to_json(members(columns, bodies[0])).dump() == R"({"name":"a,\"b\"","mass":0.1,"cells":7,"rigid":true})");
    CHECK(to_json(members(columns, bodies[1]))["mass"].is_null());
}

TEST_CASE("a quantity is met within what is allowed of its reference, or of 1 where that is 0", "[programs][table]") {
    Quantities quantities;
    quantities.near("speed", 10.1, 10.0, 0.011, "m/s");
    quantities.near("drift", 0.02, 0.0, 0.01);
    quantities.at_most("lost", 3.0);
    CHECK(quantities[0].error() == Approx(0.01));
    CHECK(quantities[0].is_met());
    CHECK_FALSE(quantities[1].is_met());
    CHECK_FALSE(quantities[2].has_target());
}
