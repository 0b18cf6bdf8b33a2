// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/item_parser.hpp"

#include <algorithm>
#include <csignal>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/config/nearest_name.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Kind = ListToken::Kind;
using ActionKind = ScriptAction::Kind;

constexpr std::size_t kNameBytesMax = 200;
constexpr std::ptrdiff_t kGroupSlashesMax = 16;
constexpr int kWaitMaxMs = 3'600'000;

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= kNameBytesMax &&
         std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) >= 0x20; });
}

constexpr double kTimeMaxS = 3600.0;
constexpr double kAnswerTimeMinS = 0.1;
constexpr double kRateMinHz = 0.01;
constexpr double kRateMaxHz = 1000.0;
constexpr int kRestartsMax = 1'000'000;
constexpr int kLastSignal = 64;

/// A command during parsing. alive_rate_hz may precede alive_channel, as others their channel.
struct Draft {
  ListedCommand command;
  std::optional<std::string> channel;
  std::optional<double> rate_hz;
  std::optional<std::string> answer_channel;
  std::vector<std::string> answers_to;
  std::optional<double> answer_timeout_s;
  std::optional<bool> answers_late;
};

using SetAttribute = std::function<void(TokenStream&, Draft&)>;

std::string parse_string(TokenStream& tokens) {
  return tokens.expect(Kind::kString, "a quoted string").text;
}

bool parse_boolean(TokenStream& tokens) {
  return tokens.expect_one_of(Kind::kString, {"true", "false"}) == "true";
}

std::vector<std::string> parse_strings(TokenStream& tokens) {
  std::vector<std::string> all{parse_string(tokens)};
  while (tokens.take_if(Kind::kComma)) all.push_back(parse_string(tokens));
  return all;
}

std::string parse_channel(TokenStream& tokens) {
  const TextPosition position = tokens.next().position;
  std::string channel = parse_string(tokens);
  if (!is_channel_name(channel)) {
    tokens.fail(position,
                quote(channel, '"') + " is not a channel name: at most 63 of A to Z, 0 to 9 and _");
  }
  return channel;
}

std::vector<std::string> parse_channels(TokenStream& tokens) {
  std::vector<std::string> all{parse_channel(tokens)};
  while (tokens.take_if(Kind::kComma)) all.push_back(parse_channel(tokens));
  return all;
}

/// Returns "outer/inner", without procman's leading slash.
std::string parse_group_attribute(TokenStream& tokens) {
  const TextPosition position = tokens.next().position;
  std::string group = parse_string(tokens);
  if (group.starts_with('/')) group.erase(0, 1);
  if (!group.empty()) require_group_path(tokens, position, group);
  return group;
}

const std::map<std::string, SetAttribute>& attributes() {
  static const std::map<std::string, SetAttribute> all{
      {"exec", [](auto& tokens, auto& draft) { draft.command.exec = parse_string(tokens); }},
      {"deputy", [](auto& tokens, auto& draft) { draft.command.deputy = parse_string(tokens); }},
      {"group",
       [](auto& tokens, auto& draft) { draft.command.group = parse_group_attribute(tokens); }},
      {"auto_respawn",
       [](auto& tokens, auto& draft) { draft.command.auto_respawn = parse_boolean(tokens); }},
      {"stop_signal",
       [](auto& tokens, auto& draft) {
         draft.command.stop_signal = tokens.expect_integer(1, kLastSignal);
       }},
      {"stop_time_allowed",
       [](auto& tokens, auto& draft) {
         draft.command.stop_time_allowed_s = tokens.expect_number(0.0, kTimeMaxS);
       }},
      {"depends_on",
       [](auto& tokens, auto& draft) { draft.command.depends_on = parse_strings(tokens); }},
      {"restart_limit",
       [](auto& tokens, auto& draft) {
         draft.command.restart_limit = tokens.expect_integer(0, kRestartsMax);
       }},
      {"alive_channel", [](auto& tokens, auto& draft) { draft.channel = parse_channel(tokens); }},
      {"alive_rate_hz",
       [](auto& tokens, auto& draft) {
         draft.rate_hz = tokens.expect_number(kRateMinHz, kRateMaxHz);
       }},
      {"answer_channel",
       [](auto& tokens, auto& draft) { draft.answer_channel = parse_channel(tokens); }},
      {"answers_to", [](auto& tokens, auto& draft) { draft.answers_to = parse_channels(tokens); }},
      {"answer_timeout_s",
       [](auto& tokens, auto& draft) {
         draft.answer_timeout_s = tokens.expect_number(kAnswerTimeMinS, kTimeMaxS);
       }},
      {"answers_late",
       [](auto& tokens, auto& draft) { draft.answers_late = parse_boolean(tokens); }},
      {"start_timeout_s", [](auto& tokens, auto& draft) {
         draft.command.start_timeout_s = tokens.expect_number(0.0, kTimeMaxS);
       }}};
  return all;
}

std::vector<std::string> attribute_names() {
  std::vector<std::string> names;
  for (const auto& [name, set] : attributes()) names.push_back(name);
  return names;
}

/// `host` is the name of `deputy` in older files.
const SetAttribute& attribute(TokenStream& tokens, const ListToken& word, std::string name) {
  if (name == "host") name = "deputy";
  const auto found = attributes().find(name);
  if (found != attributes().end()) return found->second;
  const std::string nearest = nearest_name(name, attribute_names());
  tokens.fail(word.position, "unknown attribute " + quote(name) +
                                 (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

void parse_attribute(TokenStream& tokens, Draft& draft, std::set<std::string>& seen) {
  const ListToken word = tokens.expect(Kind::kWord, "an attribute of the command or '}'");
  const SetAttribute& set = attribute(tokens, word, word.text);
  if (!seen.insert(word.text == "host" ? "deputy" : word.text).second) {
    tokens.fail(word.position, "duplicate attribute " + quote(word.text));
  }
  tokens.expect(Kind::kAssign, "'='");
  set(tokens, draft);
  tokens.expect(Kind::kEnd, "';'");
}

std::string parse_name(TokenStream& tokens) {
  const ListToken name = tokens.expect(Kind::kString, "a quoted command name");
  require_name(tokens, name);
  return name.text;
}

void set_answer(const TokenStream& tokens, const TextPosition& position, Draft& draft) {
  const bool has_options = draft.answer_timeout_s || draft.answers_late;
  if (!draft.answer_channel && draft.answers_to.empty() && !has_options) return;
  if (!draft.answer_channel || draft.answers_to.empty()) {
    tokens.fail(position, "command " + quote(draft.command.id, '"') +
                              " needs both answer_channel and answers_to");
  }
  AnswerRule& answer = draft.command.answer.emplace();
  answer.channel = *draft.answer_channel;
  answer.inputs = draft.answers_to;
  if (draft.answer_timeout_s) answer.timeout_s = *draft.answer_timeout_s;
  answer.late = draft.answers_late.value_or(false);
}

ListedCommand finished(const TokenStream& tokens, const TextPosition& position, Draft draft) {
  if (draft.command.exec.empty()) {
    tokens.fail(position, "command " + quote(draft.command.id, '"') + " has no exec");
  }
  if (draft.rate_hz && !draft.channel) {
    tokens.fail(position, "command " + quote(draft.command.id, '"') +
                              " has alive_rate_hz but no alive_channel");
  }
  if (draft.channel)
    draft.command.alive = LivenessSignal{*draft.channel, draft.rate_hz.value_or(1.0)};
  set_answer(tokens, position, draft);
  return draft.command;
}

std::string name_of(TokenStream& tokens) {
  return tokens.expect(Kind::kString, "a quoted name").text;
}

AwaitedStatus parse_status(TokenStream& tokens) {
  const std::string status = tokens.expect_one_of(Kind::kString, {"running", "stopped"});
  return status == "running" ? AwaitedStatus::kRunning : AwaitedStatus::kStopped;
}

void parse_timeout(TokenStream& tokens, ScriptAction& action) {
  if (tokens.next().kind == Kind::kEnd) return;
  if (tokens.next().text != "timeout_s") tokens.fail_next("';' or timeout_s");
  tokens.take();
  action.timeout_s = tokens.expect_number(0.0, kTimeMaxS);
}

ScriptAction parse_change(TokenStream& tokens, ActionKind kind) {
  ScriptAction action{.kind = kind};
  const std::string what = tokens.expect_one_of(Kind::kWord, {"everything", "group", "cmd"});
  if (what != "everything") {
    action.target.kind =
        what == "group" ? ScriptTarget::Kind::kGroup : ScriptTarget::Kind::kCommand;
    action.target.name = name_of(tokens);
  }
  if (tokens.next().kind == Kind::kEnd) return action;
  if (tokens.next().text != "wait") tokens.fail_next("';' or wait");
  tokens.take();
  action.awaited = parse_status(tokens);
  parse_timeout(tokens, action);
  return action;
}

ScriptAction parse_wait(TokenStream& tokens) {
  const std::string what = tokens.expect_one_of(Kind::kWord, {"ms", "group", "cmd"});
  if (what == "ms") {
    return {.kind = ActionKind::kWaitTime, .wait_ms = tokens.expect_integer(0, kWaitMaxMs)};
  }
  ScriptAction action{.kind = ActionKind::kWaitStatus};
  action.target.kind = what == "group" ? ScriptTarget::Kind::kGroup : ScriptTarget::Kind::kCommand;
  action.target.name = name_of(tokens);
  tokens.expect_one_of(Kind::kWord, {"status"});
  action.awaited = parse_status(tokens);
  parse_timeout(tokens, action);
  return action;
}

ScriptAction parse_action(TokenStream& tokens) {
  const std::string verb =
      tokens.expect_one_of(Kind::kWord, {"start", "stop", "restart", "wait", "run_script"});
  if (verb == "wait") return parse_wait(tokens);
  if (verb == "run_script") return {.kind = ActionKind::kRunScript, .script = name_of(tokens)};
  if (verb == "start") return parse_change(tokens, ActionKind::kStart);
  if (verb == "stop") return parse_change(tokens, ActionKind::kStop);
  return parse_change(tokens, ActionKind::kRestart);
}

}  // namespace

void require_name(const TokenStream& tokens, const ListToken& token) {
  if (is_name(token.text) && token.text.find('/') == std::string::npos) return;
  tokens.fail(token.position,
              "a name must have 1 to 200 bytes and no slashes or control characters");
}

void require_group_path(const TokenStream& tokens, const TextPosition& position,
                        const std::string& path) {
  if (std::ranges::count(path, '/') >= kGroupSlashesMax) {
    tokens.fail(position, "groups are nested more than sixteen levels deep");
  }
  std::istringstream parts(path);
  bool valid = !path.ends_with('/');
  for (std::string part; std::getline(parts, part, '/');) valid = valid && is_name(part);
  if (!valid)
    tokens.fail(position, quote(path, '"') + " is not a group path: names separated by /");
}

ListedCommand parse_listed_command(TokenStream& tokens, const std::string& group) {
  Draft draft;
  const TextPosition position = tokens.next().position;
  draft.command.id = parse_name(tokens);
  draft.command.group = group;
  tokens.expect(Kind::kOpen, "'{'");
  std::set<std::string> seen;
  while (tokens.next().kind != Kind::kClose) parse_attribute(tokens, draft, seen);
  tokens.take();
  return finished(tokens, position, std::move(draft));
}

ProcessScript parse_process_script(TokenStream& tokens) {
  const ListToken name = tokens.expect(Kind::kString, "a quoted script name");
  require_name(tokens, name);
  ProcessScript script{name.text, {}};
  tokens.expect(Kind::kOpen, "'{'");
  while (tokens.next().kind != Kind::kClose) {
    script.actions.push_back(parse_action(tokens));
    tokens.expect(Kind::kEnd, "';'");
  }
  tokens.take();
  return script;
}

}  // namespace adit
