#!/usr/bin/env python3
"""Scenes of scenes/ end clean: the balance holds, nothing is missed, no warning. Only those in scenes_that_warn.txt may warn.

    check_gallery.py build/dev/bin --list
    check_gallery.py build/dev/bin scenes_without_friction_end_clean

Those that take longer than some seconds are left to scripts/gallery, which runs all and asks the same of them.
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parent.parent / "scenes"
sys.path.insert(0, str(HERE.parent / "support"))
from abut_runs import Claims, Run, main, require, scenes_that_warn  # noqa: E402

SLOW = {"bimetal_strip", "broken_beam", "cattaneo_mindlin", "cattaneo_mindlin_3d", "circling_table", "crushed_lattice",
        "expanding_ring", "folded_plate", "hertz", "oblique_balls", "press_fit", "pressed_spring", "resting_pile", "rolled_sheet",
        "rolling_ball", "rolling_disc", "shattered_disc", "skidding_ball", "slipping_cylinders_3d", "spalling_plate", "taylor_bar"}
WARN = scenes_that_warn()
claim = Claims()


def runs(programs, names):
    for name in sorted(names):
        yield name, Run(programs, SCENES / f"{name}.toml", "--frames", 0).require_end().summary["verdict"]


def require_clean(programs, names):
    require(names, "there is no scene")
    unclean = [f"{name}: {verdict['text']}" for name, verdict in runs(programs, names) if not verdict["good"]]
    require(not unclean, "follow the warnings, or change them where they are wrong:\n" + "\n".join(unclean))


def quick(with_friction):
    names = {path.stem for path in SCENES.glob("*.toml") if ("\nfriction = " in path.read_text()) == with_friction}
    return names - SLOW - WARN.keys()


@claim
def scenes_without_friction_end_clean(programs):
    require_clean(programs, quick(with_friction=False))


@claim
def scenes_with_friction_end_clean(programs):
    require_clean(programs, quick(with_friction=True))


@claim
def scenes_that_may_warn_still_do(programs):
    """So that the list becomes shorter; and names in lists are those of scenes."""
    for name in SLOW | WARN.keys():
        require((SCENES / f"{name}.toml").exists(), f"there is no scene {name}")
    for name, verdict in runs(programs, WARN.keys() - SLOW):
        require(not verdict["good"], f"{name} ends clean: take it out of scenes_that_warn.txt")


if __name__ == "__main__":
    sys.exit(main(claim))
