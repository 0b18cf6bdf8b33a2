// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Compares the tables of README.md and lcmtypes/README.md with the sources: the channels that each
// stage publishes and subscribes, and their types.
#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
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

using adit::source_files;
using adit::text_of;
using Names = std::set<std::string>;
using Row = std::vector<std::string>;

const fs::path kRoot = adit::source_root();

/// Columns of the table of channels.
constexpr std::size_t kChannelColumn = 0;
constexpr std::size_t kTypeColumn = 1;
constexpr std::size_t kFromColumn = 4;
constexpr std::size_t kToColumn = 5;

/// Participants that have no sources here.
const Names kExternal{"driver", "log", "procman's sheriff", "tests"};
constexpr const char* kEveryStage = "every stage";

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" `");
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(" `") - first + 1);
}

/// The rows below a heading that begins with this column. Cells without spaces and back-ticks
/// around them; a link is its text.
std::vector<Row> read_table(const std::string& text, const std::string& heading) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line) && !line.starts_with("| " + heading + " |")) {
  }
  std::getline(lines, line);  // the rule below the heading
  std::vector<Row> rows;
  while (std::getline(lines, line) && line.starts_with('|')) {
    std::istringstream cells(std::regex_replace(line.substr(1), link, "$1"));
    Row row;
    for (std::string cell; std::getline(cells, cell, '|');) row.push_back(trimmed(cell));
    rows.push_back(row);
  }
  return rows;
}

Names column(const std::vector<Row>& rows, std::size_t index) {
  Names names;
  for (const Row& row : rows) names.insert(row.at(index));
  return names;
}

/// The items of a list that commas separate; "–" is an empty list.
Names items(const std::string& cell) {
  Names names;
  std::istringstream in(cell);
  for (std::string item; std::getline(in, item, ',');) names.insert(trimmed(item));
  names.erase("–");
  return names;
}

Names matches(const std::string& text, const std::string& pattern) {
  Names found;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
    found.insert((*it)[1]);
  }
  return found;
}

Names stage_folders() {
  Names names;
  for (const auto& entry : fs::directory_iterator(kRoot / "procs")) {
    if (entry.is_directory()) names.insert(entry.path().filename().string());
  }
  return names;
}

/// Channels by the names of their constants.
std::map<std::string, std::string> channel_constants() {
  static const std::regex pattern(R"re(std::string_view (k\w+) = "(\w+)";)re");
  const std::string text = text_of(kRoot / "common/bus/channels.hpp");
  std::map<std::string, std::string> channels;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    channels[(*it)[1]] = (*it)[2];
  }
  return channels;
}

struct Traffic {
  Names subscribed;
  Names published;
};

/// Whether every mention of a channel that is not a publication counts as a subscription, or only
/// calls named subscribe and comparisons with the channel of an event.
enum class Mentions { kAreSubscriptions, kNeedACall };

/// Adds the channels of a source. A mention of `channels::kX` belongs to the statement that begins
/// behind the last semicolon or brace.
void add_traffic(std::string text, Mentions mentions, Traffic& traffic) {
  static const std::map<std::string, std::string> channels = channel_constants();
  static const std::regex comment(R"(//[^\n]*)");
  static const std::regex mention(R"(channels::(k\w+))");
  static const std::regex call(R"(subscribe|[!=]= $)");
  text = std::regex_replace(text, comment, "");
  for (std::sregex_iterator it(text.begin(), text.end(), mention), end; it != end; ++it) {
    const auto channel = channels.find((*it)[1]);
    if (channel == channels.end()) continue;
    const std::string before = text.substr(0, static_cast<std::size_t>(it->position()));
    const std::string statement = before.substr(before.find_last_of(";{}") + 1);
    if (statement.find("publish") != std::string::npos ||
        statement.find("send(") != std::string::npos) {
      traffic.published.insert(channel->second);
    } else if (mentions == Mentions::kAreSubscriptions || std::regex_search(statement, call)) {
      traffic.subscribed.insert(channel->second);
    }
  }
}

bool is_node_source(const std::string& file) { return file.ends_with("_node.cpp"); }

/// Channels by participant, as the table names it.
std::map<std::string, Traffic> traffic_by_participant() {
  std::map<std::string, Traffic> traffic;
  for (const fs::path& path : source_files()) {
    const std::string file = adit::name_in_tree(path);
    const std::string text = text_of(path);
    if (file.starts_with("procs/") && is_node_source(file)) {
      const std::string stage = file.substr(6, file.find('/', 6) - 6);
      add_traffic(text, Mentions::kAreSubscriptions, traffic[stage]);
    } else if (file == "common/bus/node/node_host.cpp" || file == "common/bus/lcm_bus.cpp") {
      add_traffic(text, Mentions::kNeedACall, traffic[kEveryStage]);
    } else if (file == "sim/sim_node.cpp" || file.starts_with("sim/live/")) {
      add_traffic(text, Mentions::kNeedACall, traffic["sim"]);
    } else if (file == "common/bus/map_subscription.cpp" || file.starts_with("common/records/")) {
      for (const char* user : {"tools", "viewer"})
        add_traffic(text, Mentions::kNeedACall, traffic[user]);
    } else if (file.starts_with("viewer/")) {
      add_traffic(text, Mentions::kNeedACall, traffic["viewer"]);
    } else if (file.starts_with("tools/") || file == "sim/waypoint_driver_node.cpp") {
      add_traffic(text, Mentions::kNeedACall, traffic["tools"]);
    }
  }
  return traffic;
}

/// The participants that publish or subscribe a channel.
Names participants(const std::map<std::string, Traffic>& traffic, Names Traffic::*direction,
                   const std::string& channel) {
  Names names;
  for (const auto& [participant, of_it] : traffic) {
    if ((of_it.*direction).contains(channel)) names.insert(participant);
  }
  return names;
}

Names without_external(Names names) {
  for (const std::string& name : kExternal) names.erase(name);
  return names;
}

/// The types with which sources subscribe to each channel.
std::map<std::string, Names> subscribed_types() {
  static const std::regex typed(R"(subscribe<(?:\w+::)?(\w+_t)>\(\s*[\w.()]+,\s*channels::(k\w+))");
  static const std::regex decoding(R"(channels::(k\w+),[^;]*?decoding<(?:\w+::)?(\w+_t)>)");
  const auto channels = channel_constants();
  std::map<std::string, Names> types;
  for (const fs::path& path : source_files()) {
    if (adit::name_in_tree(path).starts_with("tests/")) continue;
    const std::string text = text_of(path);
    for (std::sregex_iterator it(text.begin(), text.end(), typed), end; it != end; ++it) {
      types[channels.at((*it)[2])].insert((*it)[1]);
    }
    for (std::sregex_iterator it(text.begin(), text.end(), decoding), end; it != end; ++it) {
      types[channels.at((*it)[1])].insert((*it)[2]);
    }
  }
  return types;
}

std::vector<Row> channel_table() {
  return read_table(text_of(kRoot / "lcmtypes/README.md"), "channel");
}

TEST(ChannelTable, ListsEveryChannel) {
  Names constants;
  for (const auto& [constant, channel] : channel_constants()) constants.insert(channel);
  EXPECT_FALSE(constants.empty());
  EXPECT_THAT(column(channel_table(), kChannelColumn), ElementsAreArray(constants));
  const Names listed(adit::channels::kAll.begin(), adit::channels::kAll.end());
  EXPECT_THAT(listed, ElementsAreArray(constants));
}

TEST(ChannelTable, NamesTheTypeOfEveryChannel) {
  auto types = subscribed_types();
  EXPECT_GT(types.size(), 20U);
  for (const adit::MessageType& type : adit::message_types()) types[type.channel].insert(type.name);
  for (const Row& row : channel_table()) {
    for (const std::string& type : types[row.at(kChannelColumn)]) {
      EXPECT_EQ(row.at(kTypeColumn), type) << row.at(kChannelColumn);
    }
  }
}

TEST(ChannelTable, NamesThePublishersAndSubscribersOfEveryChannel) {
  const auto traffic = traffic_by_participant();
  for (const Row& row : channel_table()) {
    const std::string& channel = row.at(kChannelColumn);
    EXPECT_THAT(without_external(items(row.at(kFromColumn))),
                ElementsAreArray(participants(traffic, &Traffic::published, channel)))
        << "publishers of " << channel;
    EXPECT_THAT(without_external(items(row.at(kToColumn))),
                ElementsAreArray(participants(traffic, &Traffic::subscribed, channel)))
        << "subscribers of " << channel;
  }
}

/// The channels in a text; a name that ends with * stands for all that begin like it.
Names channels_in(const std::string& text) {
  Names names;
  for (const std::string& pattern : matches(text, R"(([A-Z][A-Z_]+\*?))")) {
    for (const std::string_view channel : adit::channels::kAll) {
      const bool is_prefix = pattern.ends_with('*');
      if (is_prefix ? channel.starts_with(pattern.substr(0, pattern.size() - 1))
                    : channel == pattern) {
        names.emplace(channel);
      }
    }
  }
  return names;
}

std::vector<Row> pipeline_table() { return read_table(text_of(kRoot / "README.md"), "stage"); }

TEST(PipelineTable, ListsEveryStage) {
  EXPECT_THAT(column(pipeline_table(), 0), ElementsAreArray(stage_folders()));
  const std::vector<std::string>& names = adit::stage_names();
  EXPECT_EQ(Names(names.begin(), names.end()), stage_folders());
}

TEST(PipelineTable, NamesTheInputsAndOutputsOfEveryStage) {
  const std::string arrow = "→";
  auto traffic = traffic_by_participant();
  for (const Row& row : pipeline_table()) {
    const std::string& stage = row.at(0);
    const auto at = row.at(1).find(arrow);
    ASSERT_NE(at, std::string::npos) << stage;
    EXPECT_THAT(channels_in(row.at(1).substr(0, at)), ElementsAreArray(traffic[stage].subscribed))
        << "inputs of " << stage;
    EXPECT_THAT(channels_in(row.at(1).substr(at)), ElementsAreArray(traffic[stage].published))
        << "outputs of " << stage;
  }
}

std::vector<fs::path> type_files() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "lcmtypes")) {
    if (entry.path().extension() == ".lcm") paths.push_back(entry.path());
  }
  return paths;
}

/// Types that are fields of others and have no channel.
std::set<std::string> nested_types() {
  std::set<std::string> nested;
  for (const fs::path& path : type_files()) nested.merge(matches(text_of(path), R"(\n +(\w+_t))"));
  for (const char* number : {"int8_t", "int16_t", "int32_t", "int64_t"}) nested.erase(number);
  return nested;
}

TEST(MessageTable, ListsEveryType) {
  const std::string readme = text_of(kRoot / "lcmtypes/README.md");
  for (const fs::path& path : type_files()) {
    EXPECT_NE(readme.find("| `" + path.stem().string() + "` |"), std::string::npos) << path;
  }
  EXPECT_THAT(column(read_table(readme, "nested type"), 0), ElementsAreArray(nested_types()));
}

TEST(MessageTypes, HaveASampleInTests) {
  const std::set<std::string> nested = nested_types();
  std::set<std::string> files;
  for (const fs::path& path : type_files()) {
    if (!nested.contains(path.stem().string())) files.insert(path.stem().string());
  }
  std::set<std::string> types;
  for (const adit::MessageType& type : adit::message_types()) types.insert(type.name);
  EXPECT_THAT(types, ElementsAreArray(files));
}

/// The lines of the fields of a struct.
std::vector<std::string> fields(const std::string& lcm) {
  std::vector<std::string> lines;
  std::istringstream text(lcm.substr(lcm.find('{') + 1));
  static const std::regex field(R"( *(?!const)[a-z]\w* +\w+(\[\w+\])*;.*)");
  for (std::string line; std::getline(text, line);) {
    if (std::regex_match(line, field)) lines.push_back(line);
  }
  return lines;
}

TEST(MessageTypes, DocumentEveryField) {
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
