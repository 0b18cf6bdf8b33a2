// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/merge/merge_run.hpp"

#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/files/file_utils.hpp"
#include "procs/mapping/map_journal.hpp"
#include "tests/support/drives/walked_map.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

using Path = std::vector<Eigen::Vector2d>;

const Path kFromPortal{{4, 0}, {35, 0}, {30, 18}, {36, 40}, {56, 50}};
const Path kToPortal{{56, 50}, {36, 40}, {30, 18}, {35, 0}, {8, 0}};

/// Writes the journal of a walk with default lasers, as `adit map` does.
std::filesystem::path write_run(const std::filesystem::path& folder, int mine, const Path& path,
                                std::uint64_t seed) {
  std::filesystem::create_directories(folder);
  const test::WalkedMap walk = test::walked_map(test::sample_mine(mine), path, {.seed = seed});
  MapJournal journal(folder / "map.journal");
  for (std::size_t i = 0; i < walk.map->local_maps().size(); ++i)
    journal.append(MapUpdate{walk.map->local_maps().load(i), {}, {}, true});
  return folder;
}

MergeResult merge(const MergeOptions& options) {
  return run_merge(options, [](const std::string&, double) {});
}

nlohmann::json summary_in(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_text_file(folder / "summary.json"));
}

TEST(Merge, JoinsRunsOfOneMineAndContinuesItsOwnMap) {
  const test::ScratchFolder scratch;
  const auto first = write_run(scratch / "first", 1, kFromPortal, 1);
  const auto second = write_run(scratch / "second", 1, kToPortal, 2);
  const MergeResult both = merge({.runs = {first, second}, .folder = scratch / "mine"});
  EXPECT_EQ(both.joined, 2U);
  EXPECT_GT(both.links, 5U);
  EXPECT_TRUE(both.is_global);
  EXPECT_TRUE(both.not_joined.empty());
  for (const char* name : {"map.png", "map.pgm", "map.yaml", "graph.g2o", "changes.png",
                           "changes.tsv", "map.journal", "summary.json"})
    EXPECT_TRUE(std::filesystem::is_regular_file(scratch / "mine" / name)) << name;
  EXPECT_GT(read_tum(scratch / "mine" / "trajectory_2.tum").size(), 100U);
  const auto summary = summary_in(scratch / "mine");
  EXPECT_EQ(summary.at("maps").at(0).at("joins").at(0).at("link_list").size(), both.links);

  const auto third = write_run(scratch / "third", 1, kFromPortal, 3);
  const MergeResult all = merge({.runs = {scratch / "mine", third}, .folder = scratch / "mine"});
  EXPECT_EQ(all.joined, 2U);
  EXPECT_GT(all.local_maps, both.local_maps);
}

TEST(Merge, SaysWhichRunIsOfAnotherMine) {
  const test::ScratchFolder scratch;
  const auto other = write_run(scratch / "other", 7, {{4, 0}, {35, 0}, {48, -4}, {70, -5}}, 4);
  const auto first = write_run(scratch / "first", 1, kFromPortal, 1);
  const auto second = write_run(scratch / "second", 1, kToPortal, 2);
  const MergeResult result = merge({.runs = {other, first, second}, .folder = scratch / "mine"});
  EXPECT_EQ(result.joined, 2U);
  ASSERT_EQ(result.not_joined.size(), 1U);
  EXPECT_NE(result.not_joined[0].find("other is not joined"), std::string::npos)
      << result.not_joined[0];
  EXPECT_EQ(summary_in(scratch / "mine").at("runs").at(0).at("map"), 2);
}

TEST(Merge, WritesNothingForAnUnusableRun) {
  const test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "empty");
  EXPECT_THROW(merge({.runs = {scratch / "empty"}, .folder = scratch / "mine"}),
               std::runtime_error);
  EXPECT_THROW(merge({.runs = {scratch / "missing"}, .folder = scratch / "mine"}),
               std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(scratch / "mine"));
}

}  // namespace
}  // namespace adit
