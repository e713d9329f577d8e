"""What stands around the code, and nothing else runs: forms, workflow, container, hooks. Run by ctest (forms_test)."""

import json
import re
import unittest
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
INSTRUCTIONS = {
    "FROM", "RUN", "CMD", "LABEL", "EXPOSE", "ENV", "ADD", "COPY", "ENTRYPOINT", "VOLUME", "USER", "WORKDIR", "ARG",
}  # fmt: skip
FIELDS = {"markdown", "textarea", "input", "dropdown", "checkboxes"}


def instructions() -> list[tuple[str, str]]:
    """Of the Dockerfile, lines that go on put together."""
    text = (ROOT / ".devcontainer/Dockerfile").read_text().replace("\\\n", " ")
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return [(line.split(None, 1)[0], line.split(None, 1)[1]) for line in lines]


class Forms(unittest.TestCase):
    def test_of_issues_have_what_github_asks_for(self):
        forms = [f for f in sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml")) if f.name != "config.yml"]
        self.assertGreaterEqual(len(forms), 3)
        for form in forms:
            said = yaml.safe_load(form.read_text())
            self.assertTrue(said["name"] and said["description"], form.name)
            names = [field["id"] for field in said["body"]]
            self.assertEqual(len(names), len(set(names)), form.name)
            for field in said["body"]:
                self.assertIn(field["type"], FIELDS, form.name)
                self.assertTrue(field["attributes"]["label"], form.name)


class Workflow(unittest.TestCase):
    def test_runs_the_script_that_everybody_can_run(self):
        said = yaml.safe_load((ROOT / ".github/workflows/ci.yml").read_text())
        steps = [step for job in said["jobs"].values() for step in job["steps"]]
        self.assertIn(".ci/run", [step.get("run") for step in steps])
        for step in steps:
            self.assertEqual(len({"run", "uses"} & set(step)), 1, step)


class Hooks(unittest.TestCase):
    def test_call_programs_of_the_tree_that_are_there(self):
        said = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text())
        entries = [hook["entry"].split() for repository in said["repos"] for hook in repository["hooks"]]
        self.assertIn(["toolchains/format"], entries)
        for words in entries:
            for word in words:
                if "/" in word and not word.startswith("/"):
                    self.assertTrue((ROOT / word).is_file(), word)


class Container(unittest.TestCase):
    def test_is_described_by_instructions_that_docker_knows(self):
        for name, _ in instructions():
            self.assertIn(name, INSTRUCTIONS)
        self.assertEqual(instructions()[0], ("FROM", "debian:12"))

    def test_copies_what_is_there_and_calls_what_is_there(self):
        for name, words in instructions():
            if name == "COPY":
                for source in words.split()[:-1]:
                    self.assertTrue((ROOT / source).exists(), source)
            for script in re.findall(r"\btoolchains/[a-z]+\b", words) if name == "RUN" else []:
                self.assertTrue((ROOT / script).is_file(), script)

    def test_installs_groups_and_builds_programs_that_there_are(self):
        commands = "; ".join(words for name, words in instructions() if name == "RUN")
        groups = {line.split()[0] for line in (ROOT / "toolchains/packages.txt").read_text().splitlines() if line}
        for words in re.findall(r"toolchains/setup ([a-z ]+)", commands):
            self.assertLessEqual(set(words.split()), groups)
        built = re.findall(r"toolchains/build release ([a-z -]+)", commands)[0].split()
        needed = re.findall(r"\brelease (earshot[a-z -]+)\"?$", (ROOT / "sim/fly").read_text(), re.MULTILINE)[0].split()
        self.assertLessEqual(set(needed), set(built), "sim/fly would build in the container what the image lacks")

    def test_flies_one_search(self):
        self.assertEqual(json.loads(instructions()[-1][1]), ["sim/fly"])
        said = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text())
        self.assertTrue((ROOT / ".devcontainer" / said["build"]["dockerfile"]).is_file())


if __name__ == "__main__":
    unittest.main()
