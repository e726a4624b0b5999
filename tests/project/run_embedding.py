"""run_embedding.py start_embedding.md PREFIX [CMAKE_OPTION...]: the program and the CMakeLists.txt of the page build as they stand against
the package installed in PREFIX, the program prints the line that the page names, and two equal squares push each other off: what one
loses in momentum the other gains, none turns back without contact, and no contact is missed."""
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap

page, prefix, options = pathlib.Path(sys.argv[1]).read_text(), sys.argv[2], sys.argv[3:]
program = re.search(r"^```cpp\n(#include.*?)^```$", page, re.S | re.M)[1]
project = textwrap.dedent(re.search(r"`CMakeLists.txt`:\n\n((?: {4,}\S[^\n]*\n)+)", page)[1])
promised = re.search(r"It prints `([^`]+)`", page)[1]

example = pathlib.Path(sys.argv[1]).parents[1] / "examples/two_squares/two_squares.cpp"
assert example.read_text().endswith(program), f"{example} is another program than that of the page"

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "two_squares.cpp").write_text(program)
    (folder / "CMakeLists.txt").write_text(project)
    for command in (["cmake", "-S", ".", "-B", "my_build", f"-DCMAKE_PREFIX_PATH={prefix}", *options], ["cmake", "--build", "my_build"]):
        subprocess.run(command, cwd=folder, check=True)
    said = subprocess.run([folder / "my_build/two_squares"], capture_output=True, text=True, check=True).stdout.strip()

assert said == promised, f"the program prints\n{said}\nand the page promises\n{promised}"
left_x, left_y, right_x, right_y, missed = map(float, re.findall(r"-?\d+(?:\.\d+)?", said))
assert (left_x + right_x, left_y + right_y) == (0.0, 0.0), "equal masses: the velocities add up to 0"
assert -0.1 <= left_x < 0.0 < right_x <= 0.1, "they came with 0.1 m/s to the right and left, and leave the other way, no faster"
assert missed == 0
