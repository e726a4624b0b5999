#include "abut/run/steps/preset.hpp"

namespace abut::run {

void apply(Preset preset, RunOptions& options) {
    switch (preset) {
        case Preset::fast:
            options.cfl = 0.99;
            options.contact.events = false;
            break;
        case Preset::balanced:
            break;
        case Preset::exact:
            options.cfl = 0.3;
            options.filter = true;
            break;
    }
}

}  // namespace abut::run
