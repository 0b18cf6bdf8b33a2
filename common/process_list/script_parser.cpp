// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/script_parser.hpp"

#include "common/process_list/names.hpp"

namespace adit {
namespace {

using Kind = ListToken::Kind;
using ActionKind = ScriptAction::Kind;

constexpr int kWaitMaxMs = 3'600'000;
constexpr double kTimeoutMaxS = 3600.0;

std::string name_of(TokenStream& tokens) {
  return tokens.expect(Kind::kString, "a name in quotes").text;
}

AwaitedStatus parse_status(TokenStream& tokens) {
  const std::string status = tokens.expect_one_of(Kind::kString, {"running", "stopped"});
  return status == "running" ? AwaitedStatus::kRunning : AwaitedStatus::kStopped;
}

void parse_timeout(TokenStream& tokens, ScriptAction& action) {
  if (tokens.next().kind == Kind::kEnd) return;
  if (tokens.next().text != "timeout_s") tokens.fail_next("';' or timeout_s");
  tokens.take();
  action.timeout_s = tokens.expect_number(0.0, kTimeoutMaxS);
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

ProcessScript parse_process_script(TokenStream& tokens) {
  const ListToken name = tokens.expect(Kind::kString, "the name of the script in quotes");
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
