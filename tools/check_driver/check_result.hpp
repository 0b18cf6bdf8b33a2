// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace adit {

/// Whether one property of the messages of a driver is what the stages need.
struct CheckResult {
  enum class Verdict { kGood, kBad, kUnknown };

  Verdict verdict = Verdict::kUnknown;
  std::string property;  ///< one word
  std::string text;      ///< what was found; if it is bad, behind a colon what to do
};

using CheckResults = std::vector<CheckResult>;

}  // namespace adit
