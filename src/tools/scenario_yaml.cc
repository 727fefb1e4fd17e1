// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario_yaml.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "plumbline/common/atomic_file.h"
#include "tools/options_yaml.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Where scenarios lie: beside an installed program, or in the source tree.
std::vector<fs::path> ScenarioFolders() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  return {program.parent_path().parent_path().parent_path() / "share/plumbline/config/scenarios",
          PLUMBLINE_SCENARIOS};
}

std::string ShippedNames() {
  std::vector<std::string> names;
  for (const fs::path& folder : ScenarioFolders()) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
    }
    if (!names.empty()) break;
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Json JsonOf(Eigen::Vector3d& value) { return {value.x(), value.y(), value.z()}; }

template <typename Value>
Json JsonOf(std::vector<Value>& values);

template <typename Value>
Json JsonOf(Value& value) {
  if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>) {
    return value;
  } else {
    Json json = Json::object();
    VisitFields(value, [&json](const char* name, auto& field) { json[name] = JsonOf(field); });
    return json;
  }
}

template <typename Value>
Json JsonOf(std::vector<Value>& values) {
  Json json = Json::array();
  for (Value& value : values) json.push_back(JsonOf(value));
  return json;
}

}  // namespace

std::string FindScenario(const std::string& scenario) {
  if (scenario.find('/') != std::string::npos || fs::path(scenario).extension() == ".yaml") {
    return scenario;
  }
  for (const fs::path& folder : ScenarioFolders()) {
    const fs::path file = folder / (scenario + ".yaml");
    if (fs::exists(file)) return file;
  }
  throw std::runtime_error("--scenario: there is no scenario \"" + scenario + "\"; there are " +
                           ShippedNames() + ", or give a file of your own, ./" + scenario +
                           ".yaml");
}

Scenario ReadScenario(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  Scenario scenario;
  ReadValue(ParseYaml({bytes.begin(), bytes.end()}, path), {path, ""}, &scenario);
  if (!scenario.lens.file.empty()) {
    scenario.lens.file = fs::absolute(fs::path(path).parent_path() / scenario.lens.file);
  }
  const std::vector<std::string> problems = scenario.Problems();
  if (problems.empty()) return scenario;
  std::string text = path + ": ";
  for (const std::string& problem : problems) text += problem + "; ";
  throw std::runtime_error(text + "correct the file");
}

Json ToJson(const Scenario& scenario) {
  Scenario visited = scenario;
  return JsonOf(visited);
}

}  // namespace plumb::tools
