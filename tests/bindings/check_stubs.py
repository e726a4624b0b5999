"""check_stubs.py: the stubs of the package name exactly what its modules have, with the same arguments in the same order."""
import ast
import inspect
import pathlib
import re
import sys

import abut
from abut import solid


def public(names):
    return {name for name in names if not name.startswith("_")}


def arguments_of(function):
    """Lists of names, one for each overload; of pybind11 they stand in the docstring."""
    try:
        return [list(inspect.signature(function).parameters)]
    except ValueError:
        heads = re.findall(rf"^(?:\d+\. )?{function.__name__}\((?!\*args, \*\*kwargs\))(.*)\) ->", function.__doc__, re.M)
        return [re.findall(r"(?:^|, )\**(\w+)(?=: |, |$)", re.sub(r"\[[^\]]*\]|'[^']*'", "", head)) for head in heads]


def arguments_in_stub(node):
    given = node.args
    return [argument.arg for argument in [*given.args, *filter(None, [given.vararg]), *given.kwonlyargs, *filter(None, [given.kwarg])]]


def compare(what, in_stub, there, faults):
    for name in sorted(in_stub ^ there):
        faults.append(f"{what}.{name} is {'in the stub alone' if name in in_stub else 'missing in the stub'}")


def members_in_stub(node, classes):
    """{name: node} with those of its bases in the stub."""
    members = {}
    for base in node.bases:
        if isinstance(base, ast.Name) and base.id in classes:
            members |= members_in_stub(classes[base.id], classes)
    for item in node.body:
        if isinstance(item, ast.FunctionDef):
            members[item.name] = item
        elif isinstance(item, ast.AnnAssign):
            members[item.target.id] = item
    return members


def check_function(what, function, node, faults, is_method=False):
    there, in_stub = ([names[is_method:] for names in arguments_of(function)], arguments_in_stub(node)[is_method:])  # self is any name
    if in_stub not in there:
        faults.append(f"{what} has the arguments {there}, the stub says {in_stub}")


def check_class(module, node, classes, faults):
    what, members, there = f"{module.__name__}.{node.name}", members_in_stub(node, classes), getattr(module, node.name)
    if issubclass(there, Exception):  # their facts are set when they are raised
        return
    functions = {name: item for name, item in members.items() if isinstance(item, ast.FunctionDef) and not item.decorator_list}
    for name, item in functions.items():
        check_function(f"{what}.{name}", getattr(there, name), item, faults, True)
    facts = set(public(members)) - set(functions)
    if node.name in ("Frames", "Result"):  # made at run time
        result = abut.run({"dim": 2, "run": {"steps": 1}, "bodies": {"a": {"shape": "structured_box", "lower": [0, 0], "upper": [1, 1],
                                                                         "counts": [2, 2], "young": 1, "density": 1}}})
        compare(what, facts, set(result) if node.name == "Result" else set(vars(result.frames)), faults)
        compare(what, public(functions), {name for name in public(vars(there)) if callable(getattr(there, name))}, faults)
    else:
        compare(what, public(members), public(vars(there)), faults)


def check(module, faults):
    stub = ast.parse(pathlib.Path(module.__file__).with_suffix(".pyi").read_text())
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = [node for node in stub.body if isinstance(node, ast.FunctionDef)]
    there = {name for name in public(vars(module)) if inspect.isroutine(getattr(module, name)) or isinstance(getattr(module, name), type)}
    compare(module.__name__, public(classes) | {node.name for node in functions}, there, faults)
    for node in functions:
        if node.name in there:
            check_function(f"{module.__name__}.{node.name}", getattr(module, node.name), node, faults)
    for node in classes.values():
        if node.name in there:
            check_class(module, node, classes, faults)


def main():
    faults = []
    assert (pathlib.Path(abut.__file__).parent / "py.typed").exists(), "py.typed is not installed"
    assert arguments_of(abut.skin_stiffness) == [["modulus", "depth"]], "signatures of pybind11 are not read"
    for module in (abut, solid):
        check(module, faults)
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
