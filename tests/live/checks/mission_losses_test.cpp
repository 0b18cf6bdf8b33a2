// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/live/checks/mission_losses.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/volume_map/volume_journal.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit::test {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000;

Cloud scan(std::int32_t id) {
  Cloud cloud;
  cloud.utime = kUtime + id * kSecond;
  cloud.id = id;
  cloud.lines.push_back(
      {cloud.utime, {0.0F, 0.0F, 0.5F}, {{2.0F, static_cast<float>(id), 0.0F}}, {}});
  return cloud;
}

/// A mission that publishes local maps 0 and 1 after 10 s and scans 1 and 2 after 1 and 2 s, and
/// journals that can be incomplete.
class MissionLossesTest : public testing::Test {
 protected:
  MissionLossesTest() {
    LogWriter log(log_);
    for (const std::int32_t id : {1, 2}) {
      for (const CloudFragment& fragment : split(scan(id)))
        write(log, id, channels::kCloud, fragment);
    }
    for (const int id : {0, 1}) {
      for (const auto& fragment : split(local_map(id, 3)))
        write(log, 10, channels::kLocalMap, fragment);
    }
    write_graph(log, 2);
    log.close();
  }

  template <class Value>
  static void write(LogWriter& log, int at_s, std::string_view channel, const Value& value) {
    log.write({kUtime + at_s * kSecond, channel, encode(to_message(value))});
  }
  static void write_graph(LogWriter& log, std::size_t nodes) {
    const MapGraph graph{kUtime, 1, std::vector<Pose2>(nodes), {}};
    for (const auto& fragment : split(graph)) write(log, 20, channels::kPoseGraph, fragment);
  }

  void store_maps(int maps) const {
    MapJournal journal(maps_);
    for (int id = 0; id < maps; ++id) journal.append({local_map(id, 3), {}});
  }
  void store_scans(const std::vector<std::int32_t>& ids) const {
    VolumeJournal journal(scans_);
    VolumeMap map{VolumeMapParams{}};
    for (const std::int32_t id : ids) {
      map.add(scan(id));
      journal.store(map);
    }
  }
  [[nodiscard]] MissionLosses found() const { return losses(published_in({log_}), maps_, scans_); }

  ScratchFolder scratch_;
  std::filesystem::path log_ = scratch_ / "run.lcmlog";
  std::filesystem::path maps_ = scratch_ / "mapping.journal";
  std::filesystem::path scans_ = scratch_ / "volume_map.journal";
};

TEST_F(MissionLossesTest, AreEmptyForCompleteJournals) {
  store_maps(2);
  store_scans({1, 2});
  EXPECT_THAT(found().maps, IsEmpty());
  EXPECT_THAT(found().scans, IsEmpty());
}

TEST_F(MissionLossesTest, ReportAMissingLocalMap) {
  store_maps(1);
  store_scans({1, 2});
  EXPECT_THAT(found().maps, ElementsAre(Field(&PublishedItem::id, 1)));
  EXPECT_THAT(found().scans, IsEmpty());
}

TEST_F(MissionLossesTest, ReportAnOutdatedLocalMap) {
  store_scans({1, 2});
  MapJournal(maps_).append({local_map(0, 2), {}});
  MapJournal(maps_).append({local_map(1, 3), {}});
  EXPECT_THAT(found().maps, ElementsAre(Field(&PublishedItem::id, 0)));
}

TEST_F(MissionLossesTest, ReportAMissingScanWithItsTime) {
  store_maps(2);
  store_scans({1});
  const MissionLosses lost = found();
  ASSERT_EQ(lost.scans.size(), 1U);
  EXPECT_EQ(lost.scans[0].id, 2);
  EXPECT_DOUBLE_EQ(lost.scans[0].at_s, 1.0);  // since the first message
  EXPECT_DOUBLE_EQ(lost.scans[0].before_log_end_s, 18.0);
}

TEST_F(MissionLossesTest, ReportALocalMapMissingInTheLastGraph) {
  store_maps(2);
  store_scans({1, 2});
  LogWriter second(scratch_ / "run_2.lcmlog");
  write_graph(second, 1);
  second.close();
  const PublishedData published = published_in({log_, scratch_ / "run_2.lcmlog"});
  EXPECT_THAT(losses(published, maps_, scans_).maps, ElementsAre(Field(&PublishedItem::id, 1)));
}

TEST_F(MissionLossesTest, RequireJournals) {
  EXPECT_THROW(losses(published_in({log_}), maps_, scans_), std::runtime_error);
}

}  // namespace
}  // namespace adit::test
