// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission_journal.hpp"

#include "common/messages/codec.hpp"
#include "common/messages/mission.hpp"

namespace adit {
namespace {

constexpr std::string_view kPhase = "PHASE";
constexpr std::string_view kPathPose = "TRAVERSED_POSE";
constexpr std::string_view kNewestLocalMap = "NEWEST_LOCAL_MAP";
constexpr std::string_view kHomeUnknown = "HOME_UNKNOWN";

std::optional<MissionPhase> phase_of(const JournalRecord& record) {
  if (record.kind != kPhase) return std::nullopt;
  const auto message = decode<phase_t>(record.bytes);
  if (!message) return std::nullopt;
  const auto phase = from_message(*message);
  return phase ? std::optional(*phase) : std::nullopt;
}

std::optional<int> newest_local_map_of(const JournalRecord& record) {
  if (record.kind != kNewestLocalMap) return std::nullopt;
  const auto id = value_from_bytes<std::int32_t>(record.bytes);
  return id ? std::optional<int>(*id) : std::nullopt;
}

}  // namespace

MissionJournal::MissionJournal(const std::filesystem::path& path)
    : journal_(path, [this](const JournalRecord& record) { read(record); }) {}

void MissionJournal::read(const JournalRecord& record) {
  if (record.kind == kPathPose) {
    if (const auto pose = stored_path_pose_from(record.bytes)) path_.push_back(*pose);
    return;
  }
  if (const auto id = newest_local_map_of(record)) newest_local_map_ = id;
  if (record.kind == kHomeUnknown) {
    home_unknown_.emplace(record.bytes.begin(), record.bytes.end());
    return;
  }
  const auto phase = phase_of(record);
  if (!phase) return;
  if (!last_) start_utime_ = phase->utime;
  last_ = phase;
}

std::optional<MissionPhase> read_last_phase(const std::filesystem::path& path) {
  std::optional<MissionPhase> last;
  read_journal(path, [&](const JournalRecord& record) {
    if (const auto phase = phase_of(record)) last = phase;
  });
  return last;
}

std::optional<int> read_newest_local_map(const std::filesystem::path& path) {
  std::optional<int> newest;
  read_journal(path, [&](const JournalRecord& record) {
    if (const auto id = newest_local_map_of(record)) newest = id;
  });
  return newest;
}

void MissionJournal::append(const MissionPhase& phase) {
  journal_.append(kPhase, encode(to_message(phase)));
  journal_.sync();
}

void MissionJournal::append(const NewestLocalMap& map) {
  journal_.append(kNewestLocalMap, bytes_of(map.id));
}

void MissionJournal::append(const HomeUnknown& home) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(home.reason.data());
  journal_.append(kHomeUnknown, {bytes, home.reason.size()});
  journal_.sync();
}

void MissionJournal::append(const StoredPathPose& pose) {
  journal_.append(kPathPose, to_bytes(pose));
}

}  // namespace adit
