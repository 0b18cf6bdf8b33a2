// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/mapping_node.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/sensing.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/message_fields.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

/// The stage on a drive through the sample mine, with a subscriber.
class MappingNodeOnABus : public testing::Test {
 protected:
  MappingNodeOnABus() { begin(); }

  void begin() {
    node_.reset();
    bus_ = std::make_unique<MemoryBus>();
    received_.clear();
    graph_.reset();
    correction_.reset();
    subscribe<local_map_t>(*bus_, channels::kLocalMap, Delivery::queued(1000),
                           [this](const LocalMapFragment& fragment) {
                             if (fragment.fragment == 0) received_.push_back(fragment.part.id);
                           });
    subscribe<pose_graph_t>(*bus_, channels::kPoseGraph, Delivery::queued(1000),
                            [this](const PoseGraphFragment& fragment) {
                              if (auto graph = graphs_.add(fragment)) graph_ = std::move(graph);
                            });
    subscribe<map_correction_t>(*bus_, channels::kMapCorrection, Delivery::latest(),
                                [this](const MapCorrection& c) { correction_ = c; });
    subscribe<map_contradictions_t>(*bus_, channels::kContradictions, Delivery::queued(100),
                                    [this](MapContradictions contradictions) {
                                      contradictions_.push_back(std::move(contradictions));
                                    });
    MappingNodeParams params;
    params.journal = (scratch_ / "map.journal").string();
    node_ = std::make_unique<MappingNode>(*bus_, params);
  }

  void drive(int scans) {
    for (int i = 0; i < scans; ++i) add_match(next_match());
  }

  /// Sends the next scan, and returns the message of its match.
  const std::vector<std::uint8_t>& next_match() {
    const auto reading = run_.next();
    matching_.add(reading->odometry);
    ScanMatch match = matching_.add_scan(LaserId::kFront, reading->scan);
    match.channel = channels::kLaserFront;
    scan_ = encode(to_message(reading->scan));
    utime_ = reading->scan.utime;
    send_scan();
    return match_ = encode(to_message(match));
  }

  void send_scan() { bus_->inject(utime_, channels::kLaserFront, scan_); }
  [[nodiscard]] const std::vector<std::uint8_t>& last_match() const { return match_; }

  void add_match(const std::vector<std::uint8_t>& message) {
    bus_->inject(utime_, channels::kScanMatch, message);
  }

  test::ScratchFolder scratch_;
  SampleRun run_{{.length_max_m = 300.0}};
  ScanMatching matching_{ScanMatchingParams{}};
  std::unique_ptr<MemoryBus> bus_;
  std::unique_ptr<MappingNode> node_;
  PoseGraphReassembler graphs_;
  std::vector<int> received_;
  std::optional<MapGraph> graph_;
  std::optional<MapCorrection> correction_;
  std::vector<MapContradictions> contradictions_;
  std::vector<std::uint8_t> scan_;
  std::vector<std::uint8_t> match_;
  std::int64_t utime_ = 0;
};

/// Once at the beginning, so that those of an earlier process do not stay.
TEST_F(MappingNodeOnABus, SaysThatARightMapDoesNotContradictItself) {
  drive(400);
  bus_->advance_to(utime_);
  ASSERT_EQ(contradictions_.size(), 1U);
  EXPECT_TRUE(contradictions_.front().pairs.empty());
}

TEST_F(MappingNodeOnABus, ResendsItsMapOnRequestInSmallBatches) {
  drive(400);
  const std::size_t maps = node_->map().local_maps().size();
  ASSERT_GT(maps, 5U);
  received_.clear();
  graph_.reset();
  for (const char* stage : {"exploration", "volume_map"}) {
    publish(*bus_, channels::kMapRequest, to_message(MapRequest{utime_, stage}));
  }
  bus_->advance_to(utime_ + 60'000);
  EXPECT_LE(received_.size(), 8U);  // at most two ticks of four fragments
  ASSERT_TRUE(graph_);
  EXPECT_EQ(graph_->poses.size(), maps);
  bus_->advance_to(utime_ + 10 * kSecond);
  EXPECT_EQ(received_.size(), maps);
  EXPECT_EQ(std::set<int>(received_.begin(), received_.end()).size(), maps);
}

TEST_F(MappingNodeOnABus, PublishesTheCorrectionAsSoonAsOdomIsKnown) {
  drive(200);
  const MapCorrection before = *correction_;
  begin();
  bus_->advance_to(utime_ + 1);
  EXPECT_TRUE(graph_);
  EXPECT_FALSE(correction_);  // odom may have been reset
  drive(1);
  ASSERT_TRUE(correction_);
  const Pose2 off = between(before.T_map_odom, correction_->T_map_odom);
  EXPECT_LT(off.translation().norm(), 0.05);
  EXPECT_LT(std::abs(off.theta), 0.01);
}

/// What the disk does not take, in the middle of a local map too, is stored later: no gap remains.
TEST_F(MappingNodeOnABus, StoresItsMapOnceTheDiskHasRoom) {
  const auto path = scratch_ / "map.journal";
  drive(200);
  const std::size_t before = node_->map().local_maps().size();
  EXPECT_EQ(node_->health(), Health{});
  {
    const test::FileSizeLimit full(std::filesystem::file_size(path) + 40'000);
    drive(150);
    EXPECT_EQ(node_->health().level, Health::Level::kFault);
    EXPECT_TRUE(is_about_journal(node_->health().reason)) << node_->health().reason;
  }
  EXPECT_GT(node_->map().local_maps().size(), before + 1);
  drive(100);
  EXPECT_EQ(node_->health(), Health{});
  const StoredMap stored = read_map_journal(path);
  EXPECT_FALSE(stored.losses.has_gap());
  EXPECT_TRUE(stored.maps == node_->map().local_maps().load_all());  // too long to print
}

TEST_F(MappingNodeOnABus, PublishesNoCorrectionBeforeTheFirstMapInNewOdom) {
  drive(200);
  begin();
  matching_ = ScanMatching(ScanMatchingParams{});
  drive(1);
  EXPECT_FALSE(correction_);
  drive(10);
  ASSERT_TRUE(correction_);
  EXPECT_EQ(correction_->session, 1);
  EXPECT_TRUE(correction_->covariance);
}

/// Before each true match comes one with an extreme value in one field, of a scan of its own.
TEST_F(MappingNodeOnABus, MapsAfterExtremesInEveryFieldOfAMatch) {
  drive(100);
  const FieldLayout layout = field_layout<scan_match_t>(next_match());
  int sent = 0;
  for (const FieldPlace& place : layout.places()) {
    if (place.name.ends_with("utime") || place.kind == FieldPlace::Kind::kText) continue;
    for (const std::uint64_t bits : extreme_bits(place)) {
      for (const auto status : {scan_match_t::STATUS_MATCHED, scan_match_t::STATUS_LOST}) {
        std::vector<std::uint8_t> match = last_match();
        if (place.offset + place.bytes > match.size()) continue;  // no longer degenerate
        write_bits(layout.places()[4], static_cast<std::uint64_t>(status), match);
        write_bits(place, bits, match);
        send_scan();
        ASSERT_NO_THROW(add_match(match)) << place.name << ", " << number_of(place, bits);
        ++sent;
      }
    }
    ASSERT_NO_THROW(drive(1)) << place.name;
  }
  EXPECT_GT(sent, 500);
  const std::size_t maps = node_->map().local_maps().size();
  drive(200);
  EXPECT_GT(node_->map().local_maps().size(), maps + 2);
}

}  // namespace
}  // namespace adit
