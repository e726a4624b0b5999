"""Builds the package for Python as a wheel, by CMake: what `pip install .` calls (PEP 517), and scripts/deb for its own build.

    pip install .                                             the whole package
    pip install . --config-settings=layers=contact            contact alone, which needs the fewest packages
    pip install . --config-settings=build=build/release       from a build that is there
    abut_wheel.py BUILD FOLDER                                packs what is built in BUILD

The wheel has the libraries of Abut beside the module; those of others are the system's. It is for the Python and the system that it was
built on.
"""
import base64
import csv
import hashlib
import io
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
COMPONENTS = ("contact_libraries", "libraries", "gmsh", "python")
TARGETS = ("abut_python__contact", "abut_python__nearest", "abut_python_solid")


def version():
    return re.search(r"^project\(abut VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M)[1]


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{python}-{python}-{platform}"


def metadata():
    return (f"Metadata-Version: 2.1\nName: abut\nVersion: {version()}\n"
            "Summary: Contact between deformable solids in explicit dynamics\nRequires-Dist: numpy\n")


def configure_and_build(build, layers):
    """Targets that the layers do not have are left out."""
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DABUT_TESTS=OFF", "-DABUT_EXAMPLES=OFF",
                    "-DABUT_JOIN_SOURCES=ON", f"-DABUT_LAYERS={layers}", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    known = subprocess.run(["cmake", "--build", build, "--target", "help"], capture_output=True, text=True, check=True).stdout
    targets = [target for target in TARGETS if f"{target}:" in known]
    if not targets:
        raise SystemExit("abut_wheel: the module for Python cannot be built here. Install what scripts/packages.txt and "
                         "scripts/packages-python.txt list (scripts/setup does), and take the Python of the system.")
    subprocess.run(["cmake", "--build", build, "--target", *targets], check=True)


def content(installed):
    """Names in the wheel and the files that are installed."""
    package, = installed.glob("**/dist-packages/abut")
    yield from ((f"abut/{path.relative_to(package)}", path) for path in package.rglob("*") if path.is_file())
    libraries = package.parents[2]  # where Debian has them, or in a folder of the processor below
    for library in libraries.rglob("libabut_*.so.*"):
        if library.is_symlink():  # the name that is asked for
            yield f"abut/lib/{library.name}", library
    for plug_in in (path for folder in libraries.rglob("abut*") if folder.is_dir() and "dist-packages" not in folder.parts
                    for path in folder.rglob("*") if path.is_file()):
        yield f"abut/lib/{plug_in.parent.name}/{plug_in.name}", plug_in


def pack(build, folder):
    """Packs what a build tree has; returns the name of the wheel in `folder`."""
    about, name = f"abut-{version()}.dist-info", f"abut-{version()}-{tag()}.whl"
    record = io.StringIO()
    rows = csv.writer(record, lineterminator="\n")
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch, zipfile.ZipFile(pathlib.Path(folder, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        def add(path, data):
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            rows.writerow((path, f"sha256={digest}", len(data)))
            wheel.writestr(path, data)
        for component in COMPONENTS:
            subprocess.run(["cmake", "--install", build, "--prefix", scratch, "--component", component, "--strip"],
                           stdout=subprocess.DEVNULL, check=True)
        for path, file in sorted(content(pathlib.Path(scratch))):
            add(path, file.read_bytes())
        for file in ("LICENSE", "NOTICE"):
            add(f"{about}/{file}", (ROOT / file).read_bytes())
        add(f"{about}/METADATA", metadata().encode())
        add(f"{about}/WHEEL", f"Wheel-Version: 1.0\nGenerator: abut\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode())
        rows.writerow((f"{about}/RECORD", "", ""))
        wheel.writestr(f"{about}/RECORD", record.getvalue())
    return name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    unknown = sorted(set(settings) - {"build", "layers"})
    if unknown:
        raise SystemExit(f"abut_wheel: no setting is called {', '.join(unknown)}: there are build and layers")
    if "build" in settings:
        return pack(ROOT / settings["build"], wheel_directory)
    build = ROOT / "build" / "wheel"
    configure_and_build(build, settings.get("layers", "all"))
    return pack(build, wheel_directory)


def build_sdist(sdist_directory, config_settings=None):
    name = f"abut-{version()}"
    subprocess.run(["git", "-C", ROOT, "archive", f"--prefix={name}/", "--output", pathlib.Path(sdist_directory, f"{name}.tar.gz").resolve(),
                    "HEAD"], check=True)
    return f"{name}.tar.gz"


if __name__ == "__main__":
    print(pathlib.Path(sys.argv[2]) / pack(sys.argv[1], sys.argv[2]))
