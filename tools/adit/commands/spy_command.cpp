// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/App.hpp>

#include "common/command_line/command_line.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/lcm_spy.hpp"

namespace adit {
namespace {

constexpr const char* kSpyDetails =
    R"(Starts lcm-spy, or with LOG lcm-logplayer-gui, with the message types of this project. Requires Java and
the Java tools of LCM; an error names missing packages.)";

constexpr const char* kSpyExamples =
    R"(  adit spy                    inspect the live channels
  adit spy mine.lcmlog        play a log onto the channels)";

}  // namespace

void add_spy_command(CLI::App& adit) {
  CLI::App* spy =
      add_command(adit, "spy", "Inspect messages: start lcm-spy or the graphical log player");
  set_help(*spy, {kSpyDetails, "", kSpyExamples});
  const auto log = std::make_shared<std::optional<std::filesystem::path>>();
  spy->add_option("LOG", *log, "LCM log to play")->type_name("FILE");
  spy->callback([log] { run_lcm_spy(*log); });
}

}  // namespace adit
