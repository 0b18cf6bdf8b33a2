// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Every option of every command that takes a number rejects what is not a plausible number. The
// test finds the options in the command line itself, so that a new one is tested, too.
#include <exception>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include <CLI/App.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/command_line/command_line.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/adit/command_result.hpp"
#include "tools/adit/adit_app.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// What an option that is text calls its value in the help.
const std::set<std::string> kTextTypes{"AXIS", "DIR",  "FAULT", "FILE",     "FRAME", "NAME", "PATH",
                                       "PNG",  "TEXT", "URL",   "STAGE,..", "TOPIC", "WORLD"};

void visit_options(const CLI::App& app, const std::string& path,
                   const std::function<void(const std::string&, const CLI::Option&)>& visit) {
  for (const CLI::Option* option : app.get_options()) visit(path, *option);
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    visit_options(*command, path + " " + command->get_name(), visit);
  }
}

/// Whether the option with this value passes its checks and its conversion.
bool accepts(const std::string& command, const std::string& name, const std::string& value) {
  const auto app = make_adit_app();
  bool accepted = false;
  visit_options(*app, "adit", [&](const std::string& path, const CLI::Option& option) {
    if (path != command || option.get_name() != name) return;
    auto& changed = const_cast<CLI::Option&>(option);  // the tree is of this function
    try {
      changed.add_result(value);
      changed.run_callback();
      accepted = true;
    } catch (const std::exception&) {
      accepted = false;
    }
  });
  return accepted;
}

TEST(AditOptions, RejectNumbersThatAreNotPlausible) {
  const auto app = make_adit_app();
  int numbers = 0;
  visit_options(*app, "adit", [&](const std::string& path, const CLI::Option& option) {
    const bool is_flag = option.get_items_expected_max() == 0;
    if (is_flag || kTextTypes.contains(option.get_type_name())) return;
    ++numbers;
    for (const char* value :
         {"nan", "-nan", "nan(0x1)", "inf", "-inf", "1e308", "-1e308", "1e999", "1.5x", ""}) {
      EXPECT_FALSE(accepts(path, option.get_name(), value))
          << path << " " << option.get_name() << " (" << option.get_type_name() << ") accepts '"
          << value << "'";
    }
  });
  EXPECT_GT(numbers, 20);
}

TEST(AditOptions, ReportANumberThatIsNotPlausibleInOneLine) {
  const test::ScratchFolder folder;
  const CommandResult nan = adit({"sample", folder / "x.log", "--length-m", "nan"});
  EXPECT_EQ(nan.exit_code, 2);
  EXPECT_THAT(nan.err, HasSubstr("--length-m: 'nan' is not a number in the range > 0, <= 1e+09"));
  const CommandResult control = adit({"sample", folder / "x.log", "--length-m", "\x1b[2J\n"});
  EXPECT_THAT(control.err, StartsWith("adit: --length-m: '\\x1b[2J\\n' is not a number"));
  EXPECT_EQ(control.err.find('\n'), control.err.size() - 1);
}

TEST(OptionNumber, IsFiniteAndBounded) {
  EXPECT_EQ(option_number("1.5"), 1.5);
  for (const char* text : {"nan", "inf", "1e308", "-1e10", "1,5", ""}) {
    EXPECT_EQ(option_number(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace adit
