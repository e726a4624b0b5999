"""Figures of runs beside what theory wants of them: what scripts/*_figures and the like share."""
import argparse
import pathlib
import sys
import tempfile

import abut_runs

WORDS = {True: "ok", False: "missed", None: ""}
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Figures:
    """Cases that make figures, by name, and the figures that they have made."""

    def __init__(self, told_alone=()):
        """`told_alone`: cases that are made where they are named alone."""
        self.cases, self.lines, self.told_alone = abut_runs.Claims(), [], told_alone
        self.abut, self.scratch, self.is_table = None, None, False

    def case(self, function):
        return self.cases(function)

    def run(self, name, *options, scene=None, text=None, frames=0, files=()):
        """A run that must leave results, of scenes/<scene>.toml or of `text`. `files`: functions that write into its folder."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.scratch))
        file = ROOT / "scenes" / f"{scene}.toml"
        if text is not None:
            file = folder / "scene.toml"
            file.write_text(text)
        for write in files:
            write(folder)
        made = abut_runs.Run(self.abut.parent, file, "--frames", frames, *options, seconds=None, folder=folder)
        abut_runs.require(made.summary is not None, f"{name}\n{made.said}")
        made.name, made.energies = name, made.rows()
        made.last = made.energies[-1]
        return made

    def holds(self, name, what, value, wanted, ok):
        """A figure as text, and whether it is as wanted; None: nothing is wanted. `name` is a run or that of one."""
        name = getattr(name, "name", name)
        self.lines.append((name, what, value, wanted, ok))
        if not self.is_table:
            print(f"{WORDS[ok]:6}  {name:90}  {what:44.44} {value:>12}  {wanted}".rstrip(), flush=True)

    def near(self, name, what, value, wanted, part):
        """Within `part` of `wanted`."""
        off = value / wanted - 1
        self.holds(name, what, f"{value:.5g}", f"{wanted:.5g} +-{100 * part:g} % ({100 * off:+.2f} %)", abs(off) <= part)

    def below(self, name, what, value, limit):
        self.holds(name, what, f"{value:.2g}", f"<= {limit:g}", value <= limit)

    def balanced(self, run, limit=1e-11):
        self.below(run, "|H~ - H~0 + D - W| over the energy in play", run.balance(), limit)

    def tell(self, name, **values):
        """Figures without a target."""
        for what, value in values.items():
            self.holds(name, what, f"{value:.4g}", "", None)

    def main(self, description, build="release"):
        """The command line of a script: [ABUT] [--only CASE ...] [--list] [--markdown]; exits with 1 where a figure is missed."""
        parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
        parser.add_argument("abut", nargs="?", type=pathlib.Path, default=ROOT / f"build/{build}/bin/abut", metavar="ABUT")
        usual = [name for name in self.cases if name not in self.told_alone]
        parser.add_argument("--only", nargs="+", choices=sorted(self.cases), default=usual, metavar="CASE")
        parser.add_argument("--list", action="store_true", help="names of the cases")
        parser.add_argument("--markdown", action="store_true", help="the figures as a table for the docs")
        options = parser.parse_args()
        if options.list:
            print("\n".join(self.cases))
            return 0
        self.abut, self.is_table = options.abut.resolve(), options.markdown
        with tempfile.TemporaryDirectory() as self.scratch:
            for name in options.only:
                self.cases[name]()
        if self.is_table:
            print(row_of_table(("run", "figure", "measured", "wanted", "")), "|---" * 5 + "|", sep="\n")
            for name, *rest, ok in self.lines:
                print(row_of_table((f"`{name}`", *rest, "**missed**" if ok is False else WORDS[ok])))
        missed = sum(ok is False for *_, ok in self.lines)
        print(f"{len(self.lines)} figures, {missed} missed", file=sys.stderr)
        return 1 if missed else 0


def tabulate(description, head, rows, build="dev"):
    """The command line of a script that prints a table for the docs, row by row: [ABUT]. `rows` takes the folder of the program."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("abut", nargs="?", type=pathlib.Path, default=ROOT / f"build/{build}/bin/abut", metavar="ABUT")
    programs = parser.parse_args().abut.resolve().parent
    print(row_of_table(head), "|---" * len(head) + "|", sep="\n")
    for row in rows(programs):
        print(row_of_table(row), flush=True)


def row_of_table(entries):
    return "| " + " | ".join(str(entry).replace("|", "\\|") for entry in entries) + " |"
