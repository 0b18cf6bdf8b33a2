// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/report_teller.hpp"

#include <iostream>
#include <optional>
#include <string>

#include "tools/adit/progress_bar.hpp"

namespace adit {

void tell_report(const ReportOptions& options) {
  std::optional<ProgressBar> bar;
  std::string shown;
  const MissionReport result = write_report(options, [&](const std::string& label, double done) {
    if (label != shown) bar.emplace(label);
    shown = label;
    bar->update(done);
  });
  bar.reset();
  for (const std::string& sentence : result.complaints) std::cerr << "adit: " << sentence << "\n";
  std::cout << (options.folder / "mission.html").string() << ": " << result.outcome << std::endl;
}

}  // namespace adit
