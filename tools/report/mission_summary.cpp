// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_summary.hpp"

#include <nlohmann/json.hpp>

#include "tools/report/text.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

Json phases_json(const MissionFacts& facts) {
  Json phases = Json::object();
  for (const PhaseShare& share : facts.phases) {
    phases[name_of(share.phase)] = {
        {"times", share.times}, {"seconds", share.seconds}, {"share", share.share}};
  }
  return {{"said_by_mission", facts.last.has_value()}, {"by_phase", std::move(phases)}};
}

Json outcome_json(const MissionFacts& facts) {
  return {{"outcome", facts.last ? Json(name_of(facts.last->outcome)) : Json()},
          {"complete", facts.last ? Json(facts.last->complete) : Json()},
          {"text", outcome_text(facts)},
          {"last_phase", facts.last ? Json(name_of(facts.last->phase)) : Json()},
          {"last_reason", facts.last ? Json(facts.last->reason) : Json()},
          {"turned_around_because",
           facts.homeward_reason.empty() ? Json() : Json(facts.homeward_reason)},
          {"distance_from_start_m", facts.from_start_m}};
}

Json stubs_json(const MissionFacts& facts) {
  if (!facts.stubs) return {};
  return {{"found", facts.stubs->found},       {"closed", facts.stubs->closed},
          {"open", facts.stubs->open},         {"blocked", facts.stubs->blocked},
          {"doubtful", facts.stubs->doubtful}, {"corridors_known_m", *facts.explored_m}};
}

Json truth_json(const MissionFacts& facts) {
  if (!facts.score) return {};
  return {{"poses", facts.score->poses},
          {"rmse_m", facts.score->aligned.rmse_m},
          {"max_m", facts.score->aligned.max_m},
          {"rmse_from_start_m", facts.score->anchored.rmse_m},
          {"max_from_start_m", facts.score->anchored.max_m},
          {"true_length_m", facts.score->true_length_m}};
}

Json configs_json(const LogCensus& census) {
  Json configs = Json::object();
  for (const auto& [stage, copy] : census.configs) {
    configs[stage] = {{"version", copy.version}, {"yaml", copy.yaml}};
  }
  return configs;
}

}  // namespace

std::string mission_summary_json(const MissionFacts& facts, const LogCensus& census) {
  const Json json{{"simulated", facts.simulated},
                  {"begin", date_text(facts.from_utime)},
                  {"begin_utime", facts.from_utime},
                  {"end_utime", facts.to_utime},
                  {"duration_s", facts.seconds()},
                  {"way_m", facts.way_m},
                  {"farthest_from_start_m", facts.farthest_m},
                  {"mission", outcome_json(facts)},
                  {"phases", phases_json(facts)},
                  {"scans", {{"taken", facts.scans}, {"without_path", facts.scans_without_path}}},
                  {"map",
                   {{"local_maps", facts.local_maps},
                    {"closures",
                     {{"proposed", facts.closures.proposed},
                      {"accepted", facts.closures.in_force},
                      {"revised", facts.closures.revised},
                      {"revoked", facts.revoked}}}}},
                  {"openings", stubs_json(facts)},
                  {"guard", {{"stops", facts.stops}, {"stopped_s", facts.stopped_s}}},
                  {"restarts", facts.restarts},
                  {"against_truth", truth_json(facts)},
                  {"collision", facts.failure ? Json(!facts.failure->empty()) : Json()},
                  {"failure", facts.failure ? Json(*facts.failure) : Json()},
                  {"complaints", census.complaints},
                  {"version", facts.version},
                  {"messages", census.messages},
                  {"config", configs_json(census)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace adit
