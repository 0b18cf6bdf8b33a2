// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/definition/parameter_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>
#include <glob.h>
#include <nlohmann/json.hpp>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"
#include "tools/campaign/definition/campaign_definition.hpp"

namespace adit {

void UnitParameters::set(const std::string& name, ParameterValue value) {
  values_.emplace_back(name, std::move(value));
}

const ParameterValue* UnitParameters::find(const std::string& name) const {
  const auto found =
      std::ranges::find(values_, name, [](const auto& entry) { return entry.first; });
  return found != values_.end() ? &found->second : nullptr;
}

std::string UnitParameters::json() const {
  nlohmann::json object = nlohmann::json::object();  // sorted by name
  for (const auto& [name, value] : values_) {
    const auto integer = value.is_number ? parse_number<std::int64_t>(value.text) : std::nullopt;
    const auto number = value.is_number ? parse_number<double>(value.text) : std::nullopt;
    if (integer) {
      object[name] = *integer;
    } else if (number) {
      object[name] = *number;
    } else {
      object[name] = value.text;
    }
  }
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

namespace {

namespace fs = std::filesystem;
using Kind = ConfigNode::Kind;
using Values = std::vector<ParameterValue>;

class MatrixReader {
 public:
  MatrixReader(const ConfigFile& file, fs::path folder) : file_(file), folder_(std::move(folder)) {}

  std::vector<UnitParameters> units(const ConfigNode& matrix) const {
    if (matrix.kind != Kind::kMap) fail(matrix, "matrix is not a map of parameters");
    std::vector<UnitParameters> units{{}};
    for (const ConfigNode& node : matrix.children) {
      if (node.key != "include" && node.key != "exclude") units = product(units, node);
    }
    if (units.size() == 1 && units.front().values().empty()) units.clear();
    for (const ConfigNode& map : maps_of(matrix.find("exclude"))) {
      const UnitParameters excluded = parameters(map);
      std::erase_if(units, [&](const UnitParameters& unit) { return has_all(unit, excluded); });
    }
    for (const ConfigNode& map : maps_of(matrix.find("include"))) units.push_back(parameters(map));
    if (units.empty()) fail(matrix, "matrix has no units");
    return units;
  }

 private:
  [[noreturn]] void fail(const ConfigNode& node, const std::string& reason) const {
    throw ConfigError(fmt::format("{}:{}: {}", file_.name(), node.line, reason));
  }

  std::vector<UnitParameters> product(const std::vector<UnitParameters>& units,
                                      const ConfigNode& node) const {
    const Values values = values_of(node);
    if (units.size() * values.size() > kCampaignUnitsMax)
      fail(node, fmt::format("matrix has more than {} units", kCampaignUnitsMax));
    std::vector<UnitParameters> all;
    all.reserve(units.size() * values.size());
    for (const UnitParameters& unit : units) {
      for (const ParameterValue& value : values) {
        all.push_back(unit);
        all.back().set(node.key, value);
      }
    }
    return all;
  }

  void require_name(const ConfigNode& node) const {
    if (!is_column_name(node.key) || node.key == "out")
      fail(node, "matrix." + node.key + " is not a name of letters a-z, 0-9 and _, or is out");
  }

  Values values_of(const ConfigNode& node) const {
    require_name(node);
    Values values;
    if (node.kind == Kind::kScalar) values.push_back(scalar(node));
    for (const ConfigNode& child : node.children) {
      if (node.kind == Kind::kList) values.push_back(scalar(child));
    }
    if (node.kind == Kind::kMap) values = node.find("files") ? files(node) : range(node);
    if (values.empty()) fail(node, "matrix." + node.key + " has no values");
    return values;
  }

  ParameterValue scalar(const ConfigNode& node) const {
    if (node.kind != Kind::kScalar) fail(node, "a value of the matrix is not text or a number");
    if (node.text.find_first_of("{}") != std::string::npos)
      fail(node, "a value of the matrix has braces: " + quote(node.text));
    const auto number = node.quoted ? std::nullopt : parse_number<double>(node.text);
    return {node.text, number && std::isfinite(*number), false};
  }

  double number(const ConfigNode& map, const char* key, std::optional<double> otherwise) const {
    const ConfigNode* const node = map.find(key);
    if (!node && otherwise) return *otherwise;
    const auto value = node ? parse_number<double>(node->text) : std::nullopt;
    if (!value || !std::isfinite(*value))
      fail(map,
           fmt::format("matrix.{} needs numbers from, to and optionally step, or files", map.key));
    return *value;
  }

  /// Counted in steps, so that rounding neither adds nor drops the last value.
  Values range(const ConfigNode& map) const {
    for (const ConfigNode& child : map.children) {
      if (child.key != "from" && child.key != "to" && child.key != "step")
        throw_unknown_key(file_.name(), child, "key " + quote(child.key) + " in matrix." + map.key,
                          {"from", "to", "step", "files"});
    }
    const double from = number(map, "from", {});
    const double to = number(map, "to", {});
    const double step = number(map, "step", 1.0);
    constexpr double kRounding = 1e-9;  // of a step
    const double steps = std::floor((to - from) / step + kRounding);
    if (step <= 0.0 || steps < 0.0) fail(map, fmt::format("matrix.{} has no values", map.key));
    if (steps >= static_cast<double>(kCampaignUnitsMax))
      fail(map, fmt::format("matrix has more than {} units", kCampaignUnitsMax));
    Values values;
    for (std::int64_t i = 0; i <= std::llround(steps); ++i) {
      const double value = from + static_cast<double>(i) * step;
      // Of a sum like 1.3 + 2 * 0.1, what is meant: 1.5, not 1.5000000000000002.
      const double rounded = *parse_number<double>(fmt::format("{:.12g}", value));
      const bool is_integer = rounded == std::floor(rounded) && std::abs(rounded) < 1e15;
      values.push_back({is_integer ? fmt::format("{:.0f}", rounded) : number_text(rounded), true});
    }
    return values;
  }

  /// In order of names. Relative to the folder, like the pattern.
  Values files(const ConfigNode& map) const {
    const std::string pattern = map.find("files")->text;
    const fs::path absolute = folder_ / pattern;
    glob_t found{};
    const int error = glob(absolute.c_str(), 0, nullptr, &found);
    Values values;
    for (std::size_t i = 0; error == 0 && i < found.gl_pathc; ++i) {
      const fs::path path = found.gl_pathv[i];
      const bool is_relative = fs::path(pattern).is_relative();
      const fs::path name = is_relative ? path.lexically_relative(folder_) : path;
      if (name.string().find_first_of("{}") != std::string::npos)
        fail(map, "the name of a file has braces: " + quote(name.string()));
      values.push_back({name.string(), false, true});
    }
    globfree(&found);
    if (values.empty()) fail(map, "no file matches " + quote(pattern));
    return values;
  }

  std::vector<ConfigNode> maps_of(const ConfigNode* list) const {
    if (!list) return {};
    if (list->kind != Kind::kList) fail(*list, "matrix." + list->key + " is not a list of maps");
    return list->children;
  }

  UnitParameters parameters(const ConfigNode& map) const {
    if (map.kind != Kind::kMap) fail(map, "include and exclude are lists of maps");
    UnitParameters parameters;
    for (const ConfigNode& child : map.children) {
      require_name(child);
      parameters.set(child.key, scalar(child));
    }
    return parameters;
  }

  static bool has_all(const UnitParameters& unit, const UnitParameters& wanted) {
    return std::ranges::all_of(wanted.values(), [&](const auto& entry) {
      const ParameterValue* const value = unit.find(entry.first);
      return value && value->text == entry.second.text;
    });
  }

  const ConfigFile& file_;
  fs::path folder_;
};

}  // namespace

std::vector<UnitParameters> expand_matrix(const ConfigFile& file, const fs::path& folder) {
  const ConfigNode* const matrix = file.section("matrix");
  if (!matrix) return {{}};
  return MatrixReader(file, folder).units(*matrix);
}

}  // namespace adit
