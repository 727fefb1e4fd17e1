# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs of test/benchmark, which are not in the target all."""
import os
import subprocess

from benchmark.simulation import ROOT


def built_benchmark(name):
    """Its path, once it is built."""
    build = os.path.join(ROOT, "build")
    subprocess.run(["cmake", "--build", build, "--target", name], check=True,
                   stdout=subprocess.DEVNULL)
    paths = [os.path.join(build, name), os.path.join(ROOT, "devel", "lib", "plumbline", name)]
    return next(path for path in paths if os.path.exists(path))
