// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tools/report/report.hpp"

namespace adit {

/// write_report with a bar for what it is at; what the log lacks goes to standard error, and where
/// the page is and how the mission went to standard output. Throws as write_report does.
void print_report(const ReportOptions& options);

}  // namespace adit
