// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/config/bounds.hpp"

namespace adit {

struct StubChoiceParams {
  double approach_m = 5.0;   ///< added to every way, so that what is near does not win by nothing
  double switch_gain = 0.2;  ///< by which share another stub has to be better than the target
  double home_factor = 1.5;  ///< on the way home: it may be longer than the map says
  double reserve_m = 20.0;   ///< that is never spent

  template <class V>
  void visit(V& v) {
    v("approach_m", approach_m, above(0.0));
    v("switch_gain", switch_gain, within(0.0, 10.0));
    v("home_factor", home_factor, within(1.0, 10.0));
    v("reserve_m", reserve_m, at_least(0.0));
  }
};

/// A stub as it is weighed.
struct StubOffer {
  int stub = 0;
  double gain_m = 0.0;  ///< new corridor to be expected there
  double way_m = 0.0;   ///< from here
  double home_m = 0.0;  ///< from there
};

/// Whether one can go there, look on for `step_m`, and be home within the budget.
bool is_within_budget(const StubOffer& offer, double step_m, double remaining_m,
                      const StubChoiceParams& params);

/// Expected new corridor per metre of way.
double worth(const StubOffer& offer, const StubChoiceParams& params);

/// The stub that is worth most, of those given; the target unless another is better by the share of
/// the parameters. Of equals that with the lower id. Nothing where there are none.
std::optional<int> choose_stub(const std::vector<StubOffer>& offers, std::optional<int> target,
                               const StubChoiceParams& params);

}  // namespace adit
