#!/usr/bin/env python3
"""What runs on several ranks leave, each claim by runs of `abut run`.

    check_ranks.py build/dev/bin --list
    check_ranks.py build/dev/bin runs_on_ranks_leave_the_files_of_one

All files of a run on ranks are those of the run alone, byte by byte; of the summary all but times; the report is left out.
"""
import contextlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
from abut_runs import Claims, main  # noqa: E402

SCENE = str(pathlib.Path(__file__).resolve().parent.parent.parent / "scenes/slipping_cylinders.toml")
OPTIONS = ["--set", "bodies.left.size=0.2", "--set", "bodies.right.size=0.2", "--quiet"]
MPIRUN = ["mpirun", "--oversubscribe", "--bind-to", "none"] + (["--allow-run-as-root"] if os.geteuid() == 0 else [])
LISTS = ("rebuilds", "candidates")  # new where cells are shared out again
POTENTIAL, RUBS = ("--law", "pair_potential"), ("--set", "contact.friction=0.3")
AGAIN = ["--rebalance", "20", "--rebalance-above", "1"]  # at each look
LONG = {"steps": 6000, "frames": 0, "interval": 20}
claim = Claims()


@contextlib.contextmanager
def in_a_folder():
    with tempfile.TemporaryDirectory() as folder:
        yield pathlib.Path(folder)


def command(program, folder, *more, steps=150, frames=3, interval=1, threads=1, times=()):
    shown = ["--times", ",".join(map(repr, times))] if times else ["--frames", str(frames)]
    return [str(program), "run", SCENE, *OPTIONS, "--threads", str(threads), "--steps", str(steps), *shown, "--interval", str(interval),
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


def run(words):
    subprocess.run(words, check=True)


def run_alone(program, folder, *more, **choices):
    """Files that a run on one rank has left in folder/alone."""
    run(command(program, folder / "alone", *more, **choices))
    return files_of(folder / "alone")


def require_choice(program, folder, choice):
    """The same files on three ranks with these options."""
    name = "_".join(choice[1::2])
    run(command(program, folder / name, *choice))
    run(command(program, folder / f"{name}_on_3", *choice, "--ranks", "3"))
    require_same(files_of(folder / name), files_of(folder / f"{name}_on_3"), choice)


def require_times(program, folder, times, *choice):
    """Frames at given times, as cells are shared out again. Returns the files."""
    alone, shared = folder / f"times_{len(choice)}", folder / f"times_{len(choice)}_on_3"
    run(command(program, alone, *choice, times=times))
    run(command(program, shared, *choice, "--ranks", "3", *AGAIN, times=times))
    expected, found = files_of(alone, LISTS), files_of(shared, (*LISTS, "rebalancing"))
    assert sum(name.endswith(".vtu") for name in expected) == len(times), sorted(expected)
    require_same(expected, found, ("frames at given times", choice))
    return expected


def require_one_message(done, words, what):
    assert done.returncode != 0, what
    for word in words:
        assert word in done.stderr, (what, done.stderr)
    assert done.stderr.count("error:") == 1, (what, done.stderr)


# --- Files ----------------------------------------------------------------------------------------------------------------


@claim
def runs_on_ranks_leave_the_files_of_one(programs):
    program = programs / "abut"
    with in_a_folder() as folder:
        expected = run_alone(program, folder)
        assert any(name.endswith(".vtu") for name in expected) and "energy.csv" in expected, sorted(expected)
        run(command(program, folder / "2", "--ranks", "2"))
        require_same(expected, files_of(folder / "2"), "2 ranks")
        run(command(program, folder / "threads", "--ranks", "3", threads=2))
        require_same(expected, files_of(folder / "threads"), "3 ranks of 2 threads")
        run([*MPIRUN, "-n", "1", *command(program, folder / "mpirun")])
        require_same(expected, files_of(folder / "mpirun"), "mpirun -n 1")


@claim
def ranks_that_share_cells_out_again_leave_the_files_of_one(programs):
    program = programs / "abut"
    with in_a_folder() as folder:
        run_alone(program, folder)
        again = folder / "again"
        run(command(program, again, "--ranks", "3", *AGAIN))
        report = json.loads((again / "summary.json").read_text())["rebalancing"]
        assert report["looks"] == 8 and [one["step"] for one in report["done"]] == [20, 40, 60, 80, 100, 120, 140], report
        assert all(one["imbalance_before"] >= 1 and one["seconds"] > 0 for one in report["done"]), report
        require_same(files_of(folder / "alone", LISTS), files_of(again, (*LISTS, "rebalancing")), "cells shared out again")


@claim
def frames_at_given_times_are_the_same_on_ranks(programs):
    """Inside of steps while the bodies touch, at the start, at a node and at the end; with friction, too. The energies are
    those of the run without times."""
    program = programs / "abut"
    with in_a_folder() as folder:
        energies = run_alone(program, folder)["energy.csv"]
        summary = json.loads((folder / "alone" / "summary.json").read_text())
        dt, end = summary["dt"], summary["time"]
        times = (0.0, 0.3 * dt, 7 * dt, 0.4321 * end, 0.4322 * end, 0.8 * end, end)
        assert require_times(program, folder, times)["energy.csv"] == energies, "times change the energies"
        require_times(program, folder, times, *POTENTIAL, *RUBS)


@claim
def frames_in_pieces_of_ranks_leave_nothing_to_a_run_in_the_same_folder(programs):
    """Each rank leaves its own cells of a frame."""
    program = programs / "abut"
    with in_a_folder() as folder:
        expected, pieces = run_alone(program, folder), folder / "pieces"
        run(command(program, pieces, "--ranks", "2", "--pieces"))
        for name in ("frames/bodies_000002.pvtu", "frames/bodies_000002_0.vtu", "frames/bodies_000002_1.vtu",
                     "frames/bodies_surface_000002.pvtp"):
            assert (pieces / name).exists(), sorted(os.listdir(pieces))
        assert "frames/bodies_000002.pvtu" in (pieces / "bodies.pvd").read_text()
        for name in ("energy.csv", "frames/bodies_pairs_000002.vtp"):
            assert (pieces / name).read_bytes() == expected[name], name
        loud = [word for word in command(program, pieces, "--ranks", "2") if word != "--quiet"]
        told = subprocess.run(loud, check=True, capture_output=True, text=True).stdout
        assert "step" in told and not set("\r\033") & set(told), "what goes to a file has lines, and no colours"
        require_same(expected, files_of(pieces), "after frames in pieces")


@claim
def frames_in_one_file_are_the_same_on_ranks(programs):
    """In HDF5, which the first rank writes."""
    program = programs / "abut"
    with in_a_folder() as folder:
        files = run_alone(program, folder, "--format", "xdmf")
        assert "bodies.h5" in files and "bodies.xmf" in files, sorted(files)
        run(command(program, folder / "on_2", "--format", "xdmf", "--ranks", "2"))
        require_same(files, files_of(folder / "on_2"), "frames in one file")


@claim
def bodies_that_float_and_rub_leave_the_same_files_on_ranks(programs):
    with in_a_folder() as folder:
        require_choice(programs / "abut", folder, ("--kinematics", "floating", *POTENTIAL, *RUBS))


@claim
def bodies_that_bend_or_are_rigid_and_laws_and_filters_leave_the_same_files_on_ranks(programs):
    with in_a_folder() as folder:
        for choice in (("--kinematics", "finite", *POTENTIAL), ("--kinematics", "rigid", *POTENTIAL), RUBS, (*RUBS, *POTENTIAL),
                       ("--filter", "neutral"), ("--restart", "5")):
            require_choice(programs / "abut", folder, choice)


@claim
def a_run_on_ranks_shares_no_folder_with_other_runs(programs):
    """Open MPI makes one for all runs of a user, which a file stands in the way of here; nothing is left of ours."""
    with in_a_folder() as folder:
        place = folder / "temporary"
        place.mkdir()
        in_the_way = place / f"ompi.{os.uname().nodename.split('.')[0]}.{os.geteuid()}"
        in_the_way.write_text("")
        subprocess.run(command(programs / "abut", folder / "out", "--ranks", "2", steps=5), check=True,
                       env={**os.environ, "TMPDIR": str(place)})
        assert os.listdir(place) == [in_the_way.name], os.listdir(place)


# --- Runs that end early ------------------------------------------------------------------------------------------------


@claim
def a_run_that_was_ended_or_killed_goes_on_on_other_ranks(programs):
    """The energies are those of the run that nobody stopped."""
    program = programs / "abut"
    with in_a_folder() as folder:
        energies = run_alone(program, folder, **LONG)["energy.csv"]
        for before, after, how in (("2", "0", end), ("0", "2", end), ("2", "2", kill_a_rank)):
            parted = folder / f"parted_{before}_{after}"
            words = command(program, parted, "--ranks", before, *AGAIN, "--checkpoint-steps", "30", **LONG)
            end_in_its_midst(words, parted, how)
            run([program, "restart", str(parted), "--ranks", after, "--rebalance", "700", "--quiet"])
            assert (parted / "energy.csv").read_bytes() == energies, f"began on {before} ranks, went on on {after}"


@claim
def a_signal_ends_a_run_on_ranks_with_the_code_that_it_has_on_one(programs):
    """With its program the ranks end, too."""
    with in_a_folder() as folder:
        for sent, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)):
            out = folder / f"signal_{code}"
            end_in_its_midst(command(programs / "abut", out, "--ranks", "2", "--checkpoint-steps", "30", **LONG), out,
                             lambda started: started.send_signal(sent), code)


@claim
def what_ranks_cannot_do_is_refused_once(programs):
    """Each by its name, on all ranks, with one message."""
    program, not_made = programs / "abut", "not made for a run on several ranks"
    with in_a_folder() as folder:
        for name, *options in (("pilot run", "--kinematics", "automatic"),
                               ("memm_async", "--integrator", "memm_async"), ("single precision", "--lab", "precision=single"),
                               ("on a device", "--device", "kokkos")):
            done = subprocess.run(command(program, folder / "wrong", "--ranks", "2", *options), capture_output=True, text=True)
            require_one_message(done, (name, not_made), options)
        many = subprocess.run(command(program, folder / "wrong", "--ranks", "1000000"), capture_output=True, text=True)
        require_one_message(many, ("--ranks: 1000000 are asked for", "processors"), "more ranks than a machine can have")
        for words, name in (([program, "run", SCENE, "--sweep", "bodies.left.density=1,2", "--out", str(folder / "sweep")], "--sweep"),
                            ([program, "check", SCENE], "this command"),
                            ([programs / "study", "bouncing_bar", "--out", str(folder / "study")], "study bouncing_bar")):
            done = subprocess.run([*MPIRUN, "-n", "2", *words], capture_output=True, text=True)
            require_one_message(done, (name, "not made for several ranks"), words)


@claim
def an_error_of_one_rank_ends_all_ranks_that_wait_for_it(programs):
    """The second rank cannot read its scene, and the first one waits for it."""
    with in_a_folder() as folder:
        good = command(programs / "abut", folder / "left")
        bad = [str(folder / "nowhere.toml") if word == SCENE else word for word in good]
        done = subprocess.run([*MPIRUN, "-n", "1", *good, ":", "-n", "1", *bad], capture_output=True, text=True, timeout=60,
                              env={**os.environ, "ABUT_RANKS_PATIENCE": "1"})
        assert done.returncode != 0, done.stderr
        assert "on rank 1: abut: error:" in done.stderr and "nowhere.toml" in done.stderr, done.stderr


if __name__ == "__main__":
    sys.exit(main(claim))
