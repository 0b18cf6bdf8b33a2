// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Builds precompile the headers that most sources need and read many sources as one, so that no
// compiler sees a missing include before the order of the sources changes. These tests do.
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/structure/source_tree.hpp"

namespace {

using Names = std::set<std::string>;

/// What headers are included for; what all of them bring (<utility>, <cstddef>) is left out.
const std::map<std::string, Names> kNamesOfHeaders{
    {"<algorithm>",
     {"all_of", "any_of", "clamp", "count_if", "fill", "find_if", "lower_bound", "max_element",
      "min_element", "none_of", "ranges", "sort", "transform", "upper_bound"}},
    {"<array>", {"array"}},
    {"<cmath>",
     {"abs", "atan2", "ceil", "cos", "exp", "floor", "fmod", "hypot", "isfinite", "isnan", "log",
      "lround", "pow", "remainder", "round", "sin", "sqrt", "tan"}},
    {"<cstdint>",
     {"int8_t", "int16_t", "int32_t", "int64_t", "uint8_t", "uint16_t", "uint32_t", "uint64_t"}},
    {"<filesystem>", {"filesystem"}},
    {"<fstream>", {"fstream", "ifstream", "ofstream"}},
    {"<functional>", {"function"}},
    {"<limits>", {"numeric_limits"}},
    {"<map>", {"map", "multimap"}},
    {"<memory>", {"make_shared", "make_unique", "shared_ptr", "unique_ptr"}},
    {"<numeric>", {"accumulate", "inner_product", "iota", "midpoint", "partial_sum"}},
    {"<optional>", {"nullopt", "optional"}},
    {"<random>",
     {"mt19937", "mt19937_64", "normal_distribution", "uniform_int_distribution",
      "uniform_real_distribution"}},
    {"<set>", {"multiset", "set"}},
    {"<span>", {"span"}},
    {"<sstream>", {"istringstream", "ostringstream", "stringstream"}},
    {"<string>", {"string", "to_string"}},
    {"<string_view>", {"string_view"}},
    {"<vector>", {"vector"}}};

std::string without_comments(std::string text) {
  for (auto at = text.find("//"); at != std::string::npos; at = text.find("//", at)) {
    text.erase(at, text.find('\n', at) - at);
  }
  return text;
}

/// The names behind each `std::`.
Names standard_names(const std::string& text) {
  static const std::string kScope = "std::";
  Names names;
  for (auto at = text.find(kScope); at != std::string::npos; at = text.find(kScope, at)) {
    const std::size_t begin = at += kScope.size();
    while (at < text.size() && (std::isalnum(text[at]) != 0 || text[at] == '_')) ++at;
    names.insert(text.substr(begin, at - begin));
  }
  return names;
}

bool has_any_of(const Names& names, const Names& wanted) {
  for (const std::string& name : wanted) {
    if (names.contains(name)) return true;
  }
  return false;
}

/// The headers of others that our files include, themselves or through headers of ours.
class IncludedHeaders {
 public:
  const Names& of(const std::string& file) {
    const auto [entry, is_new] = found_.try_emplace(file);
    if (!is_new) return entry->second;
    Names headers;
    for (const std::string& include : adit::includes_of(text_of(file))) {
      if (include.front() == '<') {
        headers.insert(include);
      } else {
        headers.merge(Names(of(include.substr(1, include.size() - 2))));
      }
    }
    return found_[file] = headers;
  }

 private:
  static std::string text_of(const std::string& file) {
    return adit::text_of(adit::source_root() / file);
  }

  std::map<std::string, Names> found_;
};

TEST(Includes, BringTheStandardHeadersOfWhatASourceNames) {
  IncludedHeaders included;
  std::vector<std::string> missing;
  for (const auto& path : adit::source_files()) {
    const Names named = standard_names(without_comments(adit::text_of(path)));
    const Names& headers = included.of(adit::name_in_tree(path));
    for (const auto& [header, names] : kNamesOfHeaders) {
      if (has_any_of(named, names) && !headers.contains(header)) {
        missing.push_back(adit::name_in_tree(path) + " lacks " + header);
      }
    }
  }
  EXPECT_THAT(missing, testing::IsEmpty());
}

TEST(Includes, BringEigenWhereASourceNamesIt) {
  const std::string scope = std::string("Eigen") + "::";  // else this file would be one of them
  IncludedHeaders included;
  std::vector<std::string> missing;
  for (const auto& path : adit::source_files()) {
    if (without_comments(adit::text_of(path)).find(scope) == std::string::npos) continue;
    const Names& headers = included.of(adit::name_in_tree(path));
    const auto eigen = headers.lower_bound("<Eigen/");
    const bool has_it = eigen != headers.end() && eigen->starts_with("<Eigen/");
    if (!has_it) missing.push_back(adit::name_in_tree(path));
  }
  EXPECT_THAT(missing, testing::IsEmpty());
}

TEST(Includes, NameNoSource) {
  std::vector<std::string> files;
  for (const auto& path : adit::source_files()) {
    for (const std::string& include : adit::includes_of(adit::text_of(path))) {
      if (include.ends_with(".cpp\"")) files.push_back(adit::name_in_tree(path));
    }
  }
  EXPECT_THAT(files, testing::IsEmpty());
}

}  // namespace
