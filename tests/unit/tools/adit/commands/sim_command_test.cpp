// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Worlds from user files: a valid world, or a one-line error and exit code 2.
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/adit/command_result.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Floor and roof around the origin, without walls [m].
constexpr const char* kOpen =
    "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nv -9 -9 2\nv 9 -9 2\nv 9 9 2\nv -9 9 2\n"
    "f 1 2 3 4\nf 5 6 7 8\n";

class SimCommand : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// Writes the ground truth, which builds the complete world.
  [[nodiscard]] CommandResult write_truth(const std::string& world) const {
    return adit({"sim", world, "--truth", folder_ / "truth"});
  }

  void expect_error(const std::string& world, const std::string& text) const {
    const CommandResult outcome = write_truth(world);
    EXPECT_EQ(outcome.exit_code, 2) << world;
    EXPECT_THAT(outcome.err, StartsWith("adit: "));
    EXPECT_THAT(outcome.err, HasSubstr(text)) << world;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  }

  test::ScratchFolder folder_;
};

TEST_F(SimCommand, AcceptsMeshesWithHolesAndDegenerateTriangles) {
  EXPECT_EQ(write_truth(write("open.obj", kOpen)).exit_code, 0);
  const std::string odd = "v nan 0 1\nv 5 5 1\nf 1 1 2\nf 9 1 2\nf 10 10 10\n";
  EXPECT_EQ(write_truth(write("odd.obj", kOpen + odd)).exit_code, 0);
  EXPECT_EQ(write_truth(write("one.obj", "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n")).exit_code, 0);
}

TEST_F(SimCommand, RejectsInvalidMeshesInOneLine) {
  expect_error(folder_ / "none.obj", "none.obj");
  std::filesystem::create_directory(folder_ / "folder.obj");
  expect_error(folder_ / "folder.obj", "folder.obj");
  expect_error(write("empty.obj", ""), "is empty");
  expect_error(write("photo.obj", std::string("\xff\xd8\xff\xe0\0\x10JFIF\0", 11)), "photo.obj");
  expect_error(write("wrong.dae", "<?xml version=\"1.0\"?><COLLADA><a></COLLADA>"), "wrong.dae");
  expect_error(write("flat.obj", "v 0 0 0\nv 9 0 0\nf 1 2 1\n"), "flat.obj");
  expect_error(write("many.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n"),
               "announces");
}

TEST_F(SimCommand, RejectsAMeshInMillimetres) {
  const std::string text = "v -90000 -90000 0\nv 90000 -90000 0\nv 90000 90000 0\nf 1 2 3\n";
  expect_error(write("mm.obj", text), "scale");
}

TEST_F(SimCommand, RejectsOversizedWorldFilesInOneLine) {
  expect_error(write("long.yaml",
                     "world:\n  plan:\n    tunnels:\n"
                     "      - {name: main, points_m: [0, 0, 1e9, 0]}\n"),
               "is the most");
  expect_error(write("fine.yaml",
                     "world:\n  grid_m: 0.05\n  plan:\n    tunnels:\n"
                     "      - {name: main, points_m: [0, 0, 4900, 490]}\n"),
               "grid_m");
  expect_error(write("text.yaml", "world: [1, 2\n"), "text.yaml");
}

}  // namespace
}  // namespace adit
