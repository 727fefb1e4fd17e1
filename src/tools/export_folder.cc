// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/export_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "plumbline/common/atomic_file.h"
#include "plumbline/image/content_hash.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char kList[] = "plumbline_files.json";

// What Plumbline writes there, to tell of files that it did not write.
constexpr const char* kNames[] = {"colmap/cameras.txt",
                                  "colmap/images.txt",
                                  "colmap/points3D.txt",
                                  "points.ply",
                                  "mesh.ply",
                                  "mesh.obj",
                                  "frame.json"};

std::string FingerprintOf(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(16) << ContentHash(bytes.data(), bytes.size());
  return text.str();
}

// The path with the first number behind it under which there is nothing yet.
std::string FreeName(const std::string& path) {
  for (int number = 1;; ++number) {
    const std::string name = path + ".kept" + std::to_string(number);
    if (!fs::exists(name)) return name;
  }
}

}  // namespace

std::string ExportState(std::uint32_t map_sequence,
                        bool is_refined,
                        const std::string& georeference) {
  return "map " + std::to_string(map_sequence) + (is_refined ? ", refined" : "") +
         (georeference.empty() ? "" : ", georeference " + FingerprintOf(georeference));
}

ExportFolder::ExportFolder(const std::string& path) : path_(path) {
  const Json list = Json::parse(std::ifstream(PathOf(kList)), nullptr, /*allow_exceptions=*/false);
  if (!list.is_object()) return;
  for (const auto& [name, entry] : list.items()) {
    const auto is_text = [&entry = entry](const char* key) {
      return entry.is_object() && entry.contains(key) && entry[key].is_string();
    };
    if (!is_text("of") || !is_text("fingerprint")) continue;
    // A list from elsewhere does not reach out of the folder.
    const fs::path relative = fs::path(name).lexically_normal();
    if (relative.empty() || relative.is_absolute() || *relative.begin() == "..") continue;
    entry_of_name_[name] = {entry["of"], entry["fingerprint"]};
  }
}

std::vector<std::string> ExportFolder::SetAside(const std::vector<std::string>& names) {
  std::vector<std::string> lines;
  for (const std::string& name : names) {
    if (!fs::is_regular_file(PathOf(name)) || IsUnchanged(name)) continue;
    const std::string aside = FreeName(PathOf(name));
    std::error_code error;
    fs::rename(PathOf(name), aside, error);
    if (error) {
      throw std::runtime_error(
          PathOf(name) + ": Plumbline did not write it like this, and it cannot be renamed: " +
          error.message() + "; move it away");
    }
    lines.push_back("kept " + PathOf(name) + ", as Plumbline did not write it like this, as " +
                    aside);
  }
  return lines;
}

void ExportFolder::Add(const std::vector<std::string>& names, const std::string& state) {
  for (const std::string& name : names) {
    entry_of_name_[name] = {state, FingerprintOf(PathOf(name))};
  }
  Save();
}

std::vector<std::string> ExportFolder::Delete(const std::vector<std::string>& names) {
  std::vector<std::string> lines;
  std::string kept;
  for (const std::string& name : names) {
    if (!fs::is_regular_file(PathOf(name))) {
      entry_of_name_.erase(name);
    } else if (IsUnchanged(name)) {
      Remove(name);
      lines.push_back("deleted " + PathOf(name) + ", which was of the former map or georeference");
    } else {
      kept += (kept.empty() ? "" : ", ") + name;
    }
  }
  if (!kept.empty()) {
    lines.push_back(path_ + ": kept, as Plumbline did not write it like this: " + kept +
                    "; it may be of another map or frame than the files beside it");
  }
  return lines;
}

void ExportFolder::Remove(const std::string& name) {
  std::error_code error;
  if (!fs::remove(PathOf(name), error)) {
    throw std::runtime_error(PathOf(name) +
                             ": is of the former map or georeference and cannot be deleted: " +
                             error.message() + "; delete it");
  }
  fs::remove(fs::path(PathOf(name)).parent_path(), error);  // Only if that is empty now.
  entry_of_name_.erase(name);
  Save();
}

std::vector<std::string> ExportFolder::DeleteStale(const std::string& state) {
  std::vector<std::string> stale(std::begin(kNames), std::end(kNames));
  for (const auto& [name, entry] : entry_of_name_) {
    const auto known = std::find(stale.begin(), stale.end(), name);
    const bool is_stale = !entry.state.empty() && entry.state != state;
    if (is_stale && known == stale.end()) stale.push_back(name);
    if (!is_stale && known != stale.end()) stale.erase(known);
  }
  return Delete(stale);
}

bool ExportFolder::IsUnchanged(const std::string& name) const {
  const auto entry = entry_of_name_.find(name);
  return entry != entry_of_name_.end() && entry->second.fingerprint == FingerprintOf(PathOf(name));
}

void ExportFolder::Save() const {
  Json list = Json::object();
  for (const auto& [name, entry] : entry_of_name_) {
    list[name] = {{"of", entry.state}, {"fingerprint", entry.fingerprint}};
  }
  WriteFileAtomically(PathOf(kList),
                      list.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace plumb::tools
