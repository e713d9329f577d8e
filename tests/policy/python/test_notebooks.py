"""The notebooks of policy/python/notebooks: every cell runs, in order, as Jupyter would run it.

Run by ctest (run in this folder).
"""

import json
import os
import tempfile
import unittest
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

ROOT = Path(__file__).resolve().parents[3]
NOTEBOOKS = sorted((ROOT / "policy/python/notebooks").glob("*.ipynb"))


class EveryNotebook(unittest.TestCase):
    def test_runs(self):
        self.assertEqual(len(NOTEBOOKS), 5)
        for path in NOTEBOOKS:
            variables: dict[str, Any] = {"__name__": "__main__"}
            with self.subTest(notebook=path.name), tempfile.TemporaryDirectory() as folder:
                os.chdir(folder)
                for cell in json.loads(path.read_text())["cells"]:
                    if cell["cell_type"] == "code":
                        exec(compile("".join(cell["source"]), f"{path.name}, {cell['id']}", "exec"), variables)
                os.chdir(ROOT)

    def test_shows_what_its_cells_gave(self):
        for path in NOTEBOOKS:
            with self.subTest(notebook=path.name):
                shown = [o for c in json.loads(path.read_text())["cells"] for o in c.get("outputs", [])]
                self.assertTrue(any("image/png" in output.get("data", {}) for output in shown))
                self.assertFalse(any(output["output_type"] == "error" for output in shown))


if __name__ == "__main__":
    unittest.main()
