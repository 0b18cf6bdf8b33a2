// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Rules of the source tree that no compiler checks: which components may include which.
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

#include "tests/unit/structure/source_tree.hpp"

namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

using adit::source_files;
using adit::text_of;

const fs::path kRoot = adit::source_root();

/// An include directive: the file and the text after `#include`, with its quotes.
struct Include {
  std::string file;  // relative to the root
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

/// The includes that break a rule, as "file includes what".
std::vector<std::string> offenders(const std::function<bool(const Include&)>& breaks_the_rule) {
  std::vector<std::string> lines;
  for (const Include& include : includes()) {
    if (breaks_the_rule(include)) lines.push_back(include.file + " includes " + include.what);
  }
  return lines;
}

/// Files outside tests that include a library, without extension: x.cpp and x.hpp count as one.
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

TEST(Structure, OnlyTheBusIncludesLcm) {
  EXPECT_THAT(offenders([](const Include& include) {
                return include.what.starts_with("<lcm/") && !include.is_in("common/bus");
              }),
              IsEmpty());
}

TEST(Structure, OnlyConversionsAndNodesIncludeGeneratedMessages) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool generated = include.is_of("adit") || include.is_of("procman_lcm");
                return generated && !include.is_in("common/messages") && !include.is_in("tests") &&
                       !is_node_file(include.file);
              }),
              IsEmpty());
}

TEST(Structure, StagesDoNotIncludeEachOther) {
  EXPECT_THAT(offenders([](const Include& include) {
                const std::string stage = include.file.substr(0, include.file.find('/', 6));
                return include.is_in("procs") && include.is_of("procs") && !include.is_of(stage);
              }),
              IsEmpty());
}

TEST(Structure, DependenciesFollowTheLayers) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool of_tools =
                    include.is_of("tools") || include.is_of("viewer") || include.is_of("tests");
                const bool of_ends = include.is_of("procs") || include.is_of("drivers") ||
                                     include.is_of("sim") || of_tools;
                return (include.is_in("common") && of_ends) ||
                       (include.is_in("drivers") && of_ends && !include.is_of("drivers")) ||
                       (include.is_in("viewer") && of_ends && !include.is_of("viewer")) ||
                       (include.is_in("procs") && of_ends && !include.is_of("procs")) ||
                       (include.is_in("sim") && of_ends && !include.is_of("sim")) ||
                       (include.is_in("tools") && include.is_of("tests"));
              }),
              IsEmpty());
}

TEST(Structure, AlgorithmsDoNotIncludeTransport) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool may = is_node_file(include.file) || include.file.ends_with("/main.cpp");
                // A journal stores encoded messages but has no bus.
                const bool stores_messages =
                    include.file.ends_with("_journal.cpp") && include.is_of("common/messages");
                return include.is_in("procs") && !may && !stores_messages &&
                       (include.is_of("common/bus") || include.is_of("common/messages"));
              }),
              IsEmpty());
}

/// What all drivers share: the folders of drivers/ that are no driver.
bool is_shared_by_drivers(const std::string& path) {
  return path.starts_with("drivers/device/") || path.starts_with("drivers/laser/") ||
         path.starts_with("drivers/ports/") || path.starts_with("drivers/timing/");
}

TEST(Structure, DriversDoNotIncludeEachOther) {
  EXPECT_THAT(offenders([](const Include& include) {
                const std::string driver = include.file.substr(0, include.file.find('/', 8));
                return include.is_in("drivers") && include.is_of("drivers") &&
                       !include.is_of(driver) && !is_shared_by_drivers(include.what.substr(1));
              }),
              IsEmpty());
}

/// A protocol is tested and fuzzed without a device, so that it has neither port, bus nor clock.
TEST(Structure, ProtocolsOfDriversDoNotIncludeTransportOrPorts) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool may = is_node_file(include.file) ||
                                 include.file.ends_with("/main.cpp") ||
                                 include.is_in("drivers/ports");
                const bool of_messages = include.is_of("common/messages") &&
                                         include.what != "\"common/messages/result.hpp\"";
                return include.is_in("drivers") && !may &&
                       (include.is_of("common/bus") || of_messages ||
                        include.is_of("common/service") || include.is_of("drivers/ports") ||
                        include.what.starts_with("<sys/") || include.what == "<termios.h>");
              }),
              IsEmpty());
}

TEST(Structure, SimulationDoesNotIncludeTransport) {
  EXPECT_THAT(offenders([](const Include& include) {
                const bool may = is_node_file(include.file) || include.file == "sim/main.cpp" ||
                                 include.is_in("sim/live");
                return include.is_in("sim") && !may &&
                       (include.is_of("common/bus") || include.is_of("common/messages"));
              }),
              IsEmpty());
}

TEST(Structure, SimulatorLibrariesAreBehindOneClassEach) {
  EXPECT_THAT(stems_that_include("<embree3/"), testing::ElementsAre("sim/mesh/ray_scene"));
  EXPECT_LE(stems_that_include("<assimp/").size(), 1U);
}

/// Types defined in headers, with the defining files. All programs link everything: two types of
/// one name would violate the one-definition rule without a diagnostic. Without specialisations.
std::map<std::string, std::set<std::string>> defined_types() {
  static const std::regex pattern(R"((?:^|\n)(?:class|struct|enum class) (\w+)\b(?!<)[^;\n]*\{)");
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

TEST(Structure, TypeNamesAreUnique) {
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

TEST(Structure, SqliteIsBehindOneClass) {
  EXPECT_THAT(stems_that_include("<sqlite3.h>"), testing::ElementsAre("tools/database/database"));
}

TEST(Structure, CompressionsOfBagsAreBehindOneFunction) {
  EXPECT_THAT(stems_that_include("<bzlib.h>"), testing::ElementsAre("tools/ros/bag/unpack"));
  EXPECT_THAT(stems_that_include("<lz4"), testing::ElementsAre("tools/ros/bag/unpack"));
}

TEST(Structure, YamlIsBehindOneClass) {
  EXPECT_THAT(stems_that_include("<yaml-cpp/"), testing::ElementsAre("common/config/config_file"));
}

/// Lines of the programs, with their file, that a pattern matches.
std::vector<std::string> program_lines(const std::regex& pattern) {
  std::vector<std::string> found;
  for (const fs::path& path : source_files()) {
    const std::string file = adit::name_in_tree(path);
    if (file.starts_with("tests/") || file.starts_with("common/text/")) continue;
    std::istringstream text(text_of(path));
    for (std::string line; std::getline(text, line);) {
      if (std::regex_search(line, pattern)) found.push_back(file + ": " + line);
    }
  }
  return found;
}

/// Content of files, command lines and messages must not act on a terminal: quote() escapes it.
TEST(Structure, MessagesQuoteByTheFunctionQuote) {
  EXPECT_THAT(program_lines(std::regex(R"('\{\}'|"\\?'" \+|\\"\{\})")),
              testing::Each(testing::HasSubstr("--fault '{}'")));  // for the shell
}

TEST(Structure, ErrorsArePrintedByTheFunctionPrintError) {
  for (const std::string& line : program_lines(std::regex("std::cerr <<|stderr"))) {
    EXPECT_THAT(line, testing::AnyOf(testing::StartsWith("tools/adit/adit_app.cpp"),  // the help
                                     testing::HasSubstr(": ///"), testing::HasSubstr("  //"),
                                     testing::HasSubstr("\"arrows or"),
                                     testing::HasSubstr("\"adit-watch: is started"),
                                     testing::HasSubstr("\"SparseCholesky")));
  }
}

/// The checks of CLI11 accept nan.
TEST(Structure, NumbersOfOptionsAreCheckedByNumberIn) {
  EXPECT_THAT(
      program_lines(std::regex(R"(CLI::(PositiveNumber|NonNegativeNumber|Number|Range\b))")),
      IsEmpty());
}

TEST(Structure, EverySourceFileHasALicence) {
  std::vector<std::string> without;
  for (const fs::path& path : source_files()) {
    if (!text_of(path).starts_with("// SPDX-FileCopyrightText: The Adit authors\n"
                                   "// SPDX-License-Identifier: BSD-3-Clause\n")) {
      without.push_back(path.string());
    }
  }
  EXPECT_THAT(without, IsEmpty());
}

}  // namespace
