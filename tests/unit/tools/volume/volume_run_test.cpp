// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/volume/volume_run.hpp"

#include <filesystem>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

class VolumeRun : public testing::Test {
 protected:
  void write(std::string_view channel, const std::vector<std::uint8_t>& bytes) {
    log_.write({kUtime + events_++, std::string(channel), bytes});
  }
  void write_cloud(double x) {
    Cloud cloud = test::sweep_of_tunnel({x, 0.0, 0.0}, 20);
    cloud.utime = kUtime + events_;
    for (const CloudFragment& fragment : split(cloud)) {
      write(channels::kCloud, encode(to_message(fragment)));
    }
  }
  void write_graph() {
    for (const PoseGraphFragment& fragment : split(MapGraph{kUtime, 1, {{}}, {}})) {
      write(channels::kPoseGraph, encode(to_message(fragment)));
    }
    write(channels::kMapCorrection, encode(to_message(MapCorrection{kUtime, 1, 0, 0, {}, {}})));
  }
  VolumeRunResult run(const std::string& out) {
    if (!closed_) log_.close();
    closed_ = true;
    return run_volume({folder_ / "run.lcmlog", folder_ / out, {}});
  }

  test::ScratchFolder folder_;
  LogWriter log_{folder_ / "run.lcmlog"};
  int events_ = 0;
  bool closed_ = false;
};

TEST_F(VolumeRun, WritesThreeFiles) {
  write_graph();
  write_cloud(0.0);
  write_cloud(12.0);
  const VolumeRunResult result = run("out");
  EXPECT_EQ(result.scans, 2);
  EXPECT_EQ(result.volumes, 2U);
  EXPECT_THAT(result.warnings, IsEmpty());
  EXPECT_GT(fs::file_size(folder_ / "out" / "volume.bt"), 1000U);
  EXPECT_GT(fs::file_size(folder_ / "out" / "volume.ot"), 1000U);
  EXPECT_GT(fs::file_size(folder_ / "out" / "cloud.ply"), 16 * result.points);
}

TEST_F(VolumeRun, IsReproducible) {
  write_graph();
  write_cloud(0.0);
  run("first");
  run("second");
  for (const char* file : {"volume.bt", "volume.ot", "cloud.ply"}) {
    EXPECT_TRUE(test::contents(folder_ / "first" / file) ==
                test::contents(folder_ / "second" / file))
        << file;
  }
}

TEST_F(VolumeRun, WarnsOfAMissingPoseGraph) {
  write_cloud(0.0);
  EXPECT_THAT(run("out").warnings, ElementsAre(HasSubstr("no pose graph")));
}

TEST_F(VolumeRun, RejectsALogWithoutScans) {
  write_graph();
  EXPECT_THROW(run("out"), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace adit
