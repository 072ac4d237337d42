/// The rows' part of the sweeps: the columns of A on their way inward, and the L and g that they leave
/// behind.
///
/// A row that acts on one body has one column, a row between two bodies has two. Columns are kept in the
/// order of a walk through the tree that finishes a branch before it starts the next, so those that a joint
/// carries (the rows at its body and beyond) are neighbours, and each line of (8) to (10) is one loop over
/// numbers that lie side by side. `finish` sorts what they leave into rows. The order depends on the bodies
/// on which the rows act and is worked out again only when these change.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pairs.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::solver {

struct BodySweep;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Columns {
 public:
  Columns(const Model& model, int row_capacity);

  RowMajorMatrix L;   ///< rows() x rows(), the lower triangle
  Eigen::VectorXd g;  ///< by row

  int rows() const noexcept { return rows_; }

  void clear() noexcept;
  /// Adds a row that acts on the body with the constraint force `a` (base coordinates); returns its id.
  int add_row(int body, const Vector6& a) noexcept;
  /// The row added last also acts on a second body.
  void extend_last_row(int body, const Vector6& a) noexcept;
  /// Adds the row of a joint's own acceleration: A = 0, and S'A = 1 at that joint.
  int add_joint_row(int joint) noexcept;

  /// Lays the columns out for the inward sweep; g starts at A'c.
  void arrange(const std::vector<BodySweep>& bodies) noexcept;
  /// Takes the columns of body i through its joint: (8), (9) and (10). `UD` is U D^-1.
  void carry(std::size_t i, const BodySweep& sweep, const Vector6& UD) noexcept;
  /// The base does not move: what is left is L and g.
  void finish() noexcept;
  /// A floating base, (12), with IA_0^-1 = F'F: L += (F A)'(F A), g -= (F A)'(F pA).
  void finish(const Matrix6& F, const Vector6& pA) noexcept;

  /// Takes the multipliers, by row, for the functions below.
  void set_multipliers(const Eigen::VectorXd& nu) noexcept;
  /// (S'A) nu at the joint of body i.
  double joint_force(std::size_t i) const noexcept {
    const Range& range = ranges_[i];
    const double* const SA = &SA_(static_cast<Eigen::Index>(i), 0);
    return dot(range.last - range.first, SA + range.first, nu_.data() + range.first);
  }
  /// F A nu at a floating base.
  Vector6 base_force(const Eigen::VectorXd& nu) const noexcept;
  /// Adds the constraint forces of the rows from `first` on to the bodies on which they act.
  template <class Wrenches>
  void add_wrenches(int first, const Eigen::VectorXd& nu, Wrenches& wrenches) const noexcept {
    for (int k = 0; k < count_; ++k) {
      const Column& column = columns_[index(k)];
      if (column.row >= first) wrenches[index(column.body)] += own_.col(k) * nu(column.row);
    }
  }

 private:
  /// Where a column acts; columns are numbered as they were added.
  struct Column {
    int body = -1;
    int row = -1;
    bool of_joint = false;
    int place = 0;  ///< in the walk
  };
  /// Columns [first, last) of the walk are those at a body and beyond.
  struct Range {
    int first = 0;
    int last = 0;
    int joint = -1;  ///< the column of the joint's own row
  };
  static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  void add(int body, int row, bool of_joint, const Vector6& a) noexcept;
  void lay_out() noexcept;
  void sort_into_rows() noexcept;

  int rows_ = 0;
  int count_ = 0;
  std::vector<Column> columns_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> own_;  ///< as added, in the base's axes and at its origin
  bool has_fixed_base_;
  std::vector<int> parents_, walk_;
  std::vector<int> branches_;  ///< bodies that hang on the base

  // Of the bodies on which the rows act.
  int laid_out_ = 0;  ///< columns that stand in the present order
  std::vector<Range> ranges_;
  std::vector<int> row_of_;  ///< by place
  bool is_sorted_ = true;  ///< L gets its numbers where they are made: on a fixed base with place k for row k

  // By place.
  Eigen::Matrix<double, 6, Eigen::Dynamic> A_;
  RowMajorMatrix SA_;  ///< S'A: a line for each body
  RowMajorMatrix L_;   ///< where L is not sorted
  Eigen::VectorXd g_, nu_;
  RowMajorMatrix FA_;  ///< F A_0 at a floating base, its columns by row
};

}  // namespace zwang::solver
