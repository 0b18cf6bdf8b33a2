// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The tree uses the standard terms of the field (docs/glossary.md). Words that stood for them in
// earlier versions do not come back, in identifiers, comments, texts or docs.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/structure/source_tree.hpp"

namespace {

namespace fs = std::filesystem;

/// Each with the term to use instead.
const std::vector<std::pair<std::set<std::string>, std::string>> kWords{
    {{"stub", "stubs", "openings"}, "frontier"},
    {{"piece", "pieces"}, "fragment"},
    {{"refuse", "refuses", "refused", "refusing", "refusal", "refusals"}, "reject, error"},
    {{"believe", "believes", "believed", "belief", "beliefs"}, "estimate, hypothesis, accept"},
    {{"hear", "hears", "heard", "teller"}, "receive, subscribe, report"},
    {{"silent", "silently", "silence"}, "stale, timed out"},
    {{"anew"}, "reset, again"},
    {{"patience"}, "timeout"},
    {{"harm", "harms", "harmed"}, "fault"},
    {{"surprise", "surprises", "surprised"}, "map inconsistency"},
    {{"sighting", "sightings"}, "observation"},
    {{"way", "ways"}, "path, route, distance travelled"}};

const std::vector<std::pair<std::vector<std::string>, std::string>> kPhrases{
    {{"own", "track"}, "traversed path"}, {{"kept", "track"}, "traversed path"},
    {{"taken", "back"}, "revoked"},       {{"takes", "back"}, "revokes"},
    {{"cut", "off"}, "power loss"},       {{"go", "on"}, "resume, continue"},
    {{"goes", "on"}, "resumes"},          {{"went", "on"}, "resumed"},
    {{"go", "back", "to"}, "roll back"},  {{"a", "look"}, "3D scan"},
    {{"second", "look"}, "re-scan"}};

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }

/// Lower-case words of a text; the parts of an identifier are words of their own.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char before = i > 0 ? line[i - 1] : ' ';
    const char after = i + 1 < line.size() ? line[i + 1] : ' ';
    const bool begins = is_upper(line[i]) && (is_lower(before) || is_lower(after));
    const bool is_escape = before == '\\';  // the t of "\t"
    const bool is_letter = (is_upper(line[i]) || is_lower(line[i])) && !is_escape;
    if ((begins || !is_letter) && !words.back().empty()) words.emplace_back();
    if (is_letter) words.back() += static_cast<char>(std::tolower(line[i]));
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// The terms to use instead of what a line has. `before`: the last word of the line before, since a
/// phrase may be broken between two lines; it is replaced by that of this line.
std::vector<std::string> findings(const std::string& line, std::string& before) {
  std::vector<std::string> words = words_of(line);
  const std::size_t first = before.empty() ? 0 : 1;
  if (first == 1) words.insert(words.begin(), before);
  std::vector<std::string> found;
  for (std::size_t i = first; i < words.size(); ++i) {
    for (const auto& [unwanted, term] : kWords) {
      if (unwanted.contains(words[i])) found.push_back("'" + words[i] + "': " + term);
    }
    const bool closure = words[i] == "closure" || words[i] == "closures";
    if (closure && (i == 0 || words[i - 1] != "loop")) {
      found.emplace_back("'closure': loop closure");
    }
    for (const auto& [phrase, term] : kPhrases) {
      const std::size_t begin = i + 1 < phrase.size() ? words.size() : i + 1 - phrase.size();
      if (begin < words.size() && std::equal(phrase.begin(), phrase.end(), words.begin() + begin)) {
        found.push_back("'" + phrase.front() + " " + phrase.back() + "': " + term);
      }
    }
  }
  before = words.empty() ? "" : words.back();
  return found;
}

bool is_text(const fs::path& path) {
  static const std::set<std::string> kExtensions{".hpp",  ".cpp",   ".lcm",     ".md",   ".yaml",
                                                 ".cfg",  ".cmake", ".sh",      ".java", ".txt",
                                                 ".html", ".css",   ".service", ".conf"};
  return kExtensions.contains(path.extension().string());
}

/// The page that explains the terms, the one that tells what changed, and this list.
bool may_name_them(const std::string& file) {
  return file == "docs/glossary.md" || file == "CHANGELOG.md" ||
         file == "tests/unit/structure/terms_test.cpp";
}

std::vector<fs::path> texts() {
  std::vector<fs::path> paths;
  for (const char* name : {"README.md", "CONTRIBUTING.md"}) {
    paths.push_back(adit::source_root() / name);
  }
  for (const char* folder : {"common", "procs", "drivers", "sim", "tools", "viewer", "tests",
                             "lcmtypes", "deploy", "docs", "cmake"}) {
    auto entries = fs::recursive_directory_iterator(adit::source_root() / folder);
    for (const auto& entry : entries) {
      const std::string name = entry.path().filename().string();
      if (name == "node_modules" || name == "dist") {  // of others, and generated
        entries.disable_recursion_pending();
      } else if (entry.is_regular_file() && is_text(entry.path())) {
        paths.push_back(entry.path());
      }
    }
  }
  return paths;
}

TEST(Terms, AreThoseOfTheField) {
  std::vector<std::string> lines;
  for (const fs::path& path : texts()) {
    const std::string file = adit::name_in_tree(path);
    if (may_name_them(file)) continue;
    std::istringstream text(adit::text_of(path));
    std::string line;
    std::string before;
    for (int number = 1; std::getline(text, line); ++number) {
      for (const std::string& finding : findings(line, before)) {
        lines.push_back(file + ":" + std::to_string(number) + " " + finding);
      }
    }
  }
  EXPECT_THAT(lines, testing::IsEmpty());
}

TEST(Terms, AreFoundInIdentifiersAndPhrases) {
  std::string before;
  EXPECT_THAT(findings("int kept_track_m = stubCount;", before), testing::SizeIs(2));
  EXPECT_THAT(findings("the robot goes on, and has a", before), testing::SizeIs(1));
  EXPECT_THAT(findings("look at LoopClosure, at a loop", before), testing::SizeIs(1));
  EXPECT_THAT(findings("closure", before), testing::IsEmpty());
  EXPECT_THAT(findings("a Closure", before), testing::SizeIs(1));
  EXPECT_THAT(findings("WithANewPath\\tloop_closure", before), testing::IsEmpty());
}

}  // namespace
