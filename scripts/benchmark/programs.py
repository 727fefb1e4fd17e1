# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs of test/benchmark, which are not in the target all."""
import json
import os
import subprocess

from benchmark.measure import log
from benchmark.simulation import ROOT


def built_benchmark(name):
    """Its path, once it is built."""
    build = os.path.join(ROOT, "build")
    subprocess.run(["cmake", "--build", build, "--target", name], check=True,
                   stdout=subprocess.DEVNULL)
    paths = [os.path.join(build, name), os.path.join(ROOT, "devel", "lib", "plumbline", name)]
    return next(path for path in paths if os.path.exists(path))


def run_benchmark(program, *arguments):
    """What it prints."""
    words = [str(argument) for argument in arguments]
    name = " ".join([os.path.basename(program), *words])
    log(name)
    done = subprocess.run([program, *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError("%s: %s" % (name, done.stderr.strip()))
    return done.stdout


def measure(program, *arguments):
    """The JSON that it prints."""
    return json.loads(run_benchmark(program, *arguments))
