"""Contact between deformable solids in explicit dynamics: docs/languages.md walks through it.

NodalContact is contact for solvers of your own; run and memm take scenes; abut.solid has meshes, solids and runs.
"""
from ._contact import *  # noqa: F403
from ._contact import __version__  # noqa: F401
from ._results import Frames, Result  # noqa: F401
from ._scenes import memm, run  # noqa: F401
from .detection import CollisionManager, detect  # noqa: F401
