// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/journals/damaged_stages.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "common/journal/journal.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "procs/exploration/exploration_journal.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/mission/mission_journal.hpp"
#include "procs/scan_assembly/cloud_journal.hpp"
#include "procs/volume_map/volume_journal.hpp"

namespace adit::test {

/// What the map says of the newest local map relative to home.
struct NewestPose {
  int id = 0;
  Pose2 T_home_local;
  double within_m = 0.0;  ///< 95 %
};

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> kStages = {"mapping", "mission", "exploration",
                                                     "volume_map", "scan_assembly"};
constexpr double kHomeM = 0.5;  // farther from home, "home" is false
constexpr double kSds95 = 2.448;

/// The records as text, in order.
std::vector<std::string> records_in(const fs::path& journal) {
  std::vector<std::string> records;
  read_journal(journal, [&](const JournalRecord& record) {
    std::string text(record.kind);
    text.append(reinterpret_cast<const char*>(record.bytes.data()), record.bytes.size());
    records.push_back(std::move(text));
  });
  return records;
}

std::string bytes_in(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Whether a journal is the intact one as it was earlier: space that is reserved is zero.
bool is_older(const std::string& bytes, const std::string& intact) {
  const auto [at, at_intact] =
      std::mismatch(bytes.begin(), bytes.end(), intact.begin(), intact.end());
  return std::all_of(at, bytes.end(), [](char byte) { return byte == 0; });
}

std::optional<NewestPose> newest_pose(StoredMap stored) {
  if (stored.maps.empty()) return std::nullopt;
  const bool end_lost = stored.losses.end;
  const int id = stored.maps.back().id;
  stored.unfinished.reset();
  Mapping mapping{MappingParams{}};
  mapping.restore(std::move(stored));
  mapping.reconnect();
  const MapGraph graph = mapping.graph();
  NewestPose newest{id, between(graph.poses.front(), graph.poses.back()), 0.0};
  if (id > 0) {
    Trial trial(mapping.association().problem(), mapping.association().hypothesis());
    newest.within_m = kSds95 * position_sd_m(trial.covariance(0, id));
  }
  // The body is said to be anywhere.
  if (end_lost) newest.within_m = 1e9;
  return newest;
}

bool names_all_losses(const StoredMap& found, const StoredMap& intact) {
  const MapLosses& losses = found.losses;
  const auto is_in = [](const std::vector<int>& ids, int id) {
    return std::ranges::find(ids, id) != ids.end();
  };
  const auto is_named = [&](int id) {
    return is_in(losses.local_maps, id) || is_in(losses.shortened, id);
  };
  for (const LocalMap& map : intact.maps) {
    const auto i = static_cast<std::size_t>(map.id);
    if (i >= found.maps.size()) {
      if (!losses.end) return false;
    } else if (found.maps[i].scans != map.scans && !is_named(map.id)) {
      return false;
    }
  }
  if (!intact.unfinished) return true;
  const bool is_whole = found.unfinished && found.unfinished->scans == intact.unfinished->scans;
  return is_whole || losses.end || is_named(intact.unfinished->id);
}

}  // namespace

struct DamagedStages::Intact {
  std::string stage;
  fs::path journal;
  std::string bytes;
  std::vector<std::string> records;
  std::optional<StoredMap> map;
  std::optional<NewestPose> newest;
};

DamagedStages::DamagedStages(const fs::path& mission, fs::path scratch)
    : mission_(mission), scratch_(std::move(scratch)) {
  fs::create_directories(scratch_);
  for (const std::string_view stage : kStages) {
    auto intact = std::make_unique<Intact>();
    intact->stage = stage;
    intact->journal = mission / (intact->stage + ".journal");
    if (!fs::exists(intact->journal)) continue;
    intact->records = records_in(intact->journal);
    if (intact->records.empty()) continue;
    intact->bytes = bytes_in(intact->journal);
    if (stage == "mapping") {
      intact->map = read_map_journal(intact->journal);
      intact->newest = newest_pose(*intact->map);
    }
    intact_.push_back(std::move(intact));
  }
}

DamagedStages::~DamagedStages() = default;

std::vector<std::string> DamagedStages::stages() const {
  std::vector<std::string> names;
  for (const auto& intact : intact_) names.push_back(intact->stage);
  return names;
}

DamagedCase DamagedStages::run(unsigned seed) {
  std::mt19937 random(seed);
  const Intact& intact = *intact_[random() % intact_.size()];
  DamagedCase result{intact.stage, random_damage(random), {}, {}};
  const fs::path journal = scratch_ / intact.journal.filename();
  const fs::path copy = journal_copy(journal);
  for (const fs::path& path : {journal, copy})
    fs::copy_file(intact.journal, path, fs::copy_options::overwrite_existing);
  apply(result.damage, journal, random);
  const std::string damaged = bytes_in(journal);
  if (damaged == intact.bytes && bytes_in(copy) == intact.bytes) return result;

  std::optional<StoredMap> map;
  try {
    if (intact.stage == "mapping") {
      map = read_map_journal(journal);
      result.report = MapJournal(journal).report();
    }
    if (intact.stage == "mission") result.report = MissionJournal(journal).damage();
    if (intact.stage == "exploration") result.report = ExplorationJournal(journal).damage();
    if (intact.stage == "volume_map") result.report = VolumeJournal(journal).damage();
    if (intact.stage == "scan_assembly") result.report = CloudJournal(journal).damage();
  } catch (const std::exception& error) {  // the stage does not start, and says why
    result.report = error.what();
    result.outcome = DamageOutcome::kReported;
    return result;
  }
  const bool same = records_in(journal) == intact.records;
  const bool both = result.damage.files == JournalDamage::Files::kBoth;
  const bool is_cut = result.damage.action == JournalDamage::Action::kTruncate ||
                      (result.report.empty() && is_older(damaged, intact.bytes));
  if (same) {
    result.outcome = DamageOutcome::kRight;
  } else if (both && is_cut) {
    result.outcome = DamageOutcome::kOlder;
  } else {
    const bool named = !map || names_all_losses(*map, *intact.map);
    result.outcome =
        result.report.empty() || !named ? DamageOutcome::kUnreportedLoss : DamageOutcome::kReported;
  }
  if (!map || same || result.outcome == DamageOutcome::kOlder) return result;
  const auto newest = newest_pose(*map);
  if (newest && intact.newest && newest->id == intact.newest->id && newest->within_m <= kHomeM) {
    const Pose2 T_right_found = between(intact.newest->T_home_local, newest->T_home_local);
    if (T_right_found.translation().norm() > kHomeM) result.outcome = DamageOutcome::kFalseHome;
  }
  return result;
}

void copy_mission(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const auto& entry : fs::directory_iterator(from)) {
    const fs::path path = entry.path();
    if (!entry.is_regular_file()) continue;
    if (path.extension() == ".lcmlog") {
      fs::create_hard_link(path, to / path.filename());
    } else {
      fs::copy_file(path, to / path.filename());
    }
  }
}

}  // namespace adit::test
