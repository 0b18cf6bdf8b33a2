// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/terrain_node.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/terrain.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr std::int64_t kRequestPeriodUs = 2'000'000;

/// Flat ground with lines for several fragments.
Cloud flat_ground(std::int32_t id) {
  Cloud cloud;
  cloud.id = id;
  cloud.utime = kUtime + id;
  for (int i = 0; i < 120; ++i) {
    CloudLine line;
    line.utime = cloud.utime - 120 + i;
    line.origin = {0.0F, 0.0F, 0.6F};
    for (int k = 0; k < 120; ++k) {
      line.points.emplace_back(0.5F + 0.05F * static_cast<float>(i),
                               -3.0F + 0.05F * static_cast<float>(k), 0.0F);
    }
    cloud.lines.push_back(line);
  }
  return cloud;
}

class TerrainNodeOnABus : public testing::Test {
 protected:
  TerrainNodeOnABus() {
    subscribe<terrain_t>(bus_, channels::kTerrain, Delivery::queued(100),
                         [this](const TerrainFragment& tile) {
                           if (tile.fragment == 0) ready_.push_back(tile.header.id);
                         });
    subscribe<cloud_request_t>(bus_, channels::kCloudRequest, Delivery::latest(),
                               [this](const CloudRequest& request) { last_request_ = request; });
    subscribe<terrain_ready_t>(bus_, channels::kTerrainReady, Delivery::queued(100),
                               [this](const TerrainReady& made) { published_.push_back(made); });
    bus_.advance_to(kUtime);
  }

  void send(std::int32_t id, std::string_view channel, const std::set<int>& lost = {}) {
    for (const CloudFragment& fragment : split(flat_ground(id))) {
      if (!lost.contains(fragment.fragment)) publish(bus_, channel, to_message(fragment));
    }
  }

  MemoryBus bus_;
  TerrainNode node_{bus_, TerrainParams{}};
  std::vector<std::int32_t> ready_;  // ids of the clouds
  std::vector<TerrainReady> published_;
  CloudRequest last_request_;
};

TEST_F(TerrainNodeOnABus, PublishesAMapOfEachCloud) {
  send(1, channels::kCloud);
  send(2, channels::kCloud);
  EXPECT_THAT(ready_, ElementsAre(1, 2));
}

TEST_F(TerrainNodeOnABus, ReportsAReadyMapRepeatedly) {
  EXPECT_THAT(published_, IsEmpty());
  send(1, channels::kCloud);
  const TerrainReady made{kUtime + 1, 1, true};
  EXPECT_THAT(published_, ElementsAre(made));
  bus_.advance_to(kUtime + kRequestPeriodUs);
  EXPECT_THAT(published_, ElementsAre(made, made));
}

TEST_F(TerrainNodeOnABus, RequestsNewerClouds) {
  EXPECT_EQ(last_request_.after_utime, 0);
  send(1, channels::kCloud);
  bus_.advance_to(kUtime + kRequestPeriodUs);
  EXPECT_EQ(last_request_.after_utime, kUtime + 1);
}

TEST_F(TerrainNodeOnABus, TakesMissingFragmentsFromAResentCloud) {
  ASSERT_GE(split(flat_ground(1)).size(), 3U);
  send(1, channels::kCloud, {0, 2});
  EXPECT_THAT(ready_, IsEmpty());
  send(1, channels::kCloudResend, {1});
  EXPECT_THAT(ready_, ElementsAre(1));
}

/// A scan of the near half only is completed by the far half of the scan before, unless that is in
/// another odom frame.
TEST_F(TerrainNodeOnABus, DiscardsTheMemoryOfAnotherOdomFrameWithoutAJump) {
  std::size_t observed = 0;
  TerrainReassembler maps;
  subscribe<terrain_t>(
      bus_, channels::kTerrain, Delivery::queued(100), [&](const TerrainFragment& tile) {
        const auto map = maps.add(tile);
        if (!map) return;
        observed = static_cast<std::size_t>(
            std::ranges::count(map->cells, Ground::kObserved, &TerrainCell::ground));
      });
  const auto match = [&](std::int64_t odom_epoch_utime) {
    ScanMatch last_match;
    last_match.utime = last_match.odom_epoch_utime = odom_epoch_utime;
    publish(bus_, channels::kScanMatch, to_message(last_match));
  };
  const auto scan = [&](std::int32_t id, std::size_t lines) {
    Cloud cloud = flat_ground(id);
    cloud.lines.resize(lines);
    for (const CloudFragment& fragment : split(cloud))
      publish(bus_, channels::kCloud, to_message(fragment));
    return observed;
  };
  match(kUtime);
  const std::size_t full_cloud = scan(1, 120);
  EXPECT_EQ(scan(2, 60), full_cloud);
  match(kUtime + 3);
  EXPECT_LT(scan(4, 60), full_cloud);
}

TEST_F(TerrainNodeOnABus, IgnoresResentOlderClouds) {
  send(1, channels::kCloud);
  send(2, channels::kCloud);
  send(1, channels::kCloudResend);
  send(2, channels::kCloudResend);
  EXPECT_THAT(ready_, ElementsAre(1, 2));
}

}  // namespace
}  // namespace adit
