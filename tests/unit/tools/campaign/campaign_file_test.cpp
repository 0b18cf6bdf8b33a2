// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// From the text of a campaign file to the units of a plan.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config/config_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/definition/campaign_plan.hpp"
#include "tools/campaign/definition/parameter_matrix.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::ThrowsMessage;

std::vector<std::string> parameters(const std::string& text, const fs::path& folder = "/") {
  std::vector<std::string> all;
  for (const UnitParameters& unit : expand_matrix(ConfigFile::parse(text, "c.yaml"), folder))
    all.push_back(unit.json());
  return all;
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

CampaignPlan plan_of(const std::string& text, const fs::path& folder) {
  const ConfigFile file = ConfigFile::parse(text, "c.yaml");
  return make_plan(load_campaign(file), expand_matrix(file, folder), "c.yaml", folder, folder);
}

std::string message_of(const std::string& text, const fs::path& folder = "/") {
  try {
    plan_of(text, folder);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ParameterMatrix, IsTheProductOfAllValues) {
  EXPECT_THAT(parameters("matrix:\n  width_m: [1.3, 2]\n  shape: [bent, '7']\n"),
              ElementsAre(R"({"shape":"bent","width_m":1.3})", R"({"shape":"7","width_m":1.3})",
                          R"({"shape":"bent","width_m":2})", R"({"shape":"7","width_m":2})"));
}

TEST(ParameterMatrix, HasRangesWithoutRoundingErrors) {
  EXPECT_THAT(parameters("matrix: {x: {from: 1.3, to: 1.6, step: 0.1}}"),
              ElementsAre(R"({"x":1.3})", R"({"x":1.4})", R"({"x":1.5})", R"({"x":1.6})"));
  EXPECT_THAT(parameters("matrix: {seed: {from: 9, to: 11}}"),
              ElementsAre(R"({"seed":9})", R"({"seed":10})", R"({"seed":11})"));
}

TEST(ParameterMatrix, ExcludesAndIncludes) {
  EXPECT_THAT(parameters("matrix:\n  a: [1, 2]\n  b: [3, 4]\n  exclude: [{a: 1, b: 4}, {a: 2}]\n"
                         "  include: [{a: 7, b: 8}]\n"),
              ElementsAre(R"({"a":1,"b":3})", R"({"a":7,"b":8})"));
  EXPECT_THAT(parameters("matrix:\n  include: [{a: 7}]\n"), ElementsAre(R"({"a":7})"));
}

TEST(ParameterMatrix, HasTheFilesOfAPattern) {
  const test::ScratchFolder folder;
  write(folder / "b.log", "2");
  write(folder / "a.log", "1");
  EXPECT_THAT(parameters("matrix: {log: {files: '*.log'}}", folder.path()),
              ElementsAre(R"({"log":"a.log"})", R"({"log":"b.log"})"));
  EXPECT_THAT([&] { parameters("matrix: {log: {files: '*.bag'}}", folder.path()); },
              ThrowsMessage<ConfigError>("c.yaml:1: no file matches '*.bag'"));
}

TEST(ParameterMatrix, ReportsTheLineOfAnError) {
  const auto message = [](const std::string& text) {
    try {
      parameters(text);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message("matrix:\n  a: {from: 1}\n"),
            "c.yaml:2: matrix.a needs numbers from, to and optionally step, or files");
  EXPECT_EQ(message("matrix:\n  a: {from: 3, to: 1}\n"), "c.yaml:2: matrix.a has no values");
  EXPECT_THAT(message("matrix:\n  a: {from: 1, to: 2, setp: 1}\n"),
              HasSubstr("did you mean 'step'"));
  EXPECT_EQ(message("matrix:\n  a: {from: 1, to: 1e9}\n"),
            "c.yaml:2: matrix has more than 1000000 units");
  EXPECT_THAT(message("matrix:\n  Out: [1]\n"), HasSubstr("is not a name"));
}

TEST(CampaignPlan, ExpandsTheCommandWordByWord) {
  const test::ScratchFolder folder;
  const CampaignPlan plan = plan_of(
      "campaign: {command: \"N=1 sh -c 'echo {{x}} $0' {name} {out}/y\"}\nmatrix: {name: ['a "
      "b']}\n",
      folder.path());
  ASSERT_THAT(plan.units, SizeIs(1));
  const CampaignUnit& unit = plan.units.front();
  EXPECT_THAT(unit.environment, ElementsAre(std::pair<std::string, std::string>("N", "1")));
  EXPECT_THAT(with_output(unit.arguments, "/o"),
              ElementsAre(testing::EndsWith("/sh"), "-c", "echo {x} $0", "a b", "/o/y"));
  EXPECT_THAT(shell_line(plan, unit, "o"), HasSubstr("sh -c 'echo {x} $0' 'a b' o/y"));
  EXPECT_THAT(shell_line(plan, unit, "o"), HasSubstr(" && mkdir -p o && N=1 "));
  EXPECT_THAT(shell_line(plan, unit, "o"), HasSubstr(" && mkdir -p o && N=1 "));
}

TEST(CampaignPlan, KnowsUnitsByTheContentOfCommandInputsAndProgram) {
  const test::ScratchFolder folder;
  write(folder / "tool", "#!/bin/sh\n");
  fs::permissions(folder / "tool", fs::perms::owner_all);
  write(folder / "world.yaml", "1");
  const std::string text =
      "campaign:\n  command: ./tool {seed}\n  inputs: world.yaml\n  time_max_s: 5\n"
      "matrix: {seed: [1, 2]}\n";
  const auto ids = [&](const std::string& campaign) {
    const CampaignPlan plan = plan_of(campaign, folder.path());
    return std::vector<std::string>{plan.units[0].id, plan.units[1].id};
  };
  const std::vector<std::string> first = ids(text);
  EXPECT_NE(first[0], first[1]);
  EXPECT_EQ(first[0].size(), 16U);
  EXPECT_EQ(ids(text), first);
  std::string other = text;
  EXPECT_EQ(ids(other.replace(other.find("max_s: 5"), 8, "max_s: 9")), first);  // a limit
  write(folder / "world.yaml", "2");
  const std::vector<std::string> changed_input = ids(text);
  EXPECT_NE(changed_input[0], first[0]);
  write(folder / "tool", "#!/bin/sh\n:\n");
  EXPECT_NE(ids(text)[0], changed_input[0]);
}

TEST(CampaignPlan, ReadsBackTheUnitThatATaskRuns) {
  const test::ScratchFolder folder;
  const CampaignPlan plan = plan_of(
      "campaign: {command: 'A=b sh {n}', remove: '*.log x', exit_codes: [0, 1]}\n"
      "matrix: {n: [1, 2]}\n",
      folder.path());
  write_plan(plan, folder / "plan.jsonl");
  const CampaignPlan read = read_plan(folder / "plan.jsonl", plan.units[1].id);
  EXPECT_EQ(read.folder, plan.folder);
  EXPECT_THAT(read.remove, ElementsAre("*.log", "x"));
  EXPECT_THAT(read.exit_codes, ElementsAre(0, 1));
  ASSERT_THAT(read.units, SizeIs(1));
  EXPECT_EQ(read.units[0].arguments, plan.units[1].arguments);
  EXPECT_EQ(read.units[0].environment, plan.units[1].environment);
  EXPECT_EQ(read.units[0].parameters, R"({"n":2})");
  EXPECT_THROW(read_plan(folder / "plan.jsonl", "0123456789abcdef"), std::runtime_error);
}

/// A campaign may stop after the first n units, which must be a sample of all of them.
TEST(CampaignPlan, ShufflesUnitsIfARateMayStopTheCampaign) {
  const std::string text =
      "campaign:\n  command: sh {n}\n  rates: [{name: r, condition: 1, stop_width: 0.1}]\n"
      "matrix: {n: {from: 1, to: 100}}\n";
  const CampaignPlan plan = plan_of(text, "/");
  int in_order = 0;
  for (std::size_t i = 1; i < plan.units.size(); ++i)
    in_order += plan.units[i - 1].parameters < plan.units[i].parameters;
  EXPECT_GT(in_order, 30);  // of 99; 50 expected
  EXPECT_LT(in_order, 70);
  EXPECT_EQ(plan.units[0].number, 1);
  EXPECT_EQ(plan_of(text, "/").units[0].id, plan.units[0].id);
}

TEST(CampaignPlan, ReportsWhatCannotRun) {
  EXPECT_EQ(message_of("campaign: {command: no_such_program_x}"),
            "c.yaml: campaign.command has no program 'no_such_program_x'");
  EXPECT_EQ(message_of("campaign: {command: 'sh {seed}'}"),
            "c.yaml: campaign.command has the placeholder 'seed' that is no parameter of "
            "{}");
  EXPECT_EQ(message_of("campaign: {command: sh, inputs: no/file}"),
            "c.yaml: campaign.inputs has /no/file: cannot be read");
  EXPECT_EQ(message_of("campaign: {command: sh}\nmatrix: {n: [1, 2]}"),
            R"(c.yaml: the units {"n":1} and {"n":2} are the same command)");
  EXPECT_EQ(message_of("campaign: {name: x}"), "c.yaml:1: campaign.command is missing");
  EXPECT_THAT(message_of("campaign:\n  command: sh\n  scores: [{name: a, file: b}]"),
              HasSubstr("campaign.scores[0] needs either a pointer (JSON) or a column (CSV)"));
  EXPECT_THAT(message_of("campaign:\n  command: sh\n  scores: [{name: a, file: b, pointer: x}]"),
              HasSubstr("campaign.scores[0].pointer is 'x', not as in /mission/outcome"));
}

}  // namespace
}  // namespace adit
