"""check_meshes.py SOURCE [MOST]: no mesh or surface that is stored has more than MOST lines of text (2000), and those that a script
makes are what it makes. Large meshes are binary MSH; scripts write them with tests/support/abut_meshes.py."""
import os
import pathlib
import subprocess
import sys
import tempfile

SUFFIXES = {f".{suffix}" for suffix in "bdf inp k key mesh msh nas obj off ply stl su2 unv vtk vtp vtu".split()}
MADE = {"build", "install", "out"}


def meshes_below(root):
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if not name.startswith(".") and not (pathlib.Path(folder) == root and name in MADE))
        yield from (pathlib.Path(folder) / name for name in sorted(names) if pathlib.Path(name).suffix.lower() in SUFFIXES)


def long_texts(root, paths, most):
    for path in paths:
        contents = path.read_bytes()
        n_lines = contents.count(b"\n")
        if b"\0" not in contents and n_lines > most:
            yield f"{path.relative_to(root).as_posix()} has {n_lines} lines of text, {most} are allowed. Store it as binary MSH 4.1."


def outdated(root):
    for script in sorted(root.glob("scripts/*_mesh*")):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", script, folder], check=True)
            made = sorted(pathlib.Path(folder).iterdir())
            assert made, f"{script} makes no mesh"
            for path in made:
                stored = root / "scenes" / path.name
                if not stored.exists() or stored.read_bytes() != path.read_bytes():
                    yield f"scenes/{path.name} is not what scripts/{script.name} makes: run it."


def main():
    root = pathlib.Path(sys.argv[1])
    paths = list(meshes_below(root))
    assert paths, f"no mesh below {root}: nothing was looked at"
    most = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
    if wrong := [*long_texts(root, paths, most), *outdated(root)]:
        sys.exit("\n".join(wrong))
    print(f"{len(paths)} meshes are stored, in binary or with at most {most} lines each")


main()
