// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <functional>

#include <gtest/gtest.h>

#include "common/messages/association.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/planar.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::information;
using test::kNaN;
using test::kUtime;
using test::over_the_wire;

MapCorrection correction() { return {kUtime, 12, 1, 40, {0.3, -0.2, 0.01}, information()}; }

Association association() {
  Association result;
  result.utime = kUtime;
  result.action = Association::Action::kRevised;
  result.closure = {
      3,
      40,
      {{7, {0.4, 0.1, 0.0}, information(), 31.0}, {9, {0.0, 0.0, 0.1}, information(), 12.0}}};
  result.chosen = Association::kNone;
  result.chosen_before = 1;
  result.log_likelihood = -120.5;
  result.reason = "the corner does not agree";
  return result;
}

std::string_view refusal_after(const std::function<void(map_correction_t&)>& change) {
  map_correction_t message = to_message(correction());
  change(message);
  return from_message(message).refusal();
}

std::string_view refusal_after(const std::function<void(association_t&)>& change) {
  association_t message = to_message(association());
  change(message);
  return from_message(message).refusal();
}

TEST(MapCorrectionMessage, GoesThereAndBack) {
  EXPECT_EQ(*over_the_wire(correction()), correction());
}

TEST(MapCorrectionMessage, SaysThatItsCovarianceIsUnknown) {
  MapCorrection without = correction();
  without.covariance.reset();
  EXPECT_EQ(*over_the_wire(without), without);
}

TEST(MapCorrectionMessage, IsRefusedWithNumbersThatMeanNothing) {
  using Message = map_correction_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](Message& m) { m.revision = -1; }), "negative revision");
  EXPECT_EQ(refusal_after([](Message& m) { m.session = -1; }), "negative id or session");
  EXPECT_EQ(refusal_after([](Message& m) { m.local_map = -1; }), "negative id or session");
  EXPECT_EQ(refusal_after([](Message& m) { m.T_map_odom[2] = kNaN; }), kPoseNotFinite);
  EXPECT_EQ(refusal_after([](Message& m) { m.covariance[0][0] = -1.0; }), "no covariance matrix");
}

TEST(AssociationMessage, GoesThereAndBack) {
  EXPECT_EQ(*over_the_wire(association()), association());
}

TEST(AssociationMessage, MayHaveNoAlternatives) {
  Association none = association();
  none.closure.alternatives.clear();
  none.chosen_before = Association::kNone;
  EXPECT_EQ(*over_the_wire(none), none);
}

TEST(AssociationMessage, IsRefusedWithAChoiceThatIsNoAlternative) {
  for (const int chosen : {-2, 2, INT32_MAX}) {
    EXPECT_EQ(refusal_after([&](association_t& m) { m.chosen = chosen; }),
              "choice is no alternative");
    EXPECT_EQ(refusal_after([&](association_t& m) { m.chosen_before = chosen; }),
              "choice is no alternative");
  }
}

TEST(AssociationMessage, IsRefusedWithAlternativesThatMeanNothing) {
  using Message = association_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.alternatives[1].older_map = 40; }),
            "alternative is no older map");
  EXPECT_EQ(refusal_after([](Message& m) { m.alternatives[1].older_map = -1; }),
            "alternative is no older map");
  EXPECT_EQ(refusal_after([](Message& m) { m.alternatives[1].T_older_newer[0] = kNaN; }),
            kPoseNotFinite);
  EXPECT_EQ(refusal_after([](Message& m) { m.alternatives[1].information[0][0] = -1.0; }),
            kNoInformation);
  EXPECT_EQ(refusal_after([](Message& m) { m.alternatives[1].log_likelihood = kNaN; }),
            "likelihood is not finite");
  EXPECT_EQ(refusal_after([](Message& m) {
              m.alternatives.resize(501, m.alternatives[0]);
              m.n_alternatives = 501;
            }),
            "more alternatives than plausible");
}

TEST(AssociationMessage, IsRefusedWithNumbersThatMeanNothing) {
  using Message = association_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](Message& m) { m.action = 2; }), "unknown action");
  EXPECT_EQ(refusal_after([](Message& m) { m.closure = -1; }), "negative id");
  EXPECT_EQ(refusal_after([](Message& m) { m.newer_map = -1; }), "negative id");
  EXPECT_EQ(refusal_after([](Message& m) { m.log_likelihood = kNaN; }), "likelihood is not finite");
}

}  // namespace
}  // namespace adit
