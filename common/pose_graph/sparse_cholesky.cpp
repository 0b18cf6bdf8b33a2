// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/sparse_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <new>
#include <numeric>
#include <utility>

#include <Eigen/LU>
#include <suitesparse/cholmod.h>

namespace adit {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A pivot below this share of the original diagonal entry is zero up to rounding.
constexpr double kPivotMin = 1e-14;

void require(bool condition, const char* what) {
  if (condition) return;
  std::cerr << "SparseCholesky: " << what << "\n";
  std::abort();
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }
int triangular(int n) { return n * (n + 1) / 2; }

/// Compressed columns of a pattern.
struct Columns {
  std::vector<int> start;
  std::vector<int> rows;
};

/// The upper triangle without the diagonal, rows ascending and unique; `position` is the order of
/// elimination.
Columns upper_columns(const BlockPattern& pattern, const std::vector<int>& position) {
  std::vector<std::array<int, 2>> entries;  // column, row
  entries.reserve(pattern.pairs.size());
  for (const auto& [a, b] : pattern.pairs) {
    require(a != b, "a pair of the same block");
    entries.push_back(
        {std::max(position[at(a)], position[at(b)]), std::min(position[at(a)], position[at(b)])});
  }
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  Columns columns;
  columns.start.assign(at(pattern.blocks) + 1, 0);
  for (const auto& [column, row] : entries) {
    ++columns.start[at(column) + 1];
    columns.rows.push_back(row);
  }
  std::partial_sum(columns.start.begin(), columns.start.end(), columns.start.begin());
  return columns;
}

/// The settings and workspace of CHOLMOD.
class Common {
 public:
  Common() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
  }
  ~Common() { cholmod_finish(&common_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;

  cholmod_common* get() { return &common_; }
  /// Whether the last call found a positive definite matrix; throws std::bad_alloc if out of
  /// memory.
  bool positive_definite() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    require(common_.status >= CHOLMOD_OK, "CHOLMOD rejects its arguments");
    return common_.status != CHOLMOD_NOT_POSDEF;
  }

 private:
  cholmod_common common_{};
};

/// A CHOLMOD view of our arrays as a sparse matrix.
cholmod_sparse view(int rows, Columns& columns, double* values) {
  cholmod_sparse A{};
  A.nrow = at(rows);
  A.ncol = columns.start.size() - 1;
  A.nzmax = columns.rows.size();
  A.p = columns.start.data();
  A.i = columns.rows.data();
  A.x = values;
  A.itype = CHOLMOD_INT;
  A.xtype = values == nullptr ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

/// Expands each block to `size` columns, whose last entry is the diagonal.
Columns expand(const Columns& blocks, int size) {
  Columns columns;
  columns.start.push_back(0);
  for (std::size_t j = 0; j + 1 < blocks.start.size(); ++j) {
    for (int c = 0; c < size; ++c) {
      for (int k = blocks.start[j]; k < blocks.start[j + 1]; ++k) {
        for (int r = 0; r < size; ++r) columns.rows.push_back(size * blocks.rows[at(k)] + r);
      }
      for (int r = 0; r <= c; ++r) columns.rows.push_back(size * static_cast<int>(j) + r);
      columns.start.push_back(static_cast<int>(columns.rows.size()));
    }
  }
  return columns;
}

/// L and D in the storage of CHOLMOD: column j begins with D(j) in place of the unit diagonal, its
/// rows ascend.
struct FactorView {
  explicit FactorView(const cholmod_factor& L)
      : n(static_cast<int>(L.n)),
        start(static_cast<const int*>(L.p)),
        count(static_cast<const int*>(L.nz)),
        rows(static_cast<const int*>(L.i)),
        values(static_cast<double*>(L.x)) {}

  [[nodiscard]] double pivot(int j) const { return values[start[j]]; }
  /// Parent in the elimination tree; −1 at a root.
  [[nodiscard]] int parent(int j) const { return count[j] > 1 ? rows[start[j] + 1] : -1; }

  int n;
  const int* start;
  const int* count;
  const int* rows;
  const double* values;
};

/// Solves L x = b in place for the columns of `path`, which ascends, is closed under parent and
/// contains all non-zeros of b.
template <class Rows>
void solve_forward(const FactorView& L, const std::vector<int>& path, Rows& x) {
  for (const int j : path) {
    for (int k = L.start[j] + 1; k < L.start[j] + L.count[j]; ++k) {
      x.row(L.rows[k]) -= L.values[k] * x.row(j);
    }
  }
}

/// Solves D Lᵀ x = b in place for the columns of `path`, which does not depend on others.
void solve_backward(const FactorView& L, const std::vector<int>& path, RowMajor& x) {
  for (auto j = path.rbegin(); j != path.rend(); ++j) {
    x.row(*j) /= L.pivot(*j);
    for (int k = L.start[*j] + 1; k < L.start[*j] + L.count[*j]; ++k) {
      x.row(*j) -= L.values[k] * x.row(L.rows[k]);
    }
  }
}

void solve_vector(const FactorView& L, Eigen::VectorXd& x) {
  for (int j = 0; j < L.n; ++j) {
    const double x_j = x[j];
    for (int k = L.start[j] + 1; k < L.start[j] + L.count[j]; ++k) {
      x[L.rows[k]] -= L.values[k] * x_j;
    }
  }
  for (int j = L.n - 1; j >= 0; --j) {
    double x_j = x[j] / L.pivot(j);
    for (int k = L.start[j] + 1; k < L.start[j] + L.count[j]; ++k) {
      x_j -= L.values[k] * x[L.rows[k]];
    }
    x[j] = x_j;
  }
}

/// Three columns of a factor of 3 × 3 blocks, which share the rows below the block.
class BlockColumn {
 public:
  BlockColumn(const FactorView& L, int j)
      : j_(j),
        below_(L.count[j] - 3),
        rows_(L.rows + L.start[j] + 3),
        a_(L.values + L.start[j] + 3),
        b_(L.values + L.start[j + 1] + 2),
        c_(L.values + L.start[j + 2] + 1) {}

  /// One step of L x = b in place.
  void forward(double* x) const {
    const double x0 = x[j_];
    const double x1 = x[j_ + 1] -= a_[-2] * x0;
    const double x2 = x[j_ + 2] -= a_[-1] * x0 + b_[-1] * x1;
    for (int k = 0; k < below_; ++k) x[rows_[k]] -= a_[k] * x0 + b_[k] * x1 + c_[k] * x2;
  }

  /// One step of D Lᵀ x = b in place.
  void backward(double* x) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < below_; ++k) sum += x[rows_[k]] * Eigen::Vector3d(a_[k], b_[k], c_[k]);
    x[j_ + 2] = x[j_ + 2] / c_[-1] - sum[2];
    x[j_ + 1] = x[j_ + 1] / b_[-2] - sum[1] - b_[-1] * x[j_ + 2];
    x[j_] = x[j_] / a_[-3] - sum[0] - a_[-2] * x[j_ + 1] - a_[-1] * x[j_ + 2];
  }

 private:
  int j_;
  int below_;
  const int* rows_;
  const double* a_;
  const double* b_;
  const double* c_;
};

void solve_vector_by_blocks(const FactorView& L, Eigen::VectorXd& x) {
  for (int j = 0; j < L.n; j += 3) BlockColumn(L, j).forward(x.data());
  for (int j = L.n - 3; j >= 0; j -= 3) BlockColumn(L, j).backward(x.data());
}

/// The columns from the given ones up to the roots, ascending.
std::vector<int> path_to_root(const FactorView& L, const std::vector<int>& from) {
  std::vector<char> seen(at(L.n), 0);
  std::vector<int> path;
  for (int j : from) {
    for (; j >= 0 && seen[at(j)] == 0; j = L.parent(j)) {
      seen[at(j)] = 1;
      path.push_back(j);
    }
  }
  std::sort(path.begin(), path.end());
  return path;
}

/// Eᵀ A⁻¹ E = (L⁻¹ E)ᵀ D⁻¹ (L⁻¹ E) for the unit vectors E of these columns, as many as N if that is
/// fixed. `zeros` holds zeros before and after, so that the cost is that of the path.
template <int N>
Eigen::MatrixXd inverse_along(const FactorView& L, const std::vector<int>& path,
                              const std::vector<int>& columns, std::vector<double>& zeros) {
  const auto size = static_cast<Eigen::Index>(columns.size());
  zeros.resize(std::max(zeros.size(), at(L.n) * columns.size()), 0.0);
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, N, Eigen::RowMajor>> x(zeros.data(), L.n, size);
  for (Eigen::Index k = 0; k < size; ++k) x(columns[static_cast<std::size_t>(k)], k) = 1.0;
  solve_forward(L, path, x);
  Eigen::Matrix<double, N, N> inverse = Eigen::Matrix<double, N, N>::Zero(size, size);
  for (const int j : path) {
    inverse += x.row(j).transpose() * (x.row(j) / L.pivot(j));
    x.row(j).setZero();
  }
  return inverse;
}

/// The factor in blocks of three columns: A = U D Uᵀ with U unit lower triangular by blocks.
class BlockFactor {
 public:
  explicit BlockFactor(const FactorView& L) : blocks_(L.n / 3) {
    start_.push_back(0);
    for (int b = 0; b < blocks_; ++b) append(L, b);
  }

  /// The blocks of the inverse Z on the diagonal and at `pairs`, (row, column) below it: from Z =
  /// D⁻¹ U⁻¹ + Z (I − Uᵀ)… restricted to the pattern, Z_ij = −Σ_k Z_ik U_kj and Z_jj = D_j⁻¹ − Σ_k
  /// U_kjᵀ Z_kj, columns from the last to the first.
  [[nodiscard]] SparseCholesky::SelectedInverse inverse(
      const std::vector<std::array<int, 2>>& pairs) const {
    std::vector<Eigen::Matrix3d> diagonal(at(blocks_));
    std::vector<Eigen::Matrix3d> Z(U_.size());
    std::vector<int> place(at(blocks_), -1);
    for (int j = blocks_ - 1; j >= 0; --j) {
      const int first = start_[at(j)];
      const int end = start_[at(j) + 1];
      for (int k = first; k < end; ++k) place[at(rows_[at(k)])] = k;
      for (int k = first; k < end; ++k) Z[at(k)].setZero();
      for (int k = first; k < end; ++k) {
        const int column = rows_[at(k)];
        Z[at(k)].noalias() -= diagonal[at(column)] * U_[at(k)];
        for (int l = start_[at(column)]; l < start_[at(column) + 1]; ++l) {
          const int m = place[at(rows_[at(l)])];
          if (m < 0) continue;
          Z[at(m)].noalias() -= Z[at(l)] * U_[at(k)];
          Z[at(k)].noalias() -= Z[at(l)].transpose() * U_[at(m)];
        }
      }
      diagonal[at(j)] = D_[at(j)].inverse();
      for (int k = first; k < end; ++k) {
        diagonal[at(j)].noalias() -= U_[at(k)].transpose() * Z[at(k)];
        place[at(rows_[at(k)])] = -1;
      }
    }
    std::vector<Eigen::Matrix3d> selected;
    selected.reserve(pairs.size());
    for (const auto& [row, column] : pairs) {
      const auto begin = rows_.begin() + start_[at(column)];
      const auto end = rows_.begin() + start_[at(column) + 1];
      const auto found = std::lower_bound(begin, end, row);
      require(found != end && *found == row, "a pair outside the pattern");
      selected.push_back(Z[static_cast<std::size_t>(found - rows_.begin())]);
    }
    return {std::move(diagonal), std::move(selected)};
  }

 private:
  /// L is unit lower triangular within the block as well: L_j. Then D = L_j diag L_jᵀ, U = L L_j⁻¹.
  void append(const FactorView& L, int b) {
    const int j = 3 * b;
    const int s0 = L.start[j];
    const int s1 = L.start[j + 1];
    const int s2 = L.start[j + 2];
    require(L.count[j] == L.count[j + 1] + 1 && L.count[j] == L.count[j + 2] + 2 &&
                L.count[j] % 3 == 0 && L.rows[s0 + 1] == j + 1 && L.rows[s0 + 2] == j + 2,
            "the factor does not consist of blocks");
    Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
    unit(1, 0) = L.values[s0 + 1];
    unit(2, 0) = L.values[s0 + 2];
    unit(2, 1) = L.values[s1 + 1];
    const Eigen::Vector3d pivots(L.pivot(j), L.pivot(j + 1), L.pivot(j + 2));
    D_.emplace_back(unit * pivots.asDiagonal() * unit.transpose());
    for (int k = 3; k < L.count[j]; k += 3) {
      rows_.push_back(L.rows[s0 + k] / 3);
      Eigen::Matrix3d block;
      for (int r = 0; r < 3; ++r) {
        block.row(r) << L.values[s0 + k + r], L.values[s1 + k - 1 + r], L.values[s2 + k - 2 + r];
      }
      U_.push_back(block * unit.inverse());
    }
    start_.push_back(static_cast<int>(rows_.size()));
  }

  int blocks_;
  std::vector<int> start_;
  std::vector<int> rows_;
  std::vector<Eigen::Matrix3d> U_;
  std::vector<Eigen::Matrix3d> D_;
};

}  // namespace

BlockOrdering order_blocks(const BlockPattern& pattern) {
  BlockOrdering ordering;
  ordering.position.resize(at(pattern.blocks));
  std::iota(ordering.position.begin(), ordering.position.end(), 0);
  Columns columns = upper_columns(pattern, ordering.position);
  cholmod_sparse A = view(pattern.blocks, columns, nullptr);
  A.stype = 1;
  Common common;
  cholmod_factor* L = cholmod_analyze(&A, common.get());
  require(common.positive_definite() && L != nullptr, "no ordering");
  for (int i = 0; i < pattern.blocks; ++i) {
    ordering.position[at(static_cast<const int*>(L->Perm)[i])] = i;
    ordering.column_counts.push_back(static_cast<const int*>(L->ColCount)[i]);
  }
  cholmod_free_factor(&L, common.get());
  return ordering;
}

struct SparseCholesky::Cholmod {
  Cholmod() = default;
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  ~Cholmod() { cholmod_free_factor(&L, common.get()); }

  /// The matrix is already in the order of elimination, so that CHOLMOD need not permute.
  void allocate_factor(const BlockOrdering& ordering, int block_size) {
    L = cholmod_allocate_factor(ordering.position.size() * at(block_size), common.get());
    require(common.positive_definite() && L != nullptr, "no factor");
    auto* counts = static_cast<int*>(L->ColCount);
    for (const int blocks : ordering.column_counts) {
      for (int c = 0; c < block_size; ++c) *counts++ = block_size * blocks - c;
    }
  }

  Common common;
  Columns columns;
  std::vector<double> values;
  std::vector<double> zeros;  // of inverse_along
  cholmod_factor* L = nullptr;
  bool has_factor = false;
};

SparseCholesky::SparseCholesky(const BlockPattern& pattern, const BlockOrdering& ordering,
                               int block_size)
    : block_size_(block_size),
      position_(ordering.position),
      block_at_(ordering.position.size()),
      cholmod_(std::make_unique<Cholmod>()) {
  require(position_.size() == at(pattern.blocks), "the ordering belongs to another pattern");
  for (std::size_t b = 0; b < position_.size(); ++b)
    block_at_[at(position_[b])] = static_cast<int>(b);
  const Columns blocks = upper_columns(pattern, position_);
  cholmod_->columns = expand(blocks, block_size);
  cholmod_->values.assign(cholmod_->columns.rows.size(), 0.0);
  cholmod_->allocate_factor(ordering, block_size);
  values_ = cholmod_->values.data();

  const auto place = [&](int column, int row_index) {
    const int above = block_size * (blocks.start[at(column) + 1] - blocks.start[at(column)]);
    const int first = cholmod_->columns.start[at(block_size * column)];
    return Place{first + block_size * row_index, above, false};
  };
  for (const int column : position_) {
    diagonal_.push_back(place(column, blocks.start[at(column) + 1] - blocks.start[at(column)]));
  }
  for (const auto& [a, b] : pattern.pairs) {
    const auto [row, column] = std::minmax(position_[at(a)], position_[at(b)]);
    const auto begin = blocks.rows.begin() + blocks.start[at(column)];
    const auto end = blocks.rows.begin() + blocks.start[at(column) + 1];
    pairs_.push_back(place(column, static_cast<int>(std::lower_bound(begin, end, row) - begin)));
    pairs_.back().mirrored = row != position_[at(a)];
  }
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::set_zero() {
  std::fill(cholmod_->values.begin(), cholmod_->values.end(), 0.0);
}

void SparseCholesky::damp(double lambda) {
  for (const Place& place : diagonal_) {
    for (int c = 0; c < block_size_; ++c) {
      values_[place.first + c * place.stride + triangular(c) + c] *= 1.0 + lambda;
    }
  }
}

bool SparseCholesky::factorise() {
  cholmod_sparse A = view(static_cast<int>(cholmod_->L->n), cholmod_->columns, values_);
  A.stype = 1;
  cholmod_factorize(&A, cholmod_->L, cholmod_->common.get());
  negative_pivot_ = -1;
  const bool factorised = cholmod_->common.positive_definite();
  if (!factorised) weakest_block_ = block_at_[cholmod_->L->minor / at(block_size_)];
  cholmod_->has_factor = factorised && check_pivots();
  return cholmod_->has_factor;
}

/// L D Lᵀ also exists for indefinite matrices.
bool SparseCholesky::check_pivots() {
  const FactorView L(*cholmod_->L);
  for (int j = 0; j < L.n; ++j) {
    const int block = block_at_[at(j / block_size_)];
    const int c = j % block_size_;
    const Place& place = diagonal_[at(block)];
    const double before = values_[place.first + c * place.stride + triangular(c) + c];
    if (L.pivot(j) > kPivotMin * before) continue;
    weakest_block_ = block;
    if (L.pivot(j) < -kPivotMin * std::abs(before)) negative_pivot_ = j;
    return false;
  }
  return true;
}

bool SparseCholesky::has_factor() const { return cholmod_->has_factor; }
int SparseCholesky::weakest_block() const { return weakest_block_; }

/// The columns before the negative pivot d_j are a valid part of L D Lᵀ, so that v with Lᵀ v = e_j
/// has vᵀ A v = d_j.
Eigen::VectorXd SparseCholesky::negative_curvature() const {
  if (negative_pivot_ < 0) return {};
  const FactorView L(*cholmod_->L);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(L.n);
  v[negative_pivot_] = 1.0;
  for (int j = negative_pivot_ - 1; j >= 0; --j) {
    for (int k = L.start[j] + 1; k < L.start[j] + L.count[j]; ++k)
      v[j] -= L.values[k] * v[L.rows[k]];
  }
  Eigen::VectorXd result(L.n);
  for (std::size_t i = 0; i < position_.size(); ++i) {
    result.segment(row(static_cast<int>(i)), block_size_) =
        v.segment(row(position_[i]), block_size_);
  }
  return result;
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const {
  require(has_factor(), "solve without a factor");
  const FactorView L(*cholmod_->L);
  require(b.size() == L.n, "a vector of another size");
  Eigen::VectorXd x(L.n);
  for (std::size_t i = 0; i < position_.size(); ++i) {
    x.segment(row(position_[i]), block_size_) = b.segment(row(static_cast<int>(i)), block_size_);
  }
  block_size_ == 3 ? solve_vector_by_blocks(L, x) : solve_vector(L, x);
  Eigen::VectorXd result(L.n);
  for (std::size_t i = 0; i < position_.size(); ++i) {
    result.segment(row(static_cast<int>(i)), block_size_) =
        x.segment(row(position_[i]), block_size_);
  }
  return result;
}

bool SparseCholesky::update(const std::vector<int>& blocks, const Eigen::MatrixXd& C) {
  return modify(true, blocks, C);
}

bool SparseCholesky::downdate(const std::vector<int>& blocks, const Eigen::MatrixXd& C) {
  return modify(false, blocks, C);
}

bool SparseCholesky::modify(bool add, const std::vector<int>& blocks, const Eigen::MatrixXd& C) {
  require(has_factor(), "modification without a factor");
  std::vector<std::array<int, 2>> order;  // position, index into blocks
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    order.push_back({position_[at(blocks[i])], static_cast<int>(i)});
  }
  std::sort(order.begin(), order.end());
  Columns columns;
  std::vector<double> values;
  columns.start.push_back(0);
  for (int k = 0; k < C.cols(); ++k) {
    for (const auto& [position, i] : order) {
      for (int r = 0; r < block_size_; ++r) {
        columns.rows.push_back(block_size_ * position + r);
        values.push_back(C(block_size_ * i + r, k));
      }
    }
    columns.start.push_back(static_cast<int>(columns.rows.size()));
  }
  cholmod_sparse sparse = view(static_cast<int>(cholmod_->L->n), columns, values.data());
  cholmod_updown(add ? 1 : 0, &sparse, cholmod_->L, cholmod_->common.get());
  cholmod_->has_factor = cholmod_->common.positive_definite() && check_pivots();
  return cholmod_->has_factor;
}

Eigen::MatrixXd SparseCholesky::inverse_columns(int block) const {
  require(has_factor(), "columns of the inverse without a factor");
  const FactorView L(*cholmod_->L);
  std::vector<int> columns(at(block_size_));
  std::iota(columns.begin(), columns.end(), block_size_ * position_[at(block)]);
  RowMajor x = RowMajor::Zero(L.n, block_size_);
  x.middleRows(columns.front(), block_size_).setIdentity();
  solve_forward(L, path_to_root(L, columns), x);
  std::vector<int> all(at(L.n));
  std::iota(all.begin(), all.end(), 0);
  solve_backward(L, all, x);
  Eigen::MatrixXd result(L.n, block_size_);
  for (std::size_t i = 0; i < position_.size(); ++i) {
    result.middleRows(row(static_cast<int>(i)), block_size_) =
        x.middleRows(row(position_[i]), block_size_);
  }
  return result;
}

Eigen::MatrixXd SparseCholesky::inverse_among(const std::vector<int>& blocks) const {
  require(has_factor(), "a part of the inverse without a factor");
  const FactorView L(*cholmod_->L);
  const auto size = static_cast<int>(blocks.size()) * block_size_;
  std::vector<int> columns;
  for (const int block : blocks) {
    for (int r = 0; r < block_size_; ++r) columns.push_back(block_size_ * position_[at(block)] + r);
  }
  const std::vector<int> path = path_to_root(L, columns);
  std::vector<double>& zeros = cholmod_->zeros;
  if (size == 3) return inverse_along<3>(L, path, columns, zeros);
  if (size == 6) return inverse_along<6>(L, path, columns, zeros);
  return inverse_along<Eigen::Dynamic>(L, path, columns, zeros);
}

SparseCholesky::Among SparseCholesky::among(std::vector<int> blocks) const {
  require(has_factor(), "a path without a factor");
  require(block_size_ == 3, "the path is one of blocks of three");
  const FactorView L(*cholmod_->L);
  std::vector<int> columns;
  for (const int block : blocks) columns.push_back(3 * position_[at(block)]);
  std::vector<int> path = path_to_root(L, columns);
  std::erase_if(path, [](int j) { return j % 3 != 0; });
  return {std::move(blocks), std::move(path)};
}

Eigen::VectorXd SparseCholesky::solve_among(const Among& among, const Eigen::VectorXd& b) const {
  require(has_factor(), "solve without a factor");
  require(b.size() == row(static_cast<int>(among.blocks.size())), "a vector of another size");
  const FactorView L(*cholmod_->L);
  std::vector<double>& zeros = cholmod_->zeros;
  zeros.resize(std::max(zeros.size(), at(L.n)), 0.0);
  Eigen::Map<Eigen::VectorXd> x(zeros.data(), L.n);
  Eigen::VectorXd result(b.size());
  for (std::size_t i = 0; i < among.blocks.size(); ++i) {
    x.segment<3>(row(position_[at(among.blocks[i])])) = b.segment<3>(row(static_cast<int>(i)));
  }
  for (const int j : among.path) BlockColumn(L, j).forward(x.data());
  for (auto j = among.path.rbegin(); j != among.path.rend(); ++j)
    BlockColumn(L, *j).backward(x.data());
  for (std::size_t i = 0; i < among.blocks.size(); ++i) {
    result.segment<3>(row(static_cast<int>(i))) = x.segment<3>(row(position_[at(among.blocks[i])]));
  }
  for (const int j : among.path) x.segment<3>(j).setZero();
  return result;
}

std::vector<Eigen::Matrix3d> SparseCholesky::inverse_diagonal() const {
  return selected_inverse({}).diagonal;
}

SparseCholesky::SelectedInverse SparseCholesky::selected_inverse(
    const std::vector<std::array<int, 2>>& pairs) const {
  require(has_factor(), "a part of the inverse without a factor");
  require(block_size_ == 3, "the recursion is written for blocks of three");
  std::vector<std::array<int, 2>> below;  // in the order of elimination
  for (const auto& [a, b] : pairs) {
    const auto [column, row] = std::minmax(position_[at(a)], position_[at(b)]);
    below.push_back({row, column});
  }
  SelectedInverse permuted = BlockFactor(FactorView(*cholmod_->L)).inverse(below);
  SelectedInverse result;
  for (const int position : position_) result.diagonal.push_back(permuted.diagonal[at(position)]);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const bool first_is_row = position_[at(pairs[k][0])] == below[k][0];
    if (!first_is_row) permuted.pairs[k].transposeInPlace();
  }
  result.pairs = std::move(permuted.pairs);
  return result;
}

std::size_t SparseCholesky::factor_entries() const {
  return std::accumulate(static_cast<const int*>(cholmod_->L->ColCount),
                         static_cast<const int*>(cholmod_->L->ColCount) + cholmod_->L->n,
                         std::size_t{0});
}

}  // namespace adit
