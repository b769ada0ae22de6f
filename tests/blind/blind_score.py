#!/usr/bin/python3
"""blind_score.py --cases DIR --sealed DIR2 [--json FILE]

Opens the labels, checks their hashes and scores each case's diagnosis.json against its label.
Prints the table of targets, each with its n and a 95 % Clopper-Pearson interval.
Exits 1 when a hash does not match its label: then nothing is scored.
"""
import argparse
import hashlib
import json
import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

NULLS = ("null", "null_flicker", "null_drafts", "parameter_only", "not_excited")
AMBIGUOUS_BELOW = 25.0  # noncentrality against the nearest look-alike
NO_ANSWER = {"verdict": "no_answer"}


# ---------------------------------------------------------------------------------------- input

def check_hashes(sealed):
    """Names of cases whose label or nonce is not what was sealed."""
    wrong = []
    for line in (sealed / "hashes.txt").read_text().splitlines():
        stated, name = line.split()
        label = (sealed / name / "label.json").read_bytes()
        nonce = (sealed / name / "nonce").read_bytes()
        if hashlib.sha256(label + nonce).hexdigest() != stated:
            wrong.append(name)
    return wrong


def read_answer(path):
    """The answer, or one that says why there is none; never raises."""
    try:
        answer = json.loads(path.read_text())
    except (OSError, ValueError) as problem:
        return dict(NO_ANSWER, problem=f"{path}: {problem}")
    if not isinstance(answer, dict) or not isinstance(answer.get("verdict"), str):
        return dict(NO_ANSWER, problem=f"{path}: no verdict in it")
    return answer


def as_list(value):
    return value if isinstance(value, list) else []


def as_dict(value):
    return value if isinstance(value, dict) else {}


@dataclass
class Case:
    """One label beside its answer."""
    name: str
    label: dict
    answer: dict
    truth: list = field(init=False)
    named: list = field(init=False)
    reach: set = field(init=False)

    def __post_init__(self):
        self.truth = [effect["id"] for effect in self.label["effects"]]
        terms = [as_dict(term).get("id") for term in as_list(self.answer.get("terms"))]
        naming = self.answer["verdict"] in ("named", "partly_explained")
        self.named = [t for t in terms if isinstance(t, str)] if naming else []
        ambiguity = [t for t in as_list(self.answer.get("ambiguity")) if isinstance(t, str)]
        self.reach = set(self.named) | set(ambiguity)

    @property
    def kind(self):
        return self.label["class"]

    @property
    def strength(self):
        return min((effect["lambda"] for effect in self.label["effects"]), default=0.0)

    @property
    def separable(self):
        return all(e["nearest_noncentrality"] >= AMBIGUOUS_BELOW for e in self.label["effects"])

    @property
    def detected(self):
        mismatch = as_dict(self.answer.get("mismatch")).get("detected") is True
        return mismatch or self.answer["verdict"] in (
            "named", "ambiguity_set", "partly_explained", "unexplained", "bus_fault")

    @property
    def false_name(self):
        """A name for what was not there."""
        return bool(set(self.named) - set(self.truth))


def read_cases(cases, sealed, answer="diagnosis.json"):
    names = [line.split()[1] for line in (sealed / "hashes.txt").read_text().splitlines()]
    return [Case(name, json.loads((sealed / name / "label.json").read_text()),
                 read_answer(cases / name / answer)) for name in names]


# ----------------------------------------------------------------------------------- statistics

def binomial_tail(n, k, p):
    """P(X >= k) of a binomial."""
    if k <= 0:
        return 1.0
    if p <= 0:
        return 0.0
    if p >= 1:
        return 1.0
    return sum(math.exp(math.lgamma(n + 1) - math.lgamma(i + 1) - math.lgamma(n - i + 1)
                        + i * math.log(p) + (n - i) * math.log1p(-p)) for i in range(k, n + 1))


def bisect(rising, target):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if rising(middle) < target else (low, middle)
    return (low + high) / 2


def clopper_pearson(k, n, confidence=0.95):
    """Exact two-sided interval of a share k/n (Clopper and Pearson 1934)."""
    if n == 0:
        return 0.0, 1.0
    tail = (1 - confidence) / 2
    low = bisect(lambda p: binomial_tail(n, k, p), tail) if k > 0 else 0.0
    high = bisect(lambda p: binomial_tail(n, k + 1, p), 1 - tail) if k < n else 1.0
    return low, high


def quantile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))] if ordered else None


# -------------------------------------------------------------------------------------- measures

@dataclass
class Row:
    """One line of the table; `good` counts of `n`, or a plain value."""
    name: str
    target: str
    n: int
    good: int = 0
    value: float | None = None
    met: bool | None = None

    def text(self):
        if self.n == 0:
            return f"{self.name:58} {self.target:>12}   no cases"
        verdict = {True: "met", False: "MISSED", None: ""}[self.met]
        if self.value is not None:
            return f"{self.name:58} {self.target:>12} {self.value:9.3g} {'':17} n={self.n:<4} {verdict}"
        low, high = clopper_pearson(self.good, self.n)
        return (f"{self.name:58} {self.target:>12} {100 * self.good / self.n:8.1f}% "
                f"[{100 * low:5.1f},{100 * high:6.1f}] n={self.n:<4} {verdict}")


def share(name, cases, good, at_least=None, at_most=None):
    """A target share; where few are wanted, a case without an answer counts among them."""
    cases = list(cases)
    silent = at_most is not None
    count = sum(1 for case in cases
                if good(case) or (silent and case.answer["verdict"] == NO_ANSWER["verdict"]))
    target = f">= {at_least} %" if at_least is not None else f"<= {at_most} %" if at_most is not None else ""
    met = None
    if cases and target:
        percent = 100 * count / len(cases)
        met = percent >= at_least if at_least is not None else percent <= at_most
    return Row(name, target, len(cases), count, None, met)


def quantile_row(name, values, target, limit, at_least=False, share_of=0.5):
    value = quantile(values, share_of)
    met = None
    if value is not None:
        met = value >= limit if at_least else value <= limit
    return Row(name, target, len(values), 0, value, met)


def mean_row(name, values, at_most):
    value = sum(values) / len(values) if values else None
    return Row(name, f"<= {at_most}", len(values), 0, value, value <= at_most if values else None)


def named_right(case):
    return set(case.named) == set(case.truth)


def truth_in_reach(case):
    return set(case.truth) <= case.reach


def seconds_in(intervals):
    covered = set()
    for run, spans in as_dict(intervals).items():
        for span in as_list(spans):
            if isinstance(span, list) and len(span) == 2:
                covered |= {(run, t) for t in range(int(span[0]) // 10, int(span[1]) // 10)}
    return covered


def localisation(case):
    truth = seconds_in(case.label["intervals_s"])
    said = seconds_in(as_dict(case.answer.get("mismatch")).get("intervals_s"))
    return len(truth & said) / len(truth | said) if truth | said else None


def numbers(value):
    values = value if isinstance(value, list) else [value]
    return values if all(isinstance(v, (int, float)) for v in values) else []


def covered(effect, term):
    """Whether the 95 % intervals hold the truth; None where the two are told in other units.

    Compared by unit: the analyser names its parameters as it likes.
    """
    answers = [as_dict(p) for p in as_dict(term.get("parameters")).values()]
    hits = []
    for truth in effect["parameters"].values():
        same = [p for p in answers if "unit" in truth and p.get("unit") == truth["unit"]]
        wanted = numbers(truth["value"])
        spans = [s for p in same for s in intervals_of(p)]
        if len(spans) != len(wanted):
            continue
        hits += [low <= value <= high for value, (low, high) in zip(wanted, spans)]
    return all(hits) if hits else None


def intervals_of(parameter):
    """[[lo, hi], ...] of a parameter, whether it is one number or one an axis."""
    ci95 = as_list(parameter.get("ci95"))
    if ci95 and not isinstance(ci95[0], list):
        ci95 = [ci95]
    return [s for s in ci95 if isinstance(s, list) and len(numbers(s)) == 2 and len(s) == 2]


def coverage(cases):
    """[conditional on the right name], [a miss counts as uncovered]."""
    conditional, unconditional = [], []
    for case in cases:
        terms = {as_dict(t).get("id"): t for t in as_list(case.answer.get("terms"))}
        for effect in case.label["effects"]:
            if effect["id"] not in case.named:
                unconditional.append(False)
                continue
            hit = covered(effect, terms[effect["id"]])
            if hit is not None:
                conditional.append(hit)
                unconditional.append(hit)
    return conditional, unconditional


def excess_errors(cases):
    """(after - floor) / (before - floor) of held-out error, floor as the answer states it."""
    excess = []
    for case in cases:
        for term in as_list(case.answer.get("terms")):
            if as_dict(term).get("id") not in case.truth:
                continue
            before, after, floor = (as_dict(term.get(key)) for key in (
                "heldout_rmse_before", "heldout_rmse_after", "noise_floor_rmse"))
            for channel in set(before) & set(after) & set(floor) & set(case.label["channels"]):
                if before[channel] > 1.02 * floor[channel]:
                    excess.append((after[channel] - floor[channel]) / (before[channel] - floor[channel]))
    return excess


def plain_share(name, hits, low, high):
    row = Row(name, f"{low}-{high} %", len(hits), sum(hits))
    if hits:
        row.met = low <= 100 * row.good / row.n <= high
    return row


def table(cases):
    known = [c for c in cases if c.kind in ("single", "decoy")]
    strong = [c for c in known if c.strength >= 39]
    of = {kind: [c for c in cases if c.kind == kind] for kind in
          (*NULLS, "pair", "foreign")}
    conditional, unconditional = coverage(strong)
    unseparable = [c for c in strong if not c.separable]
    rows = [
        share("naming, lambda >= 40, separable", [c for c in strong if c.separable], named_right, 90),
        share("truth in name or set, lambda >= 40", strong, truth_in_reach, 95),
        share("  of these not separable: set holds the truth, no single name", unseparable,
              lambda c: not c.named and truth_in_reach(c)),
        mean_row("  mean set size there", [len(c.reach) for c in unseparable if c.reach], 2.5),
        share("false names, plain nulls", of["null"], lambda c: bool(c.named), None, 2),
        share("false names, 1.5 x flicker", of["null_flicker"], lambda c: bool(c.named), None, 5),
        share("false names, 2 x drafts", of["null_drafts"], lambda c: bool(c.named), None, 5),
        share("false names, parameters only", of["parameter_only"], lambda c: bool(c.named), None, 5),
        share("false names, not excited", of["not_excited"], lambda c: c.false_name, None, 5),
        share("detected, lambda 15-25", [c for c in known if 15 <= c.strength <= 25],
              lambda c: c.detected, 60),
        share("wrong names, single effects of any strength", known, lambda c: c.false_name),
        quantile_row("excess held-out error, median", excess_errors(strong), "<= 0.10", 0.10),
        plain_share("95 % intervals that hold the truth, named right", conditional, 92, 97),
        share("the same, a miss counts as uncovered", unconditional, lambda hit: hit),
        share("pairs: both named or in the set", of["pair"], truth_in_reach, 80),
        share("pairs: both named", of["pair"], named_right),
        share("out of catalogue: unexplained or partly", of["foreign"],
              lambda c: c.answer["verdict"] in ("unexplained", "partly_explained"), 85),
        share("false abstention, lambda >= 40", strong,
              lambda c: c.answer["verdict"] == "unexplained", None, 5),
        quantile_row("localisation, intersection over union, median",
                     [v for v in map(localisation, (c for c in strong if c.detected)) if v is not None],
                     ">= 0.6", 0.6, True),
        share("answers that are no answer", cases, lambda c: c.answer["verdict"] == "no_answer", None, 0),
    ]
    seconds = [c.answer["seconds"] for c in cases if isinstance(c.answer.get("seconds"), (int, float))]
    rows.append(quantile_row("seconds, median", seconds, "<= 10", 10))
    rows.append(quantile_row("seconds, most", seconds, "<= 60", 60, share_of=1.0))
    return rows


def confusion(cases):
    """{truth: {answer: count}} of single effects at lambda >= 40, and of nulls."""
    matrix = {}
    for case in cases:
        if case.kind in ("single", "decoy") and case.strength < 39:
            continue
        truth = " + ".join(sorted(case.truth)) if case.kind in ("single", "decoy", "foreign") else case.kind
        said = " + ".join(sorted(case.named)) or case.answer["verdict"]
        matrix.setdefault(truth, {}).setdefault(said, 0)
        matrix[truth][said] += 1
    return matrix


def metadata_leak(cases_dir, cases):
    """Share of cases whose null-or-not the nearest neighbour in file sizes and number guesses.

    Chance is the larger class's share; much above it, the files' form tells what they hide.
    """
    points = []
    for index, case in enumerate(cases):
        folder = cases_dir / case.name
        sizes = [f.stat().st_size for f in sorted(folder.glob("run-*.csv"))]
        points.append(([*sizes, 50 * index], case.kind in NULLS))
    if len(points) < 10 or any(len(p[0]) != len(points[0][0]) for p in points):
        return None
    right = 0
    for i, (here, truth) in enumerate(points):
        others = (p for j, p in enumerate(points) if j != i)
        nearest = sorted(others, key=lambda p: math.dist(p[0], here))[:5]
        right += (sum(guess for _, guess in nearest) >= 3) == truth
    nulls = sum(truth for _, truth in points)
    return right, len(points), max(nulls, len(points) - nulls)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--cases", type=Path, required=True)
    parser.add_argument("--sealed", type=Path, required=True)
    parser.add_argument("--answer", default="diagnosis.json", help="file beside each case")
    parser.add_argument("--json", type=Path, help="the same as JSON")
    args = parser.parse_args()

    wrong = check_hashes(args.sealed)
    if wrong:
        print(f"blind_score: label or nonce changed after sealing: {', '.join(wrong)}", file=sys.stderr)
        return 1
    cases = read_cases(args.cases, args.sealed, args.answer)
    print(f"{len(cases)} cases, all hashes as sealed\n")
    rows = table(cases)
    for row in rows:
        print(row.text())
    print("\nconfusion (truth: answers)")
    for truth, said in sorted(confusion(cases).items()):
        print(f"  {truth}: " + ", ".join(f"{k} {v}" for k, v in sorted(said.items())))
    leak = metadata_leak(args.cases, cases)
    if leak:
        right, n, majority = leak
        low, high = clopper_pearson(right, n)
        print(f"\nmetadata alone guesses null or not in {right} of {n} "
              f"[{100 * low:.0f}, {100 * high:.0f}] %; always the larger class: {majority}")
    for case in cases:
        if case.answer.get("problem"):
            print(f"no answer: {case.answer['problem']}")
    if args.json:
        args.json.write_text(json.dumps({
            "rows": [vars(row) for row in rows], "confusion": confusion(cases)}, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
