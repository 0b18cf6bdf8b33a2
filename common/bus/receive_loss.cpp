// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/receive_loss.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "common/config/number_text.hpp"

namespace adit {

double receive_loss_share() {
  const char* const text = std::getenv("ADIT_RECEIVE_LOSS");
  if (text == nullptr) return 0.0;
  const auto share = parse_number<double>(text);
  if (!share || !(*share >= 0.0 && *share < 1.0)) {
    throw std::invalid_argument("ADIT_RECEIVE_LOSS: '" + std::string(text) +
                                "' is no share from 0 to 1");
  }
  return *share;
}

}  // namespace adit
