// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/parser.hpp"

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config/config_file.hpp"
#include "tests/support/process_list_writer.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ProcessList parse(const std::string& text) { return parse_process_list(text, "list"); }

TEST(ProcessListParser, ReadsProcmanAttributes) {
  const ProcessList list = parse(R"(# what runs
group "sensing" {
  cmd "laser" { exec = "laser --rate 75"; host = "robot"; stop_signal = 15; stop_time_allowed = 3; }
  group "rear" { cmd "tilt" { exec = "tilt"; deputy = "robot"; auto_respawn = "true"; } }
}
cmd "loose" { exec = "sleep 5"; group = "/other"; stop_signal = "2"; }   # as procman writes numbers
)");
  ASSERT_EQ(list.commands.size(), 3U);
  const ListedCommand& laser = list.commands[0];
  EXPECT_EQ(laser.id, "laser");
  EXPECT_EQ(laser.exec, "laser --rate 75");
  EXPECT_EQ(laser.deputy, "robot");
  EXPECT_EQ(laser.group, "sensing");
  EXPECT_EQ(laser.stop_signal, 15);
  EXPECT_EQ(laser.stop_time_allowed_s, 3.0);
  EXPECT_FALSE(laser.auto_respawn);
  EXPECT_EQ(list.commands[1].group, "sensing/rear");
  EXPECT_TRUE(list.commands[1].auto_respawn);
  EXPECT_EQ(list.commands[2].group, "other");
  EXPECT_EQ(list.commands[2].stop_signal, 2);
  EXPECT_EQ(list.commands[2].stop_time_allowed_s, 7.0);
}

TEST(ProcessListParser, ReadsExtensionsOfProcman) {
  const ProcessList list = parse(R"(
cmd "laser" { exec = "laser"; }
cmd "imu" { exec = "imu"; }
cmd "slam" { exec = "slam"; depends_on = "laser", "imu"; restart_limit = 4; alive_rate_hz = 0.5;
             alive_channel = "POSE"; start_timeout_s = 2.5; answer_timeout_s = 5;
             answers_to = "LASER_FRONT", "IMU"; answer_channel = "POSE"; answers_late = "true"; })");
  const ListedCommand& slam = list.commands.at(2);
  EXPECT_THAT(slam.depends_on, ElementsAre("laser", "imu"));
  EXPECT_EQ(slam.restart_limit, 4);
  EXPECT_EQ(slam.alive, (LivenessSignal{"POSE", 0.5}));
  EXPECT_EQ(slam.start_timeout_s, 2.5);
  EXPECT_EQ(list.commands[0].restart_limit, std::nullopt);
  EXPECT_EQ(slam.answer, (AnswerRule{"POSE", {"LASER_FRONT", "IMU"}, 5.0, true}));
  EXPECT_EQ(list.commands[0].alive, std::nullopt);
  EXPECT_EQ(list.commands[0].answer, std::nullopt);
}

ScriptAction action_of(ScriptAction::Kind kind) {
  ScriptAction action;
  action.kind = kind;
  return action;
}

TEST(ProcessListParser, ReadsEveryScriptAction) {
  using Kind = ScriptAction::Kind;
  const ProcessList list = parse(R"(
group "g" { cmd "x" { exec = "x"; } }
script "go" {
  start group "g" wait "running" timeout_s 1.5; wait ms 500; stop cmd "x" wait "stopped";
  restart everything; wait cmd "x" status "running"; run_script "other";
}
script "other" { })");
  const auto& actions = list.scripts.at(0).actions;
  ASSERT_EQ(actions.size(), 6U);
  ScriptAction wait_500 = action_of(Kind::kWaitTime);
  wait_500.wait_ms = 500;
  ScriptAction run_other = action_of(Kind::kRunScript);
  run_other.script = "other";
  const ScriptTarget group{ScriptTarget::Kind::kGroup, "g"};
  const ScriptTarget command{ScriptTarget::Kind::kCommand, "x"};
  EXPECT_EQ(actions[0], (ScriptAction{Kind::kStart, group, AwaitedStatus::kRunning, 0, 1.5, {}}));
  EXPECT_EQ(actions[1], wait_500);
  EXPECT_EQ(actions[2], (ScriptAction{Kind::kStop, command, AwaitedStatus::kStopped, 0, {}, {}}));
  EXPECT_EQ(actions[3], action_of(Kind::kRestart));
  EXPECT_EQ(actions[4],
            (ScriptAction{Kind::kWaitStatus, command, AwaitedStatus::kRunning, 0, {}, {}}));
  EXPECT_EQ(actions[5], run_other);
}

TEST(ProcessListParser, AcceptsBothQuotesAndEscapes) {
  const ProcessList list = parse(R"(cmd 'it "is"' { exec = "a \"b\" \\ \t'c' \x"; })");
  EXPECT_EQ(list.commands.at(0).id, "it \"is\"");
  EXPECT_EQ(list.commands.at(0).exec, "a \"b\" \\ \t'c' x");
}

TEST(ProcessListParser, FindsCommandsOfNestedGroups) {
  const ProcessList list = parse(R"(group "a" { cmd "1" { exec = "x"; }
    group "b" { cmd "2" { exec = "x"; } } } group "ab" { cmd "3" { exec = "x"; } })");
  const auto ids = [&](const ScriptTarget& target) { return list.ids_of(target); };
  EXPECT_THAT(ids({ScriptTarget::Kind::kGroup, "a"}), ElementsAre("1", "2"));
  EXPECT_THAT(ids({ScriptTarget::Kind::kGroup, "a/b"}), ElementsAre("2"));
  EXPECT_THAT(ids({ScriptTarget::Kind::kEverything, ""}), ElementsAre("1", "2", "3"));
}

struct BadList {
  std::string text;
  std::string message;
};

class ProcessListErrors : public testing::TestWithParam<BadList> {};

TEST_P(ProcessListErrors, ReportPositionAndExpectedToken) {
  try {
    parse(GetParam().text);
    FAIL() << "accepted: " << GetParam().text;
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.what(), "list" + GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ProcessListErrors,
    testing::Values(
        BadList{"command", ":1:1: expected cmd, group or script, not 'command'"},
        BadList{"\n  42", ":2:3: expected cmd, group or script, not '42'"},
        BadList{"@", ":1:1: unexpected '@'"}, BadList{"cmd \"a\n\"", ":1:5: unterminated string"},
        BadList{"cmd \"a\\", ":1:5: unterminated string"},
        BadList{"cmd a", ":1:5: expected a quoted command name, not 'a'"},
        BadList{"cmd \"a/b\" {",
                ":1:5: a name must have 1 to 200 bytes and no slashes or control characters"},
        BadList{"group \"\" {",
                ":1:7: a name must have 1 to 200 bytes and no slashes or control characters"},
        BadList{"cmd \"a\" exec", ":1:9: expected '{', not 'exec'"},
        BadList{"cmd \"a\" {",
                ":1:10: expected an attribute of the command or '}', not the end of "
                "the file"},
        BadList{"cmd \"a\" { }", ":1:5: command \"a\" has no exec"},
        BadList{"cmd \"a\" { exec \"x\"", ":1:16: expected '=', not \"x\""},
        BadList{"cmd \"a\" { exec = x", ":1:18: expected a quoted string, not 'x'"},
        BadList{"cmd \"a\" { exec = \"x\" }", ":1:22: expected ';', not '}'"},
        BadList{"cmd \"a\" { exec = \"x\"; exec = \"y\"; }", ":1:23: duplicate attribute 'exec'"},
        BadList{"cmd \"a\" { deputy = \"x\"; host = \"y\"; }", ":1:25: duplicate attribute 'host'"},
        BadList{"cmd \"a\" { exce = \"x\"; }",
                ":1:11: unknown attribute 'exce'; did you mean 'exec'?"},
        BadList{"cmd \"a\" { auto_respawn = \"yes\"; }",
                ":1:26: expected \"true\" or \"false\", not \"yes\""},
        BadList{"cmd \"a\" { stop_signal = 0; }", ":1:25: expected a number, 1 to 64, not '0'"},
        BadList{"cmd \"a\" { stop_signal = 1.5; }", ":1:25: expected an integer, not '1.5'"},
        BadList{"cmd \"a\" { stop_time_allowed = \"nan\"; }",
                ":1:31: expected a number, 0 to 3600, not \"nan\""},
        BadList{"cmd \"a\" { alive_channel = \"pose\"; }",
                ":1:27: \"pose\" is not a channel name: at most 63 of A to Z, 0 to 9 and _"},
        BadList{"cmd \"a\" { exec = \"x\"; alive_rate_hz = 5; }",
                ":1:5: command \"a\" has alive_rate_hz but no alive_channel"},
        BadList{"cmd \"a\" { exec = \"x\"; answer_channel = \"POSE\"; }",
                ":1:5: command \"a\" needs both answer_channel and answers_to"},
        BadList{"cmd \"a\" { exec = \"x\"; answer_timeout_s = 5; }",
                ":1:5: command \"a\" needs both answer_channel and answers_to"},
        BadList{"cmd \"a\" { answers_to = \"POSE\", \"b\"; }",
                ":1:32: \"b\" is not a channel name: at most 63 of A to Z, 0 to 9 and _"},
        BadList{"cmd \"a\" { exec = \"x\"; group = \"a//b\"; }",
                ":1:31: \"a//b\" is not a group path: names separated by /"},
        BadList{"group \"g\" { exec", ":1:13: expected cmd or group, not 'exec'"},
        BadList{"group \"g\" {", ":1:12: expected cmd, group or '}', not the end of the file"},
        BadList{"script \"s\" { go; }",
                ":1:14: expected start, stop, restart, wait or run_script, not 'go'"},
        BadList{"script \"s\" { start it; }", ":1:20: expected everything, group or cmd, not 'it'"},
        BadList{"script \"s\" { start everything then }",
                ":1:31: expected ';' or wait, not 'then'"},
        BadList{"script \"s\" { start everything wait \"up\"; }",
                ":1:36: expected \"running\" or \"stopped\", not \"up\""},
        BadList{"script \"s\" { start everything wait \"running\" 5; }",
                ":1:46: expected ';' or timeout_s, not '5'"},
        BadList{"script \"s\" { wait ms 1.5; }", ":1:22: expected an integer, not '1.5'"},
        BadList{std::string("cmd \"a\" \x01"), ": byte 8 is not valid text"},
        BadList{"cmd \"a\" { exec = \"x\"; } cmd \"a\" { exec = \"x\"; }",
                ": duplicate command \"a\""},
        BadList{"script \"a\" { } script \"a\" { }", ": duplicate script \"a\""},
        BadList{"cmd \"a\" { exec = \"A=B\"; }", ": command \"a\": no program to run"},
        BadList{"cmd \"a\" { exec = \"x 'y\"; }", ": command \"a\": unterminated quote"},
        BadList{"cmd \"a\" { exec = \"x\"; depends_on = \"b\"; }",
                ": command \"a\" depends on \"b\", which is not in the list"},
        BadList{"cmd \"a\" { exec = \"x\"; depends_on = \"a\"; }",
                ": command \"a\" is part of a dependency cycle"},
        BadList{"cmd \"a\" { exec = \"x\"; depends_on = \"b\"; }"
                "cmd \"b\" { exec = \"x\"; depends_on = \"c\"; }"
                "cmd \"c\" { exec = \"x\"; depends_on = \"b\"; }",
                ": command \"b\" is part of a dependency cycle"},
        BadList{"script \"s\" { stop cmd \"x\"; }", ": script \"s\": no command \"x\""},
        BadList{"script \"s\" { stop group \"x\"; }", ": script \"s\": no group \"x\""},
        BadList{"script \"s\" { run_script \"t\"; }", ": script \"s\": no script \"t\""},
        BadList{"script \"s\" { run_script \"t\"; } script \"t\" { run_script \"s\"; }",
                ": script \"s\" is part of a call cycle"}));

TEST(ProcessListParser, AcceptsASharedDependency) {
  EXPECT_EQ(parse(R"(cmd "a" { exec = "x"; depends_on = "b", "c"; }
    cmd "b" { exec = "x"; depends_on = "d"; } cmd "c" { exec = "x"; depends_on = "d"; }
    cmd "d" { exec = "x"; })")
                .commands.size(),
            4U);
}

TEST(ProcessListParser, RejectsGroupsNestedTooDeep) {
  std::string text;
  for (int i = 0; i < 20; ++i) text += "group \"g\" { ";
  try {
    parse(text);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("more than sixteen levels deep"));
  }
}

TEST(ProcessListParser, ReadsAFileAndRejectsAMissingOne) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "list.cfg") << "cmd \"a\" { exec = \"x\"; }";
  EXPECT_EQ(read_process_list(folder / "list.cfg").commands.size(), 1U);
  EXPECT_THROW(read_process_list(folder / "none.cfg"), ConfigError);
}

TEST(ProcessListWriter, WritesAListThatParsesToTheSame) {
  const ProcessList list = parse(R"(
cmd "first \"one\"" { exec = "A=B x 'y z' \\ \n"; deputy = "far"; }
group "a" {
  cmd "2" { exec = "x"; auto_respawn = "true"; stop_signal = 15; stop_time_allowed = 0.25; }
  group "b" { cmd "3" { exec = "x"; depends_on = "2", "4"; restart_limit = 0; alive_channel = "POSE";
                        alive_rate_hz = "3.3"; start_timeout_s = "1e-5"; answer_channel = "POSE";
                        answers_to = "IMU", "TILT_REAR"; answer_timeout_s = 2.5;
                        answers_late = "true"; } }
}
cmd "4" { exec = "x"; }
script "go" {
  start group "a/b" wait "running" timeout_s 1.5; wait ms 500; stop cmd "4" wait "stopped";
  restart everything; wait cmd "3" status "running" timeout_s 2; run_script "other";
}
script "other" { stop everything; })");
  const std::string text = to_text(list);
  EXPECT_EQ(parse(text), list) << text;
  EXPECT_EQ(to_text(parse(text)), text);
}

}  // namespace
}  // namespace adit
