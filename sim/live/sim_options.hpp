// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/live/live_run.hpp"

namespace CLI {
class App;
}

namespace adit {

/// The options of a live run, for `adit-sim` and `adit sim`.
void add_live_run_options(CLI::App& app, LiveRunOptions& options);

/// What both say about worlds, time and faults at the end of their help.
extern const char* const kLiveRunFooter;

}  // namespace adit
