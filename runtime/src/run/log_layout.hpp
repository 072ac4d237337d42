/// The quantities of the log's columns. The columns are the union over all tasks, so that they stay the same
/// from the first record to the last. A column whose statement is not in force is blank.
#pragma once

#include <span>
#include <vector>

#include "run/command_columns.hpp"
#include "run/sensed_columns.hpp"
#include "run/shortfall.hpp"
#include "run/statement_table.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

/// Everything that one record tells of.
struct Tick {
  double time;                         ///< [s] that the run accepted: it never goes back
  const Sensed& sensed;                ///< as it came
  std::span<const double> parameters;  ///< as they stood then
  const Sensed& known;                 ///< with the base as the wheels tell it
  const Scheduler& scheduler;
  bool solved;  ///< the tick got to the solver
  const solver::Solution& solution;
  solver::Status solver_status;
  GuardStatus guard_status;
  const Eigen::VectorXd& tau;
  const Command& command;
  std::span<const double> extra;
  const Shortfall& shortfall;
  const Event& event;
  solver::Vector3 estimated_force;
  double slip;
};

class LogLayout {
 public:
  LogLayout(const StatementTable& statements, const Scheduler& scheduler, const solver::Model& model,
            const lang::Program& program, const std::vector<std::string>& event_signals,
            const std::vector<Column>& extra);

  const std::vector<Column>& columns() const noexcept { return columns_; }
  /// Where a snapshot has each of the program's signals. Does not allocate.
  void signals_at(const std::vector<std::size_t>& places) noexcept { inputs_.signals_at(places); }
  /// The record of a tick, one value a column; valid until the next call. Does not allocate.
  std::span<const double> fill(const StatementTable& statements, const Tick& tick) noexcept;

 private:
  struct StatementColumns {
    int position = -1, velocity = -1, acceleration = -1, b = -1, nu = -1, residual = -1, saturated = -1,
        alpha = -1;
    int limit_nu = -1, limit_residual = -1, sum = -1;
    bool inside = false;  ///< `position` is what is left to the nearest edge
  };
  struct SignalColumns {
    lang::SignalType type;
    int value = -1, age = -1, known = -1;
  };
  int add(std::string name, std::string unit, std::vector<std::string> words = {});
  void put(int column, double value) noexcept;
  void add_first(const StatementTable& statements, const Scheduler& scheduler,
                 const std::vector<std::string>& event_signals);
  void add_joints(const solver::Model& model, const lang::Drive& drive);
  void add_statement(const Statement& statement);
  void add_signal(const lang::Signal& signal);
  void put_command(const Command& command) noexcept;
  void put_signals(const Scheduler& scheduler) noexcept;
  void put_outputs(std::span<const double> outputs) noexcept;
  void put_transition(const Scheduler& scheduler) noexcept;
  void put_statements(const StatementTable& statements, const Tick& tick) noexcept;
  void put_coordinates(const StatementTable& statements, const Scheduler& scheduler, int set) noexcept;
  void put_rows(const StatementTable& statements, const Tick& tick, int set, std::size_t first_row) noexcept;
  void put_acceleration(const solver::ConstraintSet& set, const InForce& source, const solver::Row& row,
                        const solver::Solution& solution, int column) noexcept;
  const StatementColumns& columns_of(const StatementTable& statements, const InForce& source) const noexcept;

  std::vector<Column> columns_;
  std::vector<double> values_;
  std::vector<StatementColumns> of_statement_;
  std::vector<SignalColumns> of_signal_;
  std::vector<std::vector<int>> guards_;  // by task, exit
  SensedColumns inputs_;
  int first_input_ = 0;
  int first_joint_ = 0;
  int first_command_ = -1;  ///< of a drive that takes velocities
  int first_twist_ = -1;    ///< of a drive that takes the twist of the base
  int first_output_ = 0;
  int first_extra_ = 0;
};

}  // namespace zwang::runtime
