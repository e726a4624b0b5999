#!/bin/bash
# DUNE grid-glue: the contact surface of two unit cubes with 4 and 9 squares, apart and a little inside each other
# Packages of Debian 12: libdune-grid-glue-dev=2.9.0-3, libdune-grid-dev=2.9.0-2, and the other libraries of DUNE 2.9.0 that they need.
#   Needs MPI with its compiler mpicxx.
# Guess: ContactMerge finds what the faces share where they touch, up to some tolerance. Cubes 1 nm apart and 1 nm inside each other have
#   the same area in contact, 1, and cubes 10 m apart have none.
# Seen: 1 nm apart it is 1, and 10 m apart as well, as there is no largest gap. 1 nm inside each other it is 0, without a word: the default of
#   the overlap that is allowed is 0. A state after a step by penalty, or by roundings of a Lagrange multiplier, has no contact.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libdune-grid-glue-dev=2.9.0-3 libdune-grid-dev=2.9.0-2
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH="$work/usr/lib/x86_64-linux-gnu"
export LD_LIBRARY_PATH

for name in COMMON GEOMETRY GRID UGGRID GRID_GLUE; do
    printf '#define DUNE_%s_VERSION_MAJOR 2\n#define DUNE_%s_VERSION_MINOR 9\n#define DUNE_%s_VERSION_REVISION 0\n' $name $name $name
done > config.h
cat > a.cpp <<'C'
#include "config.h"
#include <array>
#include <cstdio>
#include <memory>
#include <dune/common/parallel/mpihelper.hh>
#include <dune/grid/yaspgrid.hh>
#include <dune/grid-glue/extractors/codim1extractor.hh>
#include <dune/grid-glue/gridglue.hh>
#include <dune/grid-glue/merging/contactmerge.hh>
using Grid = Dune::YaspGrid<3, Dune::EquidistantOffsetCoordinates<double, 3>>;
using Surface = Dune::GridGlue::Codim1Extractor<Grid::LeafGridView>;
using Cell = Grid::Codim<0>::Entity;
using Merge = Dune::GridGlue::ContactMerge<3, double>;
void join(double gap, const std::shared_ptr<Merge>& merge, const char* name) {
    const Grid lower({0, 0, 0}, {1, 1, 1}, std::array{2, 2, 1}), upper({0, 0, 1 + gap}, {1, 1, 2 + gap}, std::array{3, 3, 1});
    const auto top = [](const Cell&, unsigned face) { return face == 5; };
    const auto bottom = [](const Cell&, unsigned face) { return face == 4; };
    Dune::GridGlue::GridGlue<Surface, Surface> glue(std::make_shared<Surface>(lower.leafGridView(), top),
                                                    std::make_shared<Surface>(upper.leafGridView(), bottom), merge);
    glue.build();
    double area = 0;
    for (const auto& piece : intersections(glue)) area += piece.geometry().volume();
    std::printf("seen: gap %g m%s: area %g\n", gap, name, area);
}
int main(int argc, char** argv) {
    Dune::MPIHelper::instance(argc, argv);
    for (const double gap : {0.0, 1e-9, 10.0, -1e-9, -1e-3}) join(gap, std::make_shared<Merge>(), "");
    join(-1e-3, std::make_shared<Merge>(1e-2), ", 10 mm allowed");
}
C
mpicxx -std=c++17 -w -I. -I"$work/usr/include" a.cpp -o a -L"$LD_LIBRARY_PATH" -ldunegridglue -ldunegrid -ldunegeometry -ldunecommon
./a | sed -n "s/^seen: //p" | tee output
diff output - <<'C'
gap 0 m: area 1
gap 1e-09 m: area 1
gap 10 m: area 1
gap -1e-09 m: area 0
gap -0.001 m: area 0
gap -0.001 m, 10 mm allowed: area 1
C
