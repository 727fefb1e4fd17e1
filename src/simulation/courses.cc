// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What goes round the building: string courses and the entablature with its modillions.
#include <cmath>

#include "simulation/facade_elements.h"
#include "simulation/profiles.h"

namespace plumb {
namespace {

constexpr double kFriezeFoot_m = 0.16;  // Height of the entablature's lowest moulding.
constexpr double kCorniceHeight_m = 0.72;
constexpr double kModillionSpacing_m = 0.62;  // Fitted to the bay.
constexpr double kDentilSpacing_m = 0.16;

// One piece of the way round the building: a bay's width or a corner margin.
struct Piece {
  std::string copy_key;
  std::size_t from;
  std::size_t to;
};

struct Outline {
  std::vector<Eigen::Vector2d> path;
  std::vector<Piece> pieces;
};

Eigen::Vector2d OnOutline(const WallPlan& wall, double x_m) {
  return (wall.world_from_wall * Eigen::Vector3d(x_m, 0.0, 0.0)).head<2>();
}

// The building's outline with a point at every edge of a bay; keys are those of a storey.
Outline MakeOutline(const FacadePlan& plan, std::size_t storey) {
  Outline outline;
  for (const WallPlan& wall : plan.walls) {
    outline.path.push_back(OnOutline(wall, 0.0));
    outline.pieces.emplace_back();
    for (std::size_t edge = 0; edge < wall.bay_edges_m.size(); ++edge) {
      outline.path.push_back(OnOutline(wall, wall.bay_edges_m[edge]));
      outline.pieces.emplace_back();
      const bool has_bay = edge + 1 < wall.bay_edges_m.size();
      if (has_bay) outline.pieces.back().copy_key = wall.storeys[storey][edge].copy_key;
    }
  }
  for (std::size_t i = 0; i < outline.pieces.size(); ++i) {
    outline.pieces[i].from = i;
    outline.pieces[i].to = (i + 1) % outline.path.size();
  }
  return outline;
}

void AddRound(const Site& site,
              const Profile& profile,
              const Outline& outline,
              double z_m,
              const std::string& name,
              std::uint32_t material) {
  const std::vector<SweepSection> sections = LevelPath(outline.path, z_m, /*is_loop=*/true);
  for (const Piece& piece : outline.pieces) {
    const std::string key = piece.copy_key.empty() ? "" : name + piece.copy_key;
    const CopyScope copies(site.builder, key);
    AddSweep(site.builder,
             profile,
             {sections[piece.from], sections[piece.to]},
             material,
             SweepEnds::kOpen);
  }
}

// Blocks under the corona of one bay, in the bay's frame.
void AddModillions(const Site& site, double width_m, double foot_m) {
  const auto count = FittedCount(width_m, kModillionSpacing_m);
  const double step_m = width_m / count;
  const double height_m = 0.16 * kCorniceHeight_m;
  for (int k = 0; k < count; ++k) {
    const double x = (k + 0.5) * step_m;
    AddMoulding(site.builder,
                BracketProfile(height_m + 0.02, 0.4),
                x - 0.08,
                x + 0.08,
                foot_m + 0.25 * kCorniceHeight_m,
                site.palette.trim);
  }
  const auto num_dentils = FittedCount(width_m, kDentilSpacing_m);
  const double dentil_m = width_m / num_dentils;
  for (int k = 0; k < num_dentils; ++k) {
    const double x = (k + 0.5) * dentil_m;
    AddBox(site.builder,
           {x - 0.3 * dentil_m, -0.1, foot_m - 0.09},
           {x + 0.3 * dentil_m, kEmbedded_m, foot_m + 0.01},
           site.palette.trim,
           {true, false, true, true, true});
  }
}

}  // namespace

void BuildStringCourses(const Site& site) {
  for (std::size_t storey = 1; storey < site.plan.styles.size(); ++storey) {
    const StoreyStyle& style = site.plan.styles[storey];
    if (style.course_height_m <= 0.0) continue;
    AddRound(site,
             StringCourseProfile(style.course_height_m, style.course_out_m),
             MakeOutline(site.plan, storey),
             site.plan.floors_m[storey],
             "course/",
             site.palette.trim);
  }
}

void BuildEntablature(const Site& site) {
  const FacadeOptions& options = site.plan.options;
  const std::size_t top = site.plan.styles.size() - 1;
  const Outline outline = MakeOutline(site.plan, top);
  const double foot_m = site.plan.floors_m.back();
  const double cornice_m = options.height_m - kCorniceHeight_m;
  AddRound(site,
           StringCourseProfile(kFriezeFoot_m, 0.09),
           outline,
           foot_m,
           "frieze/",
           site.palette.trim);
  AddRound(site,
           MainCorniceProfile(kCorniceHeight_m, options.cornice_out_m),
           outline,
           cornice_m,
           "cornice/",
           site.palette.trim);
  for (const WallPlan& wall : site.plan.walls) {
    const FrameScope on_wall(site.builder, wall.world_from_wall);
    for (std::size_t bay = 0; bay + 1 < wall.bay_edges_m.size(); ++bay) {
      const std::string& key = wall.storeys[top][bay].copy_key;
      const CopyScope copies(site.builder, key.empty() ? "" : "modillions/" + key);
      const FrameScope on_bay(site.builder, {wall.bay_edges_m[bay], 0.0, cornice_m});
      AddModillions(site, wall.bay_edges_m[bay + 1] - wall.bay_edges_m[bay], 0.0);
    }
  }
}

}  // namespace plumb
