// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "plumbline/marker/marker_sheet.h"
#include "tools/commands.h"

namespace plumb::tools {
namespace {

constexpr char kOutputHelp[] =
    "File to write, by its ending: .pdf (all pages) or .svg (a file a page)";

struct SheetArguments {
  std::string paper = "a4";
  std::string arrangement = "fixed";
  int first_id = 0;
  std::string output;
};

struct TargetArguments {
  int id = 0;
  double diameter_mm = 500.0;
  std::string output;
};

void Write(const MarkerSheet& sheet, const std::string& output) {
  for (const std::string& path : WriteMarkerSheet(sheet, output)) std::cout << path << '\n';
  std::cout << sheet.title << '\n';
}

// The value of a word in small or capital letters. Throws std::runtime_error naming those there
// are.
template <typename Value>
Value ReadWord(const std::string& option,
               const std::string& word,
               const std::map<std::string, Value>& values) {
  const auto value = values.find(CLI::detail::to_lower(word));
  if (value != values.end()) return value->second;
  std::string known;
  for (const auto& [name, unused] : values) known += (known.empty() ? "" : " or ") + name;
  throw std::runtime_error(option + ": \"" + word + "\" is not known; use " + known);
}

void AddSheet(CLI::App* markers, ExitCode* exit_code) {
  CLI::App* command =
      markers->add_subcommand("sheet", "The 4 x 4 markers to calibrate a camera with");
  const auto arguments = std::make_shared<SheetArguments>();
  command->add_option("--paper", arguments->paper, "a4 or a3")->capture_default_str();
  command
      ->add_option("--arrangement",
                   arguments->arrangement,
                   "fixed: one page; loose: four a page, to cut out and strew")
      ->capture_default_str();
  command->add_option("--first-id", arguments->first_id, "The first of 16 IDs")
      ->capture_default_str();
  command->add_option("--output", arguments->output, kOutputHelp)->required();
  command->callback([arguments, exit_code] {
    const Paper paper =
        ReadWord<Paper>("--paper", arguments->paper, {{"a4", Paper::kA4}, {"a3", Paper::kA3}});
    const Arrangement arrangement =
        ReadWord<Arrangement>("--arrangement",
                              arguments->arrangement,
                              {{"fixed", Arrangement::kFixed}, {"loose", Arrangement::kLoose}});
    Write(LayOutGrid(paper, arrangement, arguments->first_id), arguments->output);
    *exit_code = kDone;
  });
}

void AddTarget(CLI::App* markers, ExitCode* exit_code) {
  CLI::App* command = markers->add_subcommand("target", "One marker, for a control point");
  const auto arguments = std::make_shared<TargetArguments>();
  command->add_option("--id", arguments->id, "The marker")->required();
  command->add_option("--diameter-mm", arguments->diameter_mm, "Of its outer circle")
      ->capture_default_str();
  command->add_option("--output", arguments->output, kOutputHelp)->required();
  command->callback([arguments, exit_code] {
    Write(LayOutTarget(arguments->id, arguments->diameter_mm), arguments->output);
    *exit_code = kDone;
  });
}

}  // namespace

void AddMarkersCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command = app->add_subcommand("markers", "Coded markers to print, true to scale");
  command->footer(
      "A target of more than A3 needs a plotter, or the PDF printed in tiles. Check a print with a "
      "ruler on its scale bar. A marker needs a white rim of a quarter of its "
      "radius.\n" +
      std::string(kExitCodes));
  command->require_subcommand(1);
  AddSheet(command, exit_code);
  AddTarget(command, exit_code);
}

}  // namespace plumb::tools
