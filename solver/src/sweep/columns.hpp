/// The rows' part of the sweeps: the columns of A on their way inward, and the W that they leave behind.
///
/// L is a sum of squares, (9) and (12): each joint adds (S'A)' D^-1 (S'A), the base A_0' IA_0^-1 A_0. So the
/// sweep itself factorises it,
///
///   L = W W',   W = [ F A_0,  D^-1/2 S'A of every joint ],   IA_0^-1 = F'F
///
/// one line a row, one dimension a freedom of the robot, and L itself is never formed. Joint i adds to g,
/// (10), its dimension of W times D^-1/2 u, so g needs no sweep of its own:
///
///   g = A'c + W h,   h = [ -F pA_0,  D^-1/2 u of every joint ]
///
/// A row that acts on one body has one column, a row between two bodies has two. The columns have the order
/// of a walk through the tree that finishes a branch before it starts the next. So the columns that a joint
/// carries (the rows at its body and beyond) are neighbours. The order depends on the bodies on which the
/// rows act and is worked out again only when these change.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "linear/pairs.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::solver {

struct BodySweep;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Columns {
 public:
  Columns(const Model& model, int row_capacity);

  RowMajorMatrix W;       ///< rows() x dimensions()
  Eigen::VectorXd drift;  ///< by row: A'c

  int rows() const noexcept { return rows_; }
  int dimensions() const noexcept { return dimensions_; }
  /// Of the base's own dimensions, which come first, how many the ground holds: 3 under wheels.
  int held_dimensions() const noexcept { return held_; }
  /// Rows of the ground are 0 from here on: after the base come the joints that carry wheels.
  int ground_end() const noexcept { return ground_end_; }
  int dimension_of(std::size_t body) const noexcept { return dimension_of_[body]; }

  void clear() noexcept;
  /// Adds a row that acts on the body; returns its id. last_column() is then to be set.
  int add_row(int body) noexcept {
    add(body, rows_, false);
    return rows_++;
  }
  /// The row added last also acts on a second body, with another column.
  void extend_last_row(int body) noexcept { add(body, rows_ - 1, false); }
  /// The constraint force of the column added last, in base coordinates: written where it stays, as a copy
  /// would wait for its numbers.
  auto last_column() noexcept { return own_.col(count_ - 1); }
  /// By order of adding.
  auto column(int index) const noexcept { return own_.col(index); }
  /// Adds the row of a joint's own acceleration: A = 0, and S'A = 1 at that joint.
  int add_joint_row(int joint) noexcept {
    add(joint + 1, rows_, true);
    last_column().setZero();
    return rows_++;
  }

  /// The inward sweep: from the last body to the first through its joint, and through a base that moves.
  void start_sweep() noexcept;
  void carry(std::size_t body, const BodySweep& sweep, bool goes_on) noexcept;
  void finish(const Matrix6& base_inverse_factor) noexcept;
  /// The acceleration along the rows that velocities alone cause.
  void find_drift(const std::vector<BodySweep>& bodies) noexcept;

  /// Whether rows act on the body or on one that it carries.
  bool act_beyond(std::size_t body) const noexcept {
    return rows_ > 0 && ranges_[body].first != ranges_[body].last;
  }

  /// Adds the constraint forces of the rows to the bodies on which they act.
  template <class Wrenches>
  void add_wrenches(const Eigen::VectorXd& nu, Wrenches& wrenches) const noexcept {
    for (int k = 0; k < count_; ++k) {
      const Column& column = columns_[index(k)];
      wrenches[index(column.body)] += own_.col(k) * nu(column.row);
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
  void add(int body, int row, bool of_joint) noexcept {
    Column& column = columns_[index(count_++)];
    if (column.body == body && column.row == row && column.of_joint == of_joint) return;
    column = {body, row, of_joint};
    laid_out_ = -1;
  }
  void number_dimensions(const Model& model);
  template <bool is_single>
  void carry_range(std::size_t i, const BodySweep& sweep, bool goes_on) noexcept;
  void lay_out() noexcept;

  int rows_ = 0;
  int count_ = 0;
  int dimensions_ = 0, held_ = 0, ground_end_ = 0;
  std::vector<int> dimension_of_;  ///< by body, of its joint
  std::vector<Column> columns_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> own_;  ///< as added, in the base's axes and at its origin
  std::vector<int> parents_, walk_;

  // Of the bodies on which the rows act.
  int laid_out_ = 0;       ///< columns that stand in the present order
  bool is_single_ = true;  ///< every row has one column
  std::vector<Range> ranges_;
  std::vector<int> row_of_;  ///< by place

  Eigen::Matrix<double, 6, Eigen::Dynamic> A_;  ///< by place
};

}  // namespace zwang::solver
