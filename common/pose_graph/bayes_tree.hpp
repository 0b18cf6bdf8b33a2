// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// The minimum of a sum of quadratic terms, Σ xᵀ H x − 2 bᵀ x, over blocks of unknowns, kept up to
/// date at the cost of what changes: the Bayes tree (Kaess, Johannsson, Roberts, Ila, Leonard,
/// Dellaert, "iSAM2", IJRR 2012). Each clique stores its rows of the Cholesky factor and what it
/// adds to the cliques above, so that a changed term costs the cliques from its blocks up to the
/// root. The blocks of these are ordered again, by minimum degree and least height, so that a chain
/// becomes a balanced tree; the newest block is eliminated last. No rounding errors accumulate:
/// cliques are eliminated from the terms themselves and from whole cliques below.
///
/// Changes take effect with `update`; queries before it are a bug. Deterministic.
class BayesTree {
 public:
  BayesTree(int block_size, double unchanged) : size_(block_size), unchanged_(unchanged) {}

  struct Term {
    std::vector<int> blocks;
    Eigen::MatrixXd H;  ///< symmetric, of blocks.size() · block_size rows
    Eigen::VectorXd b;
  };

  /// Adds a block; returns its index. `last`: it is eliminated after all others, as fits one that
  /// has terms with many others.
  int add_block(bool last = false);
  /// Removes the newest block, after all of its terms.
  void remove_newest_block();
  [[nodiscard]] int blocks() const { return static_cast<int>(clique_of_.size()); }

  /// Returns an id of the term.
  int add_term(Term term);
  /// Replaces a term by another one of the same blocks.
  void set_term(int id, Eigen::MatrixXd H, Eigen::VectorXd b);
  void remove_term(int id);

  /// Eliminates what changed and solves for what moves by it: the unknowns of a clique keep their
  /// values while those of its separator stay within `unchanged` of where they were solved.
  /// `only_ends`: all that was added are blocks, each with one term that determines it relative to
  /// at most one older block, so that nothing else moves or is known better. False if the terms do
  /// not determine all blocks; the tree then is unusable.
  [[nodiscard]] bool update(bool only_ends = false);

  /// The minimising x of a block.
  [[nodiscard]] Eigen::Map<const Eigen::VectorXd> solution(int block) const {
    return {x_.data() + row(block), size_};
  }
  /// The blocks that moved in the last update, ascending.
  [[nodiscard]] const std::vector<int>& moved() const { return moved_; }
  /// Σ bᵀ x at the minimum: the decrease of the sum from x = 0.
  [[nodiscard]] double decrease() const;

  /// The covariance matrix (Σ H)⁻¹ of a block.
  [[nodiscard]] Eigen::MatrixXd covariance(int block) const;
  /// The covariance of two blocks with each other: rows of `a`, columns of `b`. What was computed
  /// of the paths from both to the root serves later queries until the covariances change.
  [[nodiscard]] Eigen::MatrixXd covariance(int a, int b) const;

  /// Number of blocks that the last update eliminated.
  [[nodiscard]] int eliminated() const { return eliminated_; }
  /// Number of cliques on the longest path from a root.
  [[nodiscard]] int height() const;

 private:
  struct Clique {
    std::vector<int> frontals;   // in order of elimination
    std::vector<int> separator;  // ascending
    int parent = -1;
    std::vector<int> children;
    std::vector<int> terms;  // of which a frontal is eliminated first
    int height = 1;
    Eigen::MatrixXd R;       // rows of the factor: R_F, upper triangular, and R_S
    Eigen::VectorXd y;       // R x = y
    Eigen::MatrixXd update;  // H and b that remain for the separator
    Eigen::VectorXd update_b;
    double decrease = 0.0;        // of this clique and all below
    Eigen::VectorXd x_separator;  // for which the frontals were solved
    // On demand:
    mutable int covariance_version = -1;
    mutable Eigen::MatrixXd covariance;  // of frontals and separator
    mutable int cross_version = -1;
    mutable Eigen::MatrixXd cross;  // covariance of the frontals with the last block asked for
  };
  struct Ordering;

  [[nodiscard]] Eigen::Index row(int block) const { return Eigen::Index{size_} * block; }
  [[nodiscard]] Eigen::VectorXd gather(const std::vector<int>& blocks) const;
  void touch(int block);
  [[nodiscard]] std::vector<int> detach(std::vector<int>& blocks, std::vector<int>& terms);
  [[nodiscard]] Ordering order(const std::vector<int>& blocks, const std::vector<int>& terms,
                               const std::vector<int>& orphans);
  [[nodiscard]] std::vector<int> form_cliques(const Ordering& ordering);
  void adopt(const Ordering& ordering, const std::vector<int>& terms,
             const std::vector<int>& orphans);
  [[nodiscard]] int new_clique();
  [[nodiscard]] bool eliminate(Clique& clique);
  void solve(const std::vector<int>& fresh);
  void solve(Clique& clique);
  void solve_ends(const std::vector<int>& ends, const std::vector<int>& fresh);
  [[nodiscard]] Eigen::MatrixXd sub_covariance(const Clique& clique, const std::vector<int>& rows,
                                               const std::vector<int>& columns) const;
  [[nodiscard]] const Eigen::MatrixXd& joint_covariance(int clique) const;
  [[nodiscard]] const Eigen::MatrixXd& cross_covariance(int clique, int block) const;
  [[nodiscard]] bool is_above(int upper, int lower) const;
  [[nodiscard]] Eigen::MatrixXd covariance_across(int a, int b) const;

  int size_;
  double unchanged_;
  std::vector<Term> terms_;
  std::vector<int> free_terms_;
  std::vector<bool> is_last_;     // of each block
  std::vector<int> clique_of_;    // of each block in the tree, or −1
  std::vector<double> diagonal_;  // of H, by row
  std::vector<Clique> cliques_;
  std::vector<int> free_cliques_;
  std::set<int> roots_;
  std::vector<int> touched_;     // cliques
  std::vector<int> new_blocks_;  // in no clique yet
  std::vector<int> new_terms_;
  std::vector<double> x_;
  std::vector<int> moved_;
  int eliminated_ = 0;
  std::vector<int> place_;  // scratch, of each block; −1
  int version_ = 0;         // of the covariances
  mutable int cross_version_ = 0;
  mutable int cross_block_ = -1;
};

}  // namespace adit
