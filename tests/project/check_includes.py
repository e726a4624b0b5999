"""check_includes.py SOURCE: every source and header includes, by itself or through what it includes, the header of each type and of each function in
a namespace of ours that it names.
Sources that are compiled together (ABUT_JOIN_SOURCES) see the includes of each other, so that one which lacks its own fails
only where it is compiled alone. A name that headers give to two things, in a class or outside, is not looked at."""
import functools
import pathlib
import re
import sys
from collections import defaultdict

LAYERS = ("base", "geometry", "mesh", "contact", "dynamics", "solid", "ranks", "run", "input")
INCLUDE = re.compile(r'^\s*#\s*include\s*"abut/([\w/]+\.\w+)"', re.MULTILINE)
KIND = r"(?:struct|class|enum class)\s+(?:\[\[[^\]]*\]\]\s*)?"
DEFINED = re.compile(rf"^{KIND}(\w+)(?:\s+final)?\s*(?::[^;{{]*)?\{{", re.MULTILINE)
DECLARED = re.compile(rf"^{KIND}(\w+);", re.MULTILINE)
NAMED = re.compile(rf"\b(?:typename|{KIND}|using)\s*(\w+)\b(?!;)")
RETURNS = r"(?!return\b|using\b|friend\b|else\b|case\b|throw\b|delete\b|new\b)[\w:<>,&*\[\]]+"
FUNCTION = re.compile(rf"^(?:{RETURNS} )*{RETURNS}[ &*]+(\w+)\(", re.MULTILINE)
MEMBER = re.compile(rf"^ +(?:{RETURNS} )*{RETURNS}[ &*]+(\w+)\(|::(\w+)\([^;]*?\{{|\b(\w+) ?= ?\[|\[(\w+) =", re.MULTILINE)
PARAMETER = re.compile(r"\b(?:int|class|typename|bool|auto) ([A-Z]\w*)(?= ?[,>=])")
CALLED = re.compile(r"(?:\b(\w+)::)?(?<![\w.>:])(\w+)(?:<[^<>()]*>)?\(|\b(\w+)::(\w+)(?:<[^<>()]*>)?\(")
NOT_CODE = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|//[^\n]*', re.DOTALL)
TYPE = re.compile(rf"(?:(\w+)(?:<[^<>]*>)?::)?(?<![\w.>:])([A-Z]\w*)\b|\b(\w+)::([A-Z]\w*)\b")


class Sources:
    def __init__(self, root):
        self.paths = {path.relative_to(root).as_posix(): path
                      for layer in LAYERS for path in sorted((root / layer).rglob("*.[ch]pp"))}

    @functools.cache
    def code(self, name):
        return NOT_CODE.sub("", self.paths[name].read_text())

    @functools.cache
    def included(self, name):
        return [other for other in INCLUDE.findall(self.paths[name].read_text()) if other in self.paths]

    def reached(self, name):
        seen, left = {name}, [name]
        while left:
            for other in set(self.included(left.pop())) - seen:
                seen.add(other)
                left.append(other)
        return seen

    @functools.cache
    def members(self, name):
        return {found for member in MEMBER.findall(self.code(name)) for found in member}

    def declaring_headers(self):
        """{function: header} of what one header alone declares in a namespace, and nothing else has the name."""
        headers = [name for name in self.paths if name.endswith(".hpp")]
        declaring = defaultdict(set)
        for name in headers:
            for found in FUNCTION.findall(self.code(name)):
                declaring[found].add(name)
        others = {found for name in self.paths for found in self.members(name)}
        return {found: min(names) for found, names in declaring.items() if len(names) == 1 and found not in others}

    def defining_headers(self):
        """{type: header} of what one header defines in a namespace, and no other header gives its name to anything."""
        headers = [name for name in self.paths if name.endswith(".hpp")]
        named = defaultdict(set)
        for name in headers:
            for found in NAMED.findall(self.code(name)):
                named[found].add(name)
        return {found: name for name in headers for found in DEFINED.findall(self.code(name)) if named[found] == {name}}


def standing_alone(pattern, code):
    """Names that stand alone or behind a namespace: what belongs to a type comes with that."""
    for found in pattern.finditer(code):
        scope, name = (found[1], found[2]) if found[2] else (found[3], found[4])
        if scope is None or scope in LAYERS + ("abut",):
            yield name


def opened(code, name):
    """Whether the code looks into an object of this type. A declaration of the type alone allows that to templates only."""
    objects = re.findall(rf"\b{name}\b(?:<[^<>]*>)?(?: const)? ?[&*]? ?(\w+)\b", code)
    return any(re.search(rf"(?<![\w.>]){found}(?:\.|->)\w", code) for found in set(objects))


def missing_in(sources, headers, functions):
    for name in sources.paths:
        reached = sources.reached(name)
        code = sources.code(name)
        known = {*NAMED.findall(code), *PARAMETER.findall(code), *sources.members(name)}
        declared = {found for other in reached for found in DECLARED.findall(sources.code(other))}
        for found in sorted(set(standing_alone(TYPE, code)) - known):
            if found not in headers or headers[found] in reached:
                continue
            if found not in declared or name.endswith(".cpp") and opened(code, found):
                yield f"{name} names {found} and does not include abut/{headers[found]}"
        known = set(FUNCTION.findall(code))
        for found in sorted(set(standing_alone(CALLED, code)) - known):
            if found in functions and functions[found] not in reached:
                yield f"{name} calls {found} and does not include abut/{functions[found]}"


def main():
    sources = Sources(pathlib.Path(sys.argv[1]))
    headers = sources.defining_headers()
    functions = sources.declaring_headers()
    assert headers, f"no header below {sys.argv[1]} defines a type: nothing was looked at"
    if wrong := list(missing_in(sources, headers, functions)):
        sys.exit("\n".join(wrong))
    print(f"{len(sources.paths)} sources and headers include the headers of the {len(headers)} types and {len(functions)} functions that they name")


main()
