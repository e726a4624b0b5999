"""check_docstrings.py: everything public of the package has a docstring in the form of numpydoc: a summary line, sections whose parameters
are those of the signature, what is returned, and examples that run as they stand."""
import doctest
import inspect
import re
import sys

import abut
import abut.detection
from abut import solid
from check_stubs import arguments_of, public

# Classes whose constructors are for the package alone. The list may only become shorter.
MADE_BY_THE_PACKAGE = {"abut.Frames", "abut.Result"}


def texts_of(thing):
    """Docstrings without the signatures that pybind11 puts in front, one for each overload."""
    text = inspect.cleandoc(thing.__doc__ or "")
    if not hasattr(thing, "__name__"):
        return [text]
    head = rf"^(?:\d+\. )?{thing.__name__}\(.*\)(?: -> .*)?$"
    return [part.strip() for part in re.split(head, re.sub(r"^Overloaded function\.$", "", text, flags=re.M), flags=re.M) if part.strip()] or [""]


def sections_of(text):
    """{name: lines} by headings that are underlined."""
    lines, sections, name = text.splitlines(), {}, ""
    for line, below in zip(lines, [*lines[1:], ""]):
        if below and set(below) == {"-"} and len(below) == len(line):
            name = line
            sections[name] = []
        elif name and set(line) != {"-"}:
            sections[name].append(line)
    return sections


def names_in(lines):
    """Names of a section, "x, y : float" or "**options"."""
    heads = [line.partition(" : ")[0] for line in lines if line and not line.startswith(" ")]
    return [name.strip().lstrip("*") for head in heads for name in head.split(",")]


def summary_faults(what, text):
    summary = text.partition("\n")[0]
    if not summary:
        yield f"{what} has no docstring"
    elif not re.fullmatch(r"(?:[A-Z]|J~|H~).*\.", summary) or (text != summary and text.splitlines()[1]):
        yield f"{what}: the first line is no sentence with an empty line below it: {summary}"


def parameter_faults(what, text, signatures):
    documented = names_in(sections_of(text).get("Parameters", []))
    if documented not in signatures:
        yield f"{what} documents the parameters {documented}, and has {' or '.join(map(str, signatures))}"


def function_faults(what, function, is_method=False):
    signatures = [names[is_method:] for names in arguments_of(function)]
    for text in texts_of(function):
        yield from summary_faults(what, text)
        yield from parameter_faults(what, text, signatures)
        if not any(line.strip() for line in sections_of(text).get("Returns", [])):
            yield f"{what} does not say what it returns"


def constructor_faults(what, made):
    if "__init__" not in vars(made) or what in MADE_BY_THE_PACKAGE:
        return
    signatures = [names[1:] for names in arguments_of(made.__init__)]
    if signatures != [["args", "kwargs"]]:  # of pybind11: there is no constructor
        yield from parameter_faults(what, texts_of(made)[0], signatures)


def class_faults(what, made):
    text = texts_of(made)[0]
    yield from summary_faults(what, text)
    if issubclass(made, Exception):
        return
    yield from constructor_faults(what, made)
    attributes = names_in(sections_of(text).get("Attributes", []))
    for name in sorted(public(vars(made))):
        member = inspect.getattr_static(made, name)
        if isinstance(member, staticmethod) or name in attributes:
            continue
        if isinstance(member, property):
            yield from summary_faults(f"{what}.{name}", texts_of(member)[0])
        else:
            yield from function_faults(f"{what}.{name}", getattr(made, name), True)


def public_things():
    """{name: thing} of all functions and classes of the package, each once."""
    found = {}
    for module in (abut, solid, abut.detection):
        for name in sorted(public(vars(module))):
            thing = getattr(module, name)
            if (inspect.isroutine(thing) or isinstance(thing, type)) and thing not in found.values():
                found[f"{module.__name__}.{name}"] = thing
    return found


def example_faults(what, thing):
    texts = [thing, *[member for name, member in vars(thing).items() if not name.startswith("_")]] if isinstance(thing, type) else [thing]
    for text in filter(None, (one.__doc__ for one in texts)):
        test = doctest.DocTestParser().get_doctest(text, {}, what, None, 0)
        if test.examples and doctest.DocTestRunner(verbose=False).run(test).failed:
            yield f"{what}: an example does not print what it says"


def main():
    things, faults = public_things(), []
    assert "abut.NodalContact" in things and "abut.solid.mesh" in things, "the package is not looked through"
    for what, thing in things.items():
        faults += class_faults(what, thing) if isinstance(thing, type) else function_faults(what, thing)
        faults += example_faults(what, thing)
    for what in MADE_BY_THE_PACKAGE:
        if not list(parameter_faults(what, texts_of(things[what])[0], [names[1:] for names in arguments_of(things[what].__init__)])):
            faults.append(f"{what} documents its parameters: take it out of the list")
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
