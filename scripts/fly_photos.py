#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Leaves the photos of a folder in another one, one by one and piece by piece, as a camera would."""

import argparse
import pathlib
import sys
import time

PHOTO_SUFFIXES = {".jpg", ".jpeg", ".png", ".tif", ".tiff", ".bmp"}


MAX_DEPTH = 3  # As deep as the folder watcher looks.


def list_photos(folder, depth=MAX_DEPTH):
    """The photos of a folder and its sub-folders by name; none of hidden, linked ones and sessions.

    Links to nothing, and whatever else is no file, are left out. Raises OSError.
    """
    photos = []
    for path in sorted(pathlib.Path(folder).iterdir()):
        if path.name.startswith("."):
            continue
        if path.is_dir():
            if depth > 0 and not path.is_symlink() and not (path / "session.db").exists():
                photos += list_photos(path, depth - 1)
        elif path.suffix.lower() in PHOTO_SUFFIXES and path.is_file():
            photos.append(path)
    return photos


def leave_photo(photo, target, num_pieces=8, duration_s=0.1):
    """Writes a photo under its final path, in pieces over some time; False if it is unreadable."""
    try:
        data = photo.read_bytes()
    except OSError as error:
        print(f"{photo}: left out, it cannot be read: {error.strerror}", file=sys.stderr,
              flush=True)
        return False
    size = max(1, -(-len(data) // num_pieces))
    target.parent.mkdir(parents=True, exist_ok=True)
    with open(target, "wb") as file:
        for begin in range(0, len(data), size):
            file.write(data[begin:begin + size])
            file.flush()
            time.sleep(duration_s / num_pieces)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("photos", type=pathlib.Path,
                        help="folder of the photos to take, with its sub-folders")
    parser.add_argument("folder", type=pathlib.Path, help="watched folder to leave them in")
    parser.add_argument("--every", type=float, default=1.0, help="seconds from photo to photo")
    parser.add_argument("--first", type=int, default=0, help="skip this many photos")
    parser.add_argument("--count", type=int, default=None, help="leave at most this many photos")
    # roslaunch adds names of its own, __name:=fly_photos.
    arguments = parser.parse_args([word for word in sys.argv[1:] if ":=" not in word])
    try:
        photos = list_photos(arguments.photos)[arguments.first:]
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}; name the folder that holds the photos")
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for photo in photos[:arguments.count]:
        begin = time.monotonic()
        leave_photo(photo, arguments.folder / photo.relative_to(arguments.photos))
        time.sleep(max(0.0, arguments.every - (time.monotonic() - begin)))


if __name__ == "__main__":
    main()
