#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Photos are found in sub-folders and left in the same ones."""

import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import fly_photos


class FlyPhotosTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, *names):
        for name in names:
            path = self.folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(name)

    def found(self):
        return [str(path.relative_to(self.folder)) for path in fly_photos.list_photos(self.folder)]

    def test_sub_folders_are_searched_as_deep_as_in_flight(self):
        self.write("day 1/b.JPG", "a.png", "notes.txt", "1/2/3/deep.jpg", "1/2/3/4/deeper.jpg")
        self.assertEqual(self.found(), ["1/2/3/deep.jpg", "a.png", "day 1/b.JPG"])

    def test_hidden_ones_links_and_sessions_are_not(self):
        self.write("a.jpg", ".a.jpg", ".trash/b.jpg", "flight/session.db", "flight/photos/c.jpg")
        (self.folder / "loop").symlink_to(self.folder)
        (self.folder / "gone.jpg").symlink_to(self.folder / "nothing.jpg")
        self.assertEqual(self.found(), ["a.jpg"])

    def test_a_photo_is_left_whole_in_a_folder_that_is_made(self):
        self.write("a.jpg")
        target = self.folder / "card" / "day 1" / "a.jpg"
        fly_photos.leave_photo(self.folder / "a.jpg", target, duration_s=0.0)
        self.assertEqual(target.read_text(), "a.jpg")

    def test_a_photo_that_vanished_is_named_and_left_out(self):
        target = self.folder / "card" / "a.jpg"
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertFalse(fly_photos.leave_photo(self.folder / "a.jpg", target))
        self.assertIn(f"{self.folder / 'a.jpg'}: left out", said.getvalue())
        self.assertFalse(target.exists())

    def test_a_folder_that_is_not_there_is_told(self):
        run = subprocess.run([sys.executable, fly_photos.__file__, self.folder / "no",
                              self.folder / "card"], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 1)
        self.assertTrue(run.stderr.startswith(f"{self.folder / 'no'}: "), run.stderr)
        self.assertFalse((self.folder / "card").exists())


if __name__ == "__main__":
    unittest.main()
