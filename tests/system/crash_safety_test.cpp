// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Mapping is killed repeatedly without notice, and restarts from its journal.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/sensing.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "tests/support/scores/stored_map_score.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

constexpr std::int64_t kHour = 3'600'000'000;

/// A scan and its match.
struct MatchedScan {
  LaserScan scan;
  ScanMatch match;
};

/// Messages that a subscriber received from all mapping processes.
struct Received {
  std::vector<LocalMap> maps;
  std::vector<Association> associations;
  std::optional<MapGraph> graph;
};

/// One process of mapping; the destructor kills it.
class MappingProcess {
 public:
  MappingProcess(const std::filesystem::path& journal, Received& received, bool carried = false) {
    subscribe_all(received);
    MappingNodeParams params;
    params.carried = carried;
    params.journal = journal.string();
    node_ = std::make_unique<MappingNode>(bus_, params);
  }

  void add(const MatchedScan& matched) {
    bus_.inject(matched.scan.utime, channels::kLaserFront, encode(to_message(matched.scan)));
    bus_.inject(matched.scan.utime, channels::kScanMatch, encode(to_message(matched.match)));
  }

 private:
  void subscribe_all(Received& received) {
    subscribe<local_map_t>(bus_, channels::kLocalMap, Delivery::queued(100),
                           [&](const LocalMapFragment& fragment) {
                             if (auto map = maps_.add(fragment))
                               received.maps.push_back(std::move(*map));
                           });
    subscribe<association_t>(bus_, channels::kAssociation, Delivery::queued(100),
                             [&](const Association& a) { received.associations.push_back(a); });
    subscribe<pose_graph_t>(bus_, channels::kPoseGraph, Delivery::queued(100),
                            [&](const PoseGraphFragment& fragment) {
                              if (auto graph = graphs_.add(fragment))
                                received.graph = std::move(graph);
                            });
  }

  MemoryBus bus_;
  LocalMapReassembler maps_;
  PoseGraphReassembler graphs_;
  std::unique_ptr<MappingNode> node_;
};

/// A drive with loop closures through the sample mine.
class CrashSafety : public testing::TestWithParam<unsigned> {
 protected:
  static void SetUpTestSuite() {
    SampleRun run({.length_max_m = 300.0});
    ScanMatching matching(ScanMatchingParams{});
    while (const auto reading = run.next()) {
      matching.add(reading->odometry);
      ScanMatch match = matching.add_scan(LaserId::kFront, reading->scan);
      match.channel = channels::kLaserFront;
      drive_.push_back({reading->scan, std::move(match)});
    }
    truth_ = run.truth();
  }

  /// Runs the complete drive with kills at random times; scans until the next start are lost.
  /// `after_kill` is called with the journal closed.
  template <class AfterKill>
  void drive(AfterKill after_kill) {
    constexpr int kScansMin = 20;
    std::uniform_int_distribution<int> run_length(kScansMin, 500);
    std::uniform_int_distribution<int> outage_length(0, 20);
    for (std::size_t i = 0; i < drive_.size();
         i += static_cast<std::size_t>(outage_length(random_))) {
      MappingProcess mapping(journal_, received_);
      for (int k = run_length(random_); k > 0 && i < drive_.size(); --k) mapping.add(drive_[i++]);
      ++starts_;
      if (i < drive_.size()) after_kill();
    }
  }

  void expect_journal_matches_received() const {
    const StoredMap stored = read_map_journal(journal_);
    EXPECT_TRUE(stored.maps == received_.maps);
    EXPECT_TRUE(stored.associations == received_.associations);
  }

  void expect_consistent_map() const {
    const StoredMap stored = read_map_journal(journal_);
    const MapGraph graph = test::restore_graph(stored);
    EXPECT_LT(test::error_of(stored, graph, truth_).farthest_m, 0.5);
    EXPECT_GT(test::loop_closures_between_sessions(stored, graph), 0);
    for (std::size_t i = 0; i < stored.maps.size(); ++i) {
      EXPECT_EQ(stored.maps[i].id, static_cast<int>(i));
    }
  }

  /// Truncates a random number of bytes of the last record.
  void truncate_journal() {
    std::size_t last = 0;
    read_journal(journal_, [&](const JournalRecord& record) {
      last = journal_format::kHeaderBytes + record.kind.size() + record.bytes.size();
    });
    if (last == 0) return;
    const std::size_t bytes = std::uniform_int_distribution<std::size_t>(1, last)(random_);
    const std::uintmax_t size = std::filesystem::file_size(journal_) - bytes;
    std::filesystem::resize_file(journal_, size);
    std::filesystem::resize_file(journal_copy(journal_), size);
  }

  inline static std::vector<MatchedScan> drive_;
  inline static Trajectory truth_;

  test::ScratchFolder scratch_;
  std::filesystem::path journal_ = scratch_ / "map.journal";
  std::mt19937 random_{GetParam()};
  Received received_;
  int starts_ = 0;
};

TEST_P(CrashSafety, JournalContainsAllPublishedData) {
  drive([&] { expect_journal_matches_received(); });
  expect_journal_matches_received();
  EXPECT_GT(starts_, 3);
  expect_consistent_map();
}

TEST_P(CrashSafety, RestoresTheMap) {
  drive([&] {
    if (!received_.graph) return;
    const MapGraph graph = test::restore_graph(read_map_journal(journal_));
    ASSERT_EQ(graph.poses.size(), received_.graph->poses.size());
    EXPECT_EQ(graph.constraints.size(), received_.graph->constraints.size());
    double farthest_m = 0.0;
    for (std::size_t i = 0; i < graph.poses.size(); ++i) {
      const Pose2 error = between(received_.graph->poses[i], graph.poses[i]);
      farthest_m = std::max(farthest_m, error.translation().norm());
    }
    EXPECT_LT(farthest_m, 0.02);  // the map before the kill was linearized for the last constraints
  });
}

TEST_P(CrashSafety, LosesOnlyATornRecord) {
  drive([&] {
    truncate_journal();
    const StoredMap stored = read_map_journal(journal_);
    const std::size_t maps_lost = received_.maps.size() - stored.maps.size();
    const std::size_t associations_lost =
        received_.associations.size() - stored.associations.size();
    EXPECT_LE(maps_lost + associations_lost, 1U);
    received_.maps.resize(stored.maps.size());
    received_.associations.resize(stored.associations.size());
    expect_journal_matches_received();
  });
  expect_journal_matches_received();
  expect_consistent_map();
}

/// The same scan an hour later, in an odom frame that starts at `first`.
MatchedScan one_hour_later(const MatchedScan& matched, const MatchedScan& first) {
  MatchedScan later = matched;
  later.scan.utime += kHour;
  later.match.utime += kHour;
  later.match.reference_utime += kHour;
  later.match.T_odom_body = between(first.match.T_odom_body, matched.match.T_odom_body);
  if (matched.match.utime == first.match.utime) {
    later.match.status = ScanMatch::Status::kFirstScan;
    later.match.reference_utime = 0;
  }
  return later;
}

TEST_P(CrashSafety, LocalizesAfterAStartAtAnotherPlace) {
  drive([] {});
  constexpr std::size_t kScans = 250;  // 40 m
  const std::size_t from =
      std::uniform_int_distribution<std::size_t>(0, drive_.size() - kScans)(random_);
  {
    MappingProcess mapping(journal_, received_, true);
    for (std::size_t i = from; i < from + kScans; ++i)
      mapping.add(one_hour_later(drive_[i], drive_[from]));
  }
  const LocalMap& newest = received_.maps.back();
  ASSERT_GT(newest.utime, drive_.back().scan.utime);
  const Pose2 found = between(received_.graph->poses.front(), received_.graph->poses.back());
  const Pose2 truth = between(*interpolate(truth_, received_.maps.front().utime),
                              *interpolate(truth_, newest.utime - kHour));
  EXPECT_LT(between(truth, found).translation().norm(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Seed, CrashSafety, testing::Values(1U, 2U, 19U, 30U));

}  // namespace
}  // namespace adit
