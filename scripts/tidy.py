#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs clang-tidy on sources, on all cores. A source that passed is passed over for as long as the
compiler sees the same text of it and of all that it includes, and the checks are the same."""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys

TIDY = "clang-tidy-14"
CHECKS = pathlib.Path(".clang-tidy")


def cache_folder():
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    folder = pathlib.Path(home) / "plumbline-tidy"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def compile_flags(entry):
    """Of a compile command what the text and its meaning depend on."""
    words = shlex.split(entry["command"])[1:]
    flags = []
    while words:
        word = words.pop(0)
        if word in ("-o", "-MF", "-MT", "-MQ"):
            words.pop(0)
        elif word not in ("-c", "-MD", "-MMD", entry["file"]):
            flags.append(word)
    return flags


def key_of(entry, common):
    """None if the source cannot be read by the compiler: clang-tidy says why."""
    flags = compile_flags(entry)
    # -CC: comments tell clang-tidy what to pass over.
    text = subprocess.run(["g++", *flags, "-E", "-P", "-CC", entry["file"]], cwd=entry["directory"],
                          capture_output=True)
    if text.returncode != 0:
        return None
    told = [flag for flag in flags if not flag.startswith(("-I", "/", "-isystem"))]
    return hashlib.sha256(common + json.dumps(told).encode() + text.stdout).hexdigest()


def check(entry, build, common, cache):
    """Whether the source passes, and what clang-tidy says of it."""
    key = key_of(entry, common)
    if key and (cache / key).exists():
        return True, ""
    run = subprocess.run([TIDY, "-p", build, "--quiet", entry["file"]], capture_output=True, text=True)
    if run.returncode == 0 and key:
        (cache / key).touch()
    return run.returncode == 0, run.stdout + (run.stderr if run.returncode else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True, help="folder with compile_commands.json")
    parser.add_argument("sources", nargs="+")
    arguments = parser.parse_args()
    entries = {}
    for entry in json.loads((pathlib.Path(arguments.build) / "compile_commands.json").read_text()):
        entries[os.path.realpath(os.path.join(entry["directory"], entry["file"]))] = entry
    unknown = [source for source in arguments.sources if os.path.realpath(source) not in entries]
    if unknown:
        sys.exit("no compile command is known of " + ", ".join(unknown))
    version = subprocess.run([TIDY, "--version"], capture_output=True, check=True).stdout
    common = version + CHECKS.read_bytes()
    cache = cache_folder()
    passes = True
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for passed, said in pool.map(
                lambda source: check(entries[os.path.realpath(source)], arguments.build, common,
                                     cache), arguments.sources):
            passes = passes and passed
            print(said, end="", flush=True)
    sys.exit(0 if passes else 1)


if __name__ == "__main__":
    main()
