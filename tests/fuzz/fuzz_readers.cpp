// Reads mutated files: each must be read or refused with an abut::Error that names it, in 10 s and 200 MB.
//
//     fuzz_readers --format obj --executions 100000 --seed 1
//     fuzz_readers file.obj file.ply ...
//
// A file over which a reader fails is kept in the current folder; one over which it crashes or hangs stays where it was tried,
// and its path is printed. Files on the command line are read as they are, with what comes of it and how long it takes.
// Ends with 1 if there was a fault.
#include <signal.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>

#include "fuzz/corpus.hpp"
#include "fuzz/mutate.hpp"
#include "fuzz/read_bytes.hpp"

using namespace abut;

namespace {

constexpr unsigned time_limit = 10;  ///< [s] for one read

std::array<char, 4096> input_path{};  ///< for the handler, which may call next to nothing

void report_crash(int signal_number) {
    const auto say = [](const char* text) {
        if (write(STDERR_FILENO, text, std::strlen(text)) < 0) _exit(3);
    };
    say(signal_number == SIGALRM ? "fault: no end after 10 s, input: " : "fault: crash, input: ");
    say(input_path.data());
    say("\n");
    _exit(2);
}

void watch(const std::filesystem::path& path) {
    std::strncpy(input_path.data(), path.c_str(), input_path.size() - 1);
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) signal(number, report_crash);
}

int replay(const std::vector<std::string>& files) {
    bool has_fault = false;
    for (const std::string& file : files) {
        watch(file);
        alarm(time_limit);
        const auto start = std::chrono::steady_clock::now();
        const fuzz::Outcome outcome = fuzz::read_file(file);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        std::printf("%s%s (%.3f s)\n", outcome.is_fault ? "fault: " : "", outcome.text.c_str(), seconds.count());
        has_fault = has_fault || outcome.is_fault;
    }
    return has_fault ? 1 : 0;
}

int fuzz_format(const std::string& format, long n_executions, unsigned long seed) {
    const std::vector<std::string> files = fuzz::corpus(format);
    const fuzz::ScratchFile input(format);
    watch(input.path());
    for (const std::string& file : files)
        if (const auto outcome = fuzz::read_bytes(file, input.path()); outcome.text != "read")
            throw std::runtime_error("a file of the corpus cannot be read: " + outcome.text);
    std::mt19937_64 random(seed);
    long n_read = 0, n_faults = 0;
    for (long i = 0; i < n_executions; ++i) {
        alarm(time_limit);
        const fuzz::Outcome outcome = fuzz::read_bytes(fuzz::mutated(files, random), input.path());
        n_read += outcome.text == "read";
        if (!outcome.is_fault) continue;
        const std::string kept = "fault_" + std::to_string(seed) + "_" + std::to_string(i) + "." + format;
        std::filesystem::copy_file(input.path(), kept, std::filesystem::copy_options::overwrite_existing);
        std::printf("fault: %s, input: %s\n", outcome.text.c_str(), std::filesystem::absolute(kept).c_str());
        ++n_faults;
    }
    std::printf("%s: %ld mutated files with seed %lu: %ld read, %ld refused, %ld faults\n", format.c_str(), n_executions,
                seed, n_read, n_executions - n_read - n_faults, n_faults);
    return n_faults > 0 ? 1 : 0;
}

unsigned long number_in(const std::string& text) {
    unsigned long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::invalid_argument("'" + text + "' is no whole number of at least 0.");
    return value;
}

int run(const std::vector<std::string>& arguments) {
    std::map<std::string, std::string> options = {{"--format", ""}, {"--executions", "10000"}, {"--seed", "1"}};
    std::vector<std::string> files;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const auto option = options.find(arguments[i]);
        if (option == options.end())
            files.push_back(arguments[i]);
        else if (i + 1 < arguments.size())
            option->second = arguments[++i];
    }
    if (!files.empty()) return replay(files);
    return fuzz_format(options["--format"], static_cast<long>(number_in(options["--executions"])),
                       number_in(options["--seed"]));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::fprintf(
            stderr,
            "fuzz_readers: %s\nfuzz_readers --format obj|stl|ply|off|vtp|vtu|msh --executions N --seed N, or files\n",
            error.what());
        return 2;
    }
}
