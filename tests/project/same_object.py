"""same_object.py BUILD [LAUNCHER] COMPILER ARGUMENT...: a compiler launcher that takes the object of the build tree BUILD where that build compiles
the same source by the same command, and compiles otherwise. A second build of the same sources then costs what differs."""
import json
import pathlib
import shlex
import shutil
import subprocess
import sys


def without_dependencies(arguments):
    """Ninja adds these arguments; a list of commands does not have them."""
    rest, skip = [], False
    for argument in arguments:
        if not skip and argument not in ("-MD", "-MT", "-MF"):
            rest.append(argument)
        skip = argument in ("-MT", "-MF")
    return rest


def after(option, arguments):
    return arguments[arguments.index(option) + 1] if option in arguments[:-1] else None


def command_of(build, compiler, target):
    """Arguments of the compiler, launchers left out, for this object of a build; None if it has none."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        command = shlex.split(entry["command"])
        if compiler in command and after("-o", command) == target:
            return command[command.index(compiler) + 1:]
    return None


def in_build(arguments, build):
    return [argument.replace(str(build), ".") for argument in arguments]


def same_text(here, build, source):
    """Sources that a build writes itself may differ."""
    path = pathlib.Path(source)
    if not path.is_relative_to(here):
        return True
    twin = build / path.relative_to(here)
    return twin.is_file() and twin.read_text().replace(str(build), ".") == path.read_text().replace(str(here), ".")


def taken_from(build, here, compiler, arguments):
    target, source = after("-o", arguments), after("-c", arguments)
    if not (target and source and (build / "compile_commands.json").is_file() and (build / target).is_file()):
        return False
    other = command_of(build, compiler, target)
    if not other or in_build(other, build) != in_build(without_dependencies(arguments), here) or not same_text(here, build, source):
        return False
    shutil.copyfile(build / target, target)
    if dependencies := after("-MF", arguments):
        pathlib.Path(dependencies).write_text(f"{target}:\n")
    return True


def main():
    build, command = pathlib.Path(sys.argv[1]), sys.argv[2:]
    compiler = next(i for i, argument in enumerate(command[1:]) if argument.startswith("-"))
    if taken_from(build, pathlib.Path.cwd(), command[compiler], command[compiler + 1:]):
        return 0
    return subprocess.call(command)


sys.exit(main())
