// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/command_parser.hpp"

#include <csignal>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "common/bus/channel_name.hpp"
#include "common/config/nearest_name.hpp"
#include "common/process_list/names.hpp"

namespace adit {
namespace {

using Kind = ListToken::Kind;

constexpr double kLongestS = 3600.0;
constexpr double kRateMinHz = 0.01;
constexpr double kRateMaxHz = 1000.0;
constexpr int kRestartsMax = 1'000'000;
constexpr int kLastSignal = 64;

/// A command as it grows. The rate of the sign of life may come before its channel.
struct Draft {
  ListedCommand command;
  std::optional<std::string> channel;
  std::optional<double> rate_hz;
};

using SetAttribute = std::function<void(TokenStream&, Draft&)>;

std::string string_of(TokenStream& tokens) {
  return tokens.expect(Kind::kString, "a text in quotes").text;
}

std::vector<std::string> strings_of(TokenStream& tokens) {
  std::vector<std::string> all{string_of(tokens)};
  while (tokens.take_if(Kind::kComma)) all.push_back(string_of(tokens));
  return all;
}

std::string channel_of(TokenStream& tokens) {
  const TextPlace place = tokens.next().place;
  std::string channel = string_of(tokens);
  if (!is_channel_name(channel)) {
    tokens.fail(place, "\"" + channel + "\" is no channel: A to Z, 0 to 9 and _, at most 63");
  }
  return channel;
}

/// "outer/inner", procman's leading slash left out.
std::string group_of(TokenStream& tokens) {
  const TextPlace place = tokens.next().place;
  std::string group = string_of(tokens);
  if (group.starts_with('/')) group.erase(0, 1);
  if (!group.empty()) require_names(tokens, place, group);
  return group;
}

const std::map<std::string, SetAttribute>& attributes() {
  static const std::map<std::string, SetAttribute> all{
      {"exec", [](auto& tokens, auto& draft) { draft.command.exec = string_of(tokens); }},
      {"deputy", [](auto& tokens, auto& draft) { draft.command.deputy = string_of(tokens); }},
      {"group", [](auto& tokens, auto& draft) { draft.command.group = group_of(tokens); }},
      {"auto_respawn",
       [](auto& tokens, auto& draft) {
         const std::string text = tokens.expect_one_of(Kind::kString, {"true", "false"});
         draft.command.auto_respawn = text == "true";
       }},
      {"stop_signal",
       [](auto& tokens, auto& draft) {
         draft.command.stop_signal = tokens.expect_integer(1, kLastSignal);
       }},
      {"stop_time_allowed",
       [](auto& tokens, auto& draft) {
         draft.command.stop_time_allowed_s = tokens.expect_number(0.0, kLongestS);
       }},
      {"depends_on",
       [](auto& tokens, auto& draft) { draft.command.depends_on = strings_of(tokens); }},
      {"restart_limit",
       [](auto& tokens, auto& draft) {
         draft.command.restart_limit = tokens.expect_integer(0, kRestartsMax);
       }},
      {"alive_channel", [](auto& tokens, auto& draft) { draft.channel = channel_of(tokens); }},
      {"alive_rate_hz",
       [](auto& tokens, auto& draft) {
         draft.rate_hz = tokens.expect_number(kRateMinHz, kRateMaxHz);
       }},
      {"start_timeout_s", [](auto& tokens, auto& draft) {
         draft.command.start_timeout_s = tokens.expect_number(0.0, kLongestS);
       }}};
  return all;
}

std::vector<std::string> attribute_names() {
  std::vector<std::string> names;
  for (const auto& [name, set] : attributes()) names.push_back(name);
  return names;
}

/// `host` is what older files call the deputy.
const SetAttribute& attribute(TokenStream& tokens, const ListToken& word, std::string name) {
  if (name == "host") name = "deputy";
  const auto found = attributes().find(name);
  if (found != attributes().end()) return found->second;
  const std::string nearest = nearest_name(name, attribute_names());
  tokens.fail(word.place, "a command has no attribute '" + name + "'" +
                              (nearest.empty() ? "" : "; meant is perhaps '" + nearest + "'"));
}

void parse_attribute(TokenStream& tokens, Draft& draft, std::set<std::string>& seen) {
  const ListToken word = tokens.expect(Kind::kWord, "an attribute of the command or '}'");
  const SetAttribute& set = attribute(tokens, word, word.text);
  if (!seen.insert(word.text == "host" ? "deputy" : word.text).second) {
    tokens.fail(word.place, "'" + word.text + "' stands here twice");
  }
  tokens.expect(Kind::kAssign, "'='");
  set(tokens, draft);
  tokens.expect(Kind::kEnd, "';'");
}

std::string parse_name(TokenStream& tokens) {
  const ListToken name = tokens.expect(Kind::kString, "the name of the command in quotes");
  require_name(tokens, name);
  return name.text;
}

ListedCommand finished(const TokenStream& tokens, const TextPlace& place, Draft draft) {
  if (draft.command.exec.empty()) {
    tokens.fail(place, "command \"" + draft.command.id + "\" has no exec");
  }
  if (draft.rate_hz && !draft.channel) {
    tokens.fail(place, "command \"" + draft.command.id + "\" has alive_rate_hz without a channel");
  }
  if (draft.channel) draft.command.alive = AliveSign{*draft.channel, draft.rate_hz.value_or(1.0)};
  return draft.command;
}

}  // namespace

ListedCommand parse_listed_command(TokenStream& tokens, const std::string& group) {
  Draft draft;
  const TextPlace place = tokens.next().place;
  draft.command.id = parse_name(tokens);
  draft.command.group = group;
  tokens.expect(Kind::kOpen, "'{'");
  std::set<std::string> seen;
  while (tokens.next().kind != Kind::kClose) parse_attribute(tokens, draft, seen);
  tokens.take();
  return finished(tokens, place, std::move(draft));
}

}  // namespace adit
