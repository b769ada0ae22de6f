#!/usr/bin/python3
"""lint.py BUILD_DIR: clang-format over all tracked sources, clang-tidy over the product's own.

A source that passed is not looked at again until it, one of its headers or the rules change.
"""
import hashlib
import json
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RULES = [ROOT / ".clang-tidy", Path(__file__).resolve()]
JOBS = 2


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def format_is_clean(sources):
    return subprocess.run(["clang-format", "--dry-run", "-Werror", *sources], cwd=ROOT).returncode == 0


def headers_by_object(build):
    """What ninja knows each object to be made of, as far as it is ours."""
    headers, current = {}, None
    for line in output_of("ninja", "-C", str(build), "-t", "deps").splitlines():
        if line.startswith("    "):
            if line.strip().startswith(str(ROOT)):
                headers[current].append(Path(line.strip()))
        elif ": #deps" in line:
            current = line.split(":")[0]
            headers[current] = []
    return headers


def object_of(command):
    words = shlex.split(command["command"])
    return words[words.index("-o") + 1]


def without_gcc_pch(commands, folder):
    """Writes the compile commands without gcc's precompiled headers, which clang cannot read."""
    for command in commands:
        command["command"] = re.sub(r" (-include \S*cmake_pch\.hxx|-fpch-preprocess|-Winvalid-pch)",
                                    "", command["command"])
    (folder / "compile_commands.json").write_text(json.dumps(commands))


def key_of(files, contents={}):
    """Hash of the files' names and contents."""
    digest = hashlib.sha256()
    for file in files:
        if file not in contents:
            contents[file] = hashlib.sha256(file.read_bytes()).digest()
        digest.update(str(file).encode() + contents[file])
    return digest.hexdigest()


def tidy(commands, source):
    """What clang-tidy says, empty when the source is clean."""
    # The build's own compiler gives the warnings; clang's differ, and are not errors here.
    done = subprocess.run(["clang-tidy", "--quiet", "--extra-arg=-Wno-error", "-p", str(commands),
                           str(source)], capture_output=True, text=True)
    return done.stdout + done.stderr if done.returncode else ""


def main():
    build = Path(sys.argv[1]).resolve()
    tracked = output_of("git", "-C", str(ROOT), "ls-files", "*.cc", "*.h").split()
    ours = {ROOT / name for name in tracked}
    clean = format_is_clean(tracked)

    headers = headers_by_object(build)
    passed = build / "lint-passed"
    passed.mkdir(exist_ok=True)
    commands = json.loads((build / "compile_commands.json").read_text())
    without_gcc_pch(commands, passed)
    todo = {}
    for command in commands:
        source = Path(command["file"])
        # Tests are many and each draws in all of GoogleTest: minutes for little.
        if source not in ours or (ROOT / "tests") in source.parents:
            continue
        stamp = passed / key_of([*RULES, source, *headers.get(object_of(command), [])])
        if not stamp.exists():
            todo[source] = stamp
    if todo:
        print(f"lint: clang-tidy over {len(todo)} files", flush=True)
    with ThreadPoolExecutor(JOBS) as pool:
        for (source, stamp), said in zip(todo.items(), pool.map(lambda s: tidy(passed, s), todo)):
            if said:
                clean = False
                print(said, f"lint: {source} failed", sep="\n", flush=True)
            else:
                stamp.touch()
    print("lint: clean" if clean else "lint: FAILED")
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
