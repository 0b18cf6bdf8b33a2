// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/lcm_spy.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// An installation tree with the programs and jars that a test requests.
class SpyTest : public testing::Test {
 protected:
  SpyTest() {
    fs::create_directories(root_ / "bin");
    fs::create_directories(root_ / "share/java");
    fs::create_directories(root_ / "tools");
  }

  void install(const std::string& path) const {
    std::ofstream(root_ / path) << "#!/bin/sh\n";
    fs::permissions(root_ / path, fs::perms::owner_all);
  }

  [[nodiscard]] SpyCommand command(const std::optional<fs::path>& log = {}) const {
    return lcm_spy_command(root_ / "bin", (root_ / "tools").string(), log);
  }

  [[nodiscard]] std::string error_text(const std::optional<fs::path>& log = {}) const {
    try {
      (void)command(log);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  test::ScratchFolder folder_;
  fs::path root_ = folder_.path();
};

TEST_F(SpyTest, AddsJarsOfThisProjectToTheClassPath) {
  for (const char* file : {"tools/lcm-spy", "tools/java", "share/java/lcmtypes_adit.jar",
                           "share/java/lcmspy_plugins_adit.jar", "share/java/other.jar"}) {
    install(file);
  }
  const SpyCommand spy = command();
  EXPECT_THAT(spy.arguments, ElementsAre((root_ / "tools/lcm-spy").string()));
  EXPECT_EQ(spy.environment.at("CLASSPATH"),
            (root_ / "share/java/lcmspy_plugins_adit.jar").string() + ":" +
                (root_ / "share/java/lcmtypes_adit.jar").string());
  EXPECT_THAT(spy.environment.at("JAVA_TOOL_OPTIONS"),
              HasSubstr("-XX:+IgnoreUnrecognizedVMOptions"));
}

TEST_F(SpyTest, OpensALogInTheGraphicalPlayer) {
  for (const char* file :
       {"tools/lcm-logplayer-gui", "tools/java", "share/java/lcmtypes_adit.jar", "run.lcmlog"}) {
    install(file);
  }
  EXPECT_THAT(
      command(root_ / "run.lcmlog").arguments,
      ElementsAre((root_ / "tools/lcm-logplayer-gui").string(), (root_ / "run.lcmlog").string()));
}

TEST_F(SpyTest, ReportsMissingPackages) {
  EXPECT_THAT(error_text(), HasSubstr("lcm-spy is missing, try: sudo apt install liblcm-bin"));
  install("tools/lcm-spy");
  EXPECT_THAT(error_text(), HasSubstr("java is missing, try: sudo apt install default-jre"));
  install("tools/java");
  EXPECT_THAT(error_text(),
              HasSubstr("has no lcmtypes_adit.jar, try: sudo apt install default-jdk"));
}

TEST_F(SpyTest, ReportsAMissingLog) {
  EXPECT_THAT(error_text(root_ / "run.lcmlog"), HasSubstr("run.lcmlog: No such file"));
}

}  // namespace
}  // namespace adit
