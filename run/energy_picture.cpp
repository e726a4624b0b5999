#include "abut/run/energy_picture.hpp"

#include <fmt/format.h>

#include <string_view>

#include "abut/run/gnuplot.hpp"

namespace abut::run {
namespace {

constexpr std::string_view script = R"gp(H0 = {:.17g}  # H~ at the start [J]
scale = {:.17g}  # what drifts are divided by [J]
set multiplot
set key right center samplen 2.5 opaque
set autoscale xfixmax
set mytics 1

set origin 0,0.46
set size 1,0.54
set title '{}' font ",15" noenhanced
set ylabel "energy [J]"
set format x ""
set yrange [*<0:*]
plot "energy.csv" using "time":"kinetic" with lines lw 2 lc rgb "#2a78d6" title "kinetic", \
     "" using "time":"potential" with lines lw 2 lc rgb "#eb6834" title "potential", \
     "" using "time":"energy" with lines lw 4 lc rgb "#b9b8b4" title "H", \
     "" using "time":"pseudo_energy" with lines lw 1.5 lc rgb "#1b1b1a" title "H̃"

set origin 0,0
set size 1,0.46
unset title
set ylabel "relative to {}"
set xlabel "time [s]"
set format x "%g"
set format y "10^{{%L}}"
set logscale y
set yrange [1e-18:1]
set ytics 1e-18,1e3,1
unset mytics
shown(x) = x < 1e-18 ? 1e-18 : x  # an exact zero has no logarithm
plot "energy.csv" using "time":(shown((column("energy")-column("pseudo_energy"))/scale)) with lines lw 2 lc rgb "#eb6834" title "H − H̃", \
     "" using "time":(shown(abs(column("pseudo_energy")-column("work")-H0)/scale)) with points pt 7 ps 0.5 lc rgb "#1b1b1a" title "|H̃ − H̃_0 − work|"
unset multiplot
)gp";

/// "K_0", "E"
std::string with_index(const std::string& name) { return name.size() < 2 ? name : name.substr(0, 1) + "_" + name.substr(1); }

}  // namespace

std::string draw_energy(const std::filesystem::path& directory, const EnergyPicture& picture) {
    return draw(directory, {.name = "energy",
                            .purpose = "Energies of a run, from energy.csv beside this file",
                            .script = fmt::format(fmt::runtime(script), picture.pseudo_energy, picture.scale,
                                                  in_quotes(picture.title), with_index(picture.scale_name))});
}

}  // namespace abut::run
