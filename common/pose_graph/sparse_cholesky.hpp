// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// The non-zero off-diagonal blocks of a symmetric matrix. Pairs may repeat and come in either
/// order; the two blocks of a pair differ.
struct BlockPattern {
  int blocks = 0;
  std::vector<std::array<int, 2>> pairs;
};

/// An order of elimination with little fill-in: the symbolic analysis, which depends on the pattern
/// only and is valid for any block size.
struct BlockOrdering {
  std::vector<int> position;       ///< position of each block in the order of elimination
  std::vector<int> column_counts;  ///< number of blocks in each column of the factor, in that order
};

/// Approximate minimum degree ordering (Amestoy, Davis, Duff 1996) on the graph of blocks, which
/// has a ninth of the entries of a matrix of 3 × 3 blocks.
BlockOrdering order_blocks(const BlockPattern& pattern);

/// A sparse symmetric positive definite matrix A of square blocks and its factorisation P A Pᵀ = L
/// D Lᵀ, by CHOLMOD (Chen, Davis, Hager, Rajamanickam, "Algorithm 887", 2008): the only class that
/// includes this library. Single-threaded and deterministic. Vectors have `blocks · block_size`
/// entries in the order of the blocks. A matrix that is not positive definite is a result; a call
/// without the required factor is a bug and aborts.
class SparseCholesky {
 public:
  /// A zero matrix.
  SparseCholesky(const BlockPattern& pattern, const BlockOrdering& ordering, int block_size);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  void set_zero();
  /// Adds M to a diagonal block; only its upper triangle is used.
  template <int S>
  void add_to_diagonal(int block, const Eigen::Matrix<double, S, S>& M) {
    const Place place = diagonal_[static_cast<std::size_t>(block)];
    double* column = values_ + place.first;
    for (int c = 0; c < S; column += place.stride + ++c) {
      for (int r = 0; r <= c; ++r) column[r] += M(r, c);
    }
  }
  /// Adds M to the block at (pair[0], pair[1]), and Mᵀ to the mirrored block.
  template <int S>
  void add_to_pair(int pair, const Eigen::Matrix<double, S, S>& M) {
    const Place place = pairs_[static_cast<std::size_t>(pair)];
    double* column = values_ + place.first;
    for (int c = 0; c < S; column += place.stride + ++c) {
      for (int r = 0; r < S; ++r) column[r] += place.mirrored ? M(c, r) : M(r, c);
    }
  }
  /// Multiplies the diagonal entries (not the diagonal blocks) by 1 + `lambda`.
  void damp(double lambda);

  /// Factorises the current A. False, without a factor, if A is not positive definite or singular
  /// to working precision; `weakest_block` names the block.
  [[nodiscard]] bool factorise();
  [[nodiscard]] bool has_factor() const;
  /// The block at which the last factorisation failed.
  [[nodiscard]] int weakest_block() const;
  /// A vector v with vᵀ A v < 0, after `factorise` failed at a negative pivot; empty if the pivot
  /// was zero to rounding.
  [[nodiscard]] Eigen::VectorXd negative_curvature() const;

  /// A⁻¹ b.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// Updates the factor to that of A + C Cᵀ, at the cost of a few columns (Davis, Hager, "Dynamic
  /// supernodes in sparse Cholesky update/downdate", 2009). C has its rows in the given blocks,
  /// which need not be a pair of the pattern: (blocks.size() · block_size) × k. Changes the factor
  /// and not A, so that `factorise` discards the update.
  [[nodiscard]] bool update(const std::vector<int>& blocks, const Eigen::MatrixXd& C);
  /// Updates the factor to that of A − C Cᵀ. False, without a factor, if it is no longer positive
  /// definite.
  [[nodiscard]] bool downdate(const std::vector<int>& blocks, const Eigen::MatrixXd& C);

  /// The columns of A⁻¹ of a block: all rows × block_size.
  [[nodiscard]] Eigen::MatrixXd inverse_columns(int block) const;
  /// The submatrix of A⁻¹ with rows and columns in the given blocks. Solves only along their paths
  /// to the root of the elimination tree.
  [[nodiscard]] Eigen::MatrixXd inverse_among(const std::vector<int>& blocks) const;
  /// Some blocks, and the columns of L on their paths to the root of the elimination tree.
  struct Among {
    std::vector<int> blocks;
    std::vector<int> path;  ///< first columns of the blocks of L, ascending
  };
  [[nodiscard]] Among among(std::vector<int> blocks) const;
  /// The rows of these blocks of A⁻¹ b, for a vector that is zero in the other blocks: b and the
  /// result have the rows of `among.blocks` only. The cost is that of the path. Block size 3 only.
  [[nodiscard]] Eigen::VectorXd solve_among(const Among& among, const Eigen::VectorXd& b) const;
  /// All diagonal blocks of A⁻¹, by the recursion over the pattern of L (Takahashi, Fagan, Chin
  /// 1973; Björck, "Numerical methods for least squares problems", 1996, section 6.7.4). Block size
  /// 3 only.
  [[nodiscard]] std::vector<Eigen::Matrix3d> inverse_diagonal() const;

  /// The same with the blocks of A⁻¹ at these pairs, which must be in the pattern of A.
  struct SelectedInverse {
    std::vector<Eigen::Matrix3d> diagonal;
    std::vector<Eigen::Matrix3d> pairs;  ///< at (pair[0], pair[1])
  };
  [[nodiscard]] SelectedInverse selected_inverse(
      const std::vector<std::array<int, 2>>& pairs) const;

  /// Number of entries of L.
  [[nodiscard]] std::size_t factor_entries() const;

 private:
  /// Position of a block in the values: its column c begins at `first` + c · `stride` + the
  /// triangular number of c, since columns end at the diagonal.
  struct Place {
    int first = 0;
    int stride = 0;
    bool mirrored = false;
  };
  struct Cholmod;

  [[nodiscard]] bool modify(bool add, const std::vector<int>& blocks, const Eigen::MatrixXd& C);
  [[nodiscard]] bool check_pivots();
  [[nodiscard]] Eigen::Index row(int block) const { return Eigen::Index{block_size_} * block; }

  int block_size_ = 0;
  std::vector<int> position_;  // position of each block in the order of elimination
  std::vector<int> block_at_;  // block at each position
  std::vector<Place> diagonal_;
  std::vector<Place> pairs_;
  std::unique_ptr<Cholmod> cholmod_;
  double* values_ = nullptr;  // of the upper triangle of P A Pᵀ, by columns
  int weakest_block_ = -1;
  int negative_pivot_ = -1;  // column of the first one, or −1
};

}  // namespace adit
