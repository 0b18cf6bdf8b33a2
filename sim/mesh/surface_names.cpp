// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/surface_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace adit {
namespace {

struct NamedKind {
  std::string_view word;
  PartKind kind;
  Material material;
};

constexpr std::array<NamedKind, 12> kNamedKinds{{
    {"floor", PartKind::kFloor, Material::kRock},
    {"roof", PartKind::kRoof, Material::kRock},
    {"wall", PartKind::kWall, Material::kRock},
    {"rail", PartKind::kRail, Material::kSteel},
    {"sleeper", PartKind::kSleeper, Material::kTimber},
    {"post", PartKind::kPost, Material::kTimber},
    {"crib", PartKind::kCrib, Material::kTimber},
    {"rubble", PartKind::kRubble, Material::kRock},
    {"beam", PartKind::kBeam, Material::kTimber},
    {"cable", PartKind::kCable, Material::kSteel},
    {"car", PartKind::kCar, Material::kSteel},
    {"water", PartKind::kWater, Material::kWater},
}};

}  // namespace

std::pair<PartKind, Material> surface_named(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* named = std::find_if(
      kNamedKinds.begin(), kNamedKinds.end(),
      [&](const NamedKind& candidate) { return name.find(candidate.word) != std::string::npos; });
  if (named == kNamedKinds.end()) return {PartKind::kOther, Material::kRock};
  return {named->kind, named->material};
}

}  // namespace adit
