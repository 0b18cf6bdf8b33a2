// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What a file of a search says, and what is wrong with it, in one line.
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tools/search/search_run.hpp"
#include "tools/search/search_units.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Kind = SpaceParameter::Kind;

SearchFile loaded(const std::string& text) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "s.yaml") << text;
  return load_search_file(folder / "s.yaml");
}

constexpr const char* kCampaign = "campaign: {command: 'sh {x}'}\n";
constexpr const char* kSearch = "search: {failure: x > 1}\n";

/// Without the path of the file. Also checks that nothing is created.
std::string message_of(const std::string& text) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "s.yaml") << text;
  SearchOptions options;
  options.file = folder / "s.yaml";
  options.folder = folder / "out";
  options.programs = std::filesystem::path(ADIT_WATCH).parent_path();
  try {
    run_search(options, {});
  } catch (const std::exception& error) {
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << error.what();
    const std::string message = error.what();
    EXPECT_THAT(message, testing::Not(HasSubstr("\n")));
    const auto at = message.find("s.yaml");
    return at == std::string::npos ? message : message.substr(at);
  }
  return "no error";
}

std::string space_message(const std::string& space) {
  return message_of(std::string(kCampaign) + kSearch + "space:\n  " + space + "\n");
}

TEST(SearchFile, HasParametersOfFourKinds) {
  const SearchFile file = loaded(std::string(kCampaign) + kSearch +
                                 "space:\n"
                                 "  x: {from: -1, to: 1, simple: 0}\n"
                                 "  n: {from: 30, to: 80, integer: true}\n"
                                 "  t: [branching, 'ring', 3]\n"
                                 "  s: {seed: true}\n");
  const auto& parameters = file.space.parameters;
  ASSERT_EQ(parameters.size(), 4U);
  EXPECT_EQ(parameters[0].kind, Kind::kReal);
  EXPECT_EQ(parameters[1].kind, Kind::kInteger);
  EXPECT_EQ(parameters[1].simple, 30.0);
  EXPECT_EQ(parameters[2].kind, Kind::kChoice);
  EXPECT_EQ(parameters[3].kind, Kind::kSeed);
  EXPECT_EQ(file.space.values({0.125, 31, 1, 17}).json(),
            R"({"n":31,"s":17,"t":"ring","x":0.125})");
  EXPECT_EQ(file.space.values(file.space.simplest()).json(),
            R"({"n":30,"s":1,"t":"branching","x":0})");
}

TEST(SearchFile, WritesValuesWithFewDigits) {
  SpaceParameter parameter;
  parameter.from = 0.92;
  parameter.to = 1.02;
  EXPECT_EQ(parameter.written(parameter.rounded(0.9876543)).text, "0.9877");
  EXPECT_EQ(parameter.written(parameter.rounded(0.9876543, 2)).text, "0.988");
  EXPECT_EQ(parameter.rounded(2.0), 1.02);
  parameter.from = 0.0;
  parameter.to = 50'000.0;
  EXPECT_EQ(parameter.written(parameter.rounded(12'345.6)).text, "12350");
}

TEST(SearchFile, ReportsWhatIsWrongInOneLine) {
  EXPECT_EQ(message_of(std::string(kSearch) + "space: {x: [1]}"),
            "s.yaml: the section campaign is missing");
  EXPECT_EQ(message_of(std::string(kCampaign) + "space: {x: [1]}"),
            "s.yaml: the section search is missing");
  EXPECT_EQ(message_of(std::string(kCampaign) + kSearch), "s.yaml: the section space is missing");
  EXPECT_EQ(message_of(std::string(kCampaign) + "search: {seed: 1}\nspace: {x: [1]}"),
            "s.yaml:2: search.failure is missing");
  EXPECT_THAT(message_of(std::string(kCampaign) + "search: {failure: y > 1}\nspace: {x: [1]}"),
              HasSubstr("search.failure: no such column: y"));
  EXPECT_THAT(message_of(std::string(kCampaign) +
                         "search: {failure: x > 1, severity: x >}\nspace: {x: [1]}"),
              HasSubstr("search.severity: "));
  EXPECT_THAT(
      message_of(std::string(kCampaign) + "search: {failure: x > 1, batch: 0}\nspace: {x: [1]}"),
      HasSubstr("search.batch"));
  EXPECT_THAT(message_of(std::string(kCampaign) + kSearch + "space: {x: [1]}\nmatrix: {x: [1]}"),
              HasSubstr("matrix"));
  EXPECT_THAT(message_of("campaign: {command: 'no_such_program_x {x}'}\n" + std::string(kSearch) +
                         "space: {x: [1]}"),
              HasSubstr("campaign.command has no program 'no_such_program_x'"));
  EXPECT_THAT(
      message_of("campaign: {command: 'sh {y}'}\n" + std::string(kSearch) + "space: {x: [1]}"),
      HasSubstr("campaign.command has the placeholder 'y' that is no parameter of"));
}

TEST(SearchFile, ReportsWhatIsWrongWithAParameter) {
  EXPECT_EQ(space_message("X: [1]"),
            "s.yaml:4: space.X is not a name of letters a-z, 0-9 and _, or is out");
  EXPECT_EQ(space_message("x: 3"),
            "s.yaml:4: space.x is neither a range {from, to}, a list nor {seed: true}");
  EXPECT_EQ(space_message("x: []"), "s.yaml:4: space.x has no values");
  EXPECT_EQ(space_message("x: {from: 1}"),
            "s.yaml:4: space.x needs numbers from, to and optionally simple");
  EXPECT_EQ(space_message("x: {from: 1, to: nan}"),
            "s.yaml:4: space.x needs numbers from, to and optionally simple");
  EXPECT_EQ(space_message("x: {from: 1, to: 1}"),
            "s.yaml:4: space.x has a from that is not below its to");
  EXPECT_EQ(space_message("x: {from: 0, to: 1, simple: 2}"),
            "s.yaml:4: space.x.simple is outside the range");
  EXPECT_EQ(space_message("x: {from: 0, to: 1, integer: 1}"),
            "s.yaml:4: space.x.integer is neither true nor false");
  EXPECT_THAT(space_message("x: {from: 0, to: 1, simpel: 0}"),
              HasSubstr("key 'simpel' in space.x"));
  EXPECT_THAT(space_message("x: {seed: false}"), HasSubstr("space.x.seed is not true"));
  EXPECT_THAT(space_message("x: [[1]]"), HasSubstr("a value of space.x is not text"));
}

TEST(SearchFile, ReportsAFileOfAUnitOutsideItsFolder) {
  for (const char* name : {"", "/tmp/x", "../x", "a/../../x", "a/"}) {
    EXPECT_THAT(message_of("campaign: {command: 'sh {x}', files: [{name: '" + std::string(name) +
                           "', text: a}]}\n" + kSearch + "space: {x: [1]}"),
                HasSubstr("campaign.files[0].name is"))
        << name;
  }
}

TEST(SearchFile, KnowsKindsWithoutTheirNumbers) {
  EXPECT_EQ(without_numbers("wheel 3 stuck in 'mud_12', sinkage 0.21 m."),
            "wheel # stuck in 'mud_#', sinkage # m.");
  EXPECT_EQ(without_numbers("12.5"), "#");
  EXPECT_EQ(without_numbers(""), "");
}

}  // namespace
}  // namespace adit
