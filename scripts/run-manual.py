#!/usr/bin/env python3
"""Runs every command of the manual and renews what the manual shows of it: numbers and pictures.

    scripts/run-manual.py [--check] ZIPACT      with --check, says whether the numbers are up to date
    scripts/run-manual.py --pages               says which pages these are

In the console blocks of PAGES, what stands after "$ " (and "> ", where it continues) is run in one folder beside examples/. The other lines of a block are a choice of what the command prints, found again by their label; "..."
stands for what is left out. PICTURES are copied from the results.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
PAGES = ["getting-started.md", "studies.md", "actuators.md", "control.md", "materials.md", "phone-video.md", "paper.md"]
PICTURES = {
    "unlike-ribbons.svg": "unlike/plots/shapes.svg",
    "curved.svg": "curved-rest/plots/shapes.svg",
    "antagonists-motion.svg": "antagonists-motion/plots/members.svg",
    "stack-tolerances.svg": "stack-tolerances/plots/parallel.svg",
    "stationary.svg": "stationary/plots/shape.svg",
    "pull-in.svg": "equilibrium/plots/stroke.svg",
    "limits.svg": "chart/plots/loads.svg",
    "design-chart.svg": "design/plots/map.svg",
    "stress.svg": "stress/plots/stress.svg",
    "sensitivity.svg": "counts/plots/tornado.svg",
    "sensitivity-zip.svg": "counts-zip/plots/tornado.svg",
    "calibrate.svg": "calibrate/plots/fit.svg",
    "plan.svg": "plan/plots/plan.svg",
    "video.svg": "video/plots/fit.svg",
    "video-margin.svg": "after/plots/distribution.svg",
    "fits.svg": "bench/plots/fits.svg",
    "likelihood.svg": "bench/plots/likelihood.svg",
    "regions.svg": "bench/plots/regions.svg",
    "information.svg": "bench/plots/information.svg",
    "profile.svg": "profile/plots/profile.svg",
    "field.svg": "profile/plots/field_tip.svg",
    "isometric.svg": "isometric/plots/forces.svg",
    "actuate.svg": "actuate/plots/stroke.svg",
    "profiles.svg": "actuate/plots/profiles.svg",
    "modes.svg": "modes/plots/modes.svg",
    "reproduce.svg": "reproduce/plots/fig-8.svg",
    "sweep.svg": "sweep/plots/contraction.svg",
    "release.svg": "release/plots/stroke.svg",
    "film.svg": "actuate/plots/film.svg",
    "bead.svg": "bead/plots/forces.svg",
    "hold.svg": "hold/plots/interface.svg",
    "meter.svg": "meter/plots/sense.svg",
    "stack.svg": "stack/plots/members.svg",
    "stack-unlike.svg": "stack-unlike/plots/members.svg",
    "network.svg": "network/plots/members.svg",
    "ports.svg": "ports/plots/voltages.svg",
    "tree.gif": "tree/plots/animation.gif",
    "tree-slow.svg": "tree-slow/plots/stroke.svg",
    "column.gif": "column/plots/animation.gif",
    "column.svg": "column/plots/members.svg",
    "joint.gif": "joint/plots/animation.gif",
    "joint.svg": "joint/plots/members.svg",
    "gripper.gif": "gripper/plots/animation.gif",
    "inchworm.gif": "inchworm/plots/animation.gif",
    "inchworm.svg": "inchworm/plots/members.svg",
    "stack-steps.svg": "stack-steps/plots/stroke.svg",
    "stack-modes.svg": "stack-modes/plots/modes.svg",
    "antagonists.svg": "antagonists/plots/shapes.svg",
    "pre-opened.svg": "pre-opened/plots/shapes.svg",
    "coil-set.svg": "coil-set/plots/strokes.svg",
    "ipmc.svg": "ipmc/plots/stroke.svg",
    "curling-flange.svg": "curling/plots/voltages.svg",
    "curling-flange.gif": "curling-motion/plots/animation.gif",
    "return-spring.svg": "spring/plots/stroke.svg",
    "hinge.svg": "hinge-torque/plots/torques.svg",
    "plate.svg": "plate/plots/stroke.svg",
    "plate.gif": "plate/plots/animation.gif",
    "yielding.svg": "yielding/plots/plastic.svg",
    "caught-mass.svg": "caught-mass/plots/stroke.svg",
    "off-centre.svg": "off-centre/plots/profiles.svg",
    "held-clip.svg": "held-clip/plots/profiles.svg",
    "control.svg": "control/plots/control.svg",
    "tilted.svg": "tilted/plots/stroke.svg",
    "heavy-clips.svg": "heavy-clips/plots/zip_time.svg",
    "tension.svg": "tension/plots/frequencies.svg",
    "creep.svg": "creep/plots/stroke.svg",
    "wide-strip.svg": "wide-strip/plots/strokes.svg",
    "materials.svg": "materials/plots/distribution.svg",
    "pouch.gif": "pouch/plots/animation.gif",
    "pouch.svg": "pouch/plots/pressure.svg",
    "pouch-force.svg": "pouch-force/plots/forces.svg",
    "demo.gif": "motion/plots/animation.gif",
}


def run(command, folder):
    """What `command` prints; the manual shows no command that fails."""
    result = subprocess.run(command, shell=True, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if result.returncode != 0:
        sys.exit("%s\n%sexit status %d" % (command, result.stdout, result.returncode))
    return result.stdout.splitlines()


def label(line):
    """What a line says before its first number: "zip time" of "  zip time   152 ms"; of a note its first two words, of another sentence its first."""
    found = re.match(r"\s*(note: \S+ \S+)", line) or re.match(r"\s*(.*?\S)(?:  +[-+.\d]|  +-$|: )", line + " ")
    return found.group(1) if found else line.split()[0] if line.split() else ""


def renewed(shown, printed):
    """The lines `shown`, as they are now among those `printed`."""
    rest = iter(printed)
    for line in shown:
        if line == "...":
            yield line
            continue
        found = next((new for new in rest if label(new) == label(line)), None)
        if found is None:
            sys.exit("the manual shows a line that is not printed: " + line)
        yield found.rstrip()


def check_example(command, folder):
    """An example that is run as it is leaves a summary and a picture; tests/examples.sh relies on that."""
    found = re.fullmatch(r"zipact run examples/[\w-]+\.yaml -o (out/[a-z-]+)", command)
    results = pathlib.Path(folder) / found.group(1) if found else None
    if results and not (results / "summary.json").stat().st_size:
        sys.exit("%s: no summary" % command)
    if results and not any(picture.stat().st_size > 1024 for picture in results.glob("plots/*.svg")):
        sys.exit("%s: no pictures" % command)


def block(lines, folder):
    """A console block, run again."""
    text = "\n".join(lines)
    for command, shown in re.findall(r"^\$ (.*(?:\n> .*)*)((?:\n(?!\$ ).*)*)", text, re.M):
        yield "$ " + command
        yield from renewed(shown.splitlines()[1:], run(command.replace("\n> ", "\n"), folder))
        check_example(command, folder)


def page(text, folder):
    """The text of a page with all its console blocks run again."""
    def again(match):
        return match.group(1) + "\n".join(block(match.group(2).splitlines(), folder)) + "\n```"

    return re.sub(r"(```console\n)(.*?)\n```", again, text, flags=re.S)


def copy_pictures(results):
    for name, source in PICTURES.items():
        shutil.copyfile(results / source, DOCS / "images" / name)


def main():
    if sys.argv[1:] == ["--pages"]:
        print(" ".join(PAGES))
        return
    check = sys.argv[1:2] == ["--check"]
    zipact = pathlib.Path(sys.argv[-1]).resolve()
    os.environ["PATH"] = "%s:%s" % (zipact.parent, os.environ["PATH"])
    old = []
    with tempfile.TemporaryDirectory() as scratch:
        shutil.copytree(DOCS.parent / "examples", scratch + "/examples")
        for name in PAGES:
            text = (DOCS / name).read_text(encoding="utf-8")
            new = page(text, scratch)
            old += [name] if new != text else []
            if not check:
                (DOCS / name).write_text(new, encoding="utf-8")
        results = pathlib.Path(scratch) / "out"
        missing = [source for source in PICTURES.values() if not (results / source).is_file()]
        if not check and not missing:
            copy_pictures(results)
    if missing:
        sys.exit("not drawn: %s" % ", ".join(missing))
    if check and old:
        sys.exit("out of date: %s: make docs" % ", ".join("docs/" + name for name in old))
    if check:
        print("%d passed, 0 failed" % len(PAGES))


if __name__ == "__main__":
    main()
