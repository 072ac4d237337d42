// The rows of a task as numpy arrays, and the solver under them.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <filesystem>

#include "bind.hpp"
#include "named_sensed.hpp"
#include "read_program.hpp"
#include "zwang/runtime/planner.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::python {

namespace py = pybind11;

namespace {

struct Rows {
  std::vector<solver::Row> rows;
  std::vector<std::string> names, places;
};

Rows plan(const ReadProgram& program, const std::string& task, const NamedSensed* sensed) {
  int index = 0;
  while (index < static_cast<int>(program.tasks.size()) &&
         program.tasks[static_cast<std::size_t>(index)].name != task)
    ++index;
  if (index == static_cast<int>(program.tasks.size())) throw py::key_error("no task named `" + task + "`");
  const lang::Diagnostics unheard;
  const runtime::Planner planner(program, unheard);
  if (sensed != nullptr && (sensed->sensed.state.q.size() != program.robot.model.joint_count() ||
                            sensed->sensed.signals.size() != program.signals.size()))
    throw py::value_error("the snapshot is of another program: it has other joints or signals");
  const runtime::TaskPlan planned =
      sensed != nullptr ? planner.plan(index, sensed->sensed) : planner.plan(index);
  if (!planned.refused.empty()) throw std::invalid_argument(planned.refused);
  Rows rows;
  for (const runtime::PlannedRow& row : planned.rows) {
    rows.rows.push_back(row.row);
    rows.names.push_back(row.name);
    const auto source = static_cast<std::size_t>(row.span.source);
    rows.places.push_back(row.span.exists() && source < program.sources.size()
                              ? program.sources[source].path + ":" + std::to_string(row.span.begin.line)
                              : "");
  }
  return rows;
}

Eigen::MatrixXd directions_of(const Rows& rows) {
  Eigen::MatrixXd all(6, static_cast<Eigen::Index>(rows.rows.size()));
  for (Eigen::Index i = 0; i < all.cols(); ++i) {
    const solver::ForceVector& a = rows.rows[static_cast<std::size_t>(i)].a;
    all.col(i) << a.linear, a.angular;
  }
  return all;
}

/// A number of each row, as an array that is read and set whole.
template <double solver::Row::*member>
void bind_number(py::class_<Rows>& rows, const char* name, const char* about) {
  rows.def_property(
      name,
      [](const Rows& self) {
        Eigen::VectorXd values(static_cast<Eigen::Index>(self.rows.size()));
        for (std::size_t i = 0; i < self.rows.size(); ++i)
          values(static_cast<Eigen::Index>(i)) = self.rows[i].*member;
        return values;
      },
      [](Rows& self, const Eigen::VectorXd& values) {
        if (values.size() != static_cast<Eigen::Index>(self.rows.size()))
          throw py::value_error("one number a row");
        for (std::size_t i = 0; i < self.rows.size(); ++i)
          self.rows[i].*member = values(static_cast<Eigen::Index>(i));
      },
      about);
}

void bind_rows(py::module_& module) {
  py::class_<Rows> rows(module, "Rows", "The rows of a task as the solver gets them.");
  rows.def("__len__", [](const Rows& self) { return self.rows.size(); })
      .def_property_readonly(
          "A", &directions_of,
          "(6, n) unit constraint forces x y z [N], rx ry rz [N m], each in the axes of the "
          "body that it acts on")
      .def_property_readonly(
          "level",
          [](const Rows& self) {
            std::vector<int> levels;
            for (const solver::Row& row : self.rows) levels.push_back(row.level);
            return levels;
          },
          "lower ones come first")
      .def_readonly("name", &Rows::names, "as `contact.x`")
      .def_readonly("where", &Rows::places, "file and line of the statement");
  bind_number<&solver::Row::b>(rows, "b", "(n,) the acceleration asked for [m/s^2] or [rad/s^2]");
  bind_number<&solver::Row::force>(rows, "force", "(n,) of force rows [N] or [N m]");
  bind_number<&solver::Row::lo>(rows, "lo", "(n,) least constraint force [N] or [N m]");
  bind_number<&solver::Row::hi>(rows, "hi", "(n,) largest constraint force [N] or [N m]");
}

struct Solved {
  Eigen::VectorXd tau, qdd, nu, residual;
  std::string status;
  std::vector<std::string> of_rows;
};

/// At the start of the task's scene unless a snapshot says otherwise.
struct ProgramSolver {
  explicit ProgramSolver(const ReadProgram& program)
      : solver(program.robot.model),
        start(lang::start_state(program.robot, program.scene)),
        solution(program.robot.model) {}

  Solved solve(const Rows& rows, const NamedSensed* sensed) {
    const solver::Status status =
        solver.solve(sensed != nullptr ? sensed->sensed.state : start, rows.rows, solution);
    if (status != solver::Status::ok && status != solver::Status::iteration_limit)
      throw std::invalid_argument(solver::to_string(status));
    Solved solved{solution.tau, solution.qdd, {}, {}, solver::to_string(status), {}};
    const auto count = static_cast<Eigen::Index>(rows.rows.size());
    solved.nu.resize(count);
    solved.residual.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const solver::RowSolution& row = solution.rows[static_cast<std::size_t>(i)];
      solved.nu(i) = row.nu;
      solved.residual(i) = row.residual;
      solved.of_rows.emplace_back(solver::to_string(row.status));
    }
    return solved;
  }

  solver::Solver solver;
  solver::State start;
  solver::Solution solution;
};

}  // namespace

void bind_solver(py::module_& module) {
  using py::arg;
  bind_rows(module);
  py::class_<Solved>(module, "Solution", "Torques and accelerations for a set of rows.")
      .def_readonly("tau", &Solved::tau, "(joints,) [N m] or [N]")
      .def_readonly("qdd", &Solved::qdd, "(joints,) [rad/s^2] or [m/s^2]")
      .def_readonly("nu", &Solved::nu, "(n,) each row's constraint force [N] or [N m]")
      .def_readonly("residual", &Solved::residual,
                    "(n,) what is reached less what is asked [m/s^2] or [rad/s^2]")
      .def_readonly("status", &Solved::status, "ok, or iteration_limit")
      .def_readonly("rows", &Solved::of_rows, "of each row: held, or what keeps it from b");
  py::class_<ProgramSolver>(module, "Solver", "Solves rows on the robot of a program.")
      .def(py::init<const ReadProgram&>(), arg("program"), py::keep_alive<1, 2>())
      .def("solve", &ProgramSolver::solve, arg("rows"), arg("sensed") = py::none(),
           py::call_guard<py::gil_scoped_release>(),
           "At the start of the scene, or in the state of a Sensed. Raises ValueError for numbers that are "
           "not "
           "finite and for rows of another robot.");
  module.def("_plan", &plan, arg("program"), arg("task"), arg("sensed") = py::none(),
             py::call_guard<py::gil_scoped_release>());
}

}  // namespace zwang::python
