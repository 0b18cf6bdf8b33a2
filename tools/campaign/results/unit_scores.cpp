// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/unit_scores.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/config/number_text.hpp"
#include "common/files/file_utils.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string expanded_name(std::string text, const std::string& parameters) {
  const Json values = Json::parse(parameters);
  for (const auto& [name, value] : values.items()) {
    const std::string placeholder = "{" + name + "}";
    const std::string by = value.is_string() ? value.get<std::string>() : value.dump();
    for (auto at = text.find(placeholder); at != std::string::npos; at = text.find(placeholder))
      text.replace(at, placeholder.size(), by);
  }
  return text;
}

std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, separator);) {
    if (!cell.empty() && cell.back() == '\r') cell.pop_back();
    cells.push_back(cell);
  }
  return cells;
}

/// The columns of the last row of a table, by the names in its first row.
Json last_row(const std::string& text, char separator) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line, separator);
  std::string last;
  while (std::getline(lines, line)) {
    if (!line.empty()) last = line;
  }
  const std::vector<std::string> cells = cells_of(last, separator);
  Json row = Json::object();
  for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) {
    const auto number = parse_number<double>(cells[i]);
    row[names[i]] = number && std::isfinite(*number) ? Json(*number) : Json(cells[i]);
  }
  return row;
}

/// The content of a file as JSON, each file read once.
class ScoreFiles {
 public:
  explicit ScoreFiles(const fs::path& output) : output_(output) {}

  /// Throws std::runtime_error if the file cannot be read.
  const Json& content(const std::string& name) {
    const auto [entry, is_new] = contents_.try_emplace(name);
    if (is_new) entry->second = parsed(name);
    return entry->second;
  }

 private:
  Json parsed(const std::string& name) const {
    const std::string text = read_text_file(output_ / name);
    if (name.ends_with(".tsv")) return last_row(text, '\t');
    if (name.ends_with(".csv")) return last_row(text, ',');
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) throw std::runtime_error(name + " is not JSON");
    return json;
  }

  const fs::path& output_;
  std::map<std::string, Json> contents_;
};

Json value_of(const ScoreDefinition& score, const Json& content) {
  if (!score.column.empty()) return content.value(score.column, Json());
  const Json::json_pointer pointer(score.pointer);
  if (!content.contains(pointer)) return {};
  const Json& value = content.at(pointer);
  return value.is_structured() ? Json() : value;
}

}  // namespace

UnitScores read_scores(const std::vector<ScoreDefinition>& definitions, const fs::path& output,
                       const std::string& parameters) {
  UnitScores scores;
  Json values = Json::object();
  ScoreFiles files(output);
  for (const ScoreDefinition& definition : definitions) {
    values[definition.name] = Json();
    const std::string name = expanded_name(definition.file, parameters);
    try {
      values[definition.name] = value_of(definition, files.content(name));
    } catch (const std::exception&) {
      if (scores.failure.empty()) scores.failure = fmt::format("cannot read {}", name);
    }
  }
  scores.json = values.dump(-1, ' ', false, Json::error_handler_t::replace);
  return scores;
}

}  // namespace adit
