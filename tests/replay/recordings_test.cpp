// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Public recordings against hand-verified relations: the accuracy of scan matching, compared with
// published results (docs/results/scan_matching.md), and of mapping with loop closure
// (docs/results/mapping.md).
#include "tests/support/recordings.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/replay/map_fixture.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

struct Accuracy {
  std::string name;
  std::string log;
  std::string relations;
  double with_odometry_m;     // limit of the mean translational error of scan matching
  double without_odometry_m;  // at most the published mean with odometry
  double mapped_m;            // of the map, with and without odometry: measured value plus 15 %
};

void PrintTo(const Accuracy& accuracy, std::ostream* out) { *out << accuracy.name; }

class Recording : public MapRunTest, public testing::WithParamInterface<Accuracy> {
 protected:
  /// `file` is odometry.tum or trajectory.tum.
  double mean_error_m(const std::filesystem::path& relations, const std::string& file) const {
    return score_relations(read_relations(relations), read_tum(at("map/" + file)))
        .translation_m.mean;
  }
};

TEST_P(Recording, IsAccurateByItsRelations) {
  ADIT_RECORDING_OR_SKIP(log, GetParam().log);
  ADIT_RECORDING_OR_SKIP(relations, GetParam().relations);
  map(log, "map", Odometry::kUsed);
  EXPECT_LE(mean_error_m(relations, "odometry.tum"), GetParam().with_odometry_m);
  EXPECT_LE(mean_error_m(relations, "trajectory.tum"), GetParam().mapped_m);
  map(log, "map", Odometry::kIgnored);
  EXPECT_LE(mean_error_m(relations, "odometry.tum"), GetParam().without_odometry_m);
  EXPECT_LE(mean_error_m(relations, "trajectory.tum"), GetParam().mapped_m);
}

INSTANTIATE_TEST_SUITE_P(Laser2d, Recording,
                         testing::Values(Accuracy{"Csail", "laser2d/csail_raw.log.gz",
                                                  "laser2d/csail.relations", 0.10, 0.15, 0.030},
                                         Accuracy{"Intel", "laser2d/intel_raw.log.gz",
                                                  "laser2d/intel.relations", 0.15, 0.22, 0.114},
                                         Accuracy{"Fr079", "laser2d/fr079_chain.log.gz",
                                                  "laser2d/fr079.relations", 0.10, 0.26, 0.055}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace adit
