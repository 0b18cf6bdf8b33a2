// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What holds the tree together and no compiler checks: who includes whom, and that the tables in
// the READMEs name what there is.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/node/stages.hpp"
#include "tests/support/message_types.hpp"
#include "tests/unit/structure/source_tree.hpp"

namespace {

namespace fs = std::filesystem;
using testing::ElementsAreArray;
using testing::IsEmpty;
using testing::IsSubsetOf;

using adit::source_files;
using adit::text_of;

const fs::path kRoot = adit::source_root();

/// An include: the file that has it and what stands behind `#include`, with its quotes.
struct Include {
  std::string file;  // from the root, with slashes
  std::string what;

  [[nodiscard]] bool is_in(const std::string& folder) const {
    return file.starts_with(folder + "/");
  }
  [[nodiscard]] bool is_of(const std::string& folder) const {
    return what.starts_with('"' + folder + "/");
  }
};

std::vector<Include> includes() {
  std::vector<Include> found;
  for (const fs::path& path : source_files()) {
    for (const std::string& what : adit::includes_of(text_of(path))) {
      found.push_back({adit::name_in_tree(path), what});
    }
  }
  return found;
}

/// Those that break the rule, as "file includes what".
std::vector<std::string> offenders(const std::function<bool(const Include&)>& breaks_the_rule) {
  std::vector<std::string> lines;
  for (const Include& include : includes()) {
    if (breaks_the_rule(include)) lines.push_back(include.file + " includes " + include.what);
  }
  return lines;
}

/// The first column of a table, without back-ticks; empty without the heading.
std::set<std::string> first_column(const std::string& text, const std::string& heading) {
  std::set<std::string> names;
  static const std::regex row(R"(\| *`?\[?`?([A-Za-z0-9_]+)[^|]*\|.*)");
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line) && !line.starts_with("| " + heading + " |")) {
  }
  std::smatch match;
  while (std::getline(lines, line) && line.starts_with('|')) {
    if (std::regex_match(line, match, row)) names.insert(match[1]);
  }
  return names;
}

std::set<std::string> stage_folders() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(kRoot / "procs")) {
    if (entry.is_directory()) names.insert(entry.path().filename().string());
  }
  return names;
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  std::set<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
    found.insert((*it)[1]);
  }
  return found;
}

/// Files that include a library, which are to be one class: x.cpp and x.hpp at most.
std::set<std::string> stems_that_include(const std::string& prefix) {
  std::set<std::string> stems;
  for (const Include& include : includes()) {
    if (include.what.starts_with(prefix) && !include.is_in("tests")) {
      stems.insert(fs::path(include.file).replace_extension().generic_string());
    }
  }
  return stems;
}

bool is_node_file(const std::string& file) {
  return fs::path(file).stem().string().ends_with("_node");
}

TEST(Structure, FindsTheSources) {
  EXPECT_GT(source_files().size(), 20U);
  EXPECT_GT(includes().size(), 100U);
}

TEST(Structure, OnlyTheBusKnowsLcm) {
  EXPECT_THAT(offenders([](const Include& include) {
                return include.what.starts_with("<lcm/") && !include.is_in("common/bus");
              }),
              IsEmpty());
}

TEST(Structure, OnlyConversionsAndNodesKnowGeneratedMessages) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool generated = include.is_of("adit") || include.is_of("procman_lcm");
                return generated && !include.is_in("common/messages") && !include.is_in("tests") &&
                       !is_node_file(include.file);
              }),
              IsEmpty());
}

TEST(Structure, StagesKnowNothingOfEachOther) {
  EXPECT_THAT(offenders([](const Include& include) {
                const std::string stage = include.file.substr(0, include.file.find('/', 6));
                return include.is_in("procs") && include.is_of("procs") && !include.is_of(stage);
              }),
              IsEmpty());
}

TEST(Structure, DependenciesPointOneWay) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool of_tools = include.is_of("tools") || include.is_of("tests");
                const bool of_ends = include.is_of("procs") || include.is_of("sim") || of_tools;
                return (include.is_in("common") && of_ends) ||
                       (include.is_in("procs") && (include.is_of("sim") || of_tools)) ||
                       (include.is_in("sim") && (include.is_of("procs") || of_tools)) ||
                       (include.is_in("tools") && include.is_of("tests"));
              }),
              IsEmpty());
}

TEST(Structure, AlgorithmsKnowNoTransport) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool may = is_node_file(include.file) || include.file.ends_with("/main.cpp");
                // A journal keeps messages, but has them from nobody.
                const bool keeps_messages =
                    include.file.ends_with("_journal.cpp") && include.is_of("common/messages");
                return include.is_in("procs") && !may && !keeps_messages &&
                       (include.is_of("common/bus") || include.is_of("common/messages"));
              }),
              IsEmpty());
}

TEST(Structure, OnlyWhatRunsTheSimulatorKnowsTransport) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool may = is_node_file(include.file) || include.file == "sim/main.cpp" ||
                                 include.is_in("sim/live");
                return include.is_in("sim") && !may &&
                       (include.is_of("common/bus") || include.is_of("common/messages"));
              }),
              IsEmpty());
}

TEST(Structure, LargeLibrariesOfTheSimulatorAreBehindOneClassEach) {
  EXPECT_THAT(stems_that_include("<embree3/"), testing::ElementsAre("sim/mesh/ray_scene"));
  EXPECT_LE(stems_that_include("<assimp/").size(), 1U);
}

/// Types of headers, with the files that define them. All programs link everything, and two types
/// of one name would be taken for each other without a word.
std::map<std::string, std::set<std::string>> defined_types() {
  static const std::regex pattern(R"((?:^|\n)(?:class|struct|enum class) (\w+)[^;\n]*\{)");
  std::map<std::string, std::set<std::string>> types;
  for (const fs::path& path : source_files()) {
    const std::string file = adit::name_in_tree(path);
    if (path.extension() != ".hpp" || file.starts_with("tests/")) continue;
    const std::string text = text_of(path);
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
      types[(*it)[1]].insert(file);
    }
  }
  return types;
}

TEST(Structure, NoTwoTypesHaveOneName) {
  for (const auto& [type, files] : defined_types()) {
    EXPECT_THAT(files, testing::SizeIs(1)) << type;
  }
}

TEST(Structure, OctoMapAndCholmodAreBehindOneClassEach) {
  EXPECT_LE(stems_that_include("<octomap/").size(), 1U);
  EXPECT_THAT(stems_that_include("<cholmod"), IsEmpty());
  EXPECT_THAT(stems_that_include("<suitesparse/"),
              testing::ElementsAre("common/pose_graph/sparse_cholesky"));
}

TEST(Structure, YamlIsReadInOneFolder) {
  EXPECT_THAT(stems_that_include("<yaml-cpp/"),
              testing::ElementsAre("common/config/config_file", "common/config/second_document"));
}

TEST(Structure, EverySourceFileSaysItsLicence) {
  std::vector<std::string> without;
  for (const fs::path& path : source_files()) {
    if (!text_of(path).starts_with("// SPDX-FileCopyrightText: The Adit authors\n"
                                   "// SPDX-License-Identifier: BSD-3-Clause\n")) {
      without.push_back(path.string());
    }
  }
  EXPECT_THAT(without, IsEmpty());
}

TEST(Structure, EveryStageHasItsRowInTheReadme) {
  const std::string readme = text_of(kRoot / "README.md");
  if (readme.empty() || stage_folders().empty()) GTEST_SKIP() << "no README.md or no stage yet";
  EXPECT_THAT(stage_folders(), IsSubsetOf(first_column(readme, "stage")));
}

TEST(Structure, EveryStageIsKnownToTheConfiguration) {
  EXPECT_THAT(stage_folders(), IsSubsetOf(adit::stage_names()));
}

TEST(Structure, EveryChannelHasItsRowInTheTableAndEveryRowIsAChannel) {
  const auto constants = matches(text_of(kRoot / "common/bus/channels.hpp"),
                                 R"re(std::string_view k\w+ = "(\w+)";)re");
  const auto rows = first_column(text_of(kRoot / "lcmtypes/README.md"), "channel");
  EXPECT_FALSE(constants.empty());
  EXPECT_THAT(rows, ElementsAreArray(constants));
  const std::set<std::string> listed(adit::channels::kAll.begin(), adit::channels::kAll.end());
  EXPECT_THAT(listed, ElementsAreArray(constants));
}

std::vector<fs::path> type_files() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "lcmtypes")) {
    if (entry.path().extension() == ".lcm") paths.push_back(entry.path());
  }
  return paths;
}

/// Types that are fields of others, and so on no channel.
std::set<std::string> nested_types() {
  std::set<std::string> nested;
  for (const fs::path& path : type_files()) nested.merge(matches(text_of(path), R"(\n +(\w+_t))"));
  for (const char* number : {"int8_t", "int16_t", "int32_t", "int64_t"}) nested.erase(number);
  return nested;
}

TEST(Structure, EveryTypeIsInTheTableOfChannelsOrOfNestedTypes) {
  const std::string readme = text_of(kRoot / "lcmtypes/README.md");
  for (const fs::path& path : type_files()) {
    EXPECT_NE(readme.find("| `" + path.stem().string() + "` |"), std::string::npos) << path;
  }
  EXPECT_THAT(first_column(readme, "nested type"), ElementsAreArray(nested_types()));
}

TEST(Structure, EveryTypeOfAChannelIsAmongThoseThatTestsGoOver) {
  const std::set<std::string> nested = nested_types();
  std::set<std::string> files;
  for (const fs::path& path : type_files()) {
    if (!nested.contains(path.stem().string())) files.insert(path.stem().string());
  }
  std::set<std::string> types;
  for (const adit::MessageType& type : adit::message_types()) types.insert(type.name);
  EXPECT_THAT(types, ElementsAreArray(files));
}

/// The text within the braces of a struct, comments that stand alone left out.
std::vector<std::string> fields(const std::string& lcm) {
  std::vector<std::string> lines;
  std::istringstream text(lcm.substr(lcm.find('{') + 1));
  static const std::regex field(R"( *(?!const)[a-z]\w* +\w+(\[\w+\])*;.*)");
  for (std::string line; std::getline(text, line);) {
    if (std::regex_match(line, field)) lines.push_back(line);
  }
  return lines;
}

TEST(Structure, EveryFieldOfEveryTypeSaysWhatItIs) {
  const std::set<std::string> nested = nested_types();
  for (const fs::path& path : type_files()) {
    const auto lines = fields(text_of(path));
    ASSERT_FALSE(lines.empty()) << path;
    if (!nested.contains(path.stem().string())) {
      EXPECT_THAT(lines.front(), testing::ContainsRegex("int64_t utime; +// time|bus time"));
    }
    for (const std::string& line : lines) {
      EXPECT_NE(line.find("//"), std::string::npos) << path << ": " << line;
    }
  }
}

}  // namespace
