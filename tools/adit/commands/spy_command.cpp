// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/App.hpp>

#include "common/command_line/command_line.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/lcm_spy.hpp"
#include "tools/mission/private_network.hpp"

namespace adit {
namespace {

constexpr const char* kSpyDetails =
    R"(Starts lcm-spy, or with LOG lcm-logplayer-gui, with the message types of this project. A right click on
LOCAL_MAP, POSE_GRAPH, TERRAIN, PATH or CLOUD offers "Draw the mine": the map with pose graph, terrain, path,
3D scan and robot. Requires Java and the Java tools of LCM; an error names missing packages.

A mission of `adit mission` is on a private network, which --mission joins; the display must then be one of
this computer.)";

/// A display over TCP, as that of ssh -X, is not in the network of a mission.
void require_local_display() {
  const char* const value = std::getenv("DISPLAY");
  const std::string display = value ? value : "";
  if (display.empty() || display.starts_with(':') || display.starts_with("unix:")) return;
  throw std::runtime_error("the display " + display +
                           " is not of this computer and cannot be reached from the private "
                           "network of a mission");
}

constexpr const char* kSpyExamples =
    R"(  adit spy                    inspect the live channels
  adit spy --mission out      the mission of `adit mission mathies --out out`
  adit spy mine.lcmlog        play a log onto the channels)";

}  // namespace

void add_spy_command(CLI::App& adit) {
  CLI::App* spy =
      add_command(adit, "spy", "Inspect messages: start lcm-spy or the graphical log player");
  set_help(*spy, {kSpyDetails, "", kSpyExamples});
  const auto log = std::make_shared<std::optional<std::filesystem::path>>();
  const auto mission = std::make_shared<std::filesystem::path>();
  CLI::Option* const file = spy->add_option("LOG", *log, "LCM log to play")->type_name("FILE");
  spy->add_option("--mission", *mission, "Output folder of a running adit mission")
      ->type_name("DIR")
      ->excludes(file);
  spy->callback([log, mission] {
    if (!mission->empty()) {
      require_local_display();
      enter_network_of_mission(*mission);
    }
    run_lcm_spy(*log);
  });
}

}  // namespace adit
