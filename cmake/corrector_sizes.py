#!/usr/bin/python3
"""corrector_sizes.py SOURCE_DIR HOST_CXX OUT: what the corrector takes, on the host and a Cortex-M4F.

Prints it, and keeps it in OUT.
State: sizeof zro::Corrector. Stack: the deepest chain of calls of one zro_step, frames as the
compiler reports them (storage callbacks not counted). Text: all object files, -Os. The second line
needs arm-none-eabi-g++; without it, it says so.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FLAGS = ["-std=c++20", "-Os", "-ffreestanding", "-fno-exceptions", "-fno-rtti", "-fno-math-errno",
         "-fno-threadsafe-statics", "-ffp-contract=off", "-fcallgraph-info=su"]
CORTEX_M4F = ["-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"]
STATE = '#include "corrector/corrector.h"\nextern const char state[sizeof(zro::Corrector)];\n' \
        'const char state[sizeof(zro::Corrector)] = {};\n'


def compile_all(compiler, flags, source, folder):
    """Compiles each source of the corrector into `folder`."""
    (folder / "state.cc").write_text(STATE)
    for file in [*sorted((source / "corrector").glob("*.cc")), folder / "state.cc"]:
        subprocess.run([compiler, *FLAGS, *flags, f"-I{source}", "-c", file, "-o",
                        folder / f"{file.stem}.o"], check=True, cwd=folder)


def state_bytes(nm, folder):
    line = subprocess.run([nm, "-S", folder / "state.o"], check=True, capture_output=True, text=True)
    return int(line.stdout.split()[1], 16)


def text_bytes(size, folder):
    objects = [o for o in folder.glob("*.o") if o.stem != "state"]
    out = subprocess.run([size, "-t", *objects], check=True, capture_output=True, text=True).stdout
    return int(out.splitlines()[-1].split()[0])


def stack_bytes(folder):
    """The deepest path from zro_step through the call graphs of all objects."""
    frames, calls = {}, {}
    for graph in folder.glob("*.ci"):
        text = graph.read_text()
        for title, label in re.findall(r'node: \{ title: "([^"]*)" label: "([^"]*)"', text):
            frame = re.search(r"(\d+) bytes", label)
            if frame:
                frames[title] = int(frame[1])
        for caller, callee in re.findall(r'sourcename: "([^"]*)" targetname: "([^"]*)"', text):
            calls.setdefault(caller, set()).add(callee)

    def deepest(name, above):
        below = [deepest(c, above | {name}) for c in calls.get(name, ()) if c not in above]
        return frames.get(name, 0) + max(below, default=0)

    return deepest("zro_step", frozenset())


def report(name, compiler, flags, source):
    prefix = compiler[: -len("g++")] if compiler.endswith("arm-none-eabi-g++") else ""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        compile_all(compiler, flags, source, folder)
        return (f"corrector on {name}: state {state_bytes(prefix + 'nm', folder)} B, "
                f"stack {stack_bytes(folder)} B, text {text_bytes(prefix + 'size', folder)} B (-Os)")


def main():
    source, host, out = Path(sys.argv[1]).resolve(), sys.argv[2], Path(sys.argv[3])
    lines = [report("the host", host, [], source)]
    arm = shutil.which("arm-none-eabi-g++")
    lines.append(report("a Cortex-M4F", arm, CORTEX_M4F, source) if arm else
                 "corrector on a Cortex-M4F: not measured, arm-none-eabi-g++ is not installed")
    out.write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


main()
