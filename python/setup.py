"""Builds the wheel:  pip wheel --no-build-isolation --no-deps --no-index python/

CMake builds the C library from the repository around this folder, with the flags that it always has, so that numbers
are those of the command to the last bit; the extension is linked to it. Keys.def becomes zipact/keys.py, for type
checkers and editors. Needs the repository: there is no source distribution.

In the environment, ZIPACT_SANITIZE=address,undefined builds with sanitizers, and ZIPACT_BUILD names a build folder that has
the library already; what is compiled for the wheel is kept there, too, since objects of two builds must not mix.
"""

import ast
import glob
import os
import re
import shlex
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path.insert(0, os.path.join(ROOT, "scripts"))
from keys_table import rows  # noqa: E402

LIBRARIES = ["libfyaml", "udunits", "jansson", "hdf5-serial", "nlopt", "sqlite3"]
WARNINGS = ["-Wall", "-Wextra", "-Wconversion", "-Wno-missing-field-initializers"]
SANITIZE = os.environ.get("ZIPACT_SANITIZE", "")
BUILD = os.environ.get("ZIPACT_BUILD", "")
# as CMakeLists.txt has it
HARDENED = ["-fstack-protector-strong", *([] if SANITIZE else ["-U_FORTIFY_SOURCE", "-D_FORTIFY_SOURCE=3"])]
HARDENED_LINK = ["-Wl,-z,relro,-z,now"]


def read(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return file.read()


def version():
    return re.search(r'ZP_VERSION "(.*)"', read("include/zipact/version.h")).group(1)


def pkg_config(option):
    return shlex.split(subprocess.check_output(["pkg-config", option, *LIBRARIES], text=True))


class BuildExtension(build_ext):
    """Builds the library first."""

    def build_library(self):
        folder = BUILD
        if not folder:
            folder = os.path.abspath(os.path.join(self.build_temp, "core-" + (SANITIZE.replace(",", "-") or "release")))
            configure = ["cmake", "-S", ROOT, "-B", folder, "-DZIPACT_TESTS=OFF", "-DZIPACT_SANITIZE=" + SANITIZE]
            subprocess.check_call(configure, stdout=sys.stderr)
        targets = ["zipact_io_static", "zipact_static"]
        jobs = str(os.cpu_count() or 1)
        subprocess.check_call(["cmake", "--build", folder, "-j", jobs, "--target", *targets], stdout=sys.stderr)
        return [os.path.join(folder, name) for name in ("libzipact-io.a", "libzipact.a")]

    def build_extension(self, extension):
        archives = self.build_library()
        extension.depends += archives
        extension.extra_objects = archives
        # without link-time optimisation, as CMakeLists.txt has it: quick to link
        extension.extra_link_args = ["-fno-lto", "-Wl,--exclude-libs,ALL", *HARDENED_LINK, *pkg_config("--libs"), "-lm", "-lpthread"]
        if SANITIZE:
            extension.extra_compile_args.append("-fsanitize=" + SANITIZE)
            extension.extra_link_args.append("-fsanitize=" + SANITIZE)
        super().build_extension(extension)


def arguments(path, macro):
    """(name of the macro, its arguments as C texts) of each line ZP_MACRO(...) of a table."""
    for _, name, given in rows(read(path)):
        if re.fullmatch(macro, name):
            yield name, given


def choices():
    """Words of each choice type."""
    words, of = [], {}
    of["ZpStudy"] = ['"%s"' % given[1] for _, given in arguments("include/zipact/studies.def", "STUDY")]
    of["ZpActuatorKind"] = ['"%s"' % given[1] for _, given in arguments("include/zipact/devices.def", "KIND")]
    for name, given in arguments("include/zipact/choices.def", "CHOICE|CHOICES_END"):
        if name == "CHOICE":
            words.append(given[1])
        elif words:
            of[given[0]], words = words, []
    return of


def keywords():
    """The text of zipact/keywords.py."""
    types = {"REAL": "Number", "REAL_AUTO": "Number", "REAL_OR_AUTO": "Number", "REAL_NONE": "Number", "INT": "int", "BOOL": "bool", "TEXT": "str"}
    words = choices()
    lines = [
        '"""Every key of an actuator as a keyword; made from keys.def by setup.py."""',
        "",
        "from typing import Literal, TypedDict",
        "",
        "Number = float | str  # SI, or a text with a unit",
        "",
        "",
        "class Keywords(TypedDict, total=False):",
        '    """Keys, the dot written as two underscores."""',
    ]
    for kind, given in arguments("src/def/keys.def", "REAL|REAL_AS|REAL_AUTO|REAL_OR_AUTO|REAL_NONE|INT|BOOL|ENUM|TEXT|OF_SCENARIO"):
        if kind == "OF_SCENARIO":  # a choice key without a group
            kind, given = "ENUM", ["", *given]
        if kind == "REAL_AS":  # the field has another name
            kind, given = "REAL", [given[0], *given[2:]]
        type_ = "Literal[%s]" % ", ".join(words[given[2]]) if kind == "ENUM" else types[kind]
        unit = ast.literal_eval(given[2]) if kind.startswith("REAL") else "1"
        help_ = ast.literal_eval(given[-1]) + (" [%s]" % unit if unit != "1" else "")
        lines += ["", "    %s: %s" % ((given[0] + given[1]).replace(".", "__"), type_), "    %r" % help_]
    return "\n".join(lines) + "\n"


class BuildPython(build_py):
    """Adds the table of keywords."""

    def run(self):
        super().run()
        with open(os.path.join(self.build_lib, "zipact", "keywords.py"), "w", encoding="utf-8") as file:
            file.write(keywords())


setup(
    version=version(),
    cmdclass={"build_ext": BuildExtension, "build_py": BuildPython},
    ext_modules=[
        Extension(
            "zipact._zipact",
            sources=sorted(glob.glob("src/*.c")),
            depends=["src/binding.h", *glob.glob("../include/zipact/*")],
            include_dirs=["../include"],
            define_macros=[("Py_LIMITED_API", "0x030b0000")],
            extra_compile_args=["-std=c17", "-D_GNU_SOURCE", *HARDENED, *WARNINGS],
            py_limited_api=True,
        )
    ],
    options={
        "bdist_wheel": {"py_limited_api": "cp311"},
        "build": {"build_base": os.path.join(BUILD, "python", "objects") if BUILD else "build"},
    },
)
