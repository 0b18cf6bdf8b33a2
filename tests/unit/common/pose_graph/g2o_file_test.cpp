// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/g2o_file.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

class G2oFile : public testing::Test {
 protected:
  G2oGraph read(const std::string& text) {
    std::ofstream(folder_ / "g.g2o") << text;
    return read_g2o(folder_ / "g.g2o");
  }
  /// The error for a text.
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const G2oError& error) {
      return error.what();
    }
    return "none";
  }

  test::ScratchFolder folder_;
};

constexpr const char* kEdge = "EDGE_SE2 0 1 1 2 0.5 11 12 13 220 23 330\n";

TEST_F(G2oFile, ReadsTheG2oFormat) {
  const G2oGraph g =
      read(std::string("# a graph\n\nVERTEX_SE2 1 4 5 6\r\nVERTEX_SE2 0 1 2 3 # first\n"
                       "FIX 0\n") +
           kEdge);
  EXPECT_THAT(g.ids, ElementsAre(0, 1));
  EXPECT_EQ(g.graph.poses[1], (Pose2{4.0, 5.0, 6.0}));
  ASSERT_EQ(g.graph.constraints.size(), 1U);
  const PoseConstraint& c = g.graph.constraints.front();
  EXPECT_EQ(c.from, 0);
  EXPECT_EQ(c.to, 1);
  EXPECT_EQ(c.T_from_to, (Pose2{1.0, 2.0, 0.5}));
  Eigen::Matrix3d information;
  information << 11, 12, 13, 12, 220, 23, 13, 23, 330;
  EXPECT_EQ(c.information, information);
}

TEST_F(G2oFile, ReadsTheToroFormat) {
  const G2oGraph toro =
      read("VERTEX2 0 0 0 0\nVERTEX2 1 0 0 0\nEDGE2 0 1 1 2 0.5 11 12 220 330 13 23");
  const G2oGraph g2o = read(kEdge);
  EXPECT_EQ(toro.graph.constraints.front().information, g2o.graph.constraints.front().information);
}

TEST_F(G2oFile, ChainsOdometryWithoutVertices) {
  const G2oGraph g = read("EDGE_SE2 7 9 1 0 0.5 1 0 0 1 0 1\nEDGE_SE2 9 12 1 0 0 1 0 0 1 0 1\n");
  EXPECT_THAT(g.ids, ElementsAre(7, 9, 12));
  EXPECT_EQ(g.graph.poses[0], Pose2{});
  EXPECT_NEAR(g.graph.poses[2].y, std::sin(0.5), 1e-12);
}

TEST_F(G2oFile, ReadsBackWhatItWrote) {
  G2oGraph g = read(
      "VERTEX_SE2 -3 0.1 0.2 0.3\nVERTEX_SE2 5 1e-17 3.3333333333333335 -2\n"
      "EDGE_SE2 -3 5 0.1 1e300 0.7 1 0.1 0 1 0 1e-9\n");
  for (const char* name : {"copy.g2o", "copy.g2o.gz"}) {
    write_g2o(g, folder_ / name);
    const G2oGraph copy = read_g2o(folder_ / name);
    EXPECT_EQ(copy.ids, g.ids);
    EXPECT_EQ(copy.graph.poses, g.graph.poses);
    EXPECT_EQ(copy.graph.constraints.front().T_from_to, g.graph.constraints.front().T_from_to);
    EXPECT_EQ(copy.graph.constraints.front().information, g.graph.constraints.front().information);
  }
}

TEST_F(G2oFile, ReportsTheLineAndTheReason) {
  const std::string two = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\n";
  EXPECT_THAT(error_of(two + "EDGE_SE2 0 1 1 2 nan 1 0 0 1 0 1"), HasSubstr("g.g2o:3: 'nan'"));
  EXPECT_THAT(error_of(two + "EDGE_SE2 0 1 1 2 3 1 0 0 -1 0 1"), HasSubstr(":3: the information"));
  EXPECT_THAT(error_of(two + "EDGE_SE2 1 1 1 2 3 1 0 0 1 0 1"), EndsWith("from 1 to itself"));
  EXPECT_THAT(error_of(two + "EDGE_SE2 0 2 1 2 3 1 0 0 1 0 1"), EndsWith(":3: no vertex 2"));
  EXPECT_THAT(error_of(two + "EDGE_SE2 0 1 1 2 3 1 0 0 1 0"), HasSubstr(":3: the line ends"));
  EXPECT_THAT(error_of(two + "EDGE_SE2 0 1 1 2 3 1 0 0 1 0 1 7"), HasSubstr("'7' after"));
  EXPECT_THAT(error_of(two + "EDGE_SE3 0 1"), EndsWith(":3: unknown tag 'EDGE_SE3'"));
  EXPECT_THAT(error_of(two + "VERTEX_SE2 0 1 1 1"), EndsWith("vertex 0 is defined twice"));
  EXPECT_THAT(error_of(two + "FIX 1"), HasSubstr(":3: only the first pose"));
  EXPECT_THAT(error_of("VERTEX_SE2 0.5 0 0 0"), HasSubstr(":1: '0.5' is not a valid id"));
}

TEST_F(G2oFile, ThrowsForAMissingOrCorruptFile) {
  EXPECT_THROW(read_g2o(folder_ / "missing"), std::runtime_error);
  write_g2o(read(kEdge), folder_ / "complete.gz");
  const std::string complete = test::contents(folder_ / "complete.gz");
  std::ofstream(folder_ / "half.gz") << complete.substr(0, complete.size() / 2);
  EXPECT_THROW(read_g2o(folder_ / "half.gz"), std::runtime_error);
}

}  // namespace
}  // namespace adit
