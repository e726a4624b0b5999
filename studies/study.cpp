// What we measure ourselves by: study NAME runs a study, study list names them all, study NAME --help explains one.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "studies/program/entry.hpp"

namespace {

using namespace abut::studies;

const abut::apps::Program program{.name = "study",
                                  .purpose = "Cases with known answers, and what choices cost: study NAME runs a study.",
                                  .footer = "study list names all studies, study NAME --help lists the options of one."};

void print_list(const std::vector<Entry>& studies) {
    for (const Entry& study : studies) fmt::print("{:<18}{}\n", study.name, study.purpose);
}

/// No study is named: the list, --help, or a message.
int run_without_study(int argc, char** argv, const std::vector<Entry>& studies) {
    std::vector<std::string> known{"list"};
    for (const Entry& study : studies) known.push_back(study.name);
    return run_command(
        program, argc, argv, [&](Flags& flags) { flags.positional("NAME", "of a study, or list for all of them", known); },
        [&] { print_list(studies); });
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<Entry> studies = all_studies();
    const auto study = argc < 2 ? studies.end() : std::ranges::find(studies, argv[1], &Entry::name);
    return study == studies.end() ? run_without_study(argc, argv, studies) : study->run(argc - 1, argv + 1);
}
