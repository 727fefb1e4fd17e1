# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Running and timing programs."""
import resource
import subprocess
import sys
import time


def log(text):
    print(text, file=sys.stderr, flush=True)


def run_timed(command, log_path, environment=None, limit_s=None):
    """Wall and CPU seconds of a command; its output goes to `log_path`. With "cut_off" where it was
    ended after `limit_s`."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    with open(log_path, "a") as output:
        output.write("$ %s\n" % " ".join(command))
        output.flush()
        try:
            code = subprocess.call(command, stdout=output, stderr=subprocess.STDOUT,
                                   env=environment, timeout=limit_s)
        except subprocess.TimeoutExpired:
            code = None
    wall_s = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {"exit_code": code, "wall_s": wall_s, "cpu_s": cpu_s, "cut_off": code is None}
