# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which photos COLMAP is to match: each with those taken nearest to it, by the GPS in their EXIF
that its feature extractor left in the database. Of all pairs, those of photos with nothing in
common are most."""
import math
import sqlite3

import numpy as np

EARTH_RADIUS_M = 6378137.0


def read_places(database):
    """Names, and positions in metres east, north and up of a common point; shape [n, 3]."""
    with sqlite3.connect(database) as connection:
        rows = connection.execute("SELECT name, prior_tx, prior_ty, prior_tz FROM images "
                                  "WHERE prior_tx IS NOT NULL ORDER BY name").fetchall()
    if not rows:
        raise RuntimeError("%s: no photo has a GPS position in its EXIF" % database)
    latitude, longitude, height = np.array([row[1:] for row in rows], float).T
    north = np.radians(latitude - latitude[0]) * EARTH_RADIUS_M
    east = np.radians(longitude - longitude[0]) * EARTH_RADIUS_M
    east *= math.cos(math.radians(latitude[0]))
    return [row[0] for row in rows], np.stack([east, north, height], axis=1)


def nearest_pairs(database, num_neighbors, max_distance_m):
    """Pairs of names, each once."""
    names, places = read_places(database)
    pairs = set()
    for i, place in enumerate(places):
        distances = np.linalg.norm(places - place, axis=1)
        for j in np.argsort(distances, kind="stable")[:num_neighbors + 1]:
            if j != i and distances[j] <= max_distance_m:
                pairs.add((names[min(i, j)], names[max(i, j)]))
    return sorted(pairs)


def write_pairs(path, pairs):
    with open(path, "w") as file:
        file.writelines("%s %s\n" % pair for pair in pairs)
