// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Matches the features in a COLMAP database as COLMAP's own matcher does without a graphics card
// (every descriptor with every other; ratio, distance and mutual tests with its bounds), far
// sooner, for `colmap matches_importer --match_type raw`, which verifies them.
//
//   colmap_matches_benchmark DATABASE PAIRS MATCHES
//
// PAIRS has the names of two photos a line.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/parallel_for.h"
#include "map/sqlite.h"
#include "plumbline/matching/descriptor_matcher.h"

namespace plumb {
namespace {

// SiftMatchingOptions: the ratio is of angles, here of chords, which differ by 2 % at most there.
constexpr double kMaxRatio = 0.8;
constexpr double kMaxAngle = 0.7;
constexpr double kNorm = 512.0;
constexpr std::size_t kBatch = 256;

struct Pair {
  std::string name1, name2;
};

std::vector<Pair> ReadPairs(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  std::vector<Pair> pairs;
  for (Pair pair; file >> pair.name1 >> pair.name2;) pairs.push_back(pair);
  return pairs;
}

std::map<std::string, DescriptorMatrix> ReadDescriptors(const std::string& path) {
  sqlite::Database database(path, sqlite::Access::kRead);
  sqlite::Statement select(&database,
                           "SELECT name, rows, data FROM descriptors JOIN images USING (image_id)");
  std::map<std::string, DescriptorMatrix> found;
  for (select.Start(); select.Step();) {
    const sqlite::Blob bytes = select.Bytes(2);
    found[select.Text(0)] =
        Eigen::Map<const DescriptorMatrix>(static_cast<const std::uint8_t*>(bytes.data),
                                           select.Int(1),
                                           DescriptorMatrix::ColsAtCompileTime);
  }
  return found;
}

std::vector<FeatureMatch> Match(const DescriptorMatrix& descriptors1,
                                const DescriptorMatrix& descriptors2) {
  MatcherOptions options;
  options.max_ratio = kMaxRatio;
  std::vector<FeatureMatch> matches = MatchDescriptors(options, descriptors1, descriptors2);
  const double most = 2.0 * kNorm * kNorm * (1.0 - std::cos(kMaxAngle));
  const auto is_far = [&](const FeatureMatch& match) {
    return SquaredDistance(descriptors1.row(match.idx1).data(),
                           descriptors2.row(match.idx2).data()) > most;
  };
  matches.erase(std::remove_if(matches.begin(), matches.end(), is_far), matches.end());
  return matches;
}

void Write(const Pair& pair, const std::vector<FeatureMatch>& matches, std::ofstream* file) {
  if (matches.empty()) return;
  *file << pair.name1 << ' ' << pair.name2 << '\n';
  for (const FeatureMatch& match : matches) *file << match.idx1 << ' ' << match.idx2 << '\n';
  *file << '\n';
}

void Run(const std::string& database_path,
         const std::string& pairs_path,
         const std::string& matches_path) {
  const std::map<std::string, DescriptorMatrix> descriptors = ReadDescriptors(database_path);
  const std::vector<Pair> pairs = ReadPairs(pairs_path);
  std::ofstream file(matches_path);
  for (std::size_t first = 0; first < pairs.size(); first += kBatch) {
    std::vector<std::vector<FeatureMatch>> found(std::min(kBatch, pairs.size() - first));
    const auto match_some = [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const Pair& pair = pairs[first + i];
        found[i] = Match(descriptors.at(pair.name1), descriptors.at(pair.name2));
      }
    };
    ParallelFor(0, static_cast<int>(found.size()), 1, match_some);
    for (std::size_t i = 0; i < found.size(); ++i) Write(pairs[first + i], found[i], &file);
    std::printf("%zu of %zu pairs\n", first + found.size(), pairs.size());
  }
  if (!file.flush()) throw std::runtime_error(matches_path + ": cannot be written");
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: %s DATABASE PAIRS MATCHES\n", argv[0]);
    return EXIT_FAILURE;
  }
  try {
    plumb::Run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
