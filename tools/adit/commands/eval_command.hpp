// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace adit {

// Each adds one sub-command to `adit eval`.
void add_eval_map_command(CLI::App& eval);
void add_eval_relations_command(CLI::App& eval);

}  // namespace adit
