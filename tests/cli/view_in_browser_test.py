"""Two small pages from the committed bundle, opened in headless Chromium: skipped (77) if there is none.

More is tested by `make web-test`, which needs npm.
"""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from cli_case import CUBE_FACETS, CliTest, cube, main, off, shifted

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


class BrowserTest(CliTest):
    def dom(self, page):
        with tempfile.TemporaryDirectory() as profile:
            ended = subprocess.run(
                [BROWSER, "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                 "--ignore-gpu-blocklist", f"--user-data-dir={profile}", "--virtual-time-budget=20000", "--dump-dom",
                 (self.folder / page).as_uri()], capture_output=True, text=True, timeout=120, check=False)
        self.assertIn("</html>", ended.stdout, ended.stderr)
        return ended.stdout

    def test_a_mesh(self):
        self.run_program("mesh", "cube.off", "-o", "cube.vtu", "--fill", "-q", "--html", "page.html")
        dom = self.dom("page.html")
        self.assertIn('data-ready="yes"', dom)
        self.assertRegex(dom, r'id="counts">\d+ of \d+ tetrahedra shown; 12 triangles')

    def test_defects(self):
        self.write("crossing.off", off(cube() + cube((0.5, 0.25, 0.125)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        self.run_program("diagnose", "crossing.off", "-q", "--html", "page.html", expect=4)
        dom = self.dom("page.html")
        self.assertIn('data-ready="yes"', dom)
        self.assertRegex(dom, r'id="counts">24 triangles')
        # The page opens on the list.
        self.assertIsNone(re.search(r'<section id="tab-defects"[^>]*hidden', dom))


if __name__ == "__main__":
    if BROWSER is None:
        print("skipped: no chromium; scripts/setup.sh browser installs it")
        sys.exit(77)
    main()
