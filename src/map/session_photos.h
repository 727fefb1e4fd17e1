// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "map/sqlite.h"
#include "plumbline/map/session_store.h"

namespace plumb {

// The photos' part of a session: the tables photos, features and verdicts.

void WriteAnalysis(sqlite::Database* database,
                   PhotoId id,
                   Timestamp exposure_time,
                   const PhotoAnalysis& analysis);
void WriteFeatures(sqlite::Database* database, PhotoId id, const FeatureSet& features);
void WriteVerdict(sqlite::Database* database, const PhotoVerdict& verdict);
void WriteSeconds(sqlite::Database* database, PhotoId id, const StageSeconds& seconds);

std::vector<StoredPhoto> ReadPhotos(sqlite::Database* database);
FeatureSet ReadFeatures(sqlite::Database* database, PhotoId id);

// Of the table or view `table`, ordered by its column `order`.
std::vector<PhotoVerdict> ReadVerdicts(sqlite::Database* database,
                                       const std::string& table,
                                       const std::string& order);

}  // namespace plumb
