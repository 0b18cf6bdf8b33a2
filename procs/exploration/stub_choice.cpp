// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/stub_choice.hpp"

namespace adit {

bool is_within_budget(const StubOffer& offer, double step_m, double remaining_m,
                      const StubChoiceParams& params) {
  const double home_m = params.home_factor * (offer.home_m + step_m);
  return offer.way_m + step_m + home_m + params.reserve_m <= remaining_m;
}

double worth(const StubOffer& offer, const StubChoiceParams& params) {
  return offer.gain_m / (offer.way_m + params.approach_m);
}

std::optional<int> choose_stub(const std::vector<StubOffer>& offers, std::optional<int> target,
                               const StubChoiceParams& params) {
  const StubOffer* best = nullptr;
  double most = 0.0;
  for (const StubOffer& offer : offers) {
    const double favour = target == offer.stub ? 1.0 + params.switch_gain : 1.0;
    const double value = favour * worth(offer, params);
    if (best != nullptr && (value < most || (value == most && offer.stub > best->stub))) continue;
    best = &offer;
    most = value;
  }
  return best == nullptr ? std::nullopt : std::optional(best->stub);
}

}  // namespace adit
