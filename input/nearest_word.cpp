#include "abut/input/nearest_word.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "abut/base/nearest_word.hpp"
#include "abut/run/option_table.hpp"

namespace abut::input {
namespace {

/// Words of other programs and of equations for a key of ours, in small letters.
struct Synonym {
    std::string_view word;
    std::string_view key;
};
constexpr std::array synonyms = std::to_array<Synonym>({{"e", "young"},
                                                        {"youngs_modulus", "young"},
                                                        {"young_modulus", "young"},
                                                        {"elastic_modulus", "young"},
                                                        {"modulus", "young"},
                                                        {"nu", "poisson"},
                                                        {"poisson_ratio", "poisson"},
                                                        {"poissons_ratio", "poisson"},
                                                        {"rho", "density"},
                                                        {"rho0", "density"},
                                                        {"mass_density", "density"},
                                                        {"t_end", "time"},
                                                        {"tend", "time"},
                                                        {"t_max", "time"},
                                                        {"end", "time"},
                                                        {"end_time", "time"},
                                                        {"final_time", "time"},
                                                        {"duration", "time"},
                                                        {"until", "time"},
                                                        {"n_steps", "steps"},
                                                        {"nsteps", "steps"},
                                                        {"num_steps", "steps"},
                                                        {"time_step", "dt"},
                                                        {"timestep", "dt"},
                                                        {"delta_t", "dt"},
                                                        {"courant", "cfl"},
                                                        {"scheme", "integrator"},
                                                        {"solver", "integrator"},
                                                        {"n_threads", "threads"},
                                                        {"num_threads", "threads"},
                                                        {"h", "size"},
                                                        {"lc", "size"},
                                                        {"mesh_size", "size"},
                                                        {"cell_size", "size"},
                                                        {"element_size", "size"},
                                                        {"resolution", "size"},
                                                        {"r", "radius"},
                                                        {"diameter", "radius"},
                                                        {"center", "place"},
                                                        {"centre", "place"},
                                                        {"position", "place"},
                                                        {"translation", "place"},
                                                        {"translate", "place"},
                                                        {"offset", "place"},
                                                        {"location", "place"},
                                                        {"rotate", "turn"},
                                                        {"rotation", "turn"},
                                                        {"angle", "turn"},
                                                        {"orientation", "turn"},
                                                        {"v", "velocity"},
                                                        {"v0", "velocity"},
                                                        {"initial_velocity", "velocity"},
                                                        {"omega", "spin"},
                                                        {"angular_velocity", "spin"},
                                                        {"min", "lower"},
                                                        {"max", "upper"},
                                                        {"points", "corners"},
                                                        {"vertices", "corners"},
                                                        {"n", "counts"},
                                                        {"divisions", "counts"},
                                                        {"elements", "counts"},
                                                        {"type", "shape"},
                                                        {"kind", "shape"},
                                                        {"geometry", "shape"},
                                                        {"file", "mesh"},
                                                        {"filename", "mesh"},
                                                        {"file", "surface"},
                                                        {"filename", "surface"},
                                                        {"stl", "surface"},
                                                        {"g", "gravity"},
                                                        {"dimension", "dim"},
                                                        {"dimensions", "dim"},
                                                        {"ndim", "dim"},
                                                        {"boundary", "supports"},
                                                        {"boundary_conditions", "supports"},
                                                        {"constraints", "supports"},
                                                        {"loads", "tractions"},
                                                        {"simulation", "run"},
                                                        {"damping", "stiffness_damping"},
                                                        {"rayleigh_alpha", "mass_damping"},
                                                        {"rayleigh_beta", "stiffness_damping"},
                                                        {"viscosity", "quadratic_viscosity"},
                                                        {"directory", "out"},
                                                        {"folder", "out"},
                                                        {"output_dir", "out"}});

/// Words for keys of another table.
struct Elsewhere {
    std::string_view word;
    std::string_view text;
};
constexpr std::string_view friction =
    " Friction is contact.friction = 0.3 for all, or a table [[contact.pairs]] with bodies = [\"a\", \"b\"] or groups for "
    "two.";
constexpr std::array elsewhere = std::to_array<Elsewhere>({{"weights", " It is weighting in [laboratory]."},
                                                           {"neumann", " It is free_faces in [laboratory]."},
                                                           {"friction", friction},
                                                           {"friction_coefficient", friction},
                                                           {"coefficient_of_friction", friction},
                                                           {"mu", friction}});

/// Keys of bodies that fill a surface, which some give with `mesh`.
bool is_of_surfaces(std::string_view word) {
    constexpr std::array words = std::to_array<std::string_view>({"size", "unit", "scale", "keep_triangles"});
    return std::ranges::find(words, word) != words.end();
}

std::string in_small_letters(std::string word) {
    for (char& c : word)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return word;
}

}  // namespace

std::string hint_of_key(const std::string& word, const std::vector<std::string>& known) {
    const std::string small = in_small_letters(word);
    for (const Elsewhere& one : elsewhere)
        if (one.word == small) return std::string(one.text);
    for (const OptionFacts& option : run::run_options())
        if (option.table == "laboratory" && option.scene_key() == small)
            return fmt::format(" It is a key of [laboratory], which compares methods; on a command line --lab {}=VALUE.",
                               small);
    if (is_of_surfaces(small) && std::ranges::find(known, "mesh") != known.end())
        return " It goes with `surface`, a closed surface in 3D such as an .stl, and `mesh` is a file of cells.";
    for (const Synonym& synonym : synonyms)
        if (synonym.word == small && std::ranges::find(known, synonym.key) != known.end())
            return fmt::format(" Did you mean '{}'?", synonym.key);
    constexpr std::size_t most_known = 16;  // that a reader looks through
    if (known.size() > most_known && !nearest_word(word, known)) return " `abut keys` lists those that are known.";
    return hint(word, known);
}

namespace {

/// Names that hold this word, in small or capital letters.
std::vector<std::string> holding(const std::string& word, const std::vector<std::string>& known) {
    std::vector<std::string> found;
    for (const std::string& name : known)
        if (in_small_letters(name).find(in_small_letters(word)) != std::string::npos) found.push_back(name);
    return found;
}

}  // namespace

std::string hint_of_name(const std::string& name, const std::vector<std::string>& known) {
    constexpr std::size_t least_letters = 3;  // of a word that says something
    std::vector<std::string> words{name};
    for (std::size_t begin = 0; begin < name.size();) {
        const std::size_t end = std::min(name.find(' ', begin), name.size());
        words.push_back(name.substr(begin, end - begin));
        begin = end + 1;
    }
    for (const std::string& word : words)
        if (word.size() >= least_letters)
            if (const auto found = holding(word, known); !found.empty())
                return fmt::format(" Did you mean '{}'?", fmt::join(found, "', '"));
    return hint(name, known);
}

std::string hint(const std::string& word, const std::vector<std::string>& known) {
    if (known.empty()) return "";
    if (const auto nearest = nearest_word(word, known)) return fmt::format(" Did you mean '{}'?", *nearest);
    return fmt::format(" Known are '{}'.", fmt::join(known, "', '"));
}

}  // namespace abut::input
