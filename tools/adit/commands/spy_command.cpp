// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "tools/adit/adit_app.hpp"
#include "tools/adit/lcm_spy.hpp"

namespace adit {
namespace {

constexpr const char* kSpyFooter =
    R"(Needs Java and LCM's Java programs, and says what to install where they are missing.

Examples:
  adit spy                    what is on the channels at this moment
  adit spy mine.lcmlog        the window of the log player, to play a log onto the channels)";

}  // namespace

void add_spy_command(CLI::App& adit) {
  CLI::App* spy =
      adit.add_subcommand("spy", "Look at messages: start lcm-spy, or the log player's window");
  spy->footer(kSpyFooter);
  const auto log = std::make_shared<std::optional<std::filesystem::path>>();
  spy->add_option("LOG", *log, "An LCM log to play")->type_name("FILE");
  spy->callback([log] { run_lcm_spy(*log); });
}

}  // namespace adit
