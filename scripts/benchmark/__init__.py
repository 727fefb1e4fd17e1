# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The sections of `make bench`, one module each, and what they share; see scripts/bench.py."""
