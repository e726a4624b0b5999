#include "studies/schemes/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "abut/base/text.hpp"
#include "abut/run/files/files.hpp"

namespace abut::studies {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view beginning = R"gp(# {0}: gnuplot {1}.gp
if (!exists("picture")) picture = "{1}.png"
set terminal pngcairo size {2},{3} font "Sans,13" background "white"
set output picture
set datafile separator ","
set lmargin 12
set rmargin 3
set border 3 lc rgb "#404040"
set tics nomirror
set grid lc rgb "#e4e4e4" lt 1
)gp";

/// Exit code of gnuplot in a folder, its words thrown away; -1 if it is not there.
int run_gnuplot(const fs::path& directory, const std::string& setting, const std::string& script) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
    std::array<std::string, 4> words = {"gnuplot", "-e", setting, script};
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

std::string draw(const fs::path& directory, const Picture& picture) {
    const std::string script = picture.name + ".gp", partial_name = picture.name + ".partial.png";
    run::write_whole(
        directory / script,
        fmt::format(fmt::runtime(beginning), picture.purpose, picture.name, picture.width, picture.height) + picture.script);
    const fs::path partial = directory / partial_name;
    const int code = run_gnuplot(directory, fmt::format("picture='{}'", partial_name), script);
    std::error_code error;
    if (code == 0 && fs::exists(partial)) {
        run::move_file(partial, directory / (picture.name + ".png"));
        return "";
    }
    fs::remove(partial, error);
    if (code == -1)
        return fmt::format("gnuplot is not installed: install gnuplot-nox, then run gnuplot {} in {}", script,
                           directory.string());
    return fmt::format("gnuplot ended with code {}: run gnuplot {} in {} to see why", code, script, directory.string());
}

std::string in_quotes(const std::string& text) {
    std::string doubled;
    for (const char c : in_one_line(as_utf8(text))) doubled.append(c == '\'' ? 2 : 1, c);
    return doubled;
}

}  // namespace abut::studies
