// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/bayes_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>

#include <Eigen/Cholesky>

namespace adit {
namespace {

/// A pivot below this share of the original diagonal entry is zero up to rounding.
constexpr double kPivotMin = 1e-14;
/// Blocks with fewer neighbours are as good as those with this many: it is their height that
/// decides.
constexpr int kDegreeMin = 3;
/// Of the newest blocks, which follow each other in a chain, those that are ordered again at most.
constexpr int kRecentMax = 256;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

void sort_unique(std::vector<int>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The largest power of two that divides a positive number.
int power_of_two_in(int number) { return number & -number; }

}  // namespace

int BayesTree::add_block(bool last) {
  const int block = blocks();
  clique_of_.push_back(-1);
  is_last_.push_back(last);
  place_.push_back(-1);
  diagonal_.resize(at(size_) * clique_of_.size(), 0.0);
  x_.resize(diagonal_.size(), 0.0);
  new_blocks_.push_back(block);
  return block;
}

void BayesTree::remove_newest_block() {
  const int block = blocks() - 1;
  touch(block);
  if (const int clique = clique_of_[at(block)]; clique >= 0) {
    std::erase(cliques_[at(clique)].frontals, block);
  }
  std::erase(new_blocks_, block);
  clique_of_.pop_back();
  is_last_.pop_back();
  place_.pop_back();
  diagonal_.resize(at(size_) * clique_of_.size());
  x_.resize(diagonal_.size());
}

void BayesTree::touch(int block) {
  if (clique_of_[at(block)] >= 0) touched_.push_back(clique_of_[at(block)]);
}

int BayesTree::add_term(Term term) {
  int id = static_cast<int>(terms_.size());
  if (free_terms_.empty()) {
    terms_.emplace_back();
  } else {
    id = free_terms_.back();
    free_terms_.pop_back();
  }
  new_terms_.push_back(id);
  terms_[at(id)].blocks = std::move(term.blocks);
  set_term(id, std::move(term.H), std::move(term.b));
  return id;
}

void BayesTree::set_term(int id, Eigen::MatrixXd H, Eigen::VectorXd b) {
  Term& term = terms_[at(id)];
  for (std::size_t i = 0; i < term.blocks.size(); ++i) {
    touch(term.blocks[i]);
    for (int k = 0; k < size_; ++k) {
      const Eigen::Index r = row(static_cast<int>(i)) + k;
      const double before = term.H.size() > 0 ? term.H(r, r) : 0.0;
      diagonal_[at(size_ * term.blocks[i] + k)] += H(r, r) - before;
    }
  }
  term.H = std::move(H);
  term.b = std::move(b);
}

void BayesTree::remove_term(int id) {
  Term& term = terms_[at(id)];
  set_term(id, Eigen::MatrixXd::Zero(term.H.rows(), term.H.cols()), term.b);
  const bool is_new = std::erase(new_terms_, id) > 0;
  if (!is_new) {  // its owner is on the path from any of its blocks to the root
    for (const int block : term.blocks) {
      if (clique_of_[at(block)] < 0) continue;
      if (std::erase(cliques_[at(clique_of_[at(block)])].terms, id) > 0) break;
    }
  }
  term = {};
  free_terms_.push_back(id);
}

/// Where the neighbours of a block in the order of elimination are.
struct BayesTree::Ordering {
  std::vector<int> blocks;                  // in order of elimination
  std::vector<std::vector<int>> separator;  // of each: neighbours that are eliminated later
  std::map<int, int> position;              // of each block
};

bool BayesTree::update(bool only_ends) {
  if (!new_blocks_.empty()) {
    // Blocks at the end of a chain would else hang one below the other.
    const int newest = new_blocks_.back();
    const int recent = std::min(kRecentMax, power_of_two_in(newest + 1));
    for (int block = std::max(0, newest - recent); block < newest; ++block) touch(block);
  }
  if (!only_ends && (!touched_.empty() || !new_terms_.empty())) ++version_;
  cross_block_ = -1;
  std::vector<int> blocks = std::move(new_blocks_);
  std::vector<int> terms = std::move(new_terms_);
  std::vector<int> ends = only_ends ? terms : std::vector<int>{};
  std::ranges::sort(ends, {}, [&](int id) { return std::ranges::max(terms_[at(id)].blocks); });
  new_blocks_.clear();
  new_terms_.clear();
  const std::vector<int> orphans = detach(blocks, terms);
  const Ordering ordering = order(blocks, terms, orphans);
  const std::vector<int> fresh = form_cliques(ordering);
  adopt(ordering, terms, orphans);
  eliminated_ = static_cast<int>(blocks.size());
  for (auto clique = fresh.rbegin(); clique != fresh.rend(); ++clique) {
    if (!eliminate(cliques_[at(*clique)])) return false;
  }
  if (only_ends) {
    solve_ends(ends, fresh);
  } else {
    solve(fresh);
  }
  return true;
}

/// Removes the touched cliques and all above them. Adds their blocks and terms to these lists;
/// returns the cliques that hung below them.
std::vector<int> BayesTree::detach(std::vector<int>& blocks, std::vector<int>& terms) {
  std::vector<int> removed;
  for (int clique : touched_) {
    for (; clique >= 0 && cliques_[at(clique)].height > 0; clique = cliques_[at(clique)].parent) {
      cliques_[at(clique)].height = 0;  // marks it
      removed.push_back(clique);
    }
  }
  touched_.clear();
  std::ranges::sort(removed);
  std::vector<int> orphans;
  for (const int c : removed) {
    Clique& clique = cliques_[at(c)];
    for (const int block : clique.frontals) {
      blocks.push_back(block);
      clique_of_[at(block)] = -1;
    }
    terms.insert(terms.end(), clique.terms.begin(), clique.terms.end());
    for (const int child : clique.children) {
      if (cliques_[at(child)].height > 0) orphans.push_back(child);
    }
  }
  for (const int c : removed) {
    roots_.erase(c);
    cliques_[at(c)] = {};
    free_cliques_.push_back(c);
  }
  std::ranges::sort(blocks);
  sort_unique(terms);
  std::ranges::sort(orphans);
  return orphans;
}

/// Orders blocks by minimum degree; of those with equal degree, the one with the lowest tree below
/// it, which balances the tree.
BayesTree::Ordering BayesTree::order(const std::vector<int>& blocks, const std::vector<int>& terms,
                                     const std::vector<int>& orphans) {
  const int count = static_cast<int>(blocks.size());
  for (int i = 0; i < count; ++i) place_[at(blocks[at(i)])] = i;
  std::vector<std::vector<int>> neighbours(blocks.size());
  std::vector<int> height(blocks.size(), 0);
  const auto link_all = [&](const std::vector<int>& linked) {
    for (const int a : linked) {
      for (const int b : linked) {
        if (a != b) neighbours[at(place_[at(a)])].push_back(place_[at(b)]);
      }
    }
  };
  for (const int term : terms) link_all(terms_[at(term)].blocks);
  for (const int orphan : orphans) {
    const Clique& clique = cliques_[at(orphan)];
    link_all(clique.separator);
    for (const int block : clique.separator) {
      int& h = height[at(place_[at(block)])];
      h = std::max(h, clique.height);
    }
  }
  using Key = std::array<int, 4>;
  const int newest = count > 0 ? blocks.back() : -1;
  const auto key = [&](int i) {
    const int block = blocks[at(i)];
    const int group = is_last_[at(block)] ? 2 : block == newest ? 1 : 0;
    return Key{group, std::max(kDegreeMin, static_cast<int>(neighbours[at(i)].size())),
               height[at(i)], i};
  };
  std::set<Key> queue;
  for (int i = 0; i < count; ++i) {
    sort_unique(neighbours[at(i)]);
    queue.insert(key(i));
  }
  Ordering ordering;
  while (!queue.empty()) {
    const int i = queue.begin()->back();
    queue.erase(queue.begin());
    const std::vector<int> separator = std::move(neighbours[at(i)]);
    for (const int k : separator) {
      queue.erase(key(k));
      std::vector<int> merged;
      std::ranges::set_union(neighbours[at(k)], separator, std::back_inserter(merged));
      std::erase_if(merged, [&](int other) { return other == i || other == k; });
      neighbours[at(k)] = std::move(merged);
      height[at(k)] = std::max(height[at(k)], height[at(i)] + 1);
      queue.insert(key(k));
    }
    ordering.position[blocks[at(i)]] = static_cast<int>(ordering.blocks.size());
    ordering.blocks.push_back(blocks[at(i)]);
    ordering.separator.emplace_back();
    for (const int k : separator) ordering.separator.back().push_back(blocks[at(k)]);
  }
  for (const int block : blocks) place_[at(block)] = -1;
  return ordering;
}

int BayesTree::new_clique() {
  if (free_cliques_.empty()) {
    cliques_.emplace_back();
    return static_cast<int>(cliques_.size()) - 1;
  }
  const int clique = free_cliques_.back();
  free_cliques_.pop_back();
  return clique;
}

/// From the last block to the first: a block joins the clique of the one that is eliminated first
/// of its separator if it is linked with all of that clique. Returns the cliques, parents first.
std::vector<int> BayesTree::form_cliques(const Ordering& ordering) {
  std::vector<int> fresh;
  for (std::size_t i = ordering.blocks.size(); i-- > 0;) {
    const int block = ordering.blocks[i];
    const std::vector<int>& separator = ordering.separator[i];
    int parent = -1;
    if (!separator.empty()) {
      const int next = *std::ranges::min_element(
          separator, {}, [&](int other) { return ordering.position.at(other); });
      parent = clique_of_[at(next)];
      Clique& above = cliques_[at(parent)];
      if (above.frontals.size() + above.separator.size() == separator.size()) {
        above.frontals.push_back(block);
        clique_of_[at(block)] = parent;
        continue;
      }
    }
    const int c = new_clique();
    Clique& clique = cliques_[at(c)];
    clique.frontals = {block};
    clique.separator = separator;
    clique.parent = parent;
    clique_of_[at(block)] = c;
    if (parent < 0) roots_.insert(c);
    if (parent >= 0) cliques_[at(parent)].children.push_back(c);
    fresh.push_back(c);
  }
  for (const int c : fresh) std::ranges::reverse(cliques_[at(c)].frontals);
  return fresh;
}

/// Gives terms and orphans to the clique in which the first of their blocks is eliminated.
void BayesTree::adopt(const Ordering& ordering, const std::vector<int>& terms,
                      const std::vector<int>& orphans) {
  const auto owner = [&](const std::vector<int>& blocks) {
    return clique_of_[at(*std::ranges::min_element(
        blocks, {}, [&](int block) { return ordering.position.at(block); }))];
  };
  for (const int term : terms) cliques_[at(owner(terms_[at(term)].blocks))].terms.push_back(term);
  for (const int orphan : orphans) {
    Clique& clique = cliques_[at(orphan)];
    clique.parent = clique.separator.empty() ? -1 : owner(clique.separator);
    if (clique.parent < 0) roots_.insert(orphan);
    if (clique.parent >= 0) cliques_[at(clique.parent)].children.push_back(orphan);
  }
}

/// Partial Cholesky factorisation of the front: the terms and what the cliques below leave.
bool BayesTree::eliminate(Clique& clique) {
  int rows = 0;
  for (const auto* blocks : {&clique.frontals, &clique.separator}) {
    for (const int block : *blocks) place_[at(block)] = std::exchange(rows, rows + size_);
  }
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, rows);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows);
  const auto add = [&](const std::vector<int>& blocks, const Eigen::MatrixXd& M,
                       const Eigen::VectorXd& v) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const int to = place_[at(blocks[i])];
      const Eigen::Index from = row(static_cast<int>(i));
      b.segment(to, size_) += v.segment(from, size_);
      for (std::size_t k = 0; k < blocks.size(); ++k) {
        H.block(to, place_[at(blocks[k])], size_, size_) +=
            M.block(from, row(static_cast<int>(k)), size_, size_);
      }
    }
  };
  for (const int term : clique.terms)
    add(terms_[at(term)].blocks, terms_[at(term)].H, terms_[at(term)].b);
  clique.decrease = 0.0;
  clique.height = 1;
  for (const int c : clique.children) {
    const Clique& child = cliques_[at(c)];
    add(child.separator, child.update, child.update_b);
    clique.decrease += child.decrease;
    clique.height = std::max(clique.height, child.height + 1);
  }
  for (const auto* blocks : {&clique.frontals, &clique.separator}) {
    for (const int block : *blocks) place_[at(block)] = -1;
  }
  const Eigen::Index F = row(static_cast<int>(clique.frontals.size()));
  const Eigen::Index S = rows - F;
  const Eigen::LLT<Eigen::MatrixXd> llt(H.topLeftCorner(F, F));
  if (llt.info() != Eigen::Success) return false;
  for (Eigen::Index r = 0; r < F; ++r) {
    const int block = clique.frontals[static_cast<std::size_t>(r / size_)];
    const double pivot = llt.matrixLLT()(r, r);
    const double before = diagonal_[at(size_ * block) + static_cast<std::size_t>(r % size_)];
    if (!(pivot * pivot > kPivotMin * before)) return false;
  }
  clique.R.resize(F, rows);
  clique.R.leftCols(F) = llt.matrixU();
  clique.R.rightCols(S) = llt.matrixL().solve(H.topRightCorner(F, S));
  clique.y = llt.matrixL().solve(b.head(F));
  clique.decrease += clique.y.squaredNorm();
  const auto R_S = clique.R.rightCols(S);
  clique.update = H.bottomRightCorner(S, S);
  clique.update.noalias() -= R_S.transpose() * R_S;
  clique.update_b = b.tail(S) - R_S.transpose() * clique.y;
  clique.x_separator.resize(0);
  return true;
}

Eigen::VectorXd BayesTree::gather(const std::vector<int>& blocks) const {
  Eigen::VectorXd values(row(static_cast<int>(blocks.size())));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    values.segment(row(static_cast<int>(i)), size_) = solution(blocks[i]);
  }
  return values;
}

/// From the root downwards, where something moved.
void BayesTree::solve(const std::vector<int>& fresh) {
  moved_.clear();
  std::vector<int> waiting = fresh;
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    Clique& clique = cliques_[at(waiting[i])];
    solve(clique);
    for (const int child : clique.children) {
      const Clique& below = cliques_[at(child)];
      if (below.x_separator.size() == 0 && !below.separator.empty()) continue;  // fresh itself
      const Eigen::VectorXd now = gather(below.separator);
      if ((now - below.x_separator).cwiseAbs().maxCoeff() > unchanged_) waiting.push_back(child);
    }
  }
  sort_unique(moved_);
}

/// New blocks by their terms alone. What else was ordered again keeps its values, as these would
/// change by rounding only, all of them where the newest blocks are far from where the terms hold
/// the others.
void BayesTree::solve_ends(const std::vector<int>& ends, const std::vector<int>& fresh) {
  moved_.clear();
  for (const int id : ends) {
    const Term& term = terms_[at(id)];
    const int block = std::ranges::max(term.blocks);
    const Eigen::Index r =
        row(term.blocks.back() == block ? static_cast<int>(term.blocks.size()) - 1 : 0);
    Eigen::Map<Eigen::VectorXd> x(x_.data() + row(block), size_);
    x.setZero();
    const Eigen::VectorXd rest = term.b - term.H * gather(term.blocks);
    x = term.H.block(r, r, size_, size_).llt().solve(rest.segment(r, size_));
    if (!x.isZero(0.0)) moved_.push_back(block);
  }
  sort_unique(moved_);
  for (const int c : fresh) cliques_[at(c)].x_separator = gather(cliques_[at(c)].separator);
}

void BayesTree::solve(Clique& clique) {
  const Eigen::Index F = clique.R.rows();
  clique.x_separator = gather(clique.separator);
  Eigen::VectorXd x = clique.y - clique.R.rightCols(clique.R.cols() - F) * clique.x_separator;
  clique.R.leftCols(F).triangularView<Eigen::Upper>().solveInPlace(x);
  for (std::size_t i = 0; i < clique.frontals.size(); ++i) {
    const int block = clique.frontals[i];
    Eigen::Map<Eigen::VectorXd> before(x_.data() + row(block), size_);
    const auto now = x.segment(row(static_cast<int>(i)), size_);
    if (before != now) moved_.push_back(block);
    before = now;
  }
}

double BayesTree::decrease() const {
  double sum = 0.0;
  for (const int root : roots_) sum += cliques_[at(root)].decrease;
  return sum;
}

int BayesTree::height() const {
  int height = 0;
  for (const int root : roots_) height = std::max(height, cliques_[at(root)].height);
  return height;
}

/// Parts of the joint covariance of a clique, which contains all of these blocks.
Eigen::MatrixXd BayesTree::sub_covariance(const Clique& clique, const std::vector<int>& rows,
                                          const std::vector<int>& columns) const {
  const auto place = [&](int block) {
    const auto frontal = std::ranges::find(clique.frontals, block);
    if (frontal != clique.frontals.end())
      return row(static_cast<int>(frontal - clique.frontals.begin()));
    const auto place_in = std::ranges::find(clique.separator, block) - clique.separator.begin();
    return row(static_cast<int>(clique.frontals.size()) + static_cast<int>(place_in));
  };
  std::vector<Eigen::Index> of_column;
  for (const int column : columns) of_column.push_back(place(column));
  Eigen::MatrixXd part(row(static_cast<int>(rows.size())), row(static_cast<int>(columns.size())));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Index of_row = place(rows[i]);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      part.block(row(static_cast<int>(i)), row(static_cast<int>(k)), size_, size_) =
          clique.covariance.block(of_row, of_column[k], size_, size_);
    }
  }
  return part;
}

/// The covariance of frontals and separator: x_F = R_F⁻¹ (y − R_S x_S) with an error of unit
/// covariance in y that is independent of x_S.
const Eigen::MatrixXd& BayesTree::joint_covariance(int c) const {
  std::vector<int> path;  // of cliques whose covariance is not known
  for (; c >= 0 && cliques_[at(c)].covariance_version != version_; c = cliques_[at(c)].parent) {
    path.push_back(c);
  }
  for (auto next = path.rbegin(); next != path.rend(); ++next) {
    const Clique& clique = cliques_[at(*next)];
    const Eigen::Index F = clique.R.rows();
    const Eigen::Index S = clique.R.cols() - F;
    const auto R_F = clique.R.leftCols(F).triangularView<Eigen::Upper>();
    const Eigen::MatrixXd R_inverse = R_F.solve(Eigen::MatrixXd::Identity(F, F));
    clique.covariance.resize(F + S, F + S);
    clique.covariance.topLeftCorner(F, F).noalias() = R_inverse * R_inverse.transpose();
    if (S > 0) {
      const Eigen::MatrixXd of_separator =
          sub_covariance(cliques_[at(clique.parent)], clique.separator, clique.separator);
      const Eigen::MatrixXd A = R_inverse * clique.R.rightCols(S);
      const Eigen::MatrixXd A_Sigma = A * of_separator;
      clique.covariance.bottomRightCorner(S, S) = of_separator;
      clique.covariance.topRightCorner(F, S) = -A_Sigma;
      clique.covariance.bottomLeftCorner(S, F) = -A_Sigma.transpose();
      clique.covariance.topLeftCorner(F, F).noalias() += A_Sigma * A.transpose();
    }
    clique.covariance_version = version_;
  }
  return cliques_[at(path.empty() ? c : path.front())].covariance;
}

Eigen::MatrixXd BayesTree::covariance(int block) const {
  const int c = clique_of_[at(block)];
  static_cast<void>(joint_covariance(c));
  return sub_covariance(cliques_[at(c)], {block}, {block});
}

bool BayesTree::is_above(int upper, int lower) const {
  while (lower >= 0 && lower != upper) lower = cliques_[at(lower)].parent;
  return lower == upper;
}

Eigen::MatrixXd BayesTree::covariance(int a, int b) const {
  if (a == b) return covariance(a);
  const int of_a = clique_of_[at(a)];
  const int of_b = clique_of_[at(b)];
  const bool down = is_above(of_b, of_a);
  if (!down && is_above(of_a, of_b)) return covariance(b, a).transpose();
  if (!down) return covariance_across(a, b);
  if (cross_block_ != b) {
    cross_block_ = b;
    ++cross_version_;
  }
  const Eigen::MatrixXd& cross = cross_covariance(of_a, b);
  const auto& frontals = cliques_[at(of_a)].frontals;
  const auto place = std::ranges::find(frontals, a) - frontals.begin();
  return cross.middleRows(row(static_cast<int>(place)), size_);
}

/// The covariance of the frontals of a clique with a frontal of a clique above: that of the
/// separator with it, carried down. Blocks of the separator above that clique are in its separator
/// as well.
const Eigen::MatrixXd& BayesTree::cross_covariance(int c, int block) const {
  const int top = clique_of_[at(block)];
  std::vector<int> path;
  for (; c != top && cliques_[at(c)].cross_version != cross_version_; c = cliques_[at(c)].parent) {
    path.push_back(c);
  }
  const Clique& highest = cliques_[at(top)];
  if (highest.cross_version != cross_version_) {
    static_cast<void>(joint_covariance(top));
    highest.cross = sub_covariance(highest, highest.frontals, {block});
    highest.cross_version = cross_version_;
  }
  for (auto next = path.rbegin(); next != path.rend(); ++next) {
    const Clique& clique = cliques_[at(*next)];
    Eigen::MatrixXd of_separator(row(static_cast<int>(clique.separator.size())), size_);
    for (std::size_t i = 0; i < clique.separator.size(); ++i) {
      const int s = clique.separator[i];
      const Clique& owner = cliques_[at(clique_of_[at(s)])];
      auto rows = of_separator.middleRows(row(static_cast<int>(i)), size_);
      if (owner.cross_version == cross_version_) {
        const auto place = std::ranges::find(owner.frontals, s) - owner.frontals.begin();
        rows = owner.cross.middleRows(row(static_cast<int>(place)), size_);
      } else {
        rows = sub_covariance(highest, {s}, {block});
      }
    }
    const Eigen::Index F = clique.R.rows();
    const Eigen::MatrixXd carried = clique.R.rightCols(clique.R.cols() - F) * of_separator;
    clique.cross = -clique.R.leftCols(F).triangularView<Eigen::Upper>().solve(carried);
    clique.cross_version = cross_version_;
  }
  return cliques_[at(path.empty() ? c : path.front())].cross;
}

/// For cliques in different branches: (R⁻ᵀ E_a)ᵀ (R⁻ᵀ E_b), along both paths to the root.
Eigen::MatrixXd BayesTree::covariance_across(int a, int b) const {
  const auto forward = [this](int block) {
    std::map<int, Eigen::MatrixXd> rest;    // by block
    std::map<int, Eigen::MatrixXd> solved;  // by clique
    rest[block] = Eigen::MatrixXd::Identity(size_, size_);
    for (int c = clique_of_[at(block)]; c >= 0; c = cliques_[at(c)].parent) {
      const Clique& clique = cliques_[at(c)];
      const Eigen::Index F = clique.R.rows();
      Eigen::MatrixXd v = Eigen::MatrixXd::Zero(F, size_);
      for (std::size_t i = 0; i < clique.frontals.size(); ++i) {
        const auto found = rest.find(clique.frontals[i]);
        if (found != rest.end()) v.middleRows(row(static_cast<int>(i)), size_) = found->second;
      }
      clique.R.leftCols(F).triangularView<Eigen::Upper>().transpose().solveInPlace(v);
      const Eigen::MatrixXd carried = clique.R.rightCols(clique.R.cols() - F).transpose() * v;
      for (std::size_t i = 0; i < clique.separator.size(); ++i) {
        const auto part = carried.middleRows(row(static_cast<int>(i)), size_);
        const auto [entry, is_new] = rest.try_emplace(clique.separator[i]);
        if (is_new) entry->second = Eigen::MatrixXd::Zero(size_, size_);
        entry->second -= part;
      }
      solved[c] = std::move(v);
    }
    return solved;
  };
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size_, size_);
  const auto of_b = forward(b);
  for (const auto& [c, v] : forward(a)) {
    const auto found = of_b.find(c);
    if (found != of_b.end()) covariance += v.transpose() * found->second;
  }
  return covariance;
}

}  // namespace adit
