"""check_fields.py SOURCE: every struct of abut.h that abut.f90 has a type for has the same fields there, in order and of the same
kind."""
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


def main():
    root = pathlib.Path(sys.argv[1]) / "bindings"
    header, module = (root / "c/abut.h").read_text(), (root / "fortran/abut.f90").read_text().replace("&\n", "")
    in_c = {name: list(fields_in_c(body)) for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", header, re.S)}
    in_fortran = {name: list(fields_in_fortran(body)) for name, body in
                  re.findall(r"type, bind\(c\), public :: (\w+)\n(.*?)end type", module, re.S)}
    assert "abut_options" in in_c and len(in_c) > 5, "the structs of abut.h are not read"
    assert list(fields_in_c("double a[3]; const int32_t* b; int (*c)(void* user);")) == [
        ("a(3)", "real(c_double)"), ("b", "type(c_ptr)"), ("c", "type(c_funptr)")]
    wrong = [f"{name}: abut.h has {in_c[name]}, abut.f90 has {in_fortran.get(name)}" for name in in_c
             if in_c[name] != in_fortran.get(name)]
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


main()
