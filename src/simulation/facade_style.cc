// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/facade_style.h"

#include <algorithm>
#include <cmath>

#include "simulation/random_numbers.h"

namespace plumb {
namespace {

// What is drawn: uses of DeriveSeed.
constexpr std::uint64_t kColorKey = 101;
constexpr std::uint64_t kStyleKey = 102;

class PaletteMaker {
 public:
  PaletteMaker(World& world, double detail_scale) : world_(world), detail_scale_(detail_scale) {}

  std::uint32_t Add(Material material) {
    material.detail = static_cast<float>(material.detail * detail_scale_);
    material.element_contrast = static_cast<float>(material.element_contrast * detail_scale_);
    world_.materials.push_back(material);
    return static_cast<std::uint32_t>(world_.materials.size() - 1);
  }

 private:
  World& world_;
  double detail_scale_;
};

Material Make(Pattern pattern, const Eigen::Vector3f& reflectance, float detail) {
  Material material;
  material.pattern = pattern;
  material.reflectance = reflectance;
  material.detail = detail;
  return material;
}

Material MakeElements(Pattern pattern,
                      const Eigen::Vector3f& reflectance,
                      float detail,
                      const Eigen::Vector2f& element_m,
                      float joint_m,
                      float element_contrast) {
  Material material = Make(pattern, reflectance, detail);
  material.element_m = element_m;
  material.joint_m = joint_m;
  material.element_contrast = element_contrast;
  return material;
}

Material MakeSoil(const Eigen::Vector3f& reflectance, float detail, float coarsest_m) {
  Material material = Make(Pattern::kPlaster, reflectance, detail);
  material.coarsest_detail_m = coarsest_m;
  return material;
}

Material MakePane(const Eigen::Vector3f& reflectance, float specular) {
  Material material = Make(Pattern::kGlass, reflectance, 0.08F);
  material.specular = specular;
  return material;
}

Eigen::Vector3f DrawPlasterColor(const FacadeOptions& options) {
  static const std::array<Eigen::Vector3f, 5> kColors = {Eigen::Vector3f(0.56F, 0.45F, 0.27F),
                                                         Eigen::Vector3f(0.55F, 0.47F, 0.36F),
                                                         Eigen::Vector3f(0.46F, 0.48F, 0.40F),
                                                         Eigen::Vector3f(0.54F, 0.37F, 0.29F),
                                                         Eigen::Vector3f(0.50F, 0.49F, 0.46F)};
  RandomNumbers random(DeriveSeed(options.seed, kColorKey, 0));
  return kColors[static_cast<std::size_t>(random.Index(static_cast<int>(kColors.size())))];
}

void AddWallMaterials(PaletteMaker& maker, const Eigen::Vector3f& plaster, Palette& palette) {
  palette.plaster = maker.Add(Make(Pattern::kPlaster, plaster, 0.14F));
  palette.brick = maker.Add(
      MakeElements(Pattern::kBrick, {0.33F, 0.15F, 0.09F}, 0.16F, {0.25F, 0.077F}, 0.011F, 0.16F));
  palette.ashlar = maker.Add(
      MakeElements(Pattern::kPlaster, {0.40F, 0.36F, 0.29F}, 0.18F, {0.9F, 0.45F}, 0.012F, 0.08F));
  palette.plinth_stone = maker.Add(
      MakeElements(Pattern::kAshlar, {0.24F, 0.23F, 0.21F}, 0.22F, {1.1F, 0.6F}, 0.008F, 0.1F));
  palette.trim = maker.Add(Make(Pattern::kPlaster, {0.56F, 0.52F, 0.44F}, 0.12F));
  palette.reveal = maker.Add(Make(Pattern::kPlaster, {0.50F, 0.46F, 0.39F}, 0.12F));
  Material plain = Make(Pattern::kPlaster, {0.62F, 0.60F, 0.55F}, 0.004F);
  plain.coarsest_detail_m = 4.0F;
  palette.plain = maker.Add(plain);
}

void AddJoinery(PaletteMaker& maker, RandomNumbers& random, Palette& palette) {
  const Eigen::Vector2f boards_m(0.11F, 2.4F);
  const Eigen::Vector2f one_piece_m(400.0F, 400.0F);  // No joints.
  palette.frame = maker.Add(
      MakeElements(Pattern::kWood, {0.62F, 0.60F, 0.54F}, 0.08F, one_piece_m, 0.0F, 0.0F));
  const bool is_green = random.Chance(0.5);
  palette.shutter = maker.Add(MakeElements(
      Pattern::kWood,
      is_green ? Eigen::Vector3f(0.06F, 0.13F, 0.08F) : Eigen::Vector3f(0.17F, 0.10F, 0.06F),
      0.16F,
      one_piece_m,
      0.0F,
      0.0F));
  palette.door = maker.Add(
      MakeElements(Pattern::kWood, {0.13F, 0.065F, 0.03F}, 0.25F, boards_m, 0.002F, 0.1F));
  palette.panes = {maker.Add(MakePane({0.02F, 0.022F, 0.024F}, 0.22F)),
                   maker.Add(MakePane({0.07F, 0.07F, 0.065F}, 0.2F)),
                   maker.Add(MakePane({0.34F, 0.33F, 0.30F}, 0.14F))};
  palette.blind = maker.Add(MakeElements(
      Pattern::kWood, {0.46F, 0.43F, 0.36F}, 0.08F, {one_piece_m.x(), 0.05F}, 0.004F, 0.03F));
}

void AddMetals(PaletteMaker& maker, Palette& palette) {
  palette.iron = maker.Add(Make(Pattern::kMetal, {0.035F, 0.035F, 0.037F}, 0.2F));
  palette.zinc = maker.Add(Make(Pattern::kMetal, {0.30F, 0.32F, 0.33F}, 0.14F));
}

void AddRoofAndGround(PaletteMaker& maker, Palette& palette) {
  palette.roof_tiles = maker.Add(MakeElements(
      Pattern::kRoofTiles, {0.30F, 0.13F, 0.075F}, 0.18F, {0.18F, 0.30F}, 0.006F, 0.2F));
  palette.pavement = maker.Add(
      MakeElements(Pattern::kGround, {0.27F, 0.26F, 0.24F}, 0.13F, {0.6F, 0.4F}, 0.008F, 0.1F));
  palette.kerb = maker.Add(
      MakeElements(Pattern::kAshlar, {0.34F, 0.33F, 0.31F}, 0.2F, {1.0F, 1.0F}, 0.008F, 0.08F));
  palette.grass = maker.Add(MakeSoil({0.07F, 0.12F, 0.035F}, 0.25F, 0.5F));
  palette.asphalt = maker.Add(MakeSoil({0.14F, 0.14F, 0.135F}, 0.1F, 0.3F));
}

// Which storeys are plain: spread over the height, the ground storey last.
std::vector<bool> PlainStoreys(const FacadeOptions& options) {
  std::vector<bool> is_plain(static_cast<std::size_t>(options.num_storeys), false);
  const auto count = static_cast<int>(std::lround(options.textureless_share * options.num_storeys));
  for (int k = 0; k < count; ++k) {
    const int from_top = k * options.num_storeys / std::max(1, count);
    is_plain[is_plain.size() - 1 - static_cast<std::size_t>(from_top)] = true;
  }
  return is_plain;
}

WindowLook DrawLook(RandomNumbers& random, int storey, int num_storeys) {
  WindowLook look;
  look.surround_width_m = random.Uniform(0.14, 0.19);
  look.num_glazing_bars = random.Index(3);
  const bool is_best = storey == 1 || storey == 2;  // The beletage and the one above.
  const bool is_top = storey + 1 == num_storeys;
  if (storey > 0 && is_best) {
    look.hood = random.Chance(0.5) ? HoodKind::kTriangular : HoodKind::kStraight;
    look.alternate_hood = random.Chance(0.5) ? HoodKind::kSegmental : look.hood;
    look.has_apron = true;
  } else if (storey > 0 && !is_top) {
    look.hood = random.Chance(0.6) ? HoodKind::kStraight : HoodKind::kNone;
    look.alternate_hood = look.hood;
    look.has_apron = random.Chance(0.3);
  }
  look.has_keystone = look.hood == HoodKind::kNone && random.Chance(0.7);
  look.has_shutters = storey > 2 && random.Chance(0.4);
  return look;
}

}  // namespace

Palette AddPalette(World& world, const FacadeOptions& options) {
  PaletteMaker maker(world, options.detail);
  RandomNumbers random(DeriveSeed(options.seed, kColorKey, 1));
  Palette palette;
  AddWallMaterials(maker, DrawPlasterColor(options), palette);
  AddJoinery(maker, random, palette);
  AddMetals(maker, palette);
  AddRoofAndGround(maker, palette);
  return palette;
}

std::vector<StoreyStyle> DrawStoreyStyles(const FacadeOptions& options) {
  RandomNumbers random(DeriveSeed(options.seed, kStyleKey, 0));
  const std::vector<bool> is_plain = PlainStoreys(options);
  const int first_brick = 1 + random.Index(2);
  const int num_brick = 2 + random.Index(2);
  std::vector<StoreyStyle> styles;
  for (int storey = 0; storey < options.num_storeys; ++storey) {
    StoreyStyle style;
    const bool is_brick = storey >= first_brick && storey < first_brick + num_brick;
    if (storey == 0) style.wall = WallKind::kRusticated;
    if (storey > 0 && is_brick) style.wall = WallKind::kBrick;
    style.look = DrawLook(random, storey, options.num_storeys);
    style.course_height_m = storey == 0 ? 0.0 : random.Uniform(0.18, 0.34);
    style.course_out_m = random.Uniform(0.07, 0.12);
    if (storey == 1) style.course_height_m = 0.38;
    if (is_plain[static_cast<std::size_t>(storey)]) {
      style = StoreyStyle();
      style.wall = WallKind::kPlain;
      style.course_height_m = 0.0;
    }
    style.id = storey;
    styles.push_back(style);
  }
  return styles;
}

}  // namespace plumb
