"""check_ranks.py PROGRAM SCENE: runs a scene alone and on 2 and 3 ranks, and compares all files that are left, byte by byte
(report and summary without times). Then a run on two ranks is ended in its midst and goes on alone, one that began alone goes on
on two ranks, and one of which a rank was killed ends on all ranks and goes on: the energies are those of the run that nobody
stopped."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

# Gaps are of pairs that are listed, and lists are new where rank 0 looks at the whole.
FIELDS = 'output.fields=["pressure", "velocity", "stress", "von_mises", "pairs"]'
OPTIONS = ["--set", "bodies.left.size=0.2", "--set", "bodies.right.size=0.2", "--set", FIELDS, "--threads", "1", "--quiet"]
LONG = {"steps": 12000, "frames": 0, "interval": 20}


def command(program, scene, folder, *more, steps=150, frames=3, interval=1):
    return [program, "run", scene, *OPTIONS, "--steps", str(steps), "--frames", str(frames), "--interval", str(interval),
            "--out", str(folder), *more]


def files_of(folder):
    """Bytes of all files; of the summary without what differs from run to run."""
    files = {}
    for path in sorted(pathlib.Path(folder).rglob("*")):
        if not path.is_file() or path.name == "report.html":
            continue
        files[str(path.relative_to(folder))] = path.read_bytes()
    summary = json.loads(files.pop("summary.json"))
    for differs in ("seconds", "contact_share"):
        summary.pop(differs)
    summary["options"].pop("out")
    files["summary"] = json.dumps(summary).encode()
    return files


def require_same(expected, found, what):
    assert sorted(expected) == sorted(found), (what, sorted(expected), sorted(found))
    wrong = [name for name in expected if expected[name] != found[name]]
    assert not wrong, f"{what}: other bytes in {wrong}"


def end(run):
    run.send_signal(signal.SIGTERM)


def kill_a_rank(run):
    """One of the processes that mpirun has started, without warning."""
    children = [int(pid) for path in pathlib.Path(f"/proc/{run.pid}/task").glob("*/children") for pid in path.read_text().split()]
    assert len(children) >= 2, children
    os.kill(children[-1], signal.SIGKILL)


def end_in_its_midst(words, folder, how=end):
    """Starts a run, and ends it when its first checkpoint is there."""
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
        give_up = time.monotonic() + 120
        while not list(pathlib.Path(folder).glob("checkpoints/*.h5")):
            assert run.poll() is None and time.monotonic() < give_up, "no checkpoint came"
            time.sleep(0.01)
        how(run)
        run.wait(timeout=120)
        assert run.returncode != 0, "a run that was stopped says so"
    assert list(pathlib.Path(folder).glob("checkpoints/*.h5")), "the run had ended before it was stopped: give it more steps"


def main():
    program, scene = sys.argv[1:]
    with tempfile.TemporaryDirectory() as here:
        folder = pathlib.Path(here)
        subprocess.run(command(program, scene, folder / "alone"), check=True)
        expected = files_of(folder / "alone")
        assert any(name.endswith(".vtu") for name in expected) and "energy.csv" in expected, sorted(expected)
        for ranks in ("2", "3"):
            subprocess.run(command(program, scene, folder / ranks, "--ranks", ranks), check=True)
            require_same(expected, files_of(folder / ranks), f"{ranks} ranks")

        subprocess.run(command(program, scene, folder / "whole", **LONG), check=True)
        energies = (folder / "whole" / "energy.csv").read_bytes()
        for before, after, how in (("2", "0", end), ("0", "2", end), ("2", "2", kill_a_rank)):
            parted = folder / f"parted_{before}_{after}"
            words = command(program, scene, parted, "--ranks", before, "--checkpoint-steps", "20", **LONG)
            end_in_its_midst(words, parted, how)
            subprocess.run([program, "restart", str(parted), "--ranks", after, "--quiet"], check=True)
            assert (parted / "energy.csv").read_bytes() == energies, f"began on {before} ranks, went on on {after}"

        wrong = subprocess.run(command(program, scene, folder / "wrong", "--ranks", "2", "--kinematics", "floating"),
                               capture_output=True, text=True)
        assert wrong.returncode != 0 and "not made for a run on several ranks" in wrong.stderr, wrong.stderr
        assert wrong.stderr.count("error:") == 1, wrong.stderr


main()
