// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission_journal.hpp"

#include "common/messages/codec.hpp"
#include "common/messages/mission.hpp"

namespace adit {
namespace {

constexpr std::string_view kPhase = "PHASE";
constexpr std::string_view kPathPose = "TRAVERSED_POSE";

std::optional<MissionPhase> phase_of(const JournalRecord& record) {
  if (record.kind != kPhase) return std::nullopt;
  const auto message = decode<phase_t>(record.bytes);
  if (!message) return std::nullopt;
  const auto phase = from_message(*message);
  return phase ? std::optional(*phase) : std::nullopt;
}

}  // namespace

MissionJournal::MissionJournal(const std::filesystem::path& path)
    : journal_(path, [this](const JournalRecord& record) {
        if (record.kind == kPathPose) {
          if (const auto pose = stored_path_pose_from(record.bytes)) path_.push_back(*pose);
          return;
        }
        const auto phase = phase_of(record);
        if (!phase) return;
        if (!last_) start_utime_ = phase->utime;
        last_ = phase;
      }) {}

void MissionJournal::append(const MissionPhase& phase) {
  journal_.append(kPhase, encode(to_message(phase)));
  journal_.sync();
}

void MissionJournal::append(const StoredPathPose& pose) {
  journal_.append(kPathPose, to_bytes(pose));
}

}  // namespace adit
