// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/common/config/example_params.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string error_of(const std::string& yaml) {
  try {
    load_outer(yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(ConfigErrors, SuggestTheNearestKnownKey) {
  EXPECT_EQ(error_of("outer:\n  share: 0.5\n  serch_radius: 1\n"),
            "robot.yaml:3: unknown key 'serch_radius' in outer; did you mean 'search_radius_m'?");
  EXPECT_EQ(error_of("outer:\n  inner:\n    iteration: 1\n"),
            "robot.yaml:3: unknown key 'iteration' in outer.inner; did you mean 'iterations'?");
}

TEST(ConfigErrors, ListTheValidKeysWithoutANearOne) {
  EXPECT_EQ(error_of("outer: {inner: {zzz: 1}}"),
            "robot.yaml:1: unknown key 'zzz' in outer.inner; valid keys: iterations, robust");
}

TEST(ConfigErrors, StateTheBoundsOfAValue) {
  EXPECT_EQ(error_of("outer:\n  share: 1.5\n"),
            "robot.yaml:2: outer.share is 1.5; allowed: 0 to 1");
  EXPECT_EQ(error_of("outer:\n  search_radius_m: 0\n"),
            "robot.yaml:2: outer.search_radius_m is 0; allowed: > 0");
  EXPECT_EQ(error_of("outer:\n  inner:\n    iterations: 0\n"),
            "robot.yaml:3: outer.inner.iterations is 0; allowed: 1 to 100");
  EXPECT_EQ(error_of("outer:\n  thresholds_m:\n   - 1\n   - -1\n"),
            "robot.yaml:4: outer.thresholds_m is -1; allowed: >= 0");
}

TEST(ConfigErrors, RejectWrongTypes) {
  const std::string number = "robot.yaml:1: outer.share is ";
  EXPECT_EQ(error_of("outer: {share: high}"), number + "'high', not a number");
  EXPECT_EQ(error_of("outer: {share: \"0.5\"}"), number + "'0.5', not a number");
  EXPECT_EQ(error_of("outer: {share: [0.5]}"), number + "a list, not a number");
  EXPECT_EQ(error_of("outer: {share: }"), number + "nothing, not a number");
  EXPECT_EQ(error_of("outer: {share: 0.5m}"), number + "'0.5m', not a number");
  EXPECT_THAT(error_of("outer: {inner: {iterations: 2.0}}"), HasSubstr("not an integer"));
  EXPECT_THAT(error_of("outer: {inner: {iterations: 9999999999}}"), HasSubstr("integer"));
  EXPECT_THAT(error_of("outer: {inner: {robust: yes}}"), HasSubstr("not true or false"));
  EXPECT_THAT(error_of("outer: {inner: 3}"), HasSubstr("outer.inner is '3', not a map of keys"));
  EXPECT_THAT(error_of("outer: {channel: [a]}"), HasSubstr("not a string"));
  EXPECT_THAT(error_of("outer: {thresholds_m: 1}"), HasSubstr("not a list of numbers"));
  EXPECT_THAT(error_of("outer: {T_body_laser: [1, 2, 3]}"), HasSubstr("not a map of keys"));
  EXPECT_THAT(error_of("outer: 7"), HasSubstr("outer is '7', not a map of keys"));
}

TEST(ConfigErrors, RejectNumbersThatAreNotFinite) {
  for (const char* text : {"nan", "inf", "-inf", "1e999", ".nan", ".inf"}) {
    EXPECT_THAT(error_of("outer: {share: " + std::string(text) + "}"), HasSubstr("number")) << text;
  }
}

TEST(ConfigErrors, RejectDuplicateKeys) {
  EXPECT_EQ(error_of("outer:\n  share: 0.5\n  share: 0.6\n"),
            "robot.yaml:3: duplicate key 'share'; first on line 2");
  EXPECT_EQ(error_of("outer: {}\nouter: {}\n"),
            "robot.yaml:2: duplicate key 'outer'; first on line 1");
}

TEST(ConfigErrors, RejectUnknownSections) {
  const ConfigFile file = ConfigFile::parse("outer: {}\nmaping: {}\n", "robot.yaml");
  EXPECT_NO_THROW(file.require_known_sections({"outer", "maping"}));
  try {
    file.require_known_sections({"outer", "mapping"});
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "robot.yaml:2: unknown section 'maping'; did you mean 'mapping'?");
  }
}

TEST(ConfigErrors, LocateInvalidYaml) {
  EXPECT_THAT(error_of("outer:\n  share: [0.5\n"), StartsWith("robot.yaml:3: "));
  EXPECT_THAT(error_of("outer:\n\tshare: 1\n"), StartsWith("robot.yaml:2: "));
  EXPECT_THAT(error_of("- a\n- b\n"),
              StartsWith("robot.yaml:1: the file must be a map of sections"));
  EXPECT_THAT(error_of("a: 1\n---\nb: 2\n"), HasSubstr("robot.yaml:2: a second document"));
  EXPECT_NE(error_of(",m"), "");  // yaml-cpp parses an unlimited number of documents
  EXPECT_THAT(error_of("outer: &a {inner: *a}\n"), StartsWith("robot.yaml:1: "));
  EXPECT_THAT(error_of("outer: {[1, 2]: 3}\n"), HasSubstr("a key must be a scalar"));
  EXPECT_THAT(error_of("outer: " + std::string(100000, '[')), StartsWith("robot.yaml:"));
}

/// Nested aliases double the content with every line: 2^30 values from a few hundred bytes.
std::string nested_aliases() {
  std::string yaml = "outer:\n  a0: &a0 [1, 1]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    const std::string name = "a" + std::to_string(i);
    yaml.append("  ").append(name).append(": &").append(name).append(" [");
    yaml.append(before).append(", ").append(before).append("]\n");
  }
  return yaml;
}

TEST(ConfigErrors, BoundTheContentAfterTheExpansionOfAliases) {
  EXPECT_THAT(error_of(nested_aliases()), StartsWith("robot.yaml:"));
  std::string bomb = "a: &a [1,1,1,1,1,1,1,1,1,1]\n";
  for (char c = 'b'; c < 'k'; ++c) {
    const std::string one = std::string("*") + static_cast<char>(c - 1);
    std::string list = one;
    for (int i = 1; i < 10; ++i) list += "," + one;
    bomb += std::string(1, c) + ": &" + c + " [" + list + "]\n";
  }
  EXPECT_LT(bomb.size(), 400U);
  EXPECT_THAT(error_of(bomb), HasSubstr("with all aliases expanded"));
  // Long texts count, too: 1 MB in each of 100 aliases.
  std::string texts = "a: &a " + std::string(1'000'000, 'x') + "\nb: [";
  for (int i = 0; i < 100; ++i) texts += "*a, ";
  EXPECT_THAT(error_of(texts + "]\n"), HasSubstr("with all aliases expanded"));
}

TEST(ConfigErrors, BoundNestingAndSize) {
  EXPECT_THAT(error_of("outer: " + std::string(20, '[') + std::string(20, ']')),
              HasSubstr("nested too deeply"));
  std::string blocks;
  for (std::size_t depth = 0; depth < 2000; ++depth) {
    blocks += std::string(depth, ' ') + "a:\n";
  }
  EXPECT_THAT(error_of(blocks), StartsWith("robot.yaml:"));
  EXPECT_THAT(error_of(std::string(5'000'000, '\n')), HasSubstr("larger than"));
  EXPECT_THROW(ConfigFile::load("/dev/zero"), ConfigError);
}

std::string many_keys(int count, const std::string& indent) {
  std::string yaml;
  for (int i = 0; i < count; ++i) yaml += indent + "key" + std::to_string(i) + ": 1\n";
  return yaml;
}

/// A linear search for each key takes half a minute here, a table of keys some 0.2 s.
TEST(ConfigErrors, RejectManyKeysAndLongKeys) {
  EXPECT_THAT(error_of("outer:\n" + many_keys(90'000, "  ")),
              StartsWith("robot.yaml:2: unknown key 'key0' in outer"));
  EXPECT_THAT(error_of(many_keys(90'000, "") + "key0: 2\n"),
              StartsWith("robot.yaml:90001: duplicate key 'key0'; first on line 1"));
  EXPECT_THAT(error_of("outer:\n" + many_keys(300'000, "  ")),
              StartsWith("robot.yaml: larger than"));
  EXPECT_THAT(error_of(many_keys(200'000, "")), HasSubstr("too much content"));
  EXPECT_LT(error_of("outer: {? " + std::string(1'000'000, 'k') + " : 1}").size(), 1000U);
}

TEST(ConfigErrors, ExpandAliases) {
  EXPECT_EQ(load_outer("shared: &s {iterations: 7}\nouter: {inner: *s}\n").inner.iterations, 7);
  EXPECT_EQ(load_outer("a: &k share\nouter: {*k : 0.25}\n").share, 0.25);
}

TEST(ConfigErrors, QuoteContentOfTheFile) {
  const std::string error = error_of("outer: {\"a\\e[2J\\0b\": 1}");
  EXPECT_THAT(error, HasSubstr("unknown key 'a\\x1b[2J\\x00b' in outer"));
}

TEST(ConfigErrors, RejectBinaryInputBeforeParsing) {
  EXPECT_EQ(error_of("outer:\n  share: \x01\n"), "robot.yaml:2: not a text file");
  EXPECT_EQ(error_of(std::string("\0", 1)), "robot.yaml:1: not a text file");
  EXPECT_EQ(error_of("a: 1\n\nb: \xC3("), "robot.yaml:3: not a text file");  // truncated character
  EXPECT_EQ(error_of("outer: {} # \xFF"), "robot.yaml:1: not a text file");
  EXPECT_EQ(error_of("outer: {} # \xE2\x82"),
            "robot.yaml:1: not a text file");  // truncated character
  EXPECT_EQ(error_of("outer: {} # \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80\t\r\n"), "");
}

TEST(ConfigErrors, RejectUnreadableFiles) {
  EXPECT_THROW(ConfigFile::load("/nonexistent/robot.yaml"), ConfigError);
  EXPECT_THROW(ConfigFile::load(testing::TempDir()), ConfigError);
}

TEST(ConfigErrors, AcceptAnEmptyFile) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "empty.yaml").flush();
  EXPECT_NO_THROW(ConfigFile::load(folder / "empty.yaml"));
}

}  // namespace
}  // namespace adit
