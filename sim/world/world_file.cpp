// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/world_file.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "common/config/config.hpp"
#include "common/config/nearest_name.hpp"
#include "common/text/message_text.hpp"
#include "sim/world/built_in_world_files.hpp"
#include "sim/world/grade_tunnel.hpp"
#include "sim/world/narrow_tunnel.hpp"
#include "sim/world/random/random_mine.hpp"
#include "sim/world/random/two_levels.hpp"

namespace adit {
namespace {

constexpr const char* kRandom = "random";
constexpr const char* kRandomLevel = "random_level";
constexpr const char* kTwoLevels = "two_levels";

WorldDescription description_in(const ConfigFile& file) {
  file.require_known_sections({WorldDescription::kSection});
  if (file.section(WorldDescription::kSection) == nullptr) {
    throw ConfigError(
        fmt::format("{}: there is no section 'world', which a world file must have", file.name()));
  }
  return load_section<WorldDescription>(file, WorldDescription::kSection);
}

std::optional<WorldDescription> built_in(const std::string& name) {
  for (const WorldFileText& file : built_in_world_files()) {
    if (file.name == name) return description_in(ConfigFile::parse(file.text, name + ".yaml"));
  }
  return std::nullopt;
}

WorldDescription from_world_file(const std::filesystem::path& path) {
  WorldDescription description = description_in(ConfigFile::load(path));
  std::string& mesh = description.mesh.file;
  if (!mesh.empty()) mesh = (path.parent_path() / mesh).string();
  if (description.name.empty()) description.name = path.stem().string();
  return description;
}

WorldDescription from_mesh(const std::filesystem::path& path) {
  WorldDescription description;
  description.name = path.stem().string();
  description.mesh.file = path.string();
  return description;
}

[[noreturn]] void fail_unknown_world(const std::string& name) {
  std::vector<std::string> known = built_in_worlds();
  known.emplace_back(kRandom);
  known.emplace_back(kRandomLevel);
  known.emplace_back(kTwoLevels);
  known.emplace_back("grade:PERCENT");
  known.emplace_back("narrow:METRES");
  const std::string nearest = nearest_name(name, known);
  const std::string advice =
      nearest.empty() ? "" : fmt::format("; did you mean {}?", quote(nearest));
  throw std::runtime_error(
      fmt::format("no world {}, and no file of that name{}; there are {}, "
                  "or the path of a world file (.yaml) or of a mesh",
                  quote(name), advice, fmt::join(known, ", ")));
}

WorldDescription from_path(const std::string& name) {
  const std::filesystem::path path(name);
  if (!std::filesystem::is_regular_file(path)) fail_unknown_world(name);
  const bool yaml = path.extension() == ".yaml" || path.extension() == ".yml";
  return yaml ? from_world_file(path) : from_mesh(path);
}

}  // namespace

std::vector<std::string> built_in_worlds() {
  std::vector<std::string> names;
  for (const WorldFileText& file : built_in_world_files()) names.push_back(file.name);
  return names;
}

WorldDescription find_world(const std::string& name, std::optional<int> seed) {
  if (name == kRandom || name == kRandomLevel) {
    return random_mine(seed.value_or(1), {.level = name == kRandomLevel});
  }
  if (name == kTwoLevels) return two_levels(seed.value_or(1));
  if (const auto grade = parse_grade_tunnel(name)) return grade_tunnel(*grade, seed.value_or(1));
  if (const auto narrow = parse_narrow_tunnel(name)) {
    return narrow_tunnel(*narrow, seed.value_or(1));
  }
  std::optional<WorldDescription> known = built_in(name);
  WorldDescription description = known ? *std::move(known) : from_path(name);
  if (seed) description.seed = *seed;
  return description;
}

std::string to_world_file(const WorldDescription& description) {
  return to_yaml(description, WorldDescription::kSection);
}

}  // namespace adit
