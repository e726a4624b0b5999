"""Contact between deformable solids in explicit dynamics: docs/languages.md walks through it.

Here is contact for solvers of your own; abut.solid has meshes, solids and runs.
"""
from ._contact import *  # noqa: F403
from ._contact import __version__  # noqa: F401
