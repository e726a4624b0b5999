#include "abut/run/options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "abut/base/error.hpp"

namespace abut::run {
namespace {

template <class Choice, std::size_t N>
std::string word_of(const std::array<Word<Choice>, N>& words, Choice choice) {
    for (const auto& [word, meant] : words)
        if (meant == choice) return word;
    return "";
}

void append(NamedValues& values, const NamedValues& more) { values.insert(values.end(), more.begin(), more.end()); }

}  // namespace

std::string name_of(SolidIntegrator integrator) { return word_of(integrator_words, integrator); }

template <int Dim>
RunOptions with_defaults(RunOptions options) {
    if (options.interval == 0) options.interval = Dim == 2 ? 1 : 10;
    if (options.contact.quadrature == 0) options.contact.quadrature = Dim;
    return options;
}

void check(const RunOptions& options) {
    if (options.filter && options.integrator != SolidIntegrator::memm)
        throw BadInput(fmt::format("--filter neutral: the filter is made for memm, and {} was chosen. Take --filter none.",
                                   name_of(options.integrator)));
    const RunOptions by_default;
    if (options.integrator != SolidIntegrator::memm_async &&
        (options.levels != by_default.levels || options.contact_margin != by_default.contact_margin ||
         options.contact_levels != by_default.contact_levels))
        throw BadInput(
            fmt::format("--levels, --contact-margin, --contact-levels: {} takes one step for all cells. Take --integrator "
                        "memm_async, or leave them out.",
                        name_of(options.integrator)));
    if (!std::isnan(options.gauge) && options.integrator != SolidIntegrator::bilbao)
        throw BadInput(fmt::format("--gauge: {} has no gauge. Take --integrator bilbao, or leave --gauge out.",
                                   name_of(options.integrator)));
}

NamedValues model_values(const RunOptions& options) {
    return {{"weights", word_of(weighting_words, options.contact.weighting)},
            {"area", word_of(area_words, options.contact.area)},
            {"neumann", word_of(free_face_words, options.neumann)}};
}

NamedValues named_values(const RunOptions& options) {
    const auto& contact = options.contact;
    NamedValues values;
    if (std::isnan(options.dt))
        values = {{"cfl", options.cfl}};
    else
        values = {{"dt", options.dt}, {"allow_unstable", options.allow_unstable}};
    values.push_back({"integrator", name_of(options.integrator)});
    if (options.integrator == SolidIntegrator::memm_async)
        append(values, {{"levels", options.levels},
                        {"contact_margin", options.contact_margin},
                        {"contact_levels", options.contact_levels}});
    if (options.integrator == SolidIntegrator::bilbao && !std::isnan(options.gauge))
        values.push_back({"gauge", options.gauge});
    append(values, {{"filter", word_of(filter_words, options.filter)},
                    {"broad_phase", std::string(geometry::name(contact.search.broad_phase))},
                    {"overlap", word_of(overlap_words, contact.overlap)},
                    {"weights", word_of(weighting_words, contact.weighting)},
                    {"area", word_of(area_words, contact.area)},
                    {"events", word_of(event_words, contact.events)},
                    {"quadrature", contact.quadrature},
                    {"facing_cosine", contact.search.facing_cosine},
                    {"compression_limit", contact.compression_limit},
                    {"neumann", word_of(free_face_words, options.neumann)},
                    {"out", options.out.string()},
                    {"interval", options.interval},
                    {"frames", options.frames}});
    return values;
}

template RunOptions with_defaults<2>(RunOptions);
template RunOptions with_defaults<3>(RunOptions);

}  // namespace abut::run
