// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/run/unit_result.hpp"

#include <array>
#include <stdexcept>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "common/files/file_error.hpp"
#include "common/files/file_utils.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 7> kStateNames{
    "ended", "crashed", "time limit", "memory limit", "not started", "no score", "lost"};

UnitState state_named(const std::string& name) {
  for (std::size_t i = 0; i < kStateNames.size(); ++i) {
    if (name == kStateNames[i]) return static_cast<UnitState>(i);
  }
  throw std::invalid_argument("unknown state");
}

}  // namespace

std::string name_of(UnitState state) { return kStateNames.at(static_cast<std::size_t>(state)); }

void write_result(const UnitResult& result, const std::filesystem::path& path) {
  const Json json{{"id", result.id},
                  {"state", name_of(result.state)},
                  {"reason", result.reason},
                  {"exit_code", result.exit_code ? Json(*result.exit_code) : Json()},
                  {"began_utime", result.began_utime},
                  {"wall_s", result.wall_s},
                  {"cpu_s", result.cpu_s},
                  {"memory_mb", result.memory_mb},
                  {"limit", result.limit},
                  {"host", result.host}};
  write_text_file(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n", path);
}

std::optional<UnitResult> read_result(const std::filesystem::path& path) try {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const Json json = Json::parse(read_text_file(path));
  UnitResult result;
  result.id = json.at("id");
  result.state = state_named(json.at("state"));
  result.reason = json.at("reason");
  if (!json.at("exit_code").is_null()) result.exit_code = json.at("exit_code").get<int>();
  result.began_utime = json.at("began_utime");
  result.wall_s = json.at("wall_s");
  result.cpu_s = json.at("cpu_s");
  result.memory_mb = json.at("memory_mb");
  result.limit = json.at("limit");
  result.host = json.at("host");
  return result;
} catch (const nlohmann::json::exception&) {
  throw FileError(path.string() + ": is not the result of a unit");
} catch (const std::invalid_argument&) {
  throw FileError(path.string() + ": is not the result of a unit");
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

}  // namespace adit
