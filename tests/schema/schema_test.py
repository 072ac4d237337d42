"""Judges zwang's schemas, and its SARIF, by an independent validator (python3-jsonschema).

    schema_test.py PROGRAM ROOT

Every shipped file and every file that the golden suite accepts passes the schema of its kind; files with an
unknown, a missing or a misshapen key do not; and every shipped file has the modeline that makes an editor use
the schema. Ends with 1 and says why when anything is otherwise.
"""

import json
import pathlib
import re
import subprocess
import sys

import jsonschema
import yaml


class Yaml12Loader(yaml.SafeLoader):
    """PyYAML reads `y`, `on` and `no` as booleans, as YAML 1.1 has it; editors and zwang read YAML 1.2."""


Yaml12Loader.yaml_implicit_resolvers = {}
for tag, pattern, first in [
    ("bool", r"^(true|false)$", "tf"),
    ("int", r"^[-+]?[0-9]+$", "-+0123456789"),
    ("float", r"^[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$", "-+.0123456789"),
    ("null", r"^(~|null|)$", ["~", "n", ""]),
]:
    Yaml12Loader.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile(pattern), list(first))


def load(path):
    return yaml.load(path.read_text(encoding="utf-8"), Yaml12Loader)


def kind_of(content):
    for key, kind in [("zwang_robot", "robot"), ("zwang_scene", "scene"), ("zwang_scenario", "scenario"),
                      ("zwang_connection", "connection"), ("zwang_study", "study")]:
        if isinstance(content, dict) and key in content:
            return kind
    return "task"


# What a schema can see. A sample of the golden suite in which nothing else is wrong.
SEEN_BY_SCHEMA = [
    "E101_level_key", "E101_misspelt_quantity", "E101_misspelt_required_key", "E101_no_suggestion",
    "E103_group_without_in", "E104_about_list", "E104_bare_axis", "E104_no_value", "E104_three_ends",
    "E108_other_version", "E504_no_age", "robot_ok_without_stop",
]


def main(program, root):
    root = pathlib.Path(root)
    failures = []
    validators = {}
    for kind in ["task", "robot", "scene", "scenario", "connection", "study"]:
        schema = json.loads(subprocess.run([program, "schema", kind], check=True, capture_output=True).stdout)
        jsonschema.Draft7Validator.check_schema(schema)
        validators[kind] = jsonschema.Draft7Validator(schema)

    def errors(path):
        content = load(path)
        return [e.message for e in validators[kind_of(content)].iter_errors(content)]

    def expect_good(path):
        for message in errors(path)[:1]:
            failures.append(f"{path}: {message[:300]}")

    shipped = [p for p in sorted((root / "specs").rglob("*.yaml"))]
    if len(shipped) < 3:
        failures.append("no shipped files found: the search is broken")
    for path in shipped:
        expect_good(path)
        modeline = re.match(r"# yaml-language-server: \$schema=(\S+)\n", path.read_text(encoding="utf-8"))
        if not modeline:
            failures.append(f"{path}: does not start with the modeline of its schema")
        elif (path.parent / modeline[1]).resolve() != (root / "specs/schemas" / (kind_of(load(path)) + ".json")).resolve():
            failures.append(f"{path}: the modeline names another schema")

    accepted = 0
    for expected in sorted((root / "tests/conformance").glob("*.expected")):
        path = expected.with_suffix(".yaml")
        if path.exists() and "error " not in expected.read_text(encoding="utf-8"):
            accepted += 1
            expect_good(path)
    if accepted < 20:
        failures.append("hardly any golden file is accepted: the search is broken")
    cases = root / ".." / "shared" / "cases"
    for path in sorted(cases.glob("*.yaml")) if cases.is_dir() else []:
        expect_good(path)

    for name in SEEN_BY_SCHEMA:
        path = root / "tests/conformance" / (name + ".yaml")
        if name == "robot_ok_without_stop":
            content = load(root / "tests/conformance/robot_ok.yaml")
            del content["stop"]
            if validators["robot"].is_valid(content):
                failures.append("a robot file without `stop` passes")
        elif not errors(path):
            failures.append(f"{path}: passes the schema")

    sarif_schema = json.loads((root / "tests/schema/sarif_excerpt.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(sarif_schema)
    files = [str(p) for p in sorted((root / "tests/conformance").glob("*.yaml"))]
    log = json.loads(subprocess.run([program, "validate", "--format", "sarif", "--notes"] + files,
                                    capture_output=True).stdout)
    if len(log["runs"][0]["results"]) < 50:
        failures.append("hardly any result in the SARIF log")
    for error in jsonschema.Draft7Validator(sarif_schema).iter_errors(log):
        failures.append(f"SARIF: {list(error.absolute_path)}: {error.message[:300]}")
    ids = {rule["id"] for rule in log["runs"][0]["tool"]["driver"]["rules"]}
    for result in log["runs"][0]["results"]:
        if result["ruleId"] not in ids:
            failures.append(f"SARIF: no rule {result['ruleId']}")

    for failure in failures:
        print(failure)
    print(f"{len(shipped)} shipped, {accepted} golden files, {len(log['runs'][0]['results'])} SARIF results")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
