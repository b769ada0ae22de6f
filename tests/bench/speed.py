#!/usr/bin/python3
"""How fast a run is, the whole program on one core, by CPU time: other programs do not count.

  tests/bench/speed.py                   four hours of bench time, three times; the best counts
  tests/bench/speed.py --repeat 10       forty hours: does memory grow?
  tests/bench/speed.py --zrobench PATH   another program than build/release's
"""
import argparse
import datetime
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent


def profile(repeat):
    """The bench profile with its steps `repeat` times over."""
    text = (HERE / "four-hours.toml").read_text()
    steps, expects = text.index("[[step]]"), text.index("[[expect]]")
    return text[:steps] + text[steps:expects] * repeat + text[expects:]


def seconds(manifest):
    began, ended = (datetime.datetime.fromisoformat(manifest[key].replace("Z", "+00:00"))
                    for key in ("started", "ended"))
    return (ended - began).total_seconds()


def measure(zrobench, repeat):
    """Runs the program in a folder of its own; bench seconds, CPU seconds, bytes recorded, kB."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "profile.toml")
        path.write_text(profile(repeat))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([zrobench, "run", path, "--ui", "none"], cwd=folder,
                              stdout=subprocess.PIPE, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode not in (0, 1, 4):  # judged, whatever the verdict
            sys.exit(done.stdout)
        run = next(pathlib.Path(folder, "runs").iterdir())
        bench_s = seconds(json.loads((run / "run.json").read_text()))
        cpu_s = sum(getattr(after, k) - getattr(before, k) for k in ("ru_utime", "ru_stime"))
        return bench_s, cpu_s, os.path.getsize(run / "record.ulg"), after.ru_maxrss


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--zrobench", default=ROOT / "build/release/rig/cli/zrobench")
    parser.add_argument("--repeat", type=int, default=1)
    options = parser.parse_args()
    runs = [measure(options.zrobench, options.repeat) for _ in range(3 if options.repeat == 1 else 1)]
    bench_s, cpu_s, record, peak_kb = min(runs, key=lambda run: run[1])
    print(f"{bench_s / 3600:.2f} h of bench time in {cpu_s:.2f} s of CPU time: "
          f"{bench_s / cpu_s:,.0f} x real time; record {record / bench_s * 3.6e-3:.1f} MB/h; "
          f"memory {peak_kb / 1024:.0f} MB at most")


if __name__ == "__main__":
    main()
