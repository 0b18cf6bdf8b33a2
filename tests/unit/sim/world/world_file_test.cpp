// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/world_file.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config/config.hpp"
#include "sim/world/build_world.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(const std::string& name) {
  try {
    find_world(name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
  return path.string();
}

TEST(WorldFile, SevenWorldsAreBuiltIn) {
  EXPECT_THAT(built_in_worlds(), ElementsAre("bruceton", "florence", "grid", "mathies", "parallel",
                                             "sample", "straight"));
  for (const std::string& name : built_in_worlds()) EXPECT_EQ(find_world(name).name, name);
}

TEST(WorldFile, WrittenLoadsAgainUnchanged) {
  const test::ScratchFolder folder;
  std::vector<std::string> names = built_in_worlds();
  names.emplace_back("random");
  names.emplace_back("random_level");
  names.emplace_back("two_levels");
  for (const std::string& name : names) {
    const std::string text = to_world_file(find_world(name));
    const std::string path = write(folder / "again.yaml", text);
    EXPECT_EQ(to_world_file(find_world(path)), text) << name;
  }
}

TEST(WorldFile, ASeedReplacesThatOfTheFile) {
  EXPECT_EQ(find_world("mathies").seed, 1877);
  EXPECT_EQ(find_world("mathies", 5).seed, 5);
  EXPECT_NE(to_world_file(find_world("random", 5)), to_world_file(find_world("random", 6)));
}

TEST(WorldFile, RefersToAMeshBesideIt) {
  const test::ScratchFolder folder;
  const std::string path =
      write(folder / "own.yaml", "world:\n  mesh: {file: tunnel.obj, scale: 0.01}\n");
  const WorldDescription description = find_world(path);
  EXPECT_EQ(description.mesh.file, (folder / "tunnel.obj").string());
  EXPECT_EQ(description.name, "own");
}

TEST(WorldFile, AMeshFileIsAWorld) {
  const test::ScratchFolder folder;
  const std::string path = write(folder / "cave.obj", "v 0 0 0\n");
  const WorldDescription description = find_world(path);
  EXPECT_EQ(description.mesh.file, path);
  EXPECT_EQ(description.name, "cave");
}

TEST(WorldFile, AnUnknownNameIsRejectedWithTheKnownNames) {
  EXPECT_THAT(
      error_of("mathis"),
      AllOf(HasSubstr("no world 'mathis'"), HasSubstr("did you mean 'mathies'?"),
            HasSubstr("bruceton, florence, grid, mathies, parallel, sample, straight, random")));
  EXPECT_THAT(error_of("/nowhere/x.yaml"), HasSubstr("no world '/nowhere/x.yaml'"));
}

TEST(WorldFile, AnInvalidFileIsRejectedWithItsLine) {
  const test::ScratchFolder folder;
  const auto with = [&](const std::string& text) {
    return error_of(write(folder / "bad.yaml", text));
  };
  EXPECT_THAT(with("world:\n  nmae: x\n"), AllOf(HasSubstr("bad.yaml:2"), HasSubstr("'name'")));
  EXPECT_THAT(with("wrld:\n  name: x\n"), HasSubstr("bad.yaml:1"));
  EXPECT_THAT(with("{}\n"), HasSubstr("there is no section 'world'"));
}

}  // namespace
}  // namespace adit
