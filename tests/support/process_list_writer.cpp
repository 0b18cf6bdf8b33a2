// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/process_list_writer.hpp"

#include <sstream>
#include <string_view>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

using ActionKind = ScriptAction::Kind;

std::string between_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else if (c == '\r') {
      result += "\\r";
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + "\"";
}

/// Quoted if it has an exponent, which the grammar does not allow in unquoted numbers.
std::string number(double value) {
  const std::string text = number_text(value);
  return text.find('e') == std::string::npos ? text : between_quotes(text);
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + between_quotes(name);
  return text;
}

/// Writes one command. Attributes with default values are omitted.
class CommandWriter {
 public:
  CommandWriter(std::ostream& out, std::string indent) : out_(out), indent_(std::move(indent)) {}

  void write(const ListedCommand& command) {
    const ListedCommand none;
    out_ << indent_ << "cmd " << between_quotes(command.id) << " {\n";
    attribute("exec", between_quotes(command.exec), true);
    attribute("deputy", between_quotes(command.deputy), command.deputy != none.deputy);
    attribute("auto_respawn", "\"true\"", command.auto_respawn);
    attribute("stop_signal", std::to_string(command.stop_signal),
              command.stop_signal != none.stop_signal);
    attribute("stop_time_allowed", number(command.stop_time_allowed_s),
              command.stop_time_allowed_s != none.stop_time_allowed_s);
    write_additions(command);
    out_ << indent_ << "}\n";
  }

 private:
  void write_additions(const ListedCommand& command) {
    attribute("depends_on", joined(command.depends_on), !command.depends_on.empty());
    attribute("restart_limit", std::to_string(command.restart_limit.value_or(0)),
              command.restart_limit.has_value());
    const LivenessSignal alive = command.alive.value_or(LivenessSignal{});
    attribute("alive_channel", between_quotes(alive.channel), command.alive.has_value());
    attribute("alive_rate_hz", number(alive.rate_hz), command.alive.has_value());
    attribute("start_timeout_s", number(command.start_timeout_s),
              command.start_timeout_s != ListedCommand{}.start_timeout_s);
    const AnswerRule answer = command.answer.value_or(AnswerRule{});
    attribute("answer_channel", between_quotes(answer.channel), command.answer.has_value());
    attribute("answers_to", joined(answer.inputs), command.answer.has_value());
    attribute("answer_timeout_s", number(answer.timeout_s),
              answer.timeout_s != AnswerRule{}.timeout_s);
    attribute("answers_late", between_quotes("true"), answer.late);
  }

  void attribute(std::string_view name, const std::string& value, bool differs) {
    if (differs) out_ << indent_ << "  " << name << " = " << value << ";\n";
  }

  std::ostream& out_;
  std::string indent_;
};

std::vector<std::string> levels_of(const std::string& group) {
  std::vector<std::string> levels;
  std::istringstream parts(group);
  for (std::string part; std::getline(parts, part, '/');) levels.push_back(part);
  return levels;
}

void write_command(std::ostream& out, const ListedCommand& command) {
  const std::vector<std::string> levels = levels_of(command.group);
  std::string indent;
  for (const std::string& level : levels) {
    out << indent << "group " << between_quotes(level) << " {\n";
    indent += "  ";
  }
  CommandWriter(out, indent).write(command);
  for (; !indent.empty(); indent.resize(indent.size() - 2)) {
    out << indent.substr(2) << "}\n";
  }
}

std::string target_text(const ScriptTarget& target) {
  if (target.kind == ScriptTarget::Kind::kEverything) return "everything";
  return (target.kind == ScriptTarget::Kind::kGroup ? "group " : "cmd ") +
         between_quotes(target.name);
}

std::string status_text(const ScriptAction& action) {
  const std::string status = action.awaited == AwaitedStatus::kRunning ? "running" : "stopped";
  return between_quotes(status) +
         (action.timeout_s ? " timeout_s " + number(*action.timeout_s) : "");
}

std::string change_text(std::string_view verb, const ScriptAction& action) {
  const bool waits = action.awaited != AwaitedStatus::kNone;
  return std::string(verb) + " " + target_text(action.target) +
         (waits ? " wait " + status_text(action) : "");
}

std::string action_text(const ScriptAction& action) {
  switch (action.kind) {
    case ActionKind::kStart:
      return change_text("start", action);
    case ActionKind::kStop:
      return change_text("stop", action);
    case ActionKind::kRestart:
      return change_text("restart", action);
    case ActionKind::kWaitTime:
      return "wait ms " + std::to_string(action.wait_ms);
    case ActionKind::kWaitStatus:
      return "wait " + target_text(action.target) + " status " + status_text(action);
    case ActionKind::kRunScript:
      return "run_script " + between_quotes(action.script);
  }
  return {};
}

}  // namespace

std::string to_text(const ProcessList& list) {
  std::ostringstream out;
  for (const ListedCommand& command : list.commands) write_command(out, command);
  for (const ProcessScript& script : list.scripts) {
    out << "script " << between_quotes(script.name) << " {\n";
    for (const ScriptAction& action : script.actions) out << "  " << action_text(action) << ";\n";
    out << "}\n";
  }
  return out.str();
}

}  // namespace adit
