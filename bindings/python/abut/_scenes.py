"""Scenes in TOML, or as dicts with the same keys, from Python."""
import json
import math
import os
import re


def run(scene, set=None, look=None, leaving=None, **options):
    """Runs a scene.

    Parameters
    ----------
    scene : path or dict
        A TOML file, or a dict with the same tables and keys (docs/scenes.md, `abut keys`). In a dict `mesh` of a body
        may be a mesh of abut.solid.
    set : dict, optional
        Values in place of those of the scene, {"bodies.left.density": 2} or nested.
    look : callable (state), optional
        Called at the start and after each step; True makes the next one the last.
    leaving : callable (state), optional
        Called after each step: numbers of the cells that leave the run, as the arrays of the state have them, or None.
        Limits beyond which cells leave are in the table `erosion` of a body.
    **options
        Options in place of those of the scene: those of the command line of `abut run` with _ for -, as
        `abut.solid.simulate` lists them. `out` is the folder of report.html, energy.csv and all other files; without
        it nothing is written.

    Returns
    -------
    Result
        Ledger, frames, forces and figures of the run.

    Raises
    ------
    BadInput
        If something of the scene or an option cannot be used.
    Diverged, TooDeep
        If the run cannot go on.

    Examples
    --------
    >>> import abut
    >>> block = dict(shape="structured_box", lower=[0, 0], upper=[1, 1], counts=[4, 4], young=1.0, poisson=0.3, density=1.0)
    >>> scene = {"dim": 2, "run": {"time": 4.0}, "bodies": {"left": {**block, "velocity": [0.1, 0]},
    ...                                                     "right": {**block, "place": [1.1, 0.1]}}}
    >>> result = abut.run(scene)
    >>> result.good, result.steps == result.frames.step[-1]
    (True, True)
    >>> abut.run(scene, set={"bodies.left.density": 2.0}, steps=3).steps
    3
    """
    return built_solid().run_toml(*_source(scene, set), look, leaving, options)


def memm(scene, set=None, outside=(), **options):
    """Sets up a scene under MEMM, to be taken step by step.

    Parameters
    ----------
    scene, set
        As in `run`.
    outside : iterable of str
        Groups that `set_traction` loads.
    **options
        As in `run`, except those of steps and files.

    Returns
    -------
    Memm2D or Memm3D
        With `step`, `record`, `displacement` and so on.

    Raises
    ------
    BadInput
        If something of the scene or an option cannot be used.

    Examples
    --------
    >>> import abut
    >>> block = dict(shape="structured_box", lower=[0, 0], upper=[1, 1], counts=[4, 4], young=1.0, poisson=0.3, density=1.0)
    >>> steps = abut.memm({"dim": 2, "bodies": {"block": {**block, "velocity": [0.1, 0]}}})
    >>> steps.step(10)
    >>> abs(steps.displacement[0, 0] / steps.time - 0.1) < 1e-12
    True
    """
    file, toml, meshes, changes = _source(scene, set)
    return built_solid().memm_toml(file, toml, meshes, changes, list(outside), options)


def built_solid():
    try:
        from . import _solid
        from . import solid  # noqa: F401  it gives meshes their methods of Python
    except ImportError as error:
        if not str(error).startswith("cannot import name '_solid'"):  # it is there, and a library of it is not
            raise
        raise ImportError("this build of Abut has contact alone, and meshes and scenes need all of it. Build it without "
                          "-DABUT_LAYERS=contact.") from None
    return _solid


def _source(scene, changes):
    """(file, toml or None, meshes by text, changes as texts)"""
    texts = []
    meshes = {}
    for key, value in (changes or {}).items():
        texts.append(f"{key}={_toml(value, meshes)}")
    if not isinstance(scene, dict):
        return os.fspath(scene), None, meshes, texts
    lines = [f"{_key(key)} = {_toml(value, meshes)}" for key, value in scene.items()]
    return "scene", "\n".join(lines) + "\n", meshes, texts


def _key(key):
    if not isinstance(key, str):
        raise TypeError(f"{key!r} cannot be a key of a scene; give a text")
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _quoted(key)


def _quoted(text):
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _toml(value, meshes):
    """A value of Python in TOML. Meshes become texts, under which `meshes` has them."""
    if hasattr(value, "tolist"):  # of numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item, meshes) for item in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(key)} = {_toml(item, meshes)}" for key, item in value.items()) + "}"
    if isinstance(value, (built_solid().Mesh2D, built_solid().Mesh3D)):
        text = f"mesh {len(meshes)} of Python, '{value.name}'"
        meshes[text] = value
        return _quoted(text)
    raise TypeError(f"{value!r} cannot be a value of a scene; give numbers, texts, truths, lists, dicts, or a mesh of abut.solid")
