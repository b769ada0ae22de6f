#!/usr/bin/python3
"""The scorer on answers made by hand: an oracle, silence, one that always says creep, rubbish."""
import hashlib
import json
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import blind_score as score  # noqa: E402

EFFECT = {"id": "gyro.supply", "lambda": 100.0, "nearest": "gyro.step", "nearest_noncentrality": 90.0,
          "parameters": {"dps_per_v": {"value": [0.01, 0.02, 0.03], "unit": "dps/V"}}}
TWIN = {"id": "gyro.backlash", "lambda": 100.0, "nearest": "gyro.hysteresis",
        "nearest_noncentrality": 3.0, "parameters": {"w": {"value": 1.0}}}
FOREIGN = {"id": "other.ripple", "lambda": 200.0, "nearest": "gyro.step",
           "nearest_noncentrality": 150.0, "parameters": {}}
SETS = [("null", []), ("null_flicker", []), ("null_drafts", []), ("parameter_only", []),
        ("not_excited", [dict(EFFECT, **{"lambda": 0.5})]), ("single", [EFFECT]),
        ("single", [dict(EFFECT, **{"lambda": 20.0})]), ("single", [TWIN]),
        ("pair", [EFFECT, dict(EFFECT, id="gyro.creep")]), ("foreign", [FOREIGN])]


def term(effect):
    return {"id": effect["id"],
            "parameters": {name: {"value": p["value"], "unit": p.get("unit", ""),
                                  "ci95": [[v - 1, v + 1] for v in score.numbers(p["value"])
                                           and (p["value"] if isinstance(p["value"], list)
                                                else [p["value"]])]}
                           for name, p in effect["parameters"].items()},
            "heldout_rmse_before": {"gyro_x_dps": 2.0}, "heldout_rmse_after": {"gyro_x_dps": 1.05},
            "noise_floor_rmse": {"gyro_x_dps": 1.0}}


def oracle(label):
    answer = {"verdict": "no_missing_physics", "mismatch": {"detected": False}, "seconds": 5.0}
    if label["class"] == "foreign":
        return dict(answer, verdict="unexplained", mismatch={
            "detected": True, "intervals_s": label["intervals_s"]})
    if not label["effects"] or label["class"] == "not_excited":
        return answer
    answer["mismatch"] = {"detected": True, "intervals_s": label["intervals_s"]}
    if any(e["nearest_noncentrality"] < 25 for e in label["effects"]):
        ids = [e["id"] for e in label["effects"]] + [e["nearest"] for e in label["effects"]]
        return dict(answer, verdict="ambiguity_set", terms=[], ambiguity=ids)
    return dict(answer, verdict="named", terms=[term(e) for e in label["effects"]], ambiguity=[])


class Scorer(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        root = Path(self.folder.name)
        self.cases, self.sealed = root / "cases", root / "sealed"
        self.labels, lines = {}, []
        for index, (kind, effects) in enumerate(SETS):
            name = f"case-{index + 1:04}"
            label = {"schema": 1, "case": name, "class": kind, "effects": effects,
                     "channels": ["gyro_x_dps"] if effects else [],
                     "intervals_s": {"run-1": [[0, 600]]} if effects else {}}
            self.labels[name] = label
            text, nonce = json.dumps(label), f"{index:064x}"
            for base in (self.cases, self.sealed):
                (base / name).mkdir(parents=True)
            (self.sealed / name / "label.json").write_text(text)
            (self.sealed / name / "nonce").write_text(nonce)
            lines.append(hashlib.sha256((text + nonce).encode()).hexdigest() + f"  {name}\n")
        (self.sealed / "hashes.txt").write_text("".join(lines))

    def tearDown(self):
        self.folder.cleanup()

    def rows(self, answer):
        for name, label in self.labels.items():
            said = answer(label)
            text = said if isinstance(said, str) else json.dumps(said)
            (self.cases / name / "diagnosis.json").write_text(text)
        return {row.name: row for row in score.table(score.read_cases(self.cases, self.sealed))}

    def test_an_oracle_meets_every_target(self):
        rows = self.rows(oracle)
        for row in rows.values():
            if "intervals that hold" in row.name:
                continue  # an oracle covers 100 %, beyond the band
            self.assertIsNot(row.met, False, row.name)
            self.assertGreater(row.n, 0, row.name)
        self.assertEqual(rows["naming, lambda >= 40, separable"].n, 1)
        self.assertEqual(rows["  mean set size there"].value, 2)
        self.assertAlmostEqual(rows["excess held-out error, median"].value, 0.05)

    def test_silence_names_nothing_and_finds_nothing(self):
        rows = self.rows(lambda label: {"verdict": "no_missing_physics", "seconds": 1})
        self.assertFalse(rows["naming, lambda >= 40, separable"].met)
        self.assertFalse(rows["detected, lambda 15-25"].met)
        self.assertFalse(rows["out of catalogue: unexplained or partly"].met)
        self.assertTrue(rows["false names, plain nulls"].met)
        self.assertEqual(rows["answers that are no answer"].good, 0)

    def test_always_creep_is_caught_on_the_nulls(self):
        rows = self.rows(lambda label: {"verdict": "named", "terms": [{"id": "gyro.creep"}]})
        for kind in ("plain nulls", "1.5 x flicker", "2 x drafts", "parameters only", "not excited"):
            self.assertFalse(rows[f"false names, {kind}"].met, kind)
        self.assertEqual(rows["naming, lambda >= 40, separable"].good, 0)
        self.assertEqual(rows["pairs: both named"].good, 0)

    def test_a_single_name_for_inseparable_twins_is_an_error(self):
        rows = self.rows(lambda label: dict(oracle(label), verdict="named", ambiguity=[],
                                            terms=[term(e) for e in label["effects"]]))
        row = rows["  of these not separable: set holds the truth, no single name"]
        self.assertEqual((row.good, row.n), (0, 1))

    def test_rubbish_counts_against_the_tool_everywhere(self):
        for text in ("", "{", "[]", '{"verdict": 3}', '{"failed": "x"}'):
            rows = self.rows(lambda label: text)
            self.assertEqual(rows["answers that are no answer"].good, len(SETS), text)
            self.assertFalse(rows["false names, plain nulls"].met, text)
            self.assertFalse(rows["false abstention, lambda >= 40"].met, text)
        wrong_types = {"verdict": "named", "terms": [3, {"id": 4}], "ambiguity": {"a": 1},
                       "mismatch": [], "seconds": "x"}
        self.assertEqual(self.rows(lambda label: wrong_types)["pairs: both named"].good, 0)

    def test_a_changed_label_or_nonce_is_found(self):
        self.assertEqual(score.check_hashes(self.sealed), [])
        label = self.sealed / "case-0003" / "label.json"
        label.write_text(label.read_text().replace("null_drafts", "single"))
        nonce = self.sealed / "case-0005" / "nonce"
        nonce.write_text("f" * 64)
        self.assertEqual(score.check_hashes(self.sealed), ["case-0003", "case-0005"])

    def test_clopper_pearson_as_published(self):
        low, high = score.clopper_pearson(0, 200)
        self.assertEqual(low, 0)
        self.assertAlmostEqual(high, 1 - 0.025 ** (1 / 200), places=6)
        low, high = score.clopper_pearson(8, 10)  # Newcombe 1998-style tables
        self.assertAlmostEqual(low, 0.4439, places=3)
        self.assertAlmostEqual(high, 0.9748, places=3)

    def test_localisation_is_a_share_of_the_union(self):
        case = score.Case("case-0001", dict(self.labels["case-0006"]), {
            "verdict": "named", "mismatch": {"intervals_s": {"run-1": [[300, 900]]}}})
        self.assertAlmostEqual(score.localisation(case), 1 / 3)


if __name__ == "__main__":
    unittest.main()
