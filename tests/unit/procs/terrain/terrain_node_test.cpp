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
#include "common/bus/typed.hpp"
#include "common/messages/cloud_request.hpp"
#include "common/messages/scan_match.hpp"
#include "common/messages/terrain_made.hpp"
#include "common/messages/terrain_tiles.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr std::int64_t kAskPeriodUs = 2'000'000;

/// Flat ground that is as many lines as several pieces take.
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
                         [this](const TerrainTile& tile) {
                           if (tile.piece == 0) made_.push_back(tile.part.id);
                         });
    subscribe<cloud_request_t>(bus_, channels::kCloudRequest, Delivery::latest(),
                               [this](const CloudRequest& request) { asked_ = request; });
    subscribe<terrain_made_t>(bus_, channels::kTerrainMade, Delivery::queued(100),
                              [this](const TerrainMade& made) { told_.push_back(made); });
    bus_.advance_to(kUtime);
  }

  void send(std::int32_t id, std::string_view channel, const std::set<int>& lost = {}) {
    for (const CloudPiece& piece : divide(flat_ground(id))) {
      if (!lost.contains(piece.piece)) publish(bus_, channel, to_message(piece));
    }
  }

  MemoryBus bus_;
  TerrainNode node_{bus_, TerrainParams{}};
  std::vector<std::int32_t> made_;  // ids of clouds
  std::vector<TerrainMade> told_;
  CloudRequest asked_;
};

TEST_F(TerrainNodeOnABus, MakesOneOfEachCloud) {
  send(1, channels::kCloud);
  send(2, channels::kCloud);
  EXPECT_THAT(made_, ElementsAre(1, 2));
}

TEST_F(TerrainNodeOnABus, SaysThatThereIsOneAndSaysItAgain) {
  EXPECT_THAT(told_, IsEmpty());
  send(1, channels::kCloud);
  const TerrainMade made{kUtime + 1, 1, true};
  EXPECT_THAT(told_, ElementsAre(made));
  bus_.advance_to(kUtime + kAskPeriodUs);
  EXPECT_THAT(told_, ElementsAre(made, made));
}

TEST_F(TerrainNodeOnABus, AsksForWhatIsNewerThanWhatItHas) {
  EXPECT_EQ(asked_.after_utime, 0);
  send(1, channels::kCloud);
  bus_.advance_to(kUtime + kAskPeriodUs);
  EXPECT_EQ(asked_.asked_by, "terrain");
  EXPECT_EQ(asked_.after_utime, kUtime + 1);
}

TEST_F(TerrainNodeOnABus, TakesThePiecesThatItLacksFromARepetition) {
  ASSERT_GE(divide(flat_ground(1)).size(), 3U);
  send(1, channels::kCloud, {0, 2});
  EXPECT_THAT(made_, IsEmpty());
  send(1, channels::kCloudAgain, {1});
  EXPECT_THAT(made_, ElementsAre(1));
}

/// A look that sees the near half alone has the far half from the one before, but not where that is
/// in another odom.
TEST_F(TerrainNodeOnABus, RemembersNothingOfAnOdomThatBeganAnewWithoutAJump) {
  std::size_t seen = 0;
  TerrainAssembler maps;
  subscribe<terrain_t>(bus_, channels::kTerrain, Delivery::queued(100),
                       [&](const TerrainTile& tile) {
                         const auto map = maps.add(tile);
                         if (!map) return;
                         seen = static_cast<std::size_t>(
                             std::ranges::count(map->cells, Ground::kSeen, &TerrainCell::ground));
                       });
  const auto match = [&](std::int64_t odom_utime) {
    ScanMatch said;
    said.utime = said.odom_utime = odom_utime;
    publish(bus_, channels::kScanMatch, to_message(said));
  };
  const auto look = [&](std::int32_t id, std::size_t lines) {
    Cloud cloud = flat_ground(id);
    cloud.lines.resize(lines);
    for (const CloudPiece& piece : divide(cloud))
      publish(bus_, channels::kCloud, to_message(piece));
    return seen;
  };
  match(kUtime);
  const std::size_t whole = look(1, 120);
  EXPECT_EQ(look(2, 60), whole);
  match(kUtime + 3);
  EXPECT_LT(look(4, 60), whole);
}

TEST_F(TerrainNodeOnABus, LeavesRepetitionsForOthersAlone) {
  send(1, channels::kCloud);
  send(2, channels::kCloud);
  send(1, channels::kCloudAgain);
  send(2, channels::kCloudAgain);
  EXPECT_THAT(made_, ElementsAre(1, 2));
}

}  // namespace
}  // namespace adit
