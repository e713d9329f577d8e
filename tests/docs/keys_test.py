"""Whether the documentation has every key that the sources read from TOML files, and its default. Run by ctest."""

import re
import tomllib
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Which sources read the files of which dictionary. Keys of several dictionaries may have one name.
READERS = {
    "mission": ("firmware/host/mission", "firmware/host/listening"),
    "environment": ("sim/ocean/file", "sim/search/scenario"),
    "run": ("policy/ppo/training_run.cpp", "policy/ppo/training_reward.cpp", "firmware/host/listening"),
    "vehicle": ("firmware/host/trust/vehicle_file.cpp",),
}
KINDS = "number|number_or|integer|integer_or|boolean_or|text|text_or|choice|choice_or|choices|numbers|texts"
CALL = re.compile(rf"\b(?:{KINDS}|read_size|read_bounds|duration_or)\((?:\w+, )?(\"[a-z_0-9]+\"|k[A-Z]\w*)")
DEFAULT = re.compile(r"\b(?:number_or|integer_or)\(\"([a-z_0-9]+)\", (-?[0-9][0-9'.e+-]*),")
CONSTANT = re.compile(r"\b(k[A-Z]\w*) = (\"[a-z_0-9]+\");")


def text_of(places: tuple[str, ...]) -> str:
    files = [f for p in places for f in ([ROOT / p] if p.endswith(".cpp") else sorted((ROOT / p).rglob("*.cpp")))]
    if not files:
        raise FileNotFoundError(", ".join(places))
    return "\n".join(file.read_text() for file in files)


def keys_read(text: str) -> set[str]:
    constants = dict(CONSTANT.findall(text))
    written = [constants.get(key, key) for key in CALL.findall(text)]
    return {key.strip('"') for key in written if key.startswith('"')}


def documented(name: str) -> list[list[str]]:
    said = tomllib.loads((ROOT / f"toolchains/docs/keys/{name}.toml").read_text())
    return [key for table in said["table"] for key in table["keys"]]


class Keys(unittest.TestCase):
    def test_that_are_read_are_found_in_code(self):
        text = 'const char* kZero = "zero";\n t.number("a_m", r); t.choice_or(kZero, 0, w); read_size(t, "b", x)'
        self.assertEqual(keys_read(text), {"a_m", "zero", "b"})

    def test_of_every_file_are_documented(self):
        for name, places in READERS.items():
            found = keys_read(text_of(places))
            self.assertGreater(len(found), 3, name)
            missing = found - {key[0] for key in documented(name)}
            self.assertEqual(missing, set(), f"toolchains/docs/keys/{name}.toml lacks keys that the sources read")

    def test_have_the_default_that_the_sources_have(self):
        compared = 0
        for name, places in READERS.items():
            defaults = {key: value.replace("'", "") for key, value in DEFAULT.findall(text_of(places))}
            for key, default, _ in documented(name):
                if key in defaults and re.fullmatch(r"-?[0-9.e+-]+", default):
                    compared += 1
                    self.assertEqual(float(default), float(defaults[key]), f"{name}.toml: {key}")
        self.assertGreater(compared, 20)


if __name__ == "__main__":
    unittest.main()
