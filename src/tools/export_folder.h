// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace plumb::tools {

// The map and the georeference that a file is of, as a word; `georeference` is the path of the one
// that was followed, empty if none was.
std::string ExportState(std::uint32_t map_sequence,
                        bool is_refined,
                        const std::string& georeference);

// A folder of exports, in which files of one map in one frame shall lie. plumbline_files.json there
// keeps what Plumbline wrote, of what, and a fingerprint, so that of what a person put there or has
// changed nothing is ever deleted.
class ExportFolder {
 public:
  // A list that cannot be read counts as none: nothing is deleted then.
  explicit ExportFolder(const std::string& path);

  // To be called before files of these names are written: renames those that are there and that
  // Plumbline did not write as they are, and gives a line for each. Throws like Add.
  std::vector<std::string> SetAside(const std::vector<std::string>& names);

  // Takes note of files just written, by their names in the folder; `state` empty: of any map.
  // Throws std::runtime_error naming the file and the cause.
  void Add(const std::vector<std::string>& names, const std::string& state);

  // Deletes what was written of another state than this; gives a line for each file, and one that
  // names those that are kept because Plumbline did not write them as they are. Throws like Add.
  std::vector<std::string> DeleteStale(const std::string& state);

  // The same for these files, whatever they are of, as far as they are there.
  std::vector<std::string> Delete(const std::vector<std::string>& names);

 private:
  struct Entry {
    std::string state;
    std::string fingerprint;
  };

  std::string PathOf(const std::string& name) const { return path_ + '/' + name; }
  bool IsUnchanged(const std::string& name) const;
  void Remove(const std::string& name);
  void Save() const;

  std::string path_;
  std::map<std::string, Entry> entry_of_name_;
};

}  // namespace plumb::tools
