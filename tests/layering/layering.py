#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on an include that points up: domains <- solver <- lang, and an engine that knows no concrete domain.

    layering.py ROOT           checks a source tree
    layering.py --self-test    checks that planted violations are caught
"""
import pathlib
import re
import sys
import tempfile

LAYERS = ["domains", "solver", "lang"]
# What a layer may include of these libraries; any other library is open to all (the standard one, fmt, Eigen, MPFR).
LIBRARIES = {
    "boost": {"lang"},
    "CLI": {"lang"},
    "tbb": {"solver", "lang"},
    "oneapi": {"solver", "lang"},
    "nlohmann": {"solver", "lang"},
}
ENGINE = "solver/engine/"
ENGINE_MAY_SEE = {"domains/lattice.h", "domains/check.h"}  # of the domains
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
SOURCES = {".h", ".hpp", ".ipp", ".cpp"}


def includes(root, path):
    """The (path, quoted) pairs that a file of the tree includes, in order."""
    text = (root / path).read_text(encoding="utf-8")
    return [(target, mark == '"') for mark, target in INCLUDE.findall(text)]


def engine_leak(root, path, seen):
    """The chain of includes by which a file reaches a domain that the engine may not know, or None."""
    for target, _ in includes(root, path):
        if target.startswith("domains/") and target not in ENGINE_MAY_SEE:
            return [path, target]
        if target.startswith("solver/") and target not in seen and (root / target).is_file():
            seen.add(target)
            chain = engine_leak(root, target, seen)
            if chain:
                return [path] + chain
    return None


def violations(root):
    found = []
    files = [f.relative_to(root).as_posix()
             for layer in LAYERS for f in sorted((root / layer).rglob("*")) if f.suffix in SOURCES]
    for path in files:
        layer = path.split("/")[0]
        allowed = LAYERS[:LAYERS.index(layer) + 1]
        for target, quoted in includes(root, path):
            top = target.split("/")[0]
            if ".." in target.split("/"):
                found.append(f"{path}: {target}: write the full path from the root")
            elif top in LAYERS + ["tests", "examples"] and top not in allowed:
                found.append(f"{path}: includes {target}: {layer} may include {', '.join(allowed)} only")
            elif top in LIBRARIES and layer not in LIBRARIES[top]:
                found.append(f"{path}: includes <{target}>: not a library of {layer}")
            elif quoted and not (root / target).is_file() and (root / path).parent.joinpath(target).is_file():
                found.append(f"{path}: {target}: write the full path from the root")
        if path.startswith(ENGINE):
            chain = engine_leak(root, path, set())
            if chain:
                found.append(f"{' -> '.join(chain)}: the engine knows no concrete domain")
    if not files:
        found.append(f"{root}: no source file found")
    return found


def self_test():
    clean = {
        "domains/lattice.h": "#include <concepts>\n",
        "domains/tube.h": '#include "domains/lattice.h"\n',
        "solver/engine/graph.h": '#include "domains/lattice.h"\n#include <tbb/task_group.h>\n',
        "solver/problem.h": '#include "domains/tube.h"\n#include "solver/engine/graph.h"\n',
        "lang/compile.cpp": '#include "solver/problem.h"\n#include <boost/spirit/home/x3.hpp>\n',
    }
    planted = {
        "a domain includes the solver": ("domains/bad.h", '#include "solver/problem.h"\n'),
        "a domain includes the language": ("domains/bad.cpp", '#include <lang/parse.h>\n'),
        "the solver includes the language": ("solver/bad.h", '  #  include "lang/parse.h"\n'),
        "a layer includes the tests": ("lang/bad.cpp", '#include "tests/support/laws.h"\n'),
        "the engine includes a domain": ("solver/engine/bad.cpp", '#include "domains/tube.h"\n'),
        "the engine includes a domain by a detour": ("solver/engine/bad.h", '#include "solver/problem.h"\n'),
        "a domain uses a library of the solver": ("domains/bad.h", "#include <nlohmann/json.hpp>\n"),
        "the solver uses a library of the language": ("solver/bad.cpp", "#include <boost/spirit/home/x3.hpp>\n"),
        "an include climbs out of its folder": ("domains/bad.h", '#include "../solver/problem.h"\n'),
        "an include is relative": ("solver/engine/bad.h", '#include "graph.h"\n'),
    }

    def check(extra):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path, text in {**clean, **extra}.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            return violations(root)

    failures = [f"the clean tree: {v}" for v in check({})]
    for what, (path, text) in planted.items():
        found = check({path: text})
        if len(found) != 1 or path not in found[0]:
            failures.append(f"planted: {what}; found: {found}")
    return failures


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    found = self_test() if arguments[0] == "--self-test" else violations(pathlib.Path(arguments[0]))
    print("\n".join(found) if found else "No violation.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
