"""report.html in a real browser: RUN is the folder of a finished run, ZROBENCH the program."""
import base64
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import ulog
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By

RUN = Path(os.environ["RUN"])
FLAGS = ("--headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
         "--disable-background-networking --disable-component-update --disable-sync "
         "--disable-dev-shm-usage --window-size=1280,900").split()
PLOTS = ["offset-x", "offset-y", "offset-z", "temperatures", "raw", "corrected", "tone-map"]


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.profile = tempfile.mkdtemp()
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for flag in [*FLAGS, f"--user-data-dir={cls.profile}"]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        shutil.rmtree(cls.profile, ignore_errors=True)

    def setUp(self):
        for log in ("browser", "performance"):
            self.browser.get_log(log)  # what went before, the start page's too
        self.open(RUN)

    def open(self, run):
        self.browser.get((run / "report.html").as_uri())

    def text(self, css):
        return self.browser.find_element(By.CSS_SELECTOR, css).text

    def plots(self):
        return json.loads(self.browser.find_element(By.ID, "plots").get_attribute("textContent"))

    def marks(self, plot):
        return json.loads(self.browser.find_element(By.ID, plot).get_attribute("data-marks"))

    def drag(self, plot, from_share, to_share):
        canvas = self.browser.find_elements(By.CSS_SELECTOR, f"#{plot} canvas")[-1]
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas)
        width = canvas.size["width"]
        ActionChains(self.browser).move_to_element_with_offset(
            canvas, int((from_share - 0.5) * width), 0).click_and_hold().move_by_offset(
            int((to_share - from_share) * width), 0).release().perform()

    def test_nothing_is_said_on_the_console(self):
        self.assertEqual([], self.browser.get_log("browser"))

    def test_nobody_else_is_asked(self):
        urls = [message["params"]["request"]["url"]
                for entry in self.browser.get_log("performance")
                for message in [json.loads(entry["message"])["message"]]
                if message["method"] == "Network.requestWillBeSent"]
        self.assertIn((RUN / "report.html").as_uri(), urls)
        self.assertEqual([], [u for u in urls if not u.startswith(("file:", "data:"))])

    def test_first_screen_has_verdict_reasons_and_gaps(self):
        manifest = json.loads((RUN / "run.json").read_text())
        self.assertEqual(manifest["verdict"], self.text("#verdict"))
        rows = self.browser.find_elements(By.CSS_SELECTOR, "#checks tbody tr")
        self.assertEqual([c["verdict"] for c in manifest["checks"]],
                         [row.find_element(By.CLASS_NAME, "badge").text for row in rows])
        for css in ("#checks", "#not-exercised"):
            box = self.browser.find_element(By.CSS_SELECTOR, css).rect
            self.assertLess(box["y"] + box["height"], 900, f"{css} is beyond the first screen")
        seen = set(ulog.decision_codes(RUN / "record.ulg"))
        gaps = self.browser.find_element(By.ID, "not-exercised").get_attribute("textContent")
        never = set(map(int, re.findall(r"(\d+)\xa0", gaps)))  # number, no-break space, name
        self.assertEqual(set(range(1, 17)) - seen, never)

    def test_plots_hold_what_the_record_holds(self):
        codes = ulog.decision_codes(RUN / "record.ulg")
        origins = ulog.final_entries(RUN / "record.ulg")
        plots = self.plots()
        self.assertEqual(codes, [r["code"] for r in plots["readings"]])
        self.assertEqual([{1: "factory", 2: "learned"}[o] for o in origins],
                         [e["origin"] for e in plots["entries"]])
        refused = sum(1 <= c <= 16 for c in codes)
        self.assertGreater(refused, 0)
        self.assertEqual(refused, len(self.browser.find_elements(
            By.CSS_SELECTOR, "#refusals tbody tr")))

    def test_each_entry_and_each_reading_is_a_mark(self):
        origins = ulog.final_entries(RUN / "record.ulg")
        for axis in "xyz":
            marks = self.marks(f"offset-{axis}")
            self.assertEqual(origins.count(2), marks["entry, learned"])
            self.assertEqual(origins.count(1), marks["entry, factory"])
            self.assertEqual(ulog.refusals_with_reading(RUN / "record.ulg"),
                             marks["reading refused"])
            self.assertGreater(marks["rig's raw mean, quiet second"], 100)

    def test_every_plot_has_ink_and_units(self):
        for plot in PLOTS:
            inked = self.browser.execute_script(
                "const c = document.querySelector(`#${arguments[0]} canvas`);"
                "return c.getContext('2d').getImageData(0, 0, c.width, c.height).data"
                ".filter((v, i) => i % 4 === 3 && v > 0).length", plot)
            self.assertGreater(inked, 1000, plot)
            labels = [e.text for e in self.browser.find_elements(
                By.CSS_SELECTOR, f"#{plot} .dygraph-label")]
            self.assertEqual(2, len(labels), plot)
            self.assertTrue(all(re.search(r"\[.+\]", label) for label in labels), labels)

    def test_time_plots_zoom_together(self):
        window = lambda plot: self.browser.find_element(By.ID, plot).get_attribute("data-window")
        before = window("raw")
        self.drag("temperatures", 0.3, 0.5)
        self.assertNotEqual(before, window("temperatures"))
        self.assertEqual(window("temperatures"), window("raw"))
        self.assertEqual(window("temperatures"), window("corrected"))

    def test_zoom_leaves_fewer_marks_and_hover_names_one(self):
        everything = self.marks("offset-x")["rig's raw mean, quiet second"]
        self.drag("offset-x", 0.6, 0.8)
        self.assertLess(self.marks("offset-x")["rig's raw mean, quiet second"], everything)
        output = self.browser.find_elements(By.CSS_SELECTOR, "#offsets output")[0]
        self.assertRegex(output.text, "mdps")

    def test_deviation_from_the_rigs_mean_is_a_few_mdps(self):
        self.browser.find_element(
            By.XPATH, "//section[@id='offsets']//button[contains(., 'deviation')]").click()
        self.assertIn("deviation [mdps]", self.text("#offset-x"))
        plots, marks = self.plots(), self.marks("offset-x")
        near = [e["origin"] for e in plots["entries"]
                if min(abs(c[0] - e["degc"]) for c in plots["cloud"]) < 0.3]
        self.assertEqual(near.count("learned"), marks["entry, learned"])
        self.assertEqual(near.count("factory"), marks["entry, factory"])
        ticks = [float(e.text) for e in self.browser.find_elements(
            By.CSS_SELECTOR, "#offset-x .dygraph-axis-label-y")]
        self.assertLess(max(map(abs, ticks)), 60)

    def test_a_failure_and_hostile_texts_are_shown_as_texts(self):
        with tempfile.TemporaryDirectory() as folder:
            run = Path(folder) / "run"
            shutil.copytree(RUN, run)
            manifest = json.loads((run / "run.json").read_text())
            manifest["verdict"] = manifest["checks"][0]["verdict"] = "fail"
            hostile = "</td><script>document.title = 'taken'</script> & \"so\""
            manifest["checks"][0]["reason"] = hostile
            (run / "run.json").write_text(json.dumps(manifest))
            (run / "report.html").unlink()
            said = subprocess.run([os.environ["ZROBENCH"], "report", str(run), "--json"],
                                  check=True, capture_output=True).stdout
            self.assertEqual(str(run / "report.html"), json.loads(said)["html"])
            self.open(run)
            self.assertEqual("fail", self.text("#verdict"))
            self.assertIn(hostile, self.text("#checks tbody tr"))
            self.assertNotEqual("taken", self.browser.title)

    def test_prints_on_a4(self):
        printed = self.browser.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})
        pdf = base64.b64decode(printed["data"])
        self.assertTrue(pdf.startswith(b"%PDF"))
        pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
        self.assertIn(pages, range(2, 10))
        boxes = re.findall(rb"/MediaBox\s*\[0 0 ([\d.]+) ([\d.]+)\]", pdf)
        self.assertEqual(pages, len(boxes))
        for width, height in boxes:
            self.assertAlmostEqual(595.3, float(width), delta=1)
            self.assertAlmostEqual(841.9, float(height), delta=1)

    def test_the_verdict_needs_no_script(self):
        self.browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
        try:
            self.open(RUN)
            self.assertEqual("pass", self.text("#verdict"))
            self.assertIn("never seen", self.text("#not-exercised"))
            self.assertIn("need JavaScript", self.text("main"))
        finally:
            self.browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


if __name__ == "__main__":
    unittest.main()
