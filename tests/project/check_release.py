"""Tries scripts/release in a repository of its own: check_release.py ROOT. The files that it writes are copies of those of ROOT."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

files = ("CMakeLists.txt", "CITATION.cff", "docs/cite.md", "docs/index.md", "CHANGELOG.md", "scripts/release")


def main(root):
    with tempfile.TemporaryDirectory() as folder:
        repository = pathlib.Path(folder)
        for name in files:
            (repository / name).parent.mkdir(exist_ok=True)
            shutil.copy2(root / name, repository / name)

        def git(*words):
            settings = ("-c", "user.name=Nobody", "-c", "user.email=nobody@example.org")
            return subprocess.run(("git", *settings, *words), cwd=repository, check=True, capture_output=True, text=True).stdout

        def release(version):
            who = {f"GIT_{role}_{what}": value for role in ("AUTHOR", "COMMITTER") for what, value in
                   (("NAME", "Nobody"), ("EMAIL", "nobody@example.org"))}
            return subprocess.run((repository / "scripts/release", version), env={"PATH": "/usr/bin:/bin", "HOME": folder, **who},
                                  capture_output=True, text=True)

        def refuses(version, text):
            before = {name: (repository / name).read_bytes() for name in files}
            tried = release(version)
            assert tried.returncode == 2 and text in tried.stderr, f"{version}: {tried.stderr}"
            assert before == {name: (repository / name).read_bytes() for name in files}, f"{version}: a file was changed"

        git("init", "-q")
        git("add", ".")
        git("commit", "-qm", "all")
        refuses("1.2", "is no version")
        (repository / "CITATION.cff").write_text((root / "CITATION.cff").read_text() + "\n")
        refuses("7.8.9", "the tree has changes")
        git("checkout", "-q", ".")

        done = release("7.8.9")
        assert done.returncode == 0, done.stderr
        assert git("tag").split() == ["v7.8.9"] and not git("status", "--porcelain")
        assert "project(abut VERSION 7.8.9 " in (repository / "CMakeLists.txt").read_text()
        citation = (repository / "CITATION.cff").read_text()
        assert re.search(r"^version: 7\.8\.9\ndate-released: \d{4}-\d\d-\d\d$", citation, re.M), citation[:300]
        assert "version = {7.8.9}" in (repository / "docs/cite.md").read_text()
        assert "This is version 7.8.9," in (repository / "docs/index.md").read_text()
        changes = (repository / "CHANGELOG.md").read_text()
        assert re.search(r"^## Unreleased\n\n## 7\.8\.9 - \d{4}-\d\d-\d\d\n\n### ", changes, re.M), changes[:900]

        refuses("7.8.9", "the tag v7.8.9 is there")
        refuses("7.9.0", "has nothing under")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
