"""check_fields.py SOURCE: every struct of abut.h and abut_solid.h has a type with the same fields in abut.f90 and abut_solid.f90, in order
and of the same kind."""
import pathlib
import re
import sys

KINDS = {"size_t": "integer(c_size_t)", "int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)",
         "double": "real(c_double)", "char": "character(kind=c_char)", "abut_array": "type(abut_array)"}


def fields_in_c(body):
    """(name, kind) of each field."""
    for line in re.sub(r"/\*.*?\*/", "", body, flags=re.S).split(";"):
        line = " ".join(line.split())
        if not line:
            continue
        if function := re.match(r"\w+ \(\*(\w+)\)\(", line):
            yield function[1], "type(c_funptr)"
            continue
        kind, names = re.match(r"(?:const )?(\w+) ?(.*)", line).groups()
        for name in names.split(","):
            is_pointer = "*" in name
            size = re.search(r"\[(\d+)\]", name)
            name = re.sub(r"[*\s]|\[\d+\]", "", name)
            yield name + (f"({size[1]})" if size else ""), "type(c_ptr)" if is_pointer else KINDS[kind]


def fields_in_fortran(body):
    for line in body.splitlines():
        line = line.split("!")[0].strip()
        if "::" in line:
            kind, names = line.split("::")
            for name in names.split(","):
                yield name.split("=")[0].strip(), kind.strip()


def differences(root, name, least):
    header, module = (root / f"c/{name}.h").read_text(), (root / f"fortran/{name}.f90").read_text().replace("&\n", "")
    in_c = {name: list(fields_in_c(body)) for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", header, re.S)}
    in_fortran = {name: list(fields_in_fortran(body)) for name, body in
                  re.findall(r"type, bind\(c\), public :: (\w+)\n(.*?)end type", module, re.S)}
    assert len(in_c) >= least, f"the structs of {name}.h are not read"
    return [f"{struct}: {name}.h has {in_c[struct]}, {name}.f90 has {in_fortran.get(struct)}" for struct in in_c
            if in_c[struct] != in_fortran.get(struct)]


def main():
    root = pathlib.Path(sys.argv[1]) / "bindings"
    assert list(fields_in_c("double a[3]; const int32_t* b; int (*c)(void* user);")) == [
        ("a(3)", "real(c_double)"), ("b", "type(c_ptr)"), ("c", "type(c_funptr)")]
    wrong = differences(root, "abut", 6) + differences(root, "abut_solid", 5)
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


main()
