// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/check_driver/check_result.hpp"

namespace adit {

/// "property: text" of those that are bad.
inline std::vector<std::string> bad(const CheckResults& results) {
  std::vector<std::string> lines;
  for (const CheckResult& result : results) {
    if (result.verdict == CheckResult::Verdict::kBad)
      lines.push_back(result.property + ": " + result.text);
  }
  return lines;
}

}  // namespace adit
