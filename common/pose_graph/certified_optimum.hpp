// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/pose_graph/pose_graph.hpp"

namespace adit {

struct CertifyParams {
  double gap_max = 1e-5;     ///< relative gap up to which a minimum counts as proven global
  int rank_max = 6;          ///< of the relaxation
  int iterations_max = 300;  ///< of each descent
  /// Relative, of each descent. The default is for the bound; better poses need less.
  double tolerance = 1e-13;
};

/// How far the poses of a graph may be from the global minimum of the objective.
struct Certificate {
  double objective = 0.0;    ///< Σ eᵀ R e of the poses
  double lower_bound = 0.0;  ///< no poses have a smaller objective; 0 if no bound was found
  /// The lower bound is the objective within CertifyParams::gap_max.
  bool is_global = false;
  /// Rank at which the relaxation was solved; 0 if the certificate of the first poses held.
  int rank = 0;
  bool replaced = false;  ///< the staircase led to better poses than those given
};

/// Finds the global minimum of the objective, with a proof or a bound of how much lower it may be.
/// The poses must be at a minimum (see `optimize`); better ones replace them.
///
/// First the certificate of the given poses is checked: weak duality of the quadratic form that
/// bounds the objective tightly there (QuadraticRelaxation), for any information matrices. It costs
/// about as much as a step of `optimize`. If it does not hold, the relaxation is solved by a
/// Riemannian staircase (Boumal 2015; Rosen et al., "SE-Sync", IJRR 2019), and its solution rounded
/// and minimised exactly. Where the certificate does not hold there either, the bound is that of
/// the relaxation, which is loose for information that is far from diag(τ, τ, w).
Certificate certify(PoseGraph& graph, const CertifyParams& params = {});

/// Whether a residual is larger than noise explains (chi-square with three degrees of freedom, 1
/// in a million): the graph has wrong constraints, or the poses are at a minimum that is not the
/// global one.
bool has_implausible_residual(const PoseGraph& graph);

}  // namespace adit
