#include "support/energy_picture.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "support/files.hpp"

namespace abut::examples {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view script = R"gp(# Energies of a run, from energy.csv beside this file: gnuplot energy.gp
H0 = {:.17g}  # H~ at the start [J]
scale = {:.17g}  # what drifts are divided by [J]
if (!exists("picture")) picture = "energy.png"
set terminal pngcairo size 1200,1000 font "Sans,13" background "white"
set output picture
set datafile separator ","
set multiplot
set lmargin 12
set rmargin 3
set border 3 lc rgb "#404040"
set tics nomirror
set grid lc rgb "#e4e4e4" lt 1
set key right center samplen 2.5 opaque
set autoscale xfixmax
set mytics 1

set origin 0,0.46
set size 1,0.54
set title "{}" font ",15" noenhanced
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
set ylabel "relative to {}_{}"
set xlabel "time [s]"
set format x "%g"
set format y "10^{{%L}}"
set logscale y
set yrange [1e-18:1]
set ytics 1e-18,1e3,1
unset mytics
shown(x) = x < 1e-18 ? 1e-18 : x  # an exact zero has no logarithm
plot "energy.csv" using "time":(shown((column("energy")-column("pseudo_energy"))/scale)) with lines lw 2 lc rgb "#eb6834" title "H − H̃", \
     "" using "time":(shown(abs(column("pseudo_energy")-column("work")-H0)/scale)) with points pt 7 ps 0.5 lc rgb "#1b1b1a" title "|H̃ − H̃_0|"
unset multiplot
)gp";

/// Exit code of gnuplot in a folder, its words thrown away; -1 if it is not there.
int run_gnuplot(const fs::path& directory, const std::string& setting) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
    std::array<std::string, 4> words = {"gnuplot", "-e", setting, "energy.gp"};
    std::array<char*, 5> arguments = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
    pid_t process = 0;
    const int error = posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) return -1;
    int status = 0;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR) return 1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

std::string draw_energy(const fs::path& directory, const EnergyPicture& picture) {
    write_whole(directory / "energy.gp",
                fmt::format(fmt::runtime(script), picture.pseudo_energy, picture.scale, picture.title,
                            picture.scale_name.substr(0, 1), picture.scale_name.substr(1)));
    const fs::path partial = directory / "energy.partial.png";
    const int code = run_gnuplot(directory, "picture='energy.partial.png'");
    std::error_code error;
    if (code == 0 && fs::exists(partial)) {
        move_file(partial, directory / "energy.png");
        return "";
    }
    fs::remove(partial, error);
    if (code == -1)
        return "gnuplot is not installed: install gnuplot-nox, then run gnuplot energy.gp in " + directory.string();
    return fmt::format("gnuplot ended with code {}: run gnuplot energy.gp in {} to see why", code, directory.string());
}

}  // namespace abut::examples
