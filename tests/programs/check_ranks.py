"""check_ranks.py PROGRAM OTHER_PROGRAM SCENE: runs a scene alone and on 2 and 3 ranks, also with two threads each, started by
mpirun, with cells that are shared out again, and with bodies that turn and bend, with the filter and with neutral restarts, and compares all files that are left, byte by byte (report and summary without
times). Frames in one file of HDF5 are the same file. Then a run on two ranks is ended in its midst and goes on alone, one that began alone goes on on two ranks, and one of
which a rank was killed ends on all ranks and goes on: the energies are those of the run that nobody stopped. What ranks cannot
do is refused once, and an error of one rank that the others wait for ends all of them."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

OPTIONS = ["--set", "bodies.left.size=0.2", "--set", "bodies.right.size=0.2", "--quiet"]
MPIRUN = ["mpirun", "--oversubscribe", "--bind-to", "none"] + (["--allow-run-as-root"] if os.geteuid() == 0 else [])
LISTS = ("rebuilds", "candidates")  # new where cells are shared out again
AGAIN = ["--rebalance", "20", "--rebalance-above", "1"]  # at each look
LONG = {"steps": 15000, "frames": 0, "interval": 20}


def command(program, scene, folder, *more, steps=150, frames=3, interval=1, threads=1, times=()):
    shown = ["--times", ",".join(map(repr, times))] if times else ["--frames", str(frames)]
    return [program, "run", scene, *OPTIONS, "--threads", str(threads), "--steps", str(steps), *shown, "--interval", str(interval),
            "--animation", str(frames), "--out", str(folder), *more]


def files_of(folder, without=()):
    """Bytes of all files; of the summary without what differs from run to run, and without more."""
    files = {}
    for path in sorted(pathlib.Path(folder).rglob("*")):
        if not path.is_file() or path.name == "report.html":
            continue
        files[str(path.relative_to(folder))] = path.read_bytes()
    summary = json.loads(files.pop("summary.json"))
    for differs in ("seconds", "contact_share", *without):
        summary.pop(differs)
    for differs in ("out", "threads") + (("skin",) if without else ()):
        summary["options"].pop(differs)
    files["summary"] = json.dumps(summary).encode()
    return files


def require_same(expected, found, what):
    assert sorted(expected) == sorted(found), (what, sorted(expected), sorted(found))
    wrong = [name for name in expected if expected[name] != found[name]]
    assert not wrong, f"{what}: other bytes in {wrong}"


def end(run):
    run.send_signal(signal.SIGTERM)


def children_of(pid):
    return [int(child) for path in pathlib.Path(f"/proc/{pid}/task").glob("*/children") for child in path.read_text().split()]


def kill_a_rank(run):
    """One of the processes that mpirun has started, which the program has, without warning."""
    mpirun = children_of(run.pid)
    assert len(mpirun) == 1, mpirun
    children = children_of(mpirun[0])
    assert len(children) >= 2, children
    os.kill(children[-1], signal.SIGKILL)


def end_in_its_midst(words, folder, how=end, code=None):
    """Starts a run, and ends it when its first checkpoint is there."""
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
        give_up = time.monotonic() + 120
        while not list(pathlib.Path(folder).glob("checkpoints/*.h5")):
            assert run.poll() is None and time.monotonic() < give_up, "no checkpoint came"
            time.sleep(0.01)
        how(run)
        run.wait(timeout=120)
        assert run.returncode != 0, "a run that was stopped says so"
        assert code in (None, run.returncode), (run.returncode, code)
    assert list(pathlib.Path(folder).glob("checkpoints/*.h5")), "the run had ended before it was stopped: give it more steps"


def check_rebalancing(program, scene, folder):
    again = folder / "again"
    subprocess.run(command(program, scene, again, "--ranks", "3", *AGAIN), check=True)
    report = json.loads((again / "summary.json").read_text())["rebalancing"]
    assert report["looks"] == 8 and [one["step"] for one in report["done"]] == [20, 40, 60, 80, 100, 120, 140], report
    assert all(one["imbalance_before"] >= 1 and one["seconds"] > 0 for one in report["done"]), report
    require_same(files_of(folder / "alone", LISTS), files_of(again, (*LISTS, "rebalancing")), "cells shared out again")


def check_pieces(program, scene, folder, expected):
    """Each rank leaves its own cells of a frame; a run in the same folder leaves nothing of them."""
    pieces = folder / "pieces"
    subprocess.run(command(program, scene, pieces, "--ranks", "2", "--pieces"), check=True)
    for name in ("frames/bodies_000002.pvtu", "frames/bodies_000002_0.vtu", "frames/bodies_000002_1.vtu", "frames/bodies_surface_000002.pvtp"):
        assert (pieces / name).exists(), sorted(os.listdir(pieces))
    assert "frames/bodies_000002.pvtu" in (pieces / "bodies.pvd").read_text()
    for name in ("energy.csv", "frames/bodies_pairs_000002.vtp"):
        assert (pieces / name).read_bytes() == expected[name], name
    loud = [word for word in command(program, scene, pieces, "--ranks", "2") if word != "--quiet"]
    told = subprocess.run(loud, check=True, capture_output=True, text=True).stdout
    assert "step" in told and not set("\r\033") & set(told), "what goes to a file has lines, and no colours"
    require_same(expected, files_of(pieces), "after frames in pieces")


def check_one_file(program, scene, folder):
    """Frames in one file of HDF5, which the first rank writes."""
    subprocess.run(command(program, scene, folder / "one", "--format", "xdmf"), check=True)
    subprocess.run(command(program, scene, folder / "one_on_2", "--format", "xdmf", "--ranks", "2"), check=True)
    files = files_of(folder / "one")
    assert "bodies.h5" in files and "bodies.xmf" in files, sorted(files)
    require_same(files, files_of(folder / "one_on_2"), "frames in one file")


def check_times(program, scene, folder):
    """Frames at given times, inside of steps while the bodies touch, at the start, at a node and at the end; with friction, and as
    cells are shared out again. The energies are those of the run without."""
    summary = json.loads((folder / "alone" / "summary.json").read_text())
    dt, end = summary["dt"], summary["time"]
    times = (0.0, 0.3 * dt, 7 * dt, 0.4321 * end, 0.4322 * end, 0.8 * end, end)
    for choice in ((), ("--law", "pair_potential", "--set", "contact.friction=0.3")):
        alone, shared = folder / f"times_{len(choice)}", folder / f"times_{len(choice)}_on_3"
        subprocess.run(command(program, scene, alone, *choice, times=times), check=True)
        subprocess.run(command(program, scene, shared, *choice, "--ranks", "3", *AGAIN, times=times), check=True)
        expected, found = files_of(alone, LISTS), files_of(shared, (*LISTS, "rebalancing"))
        assert sum(name.endswith(".vtu") for name in expected) == len(times), sorted(expected)
        require_same(expected, found, ("frames at given times", choice))
        if not choice:
            assert expected["energy.csv"] == (folder / "alone" / "energy.csv").read_bytes(), "times change the energies"


def check_choices(program, scene, folder):
    """Bodies that turn in a frame, that bend, and that are rigid, under the other law of contact; friction under both laws; the filter;
    neutral restarts."""
    pairs, rubs = ("--law", "pair_potential"), ("--set", "contact.friction=0.3")
    for choice in (("--kinematics", "floating", *pairs), ("--kinematics", "finite", *pairs), ("--kinematics", "rigid", *pairs),
                   rubs, (*rubs, *pairs), ("--filter", "neutral"), ("--restart", "5")):
        name = "_".join(choice[1::2])
        alone, shared = folder / name, folder / (name + "_on_3")
        subprocess.run(command(program, scene, alone, *choice), check=True)
        subprocess.run(command(program, scene, shared, *choice, "--ranks", "3"), check=True)
        require_same(files_of(alone), files_of(shared), choice)


def check_one_message(run, words, what):
    assert run.returncode != 0, what
    for word in words:
        assert word in run.stderr, (what, run.stderr)
    assert run.stderr.count("error:") == 1, (what, run.stderr)


def check_refused(program, studies, scene, folder):
    """Each by its name, on all ranks, with one message."""
    not_made = "not made for a run on several ranks"
    for name, *options in (("pilot run", "--kinematics", "automatic"),
                           ("memm_async", "--integrator", "memm_async"), ("single precision", "--lab", "precision=single"),
                           ("on a device", "--device", "kokkos")):
        run = subprocess.run(command(program, scene, folder / "wrong", "--ranks", "2", *options), capture_output=True, text=True)
        check_one_message(run, (name, not_made), options)
    many = subprocess.run(command(program, scene, folder / "wrong", "--ranks", "1000000"), capture_output=True, text=True)
    check_one_message(many, ("--ranks: 1000000 are asked for", "processors"), "more ranks than a machine can have")
    for words, name in (([program, "run", scene, "--sweep", "bodies.left.density=1,2", "--out", str(folder / "sweep")], "--sweep"),
                        ([program, "check", scene], "this command"), ([studies, "bouncing_bar", "--out", str(folder / "study")], "study bouncing_bar")):
        run = subprocess.run([*MPIRUN, "-n", "2", *words], capture_output=True, text=True)
        check_one_message(run, (name, "not made for several ranks"), words)


def check_signals(program, scene, folder):
    """A signal ends a run on ranks with the exit code that it has on one; with its program the ranks end, too."""
    for sent, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)):
        out = folder / f"signal_{code}"
        end_in_its_midst(command(program, scene, out, "--ranks", "2", "--checkpoint-steps", "30", **LONG), out,
                         lambda run: run.send_signal(sent), code)


def check_left_alone(program, scene, folder):
    """The second rank cannot read its scene, and the first one waits for it."""
    good, bad = command(program, scene, folder / "left"), command(program, str(folder / "nowhere.toml"), folder / "left")
    run = subprocess.run([*MPIRUN, "-n", "1", *good, ":", "-n", "1", *bad], capture_output=True, text=True, timeout=60,
                         env={**os.environ, "ABUT_RANKS_PATIENCE": "1"})
    assert run.returncode != 0, run.stderr
    assert "on rank 1: abut: error:" in run.stderr and "nowhere.toml" in run.stderr, run.stderr


def main():
    program, studies, scene = sys.argv[1:]
    with tempfile.TemporaryDirectory() as here:
        folder = pathlib.Path(here)
        subprocess.run(command(program, scene, folder / "alone"), check=True)
        expected = files_of(folder / "alone")
        assert any(name.endswith(".vtu") for name in expected) and "energy.csv" in expected, sorted(expected)
        for ranks in ("2", "3"):
            subprocess.run(command(program, scene, folder / ranks, "--ranks", ranks), check=True)
            require_same(expected, files_of(folder / ranks), f"{ranks} ranks")
        subprocess.run(command(program, scene, folder / "threads", "--ranks", "2", threads=2), check=True)
        require_same(expected, files_of(folder / "threads"), "2 ranks of 2 threads")
        subprocess.run([*MPIRUN, "-n", "1", *command(program, scene, folder / "mpirun")], check=True)
        require_same(expected, files_of(folder / "mpirun"), "mpirun -n 1")
        check_rebalancing(program, scene, folder)
        check_times(program, scene, folder)
        check_pieces(program, scene, folder, expected)
        check_one_file(program, scene, folder)
        check_choices(program, scene, folder)

        subprocess.run(command(program, scene, folder / "whole", **LONG), check=True)
        energies = (folder / "whole" / "energy.csv").read_bytes()
        for before, after, how in (("2", "0", end), ("0", "2", end), ("2", "2", kill_a_rank)):
            parted = folder / f"parted_{before}_{after}"
            words = command(program, scene, parted, "--ranks", before, *AGAIN, "--checkpoint-steps", "30", **LONG)
            end_in_its_midst(words, parted, how)
            subprocess.run([program, "restart", str(parted), "--ranks", after, "--rebalance", "700", "--quiet"], check=True)
            assert (parted / "energy.csv").read_bytes() == energies, f"began on {before} ranks, went on on {after}"

        check_signals(program, scene, folder)
        check_refused(program, studies, scene, folder)
        check_left_alone(program, scene, folder)


main()
