#include "abut/mesh/shapes/estimate.hpp"

#include <algorithm>

#include "abut/base/messages.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {

void check_estimate(const std::string& name, double cells, double usual, const MeshOptions& options,
                    const std::string& remedy) {
    const double wanted = options.most_cells.value_or(usual), limit = std::min<double>(wanted, max_cells);
    if (cells <= limit) return;
    const std::string raise = wanted < max_cells ? ", or raise most_cells where memory and patience allow so many." : ".";
    throw MeshError(name + ": its sizes make about " + number(cells) + " cells, at most " + count_text(limit) +
                    " are made. " + remedy + raise);
}

}  // namespace abut::mesh
