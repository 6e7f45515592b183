"""Pages: `holdfast view` and --html. What they hold, and that foreign text cannot become script."""
import base64
import hashlib
import html.parser
import json
import re
import struct
import zlib

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off, shifted

HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'&"


class Page(html.parser.HTMLParser):
    """Elements of a page, with their text, as a browser without script would have them."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.elements, self.open = [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.elements.append({"tag": tag, "text": "", **dict(attributes)})
        self.open.append(self.elements[-1])

    def handle_endtag(self, tag):
        while self.open and self.open.pop()["tag"] != tag:
            pass

    def handle_data(self, data):
        for element in self.open:
            element["text"] += data

    def all(self, tag, **attributes):
        return [e for e in self.elements
                if e["tag"] == tag and all(e.get(k.rstrip("_").replace("_", "-")) == v for k, v in attributes.items())]


def data_of(page):
    """The header of a page's data."""
    raw = zlib.decompress(base64.b64decode(page.all("script", id="data")[0]["text"]))
    size = struct.unpack("<I", raw[:4])[0]
    return json.loads(raw[4:4 + size])


class ViewTest(CliTest):
    def page(self, name="page.html"):
        return Page((self.folder / name).read_text(encoding="utf-8"))

    def crossing(self):
        return self.write("crossing.off", off(cube() + cube((0.5, 0.25, 0.125)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))

    def test_policy_lets_its_own_script_run_alone(self):
        self.run_program("view", "cube.off", "-o", "page.html")
        page = self.page()
        policy = page.all("meta", http_equiv="Content-Security-Policy")[0]["content"]
        rules = dict(rule.split(" ", 1) for rule in policy.split("; "))
        self.assertEqual(rules["default-src"], "'none'")
        self.assertNotIn("unsafe", policy)
        self.assertNotIn("http", policy)
        scripts = [e for e in page.all("script") if e.get("id") != "data"]
        self.assertEqual(len(scripts), 1)
        for element, rule in ((scripts[0], "script-src"), (page.all("style")[0], "style-src")):
            digest = base64.b64encode(hashlib.sha256(element["text"].encode()).digest()).decode()
            self.assertEqual(rules[rule], f"'sha256-{digest}'")
        self.assertFalse([e for e in page.elements if any(k.startswith("on") or k in ("src", "href") for k in e)])

    def test_surfaces_and_volumes(self):
        self.run_program("mesh", "cube.off", "-o", "cube.vtu", "--fill", "-q")
        self.run_program("view", "cube.vtu", "cube.off", "-o", "page.html")
        told = data_of(self.page())
        self.assertEqual([(part["name"], part["kind"]) for part in told["parts"]],
                         [("cube.vtu", "volume"), ("cube.off", "surface")])
        counts = {a["name"]: a["count"] for a in told["parts"][0]["arrays"]}
        self.assertEqual(counts["facets"], 36)
        self.assertGreater(counts["tetrahedra"], 0)

    def test_a_surface_in_a_format_of_volumes(self):
        self.run_program("repair", "cube.off", "-o", "cube.mesh", "-q")
        self.run_program("view", "cube.mesh", "-o", "page.html")
        self.assertEqual(data_of(self.page())["parts"][0]["kind"], "surface")

    def test_a_volume_in_a_format_that_is_only_read(self):
        self.write("tet.avs", "4 1 0 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n1 7 tet 1 2 3 4\n")
        self.run_program("view", "tet.avs", "-o", "page.html")
        self.assertEqual(data_of(self.page())["parts"][0]["kind"], "volume")

    def test_to_standard_output(self):
        text = self.run_program("view", "cube.off", "-o", "-").stdout
        self.assertTrue(text.startswith("<!DOCTYPE html>") and text.endswith("</html>\n"))

    def test_a_temporary_page_is_told(self):
        ended = self.run_program("view", "cube.off", "-q")
        path = ended.stdout.strip()
        self.assertRegex(path, r"holdfast-\w+\.html$")
        with open(path, encoding="utf-8") as file:
            self.assertIn("<!DOCTYPE html>", file.read(100))

    def test_every_defect_stands_in_the_page(self):
        self.crossing()
        self.run_program("diagnose", "crossing.off", "--html", "page.html", "--report", "report.json", expect=4)
        page = self.page()
        defects = json.loads((self.folder / "report.json").read_text())["defects"]
        self.assertGreater(len(defects), 3)
        texts = [e["text"] for e in page.all("button") if "data-entry" in e]
        for defect in defects:
            self.assertTrue(any(defect["message"] in text for text in texts), defect)
        told = data_of(page)["entries"]
        self.assertEqual(len(told), len(texts))
        self.assertTrue(all(e["where"] or e["vertices"] or e["facets"] for e in told))
        self.assertIn("not valid", page.all("section", id="tab-verdict")[0]["text"])

    def test_each_command_writes_a_page(self):
        self.crossing()
        self.run_program("mesh", "cube.off", "-o", "cube.vtu", "--fill", "-q", "--html", "mesh.html")
        self.run_program("mesh", "crossing.off", "-o", "no.vtu", "--fill", "-q", "--html", "refused.html", expect=4)
        self.run_program("check", "cube.off", "cube.vtu", "-q", "--html", "check.html")
        self.run_program("repair", "crossing.off", "-o", "after.off", "-q", "--html", "repair.html")
        self.run_program("untangle", "cube.vtu", "-o", "again.vtu", "-q", "--html", "untangle.html")
        kinds = {name: [part["kind"] for part in data_of(self.page(name))["parts"]]
                 for name in ("mesh.html", "refused.html", "check.html", "repair.html", "untangle.html")}
        self.assertEqual(kinds, {"mesh.html": ["volume"], "refused.html": ["surface"], "check.html": ["volume", "surface"],
                                 "repair.html": ["surface", "surface"], "untangle.html": ["volume", "volume"]})
        rules = self.page("check.html").all("section", id="tab-verdict")[0]["text"]
        self.assertEqual(rules.count("holds"), 14)  # the verdict and 13 rules
        self.assertIn('"outcome": "done"', self.page("mesh.html").all("section", id="tab-report")[0]["text"])

    def test_hostile_names_stay_text(self):
        name = "<img src=x onerror=alert(3)>.off"
        self.write(name, off(CUBE_POINTS, CUBE_FACETS))
        self.run_program("mesh", name, "-o", "cube.vtu", "--fill", "-q", "--region", "0.5,0.5,0.5,3",
                         "--name", "region:3=" + HOSTILE, "--html", "page.html")
        text = (self.folder / "page.html").read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual(len(page.all("script")), 2)
        self.assertFalse(page.all("img"))
        self.assertEqual(page.all("title")[0]["text"], name)
        names = data_of(page)["parts"][0]["names"]
        self.assertEqual(names["regions"]["3"], HOSTILE)
        self.assertFalse(re.search("alert\\(1\\)</script>", text))

    def test_a_page_is_no_file_of_the_run_otherwise(self):
        ended = self.run_program("diagnose", "cube.off", "--html", "cube.off", expect=2)
        self.assertIn("--html would overwrite the input", ended.stderr)
        self.run_program("view", "cube.off", "-o", "no/page.html", expect=3)
        self.assertEqual(self.files(), ["cube.off"])

    def test_what_cannot_be_read(self):
        self.run_program("view", "missing.vtu", "-o", "page.html", expect=3)
        self.write("half.vtu", "<VTKFile")
        self.run_program("view", "half.vtu", "-o", "page.html", expect=3)
        self.assertEqual(self.files(), ["cube.off", "half.vtu"])


if __name__ == "__main__":
    main()
