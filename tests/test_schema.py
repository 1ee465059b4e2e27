#!/usr/bin/env python3
"""The JSON schema of scenarios:  test_schema.py ZIPACT REPOSITORY SCRATCH

It is the committed one; every example names and satisfies it; and it judges scenarios as the command does, right ones and
wrong ones.
"""

import json
import pathlib
import re
import subprocess
import sys

import jsonschema
import yaml

zipact, repository, scratch = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
counts = [0, 0]


def ok(what, good):
    counts[0 if good else 1] += 1
    if not good:
        print("FAILED:", what)


def printed(*words):
    return subprocess.run([zipact, *words], stdout=subprocess.PIPE, text=True, check=True).stdout


class Loader(yaml.SafeLoader):
    """YAML 1.2, as the command and editors read it: 1e-3 is a number."""


Loader.yaml_implicit_resolvers = {k: [r for r in v if r[0] in ("tag:yaml.org,2002:null", "tag:yaml.org,2002:merge")]
                                  for k, v in yaml.SafeLoader.yaml_implicit_resolvers.items()}
NUMBER = r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?"
for tag, pattern, first in (("bool", r"true|True|TRUE|false|False|FALSE", "tTfF"), ("int", r"[-+]?[0-9]+", "-+0123456789"),
                            ("float", NUMBER, "-+.0123456789")):
    Loader.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile("^(?:%s)$" % pattern), list(first))
Loader.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(loader.construct_scalar(node)))
Loader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(loader.construct_scalar(node)))

text = printed("schema")
committed = repository / "docs" / "scenario.schema.json"
ok("docs/scenario.schema.json is current: zipact schema > docs/scenario.schema.json", text == committed.read_text(encoding="utf-8"))
schema = json.loads(text)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)


def fault(document):
    """The first thing that the schema has against a text, None if nothing."""
    error = next(validator.iter_errors(yaml.load(document, Loader) or {}), None)
    return error and "%s: %s" % ("/".join(map(str, error.path)), error.message[:200])


def pattern_of(name):
    """That of the name of a key of any member or segment."""
    numbers = "[1-9]|[1-5][0-9]|6[0-4]" if "segment_K" in name else "[1-9][0-9]{0,2}|10[01][0-9]|102[0-4]"
    return name.replace("_K", "_(?:%s)" % numbers).replace(".", "[.]")


# every key, as a dotted name and in its group, with what is told of it
keys = json.loads(printed("keys", "--json"))
for key in keys:
    name = key["key"]
    entry = schema["definitions"][name]
    ok("%s has its help" % name, entry["description"].startswith(key["help"]))
    ok("%s has its unit" % name, key["type"] not in ("real", "real_auto") or entry["x-unit"] == key["unit"])
    of_members = "_K" in name  # which stands for those of every member, body or spring
    place = schema["patternProperties"]["^%s$" % pattern_of(name)] if of_members else schema["properties"][name]
    ok("%s stands at the root" % name, place == {"$ref": "#/definitions/" + name})
    place = schema
    for part in name.split("."):
        place = place["patternProperties"]["^%s$" % pattern_of(part)] if part.endswith("_K") else place["properties"][part]
    ok("%s stands in its group" % name, place == {"$ref": "#/definitions/" + name})
    default = json.dumps(entry["default"])
    name = name.replace("_K", "_12")
    ok("%s: its default %s is right" % (name, default), not fault("%s: %s" % (name, default)))
    for choice in key["choices"]:
        ok("%s: %s is right" % (name, choice["word"]), not fault("%s: %s" % (name, choice["word"])))
    is_a_name = name in ("member_12.upper", "member_12.lower", "member_12.port", "spring_12.first", "spring_12.second", "joint_12.first", "joint_12.second", "isometric.body", "profile.member")
    ok("%s: a word that is none of its own" % name, key["type"] == "text" or is_a_name or fault(name + ": quux"))

# every example but those of devices that have to be added, and what the command writes
for example in sorted(set(repository.glob("examples/**/*.yaml")) - set(repository.glob("examples/extend/**/*.yaml"))):
    document = example.read_text(encoding="utf-8")
    line = document.splitlines()[0]
    named = (example.parent / line.partition("=")[2]).resolve()
    if "\nfitted:\n" not in document:  # which calibrate writes
        ok("%s begins with the modeline" % example.name, line.startswith("# yaml-language-server: $schema="))
        ok("%s names docs/scenario.schema.json" % example.name, named == committed.resolve())
    ok("%s: %s" % (example.name, fault(document)), not fault(document))
ok("the starter scenario: %s" % fault(printed("keys", "--yaml")), not fault(printed("keys", "--yaml")))

RIGHT = [
    "",
    "load:\n",
    "load: {mass: 8 g}",
    "load.mass: 0.008",
    "load.mass: .5e-2",
    "load.mass: [8 g, 0.02, 1e-3]",
    "load.mass: {from: 1 g, to: 100 g, count: 5, spacing: log}",
    "load.mass: '1 g .. 100 g : 5 log'",
    "load.mass: {normal: 8 g, sigma: 0.1 g}",
    "load.mass: normal(8 g, 0.1 g)",
    "lower: {ribbon: {thickness: auto}, insulator.thickness: 100 um}",
    "lower.ribbon.thickness: 60 um",
    "lower.ribbon: {thickness: 60 um}",
    "ribbon.length: 4 inch",
    "ribbon.young_modulus: 200000 N/mm2",
    "ribbon.density: 7.85 g/cm3",
    "mount.tilt: 180 deg",
    "mesh.nodes: [21, 41]",
    "output.plots: no",
    "output.series: true",
    "study: limits",
    "insulator.resistivity: none",
    "ribbon.poisson_ratio: 30 %",
    "medium.kinematic_viscosity: 50 cSt",
    "load.mass:  8g ",
    "stack.series: 12\nmember_12.ribbon.thickness: 60 um",
    "bodies: {hand: {mass: 8 g, force: [0, 1 mN]}, floor: {moves: none, at: [0, -50 mm]}}\n"
    "members: {left: {upper: frame, lower: hand, drive: {voltage: 8 kV}}, right: {upper: floor, lower: hand, angle: 180 degree}}\n"
    "springs: {back: {between: [frame, hand], stiffness: 5 N/m, kind: pull}}\nmembers.left.ribbon.thickness: 60 um",
    "bodies.hand: {at.y: 3 mm}\nmembers.left: {upper: frame, lower: hand}",
    "stack.series: 12\nmember_9: {ribbon: {thickness: [50 um, auto]}, insulator.thickness: 100 um}",
    "stack.series: 12\nmember_10.ribbon: {young_modulus: 100 GPa}",
]
WRONG = [
    "load.mas: 8 g",
    "member_0.ribbon.thickness: 60 um",
    "bodies: {Hand: {mass: 8 g}}",
    "bodies: {hand: {mas: 8 g}}",
    "springs: {back: {between: [frame]}}",
    "springs.back.kind: soft",
    "member_1025.ribbon.thickness: 60 um",
    "member_K.ribbon.thickness: 60 um",
    "member_3: {ribbon: {thicknes: 60 um}}",
    "load: {mas: 8 g}",
    "load: 8 g",
    "load.mass: heavy",
    "load.mass: 8 mm",
    "load.mass: 8 g g",
    "load.mass: 0x10",
    "load.mass: -1",
    "load.mass: []",
    "load.mass: [8 g, heavy]",
    "load.mass: {from: 1 g, to: 100 g}",
    "load.mass: {from: 1 g, to: 100 g, count: 5, step: 2}",
    "load.mass: {normal: 8 g, to: 9 g}",
    "load.mass: true",
    "mesh.nodes: 3",
    "mesh.nodes: 20.5",
    "mesh.nodes: 21 mm",
    "contact.model: sticky",
    "contact.model: [unilateral]",
    "output.plots: perhaps",
    "study: fly",
    "ribbon.poisson_ratio: 0.7",
    "ribbon.length: auto",
    "- 1",
]
scratch.mkdir(parents=True, exist_ok=True)
for right, documents in ((True, RIGHT), (False, WRONG)):
    for document in documents:
        (scratch / "scenario.yaml").write_text(document + "\n", encoding="utf-8")
        run = subprocess.run([zipact, "stationary", str(scratch / "scenario.yaml"), "--no-plots", "--quiet", "-o", str(scratch / "run")],
                             stderr=subprocess.PIPE, text=True)
        ok("the command takes %r: %s" % (document, run.stderr), run.returncode in (0, 1) if right else run.returncode == 2)
        ok("the schema judges %r as the command does: %s" % (document, fault(document)), bool(fault(document)) != right)

print("%d passed, %d failed" % tuple(counts))
sys.exit(counts[1] != 0)
