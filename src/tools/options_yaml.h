// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace plumb::tools {

// Reads options from YAML: a map of field names, where a nested struct is a map of its own.
// What the file leaves out keeps its value. Errors are std::runtime_error naming the
// source, the field by its full name (localizer.min_num_inliers), and the cure.

// Parses `text`, which may be empty. `source` names it in errors.
YAML::Node ParseYaml(const std::string& text, const std::string& source);

// One setting KEY=VALUE as YAML, e.g. "bundle.num_threads=2", or as docs/parameters.md and ROS
// write it, "mapper/bundle/num_threads=2" and "surface/num_threads=2".
YAML::Node ParseSetting(const std::string& setting);

// Where a field stands.
struct FieldPath {
  std::string source;
  std::string name;  // Empty at the top.
};

// Throws unless `node` is a map without repeated names, all among `known`.
void CheckNames(const YAML::Node& node, const std::set<std::string>& known, const FieldPath& path);

void ReadValue(const YAML::Node& node, const FieldPath& path, double* value);
void ReadValue(const YAML::Node& node, const FieldPath& path, int* value);
void ReadValue(const YAML::Node& node, const FieldPath& path, bool* value);
void ReadValue(const YAML::Node& node, const FieldPath& path, std::string* value);
void ReadValue(const YAML::Node& node, const FieldPath& path, std::uint32_t* value);
void ReadValue(const YAML::Node& node, const FieldPath& path, Eigen::Vector3d* value);

// Throws unless `node` is a list.
void CheckList(const YAML::Node& node, const FieldPath& path);

// A list of structs with VisitFields; it replaces what there was.
template <typename Options>
void ReadValue(const YAML::Node& node, const FieldPath& path, std::vector<Options>* list);

// Any struct with VisitFields.
template <typename Options>
void ReadValue(const YAML::Node& node, const FieldPath& path, Options* options) {
  if (node.IsNull()) return;
  std::set<std::string> known;
  VisitFields(*options, [&](const char* name, auto&) { known.insert(name); });
  CheckNames(node, known, path);
  VisitFields(*options, [&](const char* name, auto& field) {
    const YAML::Node child = node[name];
    if (!child.IsDefined()) return;
    ReadValue(child, {path.source, path.name.empty() ? name : path.name + '.' + name}, &field);
  });
}

template <typename Options>
void ReadValue(const YAML::Node& node, const FieldPath& path, std::vector<Options>* list) {
  CheckList(node, path);
  list->assign(node.size(), Options());
  for (std::size_t i = 0; i < node.size(); ++i) {
    ReadValue(node[i], {path.source, path.name + '[' + std::to_string(i) + ']'}, &(*list)[i]);
  }
}

}  // namespace plumb::tools
