// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/association.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/planar_geometry.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::information;
using test::kNaN;
using test::kUtime;
using test::round_trip;

MapCorrection correction() { return {kUtime, 12, 1, 40, {0.3, -0.2, 0.01}, information()}; }

Association association() {
  Association result;
  result.utime = kUtime;
  result.action = Association::Action::kRevised;
  result.loop_closure = {
      3,
      40,
      {{7, {0.4, 0.1, 0.0}, information(), 31.0}, {9, {0.0, 0.0, 0.1}, information(), 12.0}}};
  result.chosen = Association::kNone;
  result.previously_chosen = 1;
  result.log_likelihood = -120.5;
  result.reason = "the corner does not agree";
  return result;
}

std::string_view rejection_after(const std::function<void(map_correction_t&)>& change) {
  map_correction_t message = to_message(correction());
  change(message);
  return from_message(message).rejection();
}

std::string_view rejection_after(const std::function<void(association_t&)>& change) {
  association_t message = to_message(association());
  change(message);
  return from_message(message).rejection();
}

TEST(MapCorrectionMessage, SurvivesARoundTrip) {
  EXPECT_EQ(*round_trip(correction()), correction());
}

TEST(MapCorrectionMessage, MayHaveNoCovariance) {
  MapCorrection without = correction();
  without.covariance.reset();
  EXPECT_EQ(*round_trip(without), without);
}

TEST(MapCorrectionMessage, IsRejectedWithInvalidNumbers) {
  using Message = map_correction_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.revision = -1; }), "negative revision");
  EXPECT_EQ(rejection_after([](Message& m) { m.session = -1; }), "negative id or session");
  EXPECT_EQ(rejection_after([](Message& m) { m.local_map = -1; }), "negative id or session");
  EXPECT_EQ(rejection_after([](Message& m) { m.T_map_odom[2] = kNaN; }), kImplausibleHeading);
  EXPECT_EQ(rejection_after([](Message& m) { m.covariance[0][0] = -1.0; }), kInvalidCovariance);
}

TEST(AssociationMessage, SurvivesARoundTrip) {
  EXPECT_EQ(*round_trip(association()), association());
}

TEST(AssociationMessage, MayHaveNoAlternatives) {
  Association none = association();
  none.loop_closure.alternatives.clear();
  none.previously_chosen = Association::kNone;
  EXPECT_EQ(*round_trip(none), none);
}

TEST(AssociationMessage, IsRejectedWithAnInvalidChoice) {
  for (const int chosen : {-2, 2, INT32_MAX}) {
    EXPECT_EQ(rejection_after([&](association_t& m) { m.chosen = chosen; }),
              "choice is not an alternative");
    EXPECT_EQ(rejection_after([&](association_t& m) { m.previously_chosen = chosen; }),
              "choice is not an alternative");
  }
}

TEST(AssociationMessage, IsRejectedWithInvalidAlternatives) {
  using Message = association_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.alternatives[1].older_map = 40; }),
            "alternative is not an older map");
  EXPECT_EQ(rejection_after([](Message& m) { m.alternatives[1].older_map = -1; }),
            "alternative is not an older map");
  EXPECT_EQ(rejection_after([](Message& m) { m.alternatives[1].T_older_newer[0] = kNaN; }),
            kImplausiblePosition);
  EXPECT_EQ(rejection_after([](Message& m) { m.alternatives[1].information[0][0] = -1.0; }),
            kInvalidInformation);
  EXPECT_EQ(rejection_after([](Message& m) { m.alternatives[1].log_likelihood = kNaN; }),
            "implausible likelihood");
  EXPECT_EQ(rejection_after([](Message& m) {
              m.alternatives.resize(501, m.alternatives[0]);
              m.n_alternatives = 501;
            }),
            "implausible number of alternatives");
}

TEST(AssociationMessage, IsRejectedWithInvalidNumbers) {
  using Message = association_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.action = 2; }), "unknown action");
  EXPECT_EQ(rejection_after([](Message& m) { m.loop_closure = -1; }), "negative id");
  EXPECT_EQ(rejection_after([](Message& m) { m.newer_map = -1; }), "negative id");
  EXPECT_EQ(rejection_after([](Message& m) { m.log_likelihood = kNaN; }), "implausible likelihood");
}

MapContradictions contradictions() { return {kUtime, 12, {{3, 40, 55.5}, {4, 41, 31.25}}}; }

std::string_view rejection_after(const std::function<void(map_contradictions_t&)>& change) {
  map_contradictions_t message = to_message(contradictions());
  change(message);
  return from_message(message).rejection();
}

TEST(MapContradictionsMessage, SurvivesARoundTrip) {
  EXPECT_EQ(*round_trip(contradictions()), contradictions());
}

TEST(MapContradictionsMessage, HoldsThePairsWithTheMostEvidence) {
  MapContradictions many{kUtime, 12, {}};
  for (int i = 0; i < 3000; ++i) many.pairs.push_back({i, i + 1, static_cast<double>(i)});
  const map_contradictions_t message = to_message(many);
  ASSERT_EQ(message.n_pairs, 1000);
  EXPECT_EQ(message.older_maps.front(), 2999);
  EXPECT_TRUE(from_message(message));
}

TEST(MapContradictionsMessage, IsRejectedWithInvalidNumbers) {
  using Message = map_contradictions_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.n_pairs = 1001; }), "implausible number of pairs");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_pairs = -1; }), "implausible number of pairs");
  EXPECT_EQ(rejection_after([](Message& m) { m.older_maps[1] = 41; }),
            "pair is not an older and a newer map");
  EXPECT_EQ(rejection_after([](Message& m) { m.older_maps[1] = -1; }),
            "pair is not an older and a newer map");
  EXPECT_EQ(rejection_after([](Message& m) { m.evidence[0] = kNaN; }), "implausible likelihood");
}

}  // namespace
}  // namespace adit
