#include "studies/program/list.hpp"

namespace abut::studies {

// Each study has a namespace and a source of its own.
namespace bar_impact_study {
Entry entry();
}
namespace bouncing_bar_study {
Entry entry();
}
namespace bouncing_strip_study {
Entry entry();
}
namespace bulk_patch_study {
Entry entry();
}
namespace contact_patch_study {
Entry entry();
}
namespace disc_collision_study {
Entry entry();
}
namespace disc_on_plane_study {
Entry entry();
}
namespace extremes {
Entry entry();
}
namespace falling_bar_study {
Entry entry();
}
namespace fixed_bar_study {
Entry entry();
}
namespace fpu_study {
Entry entry();
}
namespace hertz_study {
Entry entry();
}
namespace kinematics {
Entry entry();
}
namespace long_runs {
Entry entry();
}
namespace manufactured_study {
Entry entry();
}
namespace slow_fast_wave_study {
Entry entry();
}
namespace spectrum_study {
Entry entry();
}
namespace sphere_collision_study {
Entry entry();
}
namespace trade {
Entry entry();
}
namespace turning {
Entry entry();
}
namespace two_bars_study {
Entry entry();
}
namespace wave_speeds_study {
Entry entry();
}

std::vector<Entry> all_studies() {
    return {bar_impact_study::entry(),
            bouncing_bar_study::entry(),
            bouncing_strip_study::entry(),
            bulk_patch_study::entry(),
            contact_patch_study::entry(),
            disc_collision_study::entry(),
            disc_on_plane_study::entry(),
            extremes::entry(),
            falling_bar_study::entry(),
            fixed_bar_study::entry(),
            fpu_study::entry(),
            hertz_study::entry(),
            kinematics::entry(),
            long_runs::entry(),
            manufactured_study::entry(),
            slow_fast_wave_study::entry(),
            spectrum_study::entry(),
            sphere_collision_study::entry(),
            trade::entry(),
            turning::entry(),
            two_bars_study::entry(),
            wave_speeds_study::entry()};
}

}  // namespace abut::studies
