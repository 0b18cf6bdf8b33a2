// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/search/search_space.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"
#include "tools/campaign/definition/campaign_definition.hpp"

namespace adit {
namespace {

using Kind = SpaceParameter::Kind;

constexpr double kSeedMax = 999'999.0;

class SpaceReader {
 public:
  explicit SpaceReader(const ConfigFile& file) : file_(file) {}

  SearchSpace space(const ConfigNode& section) const {
    if (section.kind != ConfigNode::Kind::kMap) fail(section, "space is not a map of parameters");
    SearchSpace space;
    for (const ConfigNode& node : section.children) space.parameters.push_back(parameter(node));
    if (space.parameters.empty()) fail(section, "space has no parameters");
    return space;
  }

 private:
  [[noreturn]] void fail(const ConfigNode& node, const std::string& reason) const {
    throw ConfigError(fmt::format("{}:{}: {}", file_.name(), node.line, reason));
  }

  SpaceParameter parameter(const ConfigNode& node) const {
    if (!is_column_name(node.key) || node.key == "out")
      fail(node, "space." + node.key + " is not a name of letters a-z, 0-9 and _, or is out");
    if (node.kind == ConfigNode::Kind::kList) return choice(node);
    if (node.kind == ConfigNode::Kind::kMap) return node.find("seed") ? seed(node) : range(node);
    fail(node, fmt::format("space.{} is neither a range {{from, to}}, a list nor {{seed: true}}",
                           node.key));
  }

  SpaceParameter choice(const ConfigNode& list) const {
    SpaceParameter parameter;
    parameter.name = list.key;
    parameter.kind = Kind::kChoice;
    for (const ConfigNode& child : list.children) {
      if (child.kind != ConfigNode::Kind::kScalar ||
          child.text.find_first_of("{}") != std::string::npos)
        fail(child, fmt::format("a value of space.{} is not text without braces", list.key));
      const auto number = child.quoted ? std::nullopt : parse_number<double>(child.text);
      parameter.choices.push_back({child.text, number && std::isfinite(*number), false});
    }
    if (parameter.choices.empty()) fail(list, "space." + list.key + " has no values");
    parameter.to = static_cast<double>(parameter.choices.size()) - 1.0;
    return parameter;
  }

  SpaceParameter seed(const ConfigNode& map) const {
    require_keys(map, {"seed"});
    if (!truth(map, "seed")) fail(map, fmt::format("space.{}.seed is not true", map.key));
    SpaceParameter parameter;
    parameter.name = map.key;
    parameter.kind = Kind::kSeed;
    parameter.from = parameter.simple = 1.0;
    parameter.to = kSeedMax;
    return parameter;
  }

  SpaceParameter range(const ConfigNode& map) const {
    require_keys(map, {"from", "to", "simple", "integer"});
    SpaceParameter parameter;
    parameter.name = map.key;
    if (map.find("integer") && truth(map, "integer")) parameter.kind = Kind::kInteger;
    parameter.from = number(map, "from", {});
    parameter.to = number(map, "to", {});
    parameter.simple = number(map, "simple", parameter.from);
    if (parameter.from >= parameter.to)
      fail(map, fmt::format("space.{} has a from that is not below its to", map.key));
    if (parameter.simple < parameter.from || parameter.simple > parameter.to)
      fail(map, fmt::format("space.{}.simple is outside the range", map.key));
    return parameter;
  }

  void require_keys(const ConfigNode& map, const std::vector<std::string>& known) const {
    for (const ConfigNode& child : map.children) {
      if (std::ranges::count(known, child.key) == 0)
        throw_unknown_key(file_.name(), child, "key " + quote(child.key) + " in space." + map.key,
                          known);
    }
  }

  bool truth(const ConfigNode& map, const char* key) const {
    const std::string& text = map.find(key)->text;
    if (text != "true" && text != "false")
      fail(map, fmt::format("space.{}.{} is neither true nor false", map.key, key));
    return text == "true";
  }

  double number(const ConfigNode& map, const char* key, std::optional<double> otherwise) const {
    const ConfigNode* const node = map.find(key);
    if (!node && otherwise) return *otherwise;
    const auto value = node ? parse_number<double>(node->text) : std::nullopt;
    if (!value || !std::isfinite(*value))
      fail(map, fmt::format("space.{} needs numbers from, to and optionally simple", map.key));
    return *value;
  }

  const ConfigFile& file_;
};

}  // namespace

double SpaceParameter::rounded(double value, int digits) const {
  double step = 1.0;
  if (kind == Kind::kReal) step = std::pow(10.0, std::floor(std::log10(to - from)) - digits);
  // A quotient of integers has the digits that are meant: 3 / 10, not 3 * 0.1.
  const double by = step < 1.0 ? std::round(1.0 / step) : 1.0 / step;
  return std::clamp(std::round(value * by) / by, from, to);
}

ParameterValue SpaceParameter::written(double value) const {
  if (kind == Kind::kChoice) return choices.at(static_cast<std::size_t>(std::lround(value)));
  const bool is_integer = value == std::floor(value) && std::abs(value) < 1e15;
  return {is_integer ? fmt::format("{:.0f}", value) : number_text(value), true, false};
}

SearchPoint SearchSpace::simplest() const {
  SearchPoint point;
  for (const SpaceParameter& parameter : parameters) point.push_back(parameter.simple);
  return point;
}

UnitParameters SearchSpace::values(const SearchPoint& point) const {
  UnitParameters values;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    values.set(parameters[i].name, parameters[i].written(point[i]));
  return values;
}

double SearchSpace::complexity(const SearchPoint& point) const {
  double changed = 0.0;
  double distance = 0.0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const SpaceParameter& parameter = parameters[i];
    if (parameter.kind == Kind::kSeed || point[i] == parameter.simple) continue;
    changed += 1.0;
    distance += std::abs(point[i] - parameter.simple) / (parameter.to - parameter.from);
  }
  return changed + distance / (1.0 + static_cast<double>(parameters.size()));
}

SearchSpace load_space(const ConfigFile& file) {
  const ConfigNode* const section = file.section("space");
  if (section == nullptr) throw ConfigError(file.name() + ": the section space is missing");
  return SpaceReader(file).space(*section);
}

}  // namespace adit
