// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options_yaml.h"

#include <algorithm>
#include <stdexcept>

#include "common/yaml_hint.h"

namespace plumb::tools {
namespace {

[[noreturn]] void Fail(const FieldPath& path, const std::string& what) {
  const std::string name = path.name.empty() ? std::string() : path.name + ": ";
  throw std::runtime_error(path.source + ": " + name + what);
}

std::string Listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

template <typename Value>
void ReadScalar(const YAML::Node& node,
                const FieldPath& path,
                const std::string& wanted,
                Value* value) {
  const bool is_quoted = node.IsScalar() && node.Tag() == "!";
  const bool is_read = node.IsScalar() && !is_quoted && YAML::convert<Value>::decode(node, *value);
  if (is_read) return;
  const std::string found = node.IsScalar() ? '"' + node.Scalar() + '"' : "not a single value";
  Fail(path, "must be " + wanted + ", but is " + found + "; correct this value");
}

// A parameter's name with dots between its groups, without what ROS sets before it: the private
// '~', the namespace and name of the node, and the group that holds all of MapperOptions or
// SurfaceOptions.
std::string WithDots(std::string name) {
  std::replace(name.begin(), name.end(), '/', '.');
  for (const std::string prefix :
       {"~", ".", "plumbline.", "mapper.", "mapper.", "mesher.", "surface."}) {
    if (name.rfind(prefix, 0) == 0) name.erase(0, prefix.size());
  }
  return name;
}

}  // namespace

YAML::Node ParseYaml(const std::string& text, const std::string& source) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(source + ": line " + std::to_string(error.mark.line + 1) +
                             ": is no YAML: " + error.msg + TabulatorHint(text));
  }
}

YAML::Node ParseSetting(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw std::runtime_error(
        "--set: \"" + setting +
        "\" is no setting; use KEY=VALUE, with the names of docs/parameters.md");
  }
  YAML::Node node = ParseYaml(setting.substr(equals + 1), "--set " + setting);
  std::string key = WithDots(setting.substr(0, equals));
  for (std::size_t dot = key.rfind('.'); !key.empty(); dot = key.rfind('.')) {
    YAML::Node parent(YAML::NodeType::Map);
    parent[dot == std::string::npos ? key : key.substr(dot + 1)] = node;
    node = parent;
    key.resize(dot == std::string::npos ? 0 : dot);
  }
  return node;
}

void CheckNames(const YAML::Node& node, const std::set<std::string>& known, const FieldPath& path) {
  if (!node.IsMap()) Fail(path, "must be a map of " + Listed(known));
  std::set<std::string> seen;
  for (const auto& child : node) {
    const std::string name =
        child.first.IsScalar() ? child.first.Scalar() : "a key that is no word";
    if (known.count(name) == 0) {
      Fail(path, "unknown option \"" + name + "\"; known are " + Listed(known));
    }
    if (!seen.insert(name).second) Fail(path, "option \"" + name + "\" is given twice; remove one");
  }
}

void ReadValue(const YAML::Node& node, const FieldPath& path, double* value) {
  ReadScalar(node, path, "a number", value);
}

void ReadValue(const YAML::Node& node, const FieldPath& path, int* value) {
  ReadScalar(node, path, "a whole number", value);
}

void ReadValue(const YAML::Node& node, const FieldPath& path, bool* value) {
  ReadScalar(node, path, "true or false", value);
}

void ReadValue(const YAML::Node& node, const FieldPath& path, std::uint32_t* value) {
  ReadScalar(node, path, "a whole number of at least 0", value);
}

void ReadValue(const YAML::Node& node, const FieldPath& path, Eigen::Vector3d* value) {
  if (!node.IsSequence() || node.size() != 3) {
    Fail(path, "must be a list of three numbers, [x, y, z]; correct this value");
  }
  for (int i = 0; i < 3; ++i) ReadValue(node[i], path, &(*value)[i]);
}

void CheckList(const YAML::Node& node, const FieldPath& path) {
  if (!node.IsSequence()) Fail(path, "must be a list, each entry after a \"- \"");
}

void ReadValue(const YAML::Node& node, const FieldPath& path, std::string* value) {
  if (!node.IsScalar()) Fail(path, "must be a text; correct this value");
  *value = node.Scalar();
}

}  // namespace plumb::tools
