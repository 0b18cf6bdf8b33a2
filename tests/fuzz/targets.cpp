// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/targets.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <variant>

#include <octomap/OcTree.h>
#include <unistd.h>

#include "common/bus/log/lcm_log.hpp"
#include "common/config/config_file.hpp"
#include "common/files/zstd_stream.hpp"
#include "common/journal/journal_recovery.hpp"
#include "common/process_list/parser.hpp"
#include "common/volume/volume.hpp"
#include "procs/volume_map/occupancy_tree.hpp"
#include "tests/support/message_types.hpp"
#include "tests/support/process_list_writer.hpp"
#include "tools/carmen/carmen_line.hpp"

namespace adit::fuzz {
namespace {

/// An octree with runs of free and occupied cells of many lengths.
Bytes sample_octree() {
  std::vector<CellRun> runs;
  VoxelCode begin = VoxelGrid::code_of({32768, 32700, 32760});
  for (unsigned i = 0; i < 40; ++i) {
    const VoxelCode end = begin + (VoxelCode{1} << (i % 11)) + i % 3;
    runs.push_back({begin, end, i % 4 == 0});
    begin = end + 5 * i;
  }
  OccupancyTree tree(0.1);
  tree.update(runs);
  return tree.stream();
}

/// Checks that OctoMap reads every accepted stream to its end and finds the same number of leaves.
std::string_view take_octree(std::span<const std::uint8_t> bytes) {
  std::size_t leaves = 0;
  const auto reason = visit_leaves(bytes, [&leaves](const CellRun&) { ++leaves; });
  if (!reason.empty() || bytes.empty()) return reason;
  octomap::OcTree tree(0.1);
  std::istringstream in(std::string(bytes.begin(), bytes.end()));
  tree.readBinaryData(in);
  if (!in || in.peek() != std::istringstream::traits_type::eof() ||
      tree.getNumLeafNodes() != leaves) {
    std::cerr << "OctoMap reads a different octree than visit_leaves\n";
    std::abort();
  }
  return {};
}

}  // namespace

Target octree_target() { return {"octree", {sample_octree()}, take_octree}; }

namespace {

Bytes sample_log() {
  namespace fs = std::filesystem;
  const fs::path path =
      fs::temp_directory_path() / ("fuzz_" + std::to_string(getpid()) + ".lcmlog");
  LogWriter writer(path);
  for (int i = 0; i < 5; ++i) writer.write({1'600'000'000'000'000 + i, "POSE", Bytes(40)});
  writer.close();
  std::ifstream file(path, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(file), {}};
  fs::remove(path);
  return bytes;
}

/// Reads all events. Every byte must belong to an event or be counted as corrupt or truncated.
std::string_view take_log(std::span<const std::uint8_t> bytes) {
  LogParser parser(bytes);
  std::size_t in_events = 0;
  while (const auto event = parser.next()) {
    in_events += log_format::kHeaderBytes + event->channel.size() + event->data.size();
  }
  const LogHealth& health = parser.health();
  if (in_events + health.corrupt_bytes + health.truncated_bytes != bytes.size()) {
    std::cerr << "the byte counts of the log parser do not add up\n";
    std::abort();
  }
  return health.corrupt_bytes + health.truncated_bytes > 0 ? "damaged" : "";
}

Bytes sample_compressed_log() {
  const Bytes log = sample_log();
  ZstdEncoder encoder;
  std::string compressed;
  for (int i = 0; i < 3; ++i) {
    compressed += encoder.add({reinterpret_cast<const char*>(log.data()), log.size()});
    compressed += encoder.end_frame();
  }
  return {compressed.begin(), compressed.end()};
}

/// Decompresses all that is readable, and reads its events.
std::string_view take_compressed_log(std::span<const std::uint8_t> bytes) {
  ZstdDecoder decoder(bytes);
  Bytes content;
  while (decoder.read(content)) {
  }
  const ZstdDecoder::Damage& damage = decoder.damage();
  if (damage.corrupt_bytes + damage.truncated_bytes > bytes.size()) {
    std::cerr << "more is damaged than there is\n";
    std::abort();
  }
  take_log(content);
  return damage.corrupt_regions + damage.truncated_bytes > 0 ? "damaged" : "";
}

std::string_view take_carmen(std::span<const std::uint8_t> bytes) {
  const CarmenLine line =
      parse_carmen_line({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (std::holds_alternative<CarmenIgnored>(line)) return "ignored";
  const auto* const rejected = std::get_if<CarmenError>(&line);
  return rejected ? rejected->reason : "";
}

Bytes sample_journal() {
  Bytes bytes;
  journal_format::Place place;
  for (const std::size_t size : {0U, 40U, 7U, 300U}) {
    const Bytes data(size, static_cast<std::uint8_t>(size));
    const Bytes record = journal_format::write({"LOCAL_MAP", data}, place);
    place = {place.sequence + 1, journal_format::checksum_of(record)};
    bytes.insert(bytes.end(), record.begin(), record.end());
  }
  return bytes;
}

/// Finds all records. Every byte must belong to a record or be counted as corrupt or truncated; and
/// the intact copy beside it makes every loss good.
std::string_view take_journal(std::span<const std::uint8_t> bytes) {
  const JournalScan scan = scan_journal(bytes);
  std::size_t counted = scan.truncated_bytes;
  for (const auto& record : scan.records) counted += record.size;
  for (const JournalRegion& region : scan.corrupt) counted += region.bytes;
  if (counted != bytes.size()) {
    std::cerr << "the byte counts of the journal do not add up\n";
    std::abort();
  }
  const Bytes intact = sample_journal();
  const JournalContents joined = join_copies(std::array{scan, scan_journal(intact)});
  if (joined.records.size() < 4) {
    std::cerr << "a record that one copy has is lost\n";
    std::abort();
  }
  return text_of(joined.health).empty() ? "" : "damaged";
}

/// Reads a process list. Writing and reading it again must give the same list.
std::string_view take_process_list(std::span<const std::uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  ProcessList list;
  try {
    list = parse_process_list(text, "list");
  } catch (const ConfigError&) {
    return "rejected";
  }
  if (parse_process_list(to_text(list), "written") != list) {
    std::cerr << "a process list changes when it is written and read again\n";
    std::abort();
  }
  return {};
}

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

}  // namespace

std::vector<Target> message_targets() {
  std::vector<Target> targets;
  for (const MessageType& type : message_types()) {
    targets.push_back({type.name, {type.sample}, type.process});
  }
  return targets;
}

Target compressed_log_target() {
  return {"compressed log", {sample_compressed_log()}, take_compressed_log};
}
Target log_target() { return {"log", {sample_log()}, take_log}; }

Target journal_target() { return {"journal", {sample_journal()}, take_journal}; }

Target carmen_target() {
  return {"carmen",
          {bytes_of("FLASER 4 1.0 2.5 81.83 0.0 1 2 0.5 3 4 -0.5 1134864629.895182 b21 0.0863"),
           bytes_of("ODOM 1.5 -2.25 0.5 0.1 0.01 0 1134864629.895182 b21 0.0863"),
           bytes_of("ROBOTLASER1 0 -1.570796 3.141593 0.785398 81.9 0.01 0 5 1 2 3 4 5 0 "
                    "1 2 0.5 1 2 0.5 0.1 0.2 0.3 0.4 1e9 1134864629.895182 b21 0.0863")},
          take_carmen};
}

Target process_list_target() {
  return {"process list",
          {bytes_of(R"(group "g" { cmd "laser" { exec = "A=B laser 'x y'"; host = "robot"; }
              group "h" { cmd "slam" { exec = "slam \\ x"; auto_respawn = "true"; stop_signal = 15;
                depends_on = "laser"; restart_limit = 3; alive_channel = "POSE";
                alive_rate_hz = 2.5; start_timeout_s = 4; stop_time_allowed = 0.5; answer_channel = "POSE";
                answers_to = "LASER_FRONT", "IMU"; answer_timeout_s = 5; } } }  # both
              script "go" { start group "g/h" wait "running" timeout_s 9; wait ms 500;
                stop cmd "slam"; wait cmd "slam" status "stopped"; run_script "end"; }
              script "end" { restart everything; })")},
          take_process_list};
}

std::vector<Target> all_targets() {
  std::vector<Target> targets = message_targets();
  targets.push_back(log_target());
  targets.push_back(compressed_log_target());
  targets.push_back(carmen_target());
  targets.push_back(journal_target());
  targets.push_back(octree_target());
  targets.push_back(process_list_target());
  for (Target& target : world_targets()) targets.push_back(std::move(target));
  for (Target& target : cloud_targets()) targets.push_back(std::move(target));
  for (Target& target : viewer_targets()) targets.push_back(std::move(target));
  for (Target& target : driver_targets()) targets.push_back(std::move(target));
  for (Target& target : bag_targets()) targets.push_back(std::move(target));
  return targets;
}

}  // namespace adit::fuzz
