// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_loader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Kind = ConfigNode::Kind;

template <class T>
std::optional<T> number_in(const ConfigNode& node) {
  if (node.kind != Kind::kScalar || node.quoted) return std::nullopt;
  return parse_number<T>(node.text);
}

std::string describe(const ConfigNode& node) {
  if (node.kind == Kind::kScalar) return quote(node.text);
  if (node.kind == Kind::kList) return "a list";
  return node.kind == Kind::kMap ? "a map" : "nothing";
}

}  // namespace

ConfigLoader::ConfigLoader(const ConfigFile& file, std::string_view section) : file_(file) {
  push(file.section(section), std::string(section));
}

void ConfigLoader::operator()(std::string_view key, bool& value) {
  const ConfigNode* node = visit_key(key);
  if (node == nullptr) return;
  const bool plain = node->kind == Kind::kScalar && !node->quoted;
  if (!plain || (node->text != "true" && node->text != "false")) {
    fail(*node, "is " + describe(*node) + ", not true or false");
  }
  value = node->text == "true";
}

void ConfigLoader::operator()(std::string_view key, int& value, const Bounds& bounds) {
  const ConfigNode* node = visit_key(key);
  if (node == nullptr) return;
  const auto number = number_in<int>(*node);
  if (!number) fail(*node, "is " + describe(*node) + ", not an integer");
  check(*node, *number, bounds);
  value = *number;
}

void ConfigLoader::operator()(std::string_view key, double& value, const Bounds& bounds) {
  const ConfigNode* node = visit_key(key);
  if (node != nullptr) value = read_number(*node, bounds);
}

void ConfigLoader::operator()(std::string_view key, std::string& value) {
  const ConfigNode* node = visit_key(key);
  if (node == nullptr) return;
  if (node->kind != Kind::kScalar) fail(*node, "is " + describe(*node) + ", not a string");
  value = node->text;
}

void ConfigLoader::operator()(std::string_view key, std::string& value, const OneOf& allowed) {
  (*this)(key, value);
  if (has(key) && !allowed.allow(value)) {
    const ConfigNode* node = levels_.back().map->find(key);
    fail(*node, "is " + describe(*node) + "; allowed: " + allowed.text());
  }
}

void ConfigLoader::operator()(std::string_view key, std::vector<double>& values,
                              const Bounds& bounds) {
  const ConfigNode* node = visit_key(key);
  if (node == nullptr) return;
  if (node->kind != Kind::kList) fail(*node, "is " + describe(*node) + ", not a list of numbers");
  std::vector<double> numbers;
  for (const ConfigNode& item : node->children) {
    ConfigNode named = item;
    named.key = node->key;
    numbers.push_back(read_number(named, bounds));
  }
  values = std::move(numbers);
}

void ConfigLoader::operator()(std::string_view key, Pose2& pose) {
  PoseKeys keys{pose};
  (*this)(key, keys);
}

const ConfigNode* ConfigLoader::visit_key(std::string_view key) {
  Level& level = levels_.back();
  level.known.emplace_back(key);
  return level.map != nullptr ? level.map->find(key) : nullptr;
}

bool ConfigLoader::has(std::string_view key) const {
  return levels_.back().map != nullptr && levels_.back().map->find(key) != nullptr;
}

std::vector<const ConfigNode*> ConfigLoader::visit_list(std::string_view key) {
  const ConfigNode* node = visit_key(key);
  if (node == nullptr) return {};
  if (node->kind != Kind::kList) fail(*node, "is " + describe(*node) + ", not a list");
  std::vector<const ConfigNode*> maps;
  for (const ConfigNode& child : node->children) maps.push_back(&child);
  return maps;
}

void ConfigLoader::enter(std::string_view key) {
  const ConfigNode* node = visit_key(key);
  push(node, levels_.back().path + "." + std::string(key));
}

void ConfigLoader::push(const ConfigNode* map, std::string path) {
  if (map != nullptr && map->kind != Kind::kMap && map->kind != Kind::kNothing) {
    throw ConfigError(file_.name() + ":" + std::to_string(map->line) + ": " + path + " is " +
                      describe(*map) + ", not a map of keys");
  }
  levels_.push_back({map, std::move(path), {}});
}

void ConfigLoader::leave() {
  const Level level = std::move(levels_.back());
  levels_.pop_back();
  if (level.map == nullptr) return;
  for (const ConfigNode& child : level.map->children) {
    if (std::find(level.known.begin(), level.known.end(), child.key) == level.known.end()) {
      throw_unknown_key(file_.name(), child, "key " + quote(child.key) + " in " + level.path,
                        level.known);
    }
  }
}

void ConfigLoader::fail(const ConfigNode& node, const std::string& reason) const {
  throw ConfigError(file_.name() + ":" + std::to_string(node.line) + ": " + levels_.back().path +
                    "." + node.key + " " + reason);
}

double ConfigLoader::read_number(const ConfigNode& node, const Bounds& bounds) const {
  const auto number = number_in<double>(node);
  if (!number) fail(node, "is " + describe(node) + ", not a number");
  if (!std::isfinite(*number)) fail(node, "is " + describe(node) + ", not a finite number");
  check(node, *number, bounds);
  return *number;
}

void ConfigLoader::check(const ConfigNode& node, double value, const Bounds& bounds) const {
  if (!bounds.allow(value))
    fail(node, "is " + message_line(node.text) + "; allowed: " + bounds.text());
}

}  // namespace adit
