// The control loop: what is sensed, the runner, what is commanded.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <map>

#include "bind.hpp"
#include "named_sensed.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::python {

namespace py = pybind11;

namespace {

using runtime::SignalSample;

SignalSample& sample_of(NamedSensed& self, const std::string& name) {
  for (std::size_t i = 0; i < self.signals.size(); ++i) {
    if (self.signals[i].name == name) return self.sensed.signals[i];
  }
  throw py::key_error("the task has no signal `" + name + "`");
}

solver::Pose pose_of(const solver::Vector3& position, const solver::Matrix3& rotation) {
  solver::Pose pose;
  pose.position = position;
  pose.rotation = rotation;
  return pose;
}

const char* kind_of(lang::SignalType type) {
  switch (type) {
    case lang::SignalType::boolean:
      return "a bool";
    case lang::SignalType::number:
      return "a number in SI";
    case lang::SignalType::pose:
      return "a pose: (position, rotation), of (3,) and (3, 3)";
    case lang::SignalType::wrench:
      break;
  }
  return "a wrench: (6,), force [N] and moment [N m]";
}

using Six = Eigen::Matrix<double, 6, 1>;

template <typename Vector>
Vector spatial_of(const Six& linear_first) {
  Vector vector;
  vector.linear = linear_first.head<3>();
  vector.angular = linear_first.tail<3>();
  return vector;
}

void take(SignalSample& sample, const py::object& value) {
  switch (sample.type.value()) {
    case lang::SignalType::boolean:
      sample.boolean = value.cast<bool>();
      break;
    case lang::SignalType::number:
      sample.number = value.cast<double>();
      break;
    case lang::SignalType::pose: {
      const auto [position, rotation] = value.cast<std::pair<solver::Vector3, solver::Matrix3>>();
      sample.pose = pose_of(position, rotation);
      break;
    }
    case lang::SignalType::wrench:
      sample.wrench = spatial_of<solver::ForceVector>(value.cast<Six>());
      break;
  }
}

void measure(NamedSensed& self, const std::string& name, const py::object& value,
             const std::optional<double>& stamp, const std::optional<Six>& twist) {
  SignalSample& sample = sample_of(self, name);
  try {
    take(sample, value);
  } catch (const py::cast_error&) {
    throw py::type_error("signal `" + name + "` is " + kind_of(sample.type.value()));
  }
  if (twist && sample.type != lang::SignalType::pose)
    throw py::type_error("signal `" + name + "` is " + kind_of(sample.type.value()) + ": no twist");
  sample.twist = twist ? std::optional(spatial_of<solver::MotionVector>(*twist)) : std::nullopt;
  sample.valid = true;
  sample.stamp = stamp.value_or(self.sensed.time);
}

template <typename Of>
auto view(Of of) {
  return [of](NamedSensed& self) -> Eigen::Ref<std::remove_reference_t<decltype(of(self.sensed.state))>> {
    return of(self.sensed.state);
  };
}

void bind_sensed(py::module_& module) {
  using py::arg;
  const auto internal = py::return_value_policy::reference_internal;
  py::class_<NamedSensed> sensed(
      module, "Sensed",
      "All that the controller may know at one instant. The arrays are views: write into them, "
      "`sensed.q[:] = ..`.");
  sensed.def(py::init<const lang::Program&>(), arg("program"))
      .def_property(
          "time", [](const NamedSensed& s) { return s.sensed.time; },
          [](NamedSensed& s, double time) { s.sensed.time = time; }, "[s] by any clock that goes on evenly")
      .def_property(
          "measured_at", [](const NamedSensed& s) { return s.sensed.measured_at; },
          [](NamedSensed& s, std::optional<double> time) { s.sensed.measured_at = time; },
          "[s] when the state was measured; None: now")
      .def_property(
          "base_measured", [](const NamedSensed& s) { return s.sensed.base_measured; },
          [](NamedSensed& s, bool is) { s.sensed.base_measured = is; },
          "position, rotation, linear and angular are measured; else they are reckoned from the wheels")
      .def_property_readonly("q", view([](solver::State& s) -> Eigen::VectorXd& { return s.q; }), internal,
                             "(joints,) [rad] or [m], as Program.joints")
      .def_property_readonly("qd", view([](solver::State& s) -> Eigen::VectorXd& { return s.qd; }), internal,
                             "(joints,) [rad/s] or [m/s]")
      .def_property_readonly("position",
                             view([](solver::State& s) -> solver::Vector3& { return s.base_pose.position; }),
                             internal, "(3,) [m] of the base in the world")
      .def_property_readonly("rotation",
                             view([](solver::State& s) -> solver::Matrix3& { return s.base_pose.rotation; }),
                             internal, "(3, 3) of the base in the world")
      .def_property_readonly("linear",
                             view([](solver::State& s) -> solver::Vector3& { return s.base_twist.linear; }),
                             internal, "(3,) [m/s] of the base's origin, in its axes")
      .def_property_readonly("angular",
                             view([](solver::State& s) -> solver::Vector3& { return s.base_twist.angular; }),
                             internal, "(3,) [rad/s] of the base, in its axes")
      .def("measure", &measure, arg("signal"), arg("value"), arg("stamp") = py::none(),
           arg("twist") = py::none(),
           "A sample of a signal, in SI: bool, float, (position, rotation) of a pose, or (6,) force and "
           "moment. `stamp` [s]; None: time. `twist`: (6,) linear and angular, of a pose that moves.")
      .def_property(
          "effort", [](const NamedSensed& s) { return s.sensed.effort; },
          [](NamedSensed& s, const Eigen::VectorXd& effort) { s.sensed.effort = effort; },
          "(joints,) [N m] measured torques of the motors, of a robot that `feels` by effort; else empty")
      .def(
          "feel",
          [](NamedSensed& s, const Six& wrench) {
            s.sensed.contact_wrench = spatial_of<solver::ForceVector>(wrench);
          },
          arg("wrench"),
          "(6,) force and moment that press on a robot that `feels` by a wrench, in the sensor's axes.")
      .def(
          "locate",
          [](NamedSensed& s, const solver::Vector3& position, const solver::Matrix3& rotation,
             const std::optional<double>& stamp) {
            s.sensed.base_fix = {stamp.value_or(s.sensed.time), pose_of(position, rotation)};
          },
          arg("position"), arg("rotation"), arg("stamp") = py::none(),
          "The base's pose in the world, where somebody measures it now and then: (3,) [m], (3, 3).")
      .def(
          "forget", [](NamedSensed& s, const std::string& name) { sample_of(s, name).valid = false; },
          arg("signal"), "No sample of it from now on.");
}

std::vector<py::dict> events_of(const runtime::Runner& runner) {
  std::vector<py::dict> events;
  for (const runtime::Event& e : runner.events()) {
    py::dict event;
    event["code"] = runtime::to_string(e.code);
    event["time"] = e.time;
    event["signal"] = runner.event_signal(e);
    event["value"] = e.value;
    events.push_back(event);
  }
  return events;
}

std::vector<std::pair<double, std::string>> transitions_of(const runtime::Runner& runner) {
  std::vector<std::pair<double, std::string>> transitions;
  for (const runtime::Transition& t : runner.transitions())
    transitions.emplace_back(t.time, runner.scheduler().tasks()[static_cast<std::size_t>(t.to)].name);
  return transitions;
}

/// The columns of the log name them, in the order of the program.
std::map<std::string, double> outputs_of(const runtime::Runner& runner) {
  static const std::string before = "output.";
  std::map<std::string, double> outputs;
  std::size_t next = 0;
  for (const runtime::Column& column : runner.columns()) {
    if (next < runner.outputs().size() && column.name.starts_with(before))
      outputs[column.name.substr(before.size())] = runner.outputs()[next++];
  }
  return outputs;
}

std::string task_of(const runtime::Runner& runner) {
  const int task = runner.scheduler().task();
  return task < 0 ? "" : runner.scheduler().tasks()[static_cast<std::size_t>(task)].name;
}

void set_parameter(runtime::Runner& runner, const std::string& name, double value) {
  if (!runner.set_parameter(name, value))
    throw py::value_error("no parameter `" + name + "` takes " + std::to_string(value));
}

void bind_runner(py::module_& module) {
  using py::arg;
  py::class_<runtime::Command>(module, "Command", "What a drive is told for one control period.")
      .def_readonly("torque", &runtime::Command::torque, "(joints,) [N m] or [N]")
      .def_readonly("velocity", &runtime::Command::velocity,
                    "(joints,) [rad/s]; 0 of a drive that takes torques")
      .def_readonly("twist", &runtime::Command::twist,
                    "(3,) of the base in its axes: x, y [m/s], rz [rad/s]; of a drive that takes it")
      .def_readonly("outputs", &runtime::Command::outputs,
                    "what the task's outputs are set to, as Program.outputs: in SI, or 0 and 1")
      .def_readonly("lower", &runtime::Command::lower, "(joints,) least torque [N m]")
      .def_readonly("upper", &runtime::Command::upper, "(joints,) largest torque [N m]");

  py::class_<runtime::Runner>(module, "Runner", "Steps a program on your robot: one `step` a control period.")
      .def(py::init([](const lang::Program& program, std::optional<double> period) {
             runtime::RunnerSettings settings;
             settings.period = period;
             return std::make_unique<runtime::Runner>(program, settings);
           }),
           arg("program"), arg("period") = py::none())
      .def(
          "step",
          [](runtime::Runner& runner, const NamedSensed& sensed) {
            if (sensed.sensed.state.q.size() != runner.command().torque.size())
              throw py::value_error("this Sensed is of a robot with other joints than the runner's");
            runner.step(sensed.sensed);
            return runner.command();
          },
          arg("sensed"),
          "What to send for this snapshot: a copy, always finite and within the motors' limits.")
      .def_property_readonly("period", &runtime::Runner::period, "[s] between steps")
      .def_property_readonly("finished", &runtime::Runner::finished,
                             "the outcome is known, and the base stands")
      .def_property_readonly(
          "state", [](const runtime::Runner& r) { return runtime::to_string(r.state()); },
          "running, done, failed or stopped")
      .def_property_readonly("task", &task_of, "the active one's name")
      .def_property_readonly(
          "force", &runtime::Runner::estimated_force,
          "(3,) estimate of what the world presses with: x, y [N], rz [N m] in the base's axes")
      .def_property_readonly(
          "why",
          [](const runtime::Runner& r) {
            const auto why = r.why();
            return why ? why->sentence : std::string();
          },
          "a sentence: why the run is not done; empty where it is")
      .def_property_readonly("transitions", &transitions_of, "the tasks that were entered, and when [s]")
      .def_property_readonly("limits", &runtime::Runner::limits, "as of Result")
      .def_property_readonly("events", &events_of, "code, time [s], signal and value of each")
      .def_property_readonly(
          "outputs", &outputs_of,
          "by name, what the task's outputs are set to after the last step: SI, or 0 and 1")
      .def("set", &set_parameter, arg("name"), arg("value"), "A parameter, in SI, between two steps.")
      .def(
          "stop", [](runtime::Runner& r) { r.guard().stop(runtime::EventCode::requested); },
          "The protective stop: brakes and holds from the next step on.")
      .def(
          "reset", [](runtime::Runner& r) { r.guard().reset(); }, "Releases the protective stop.");
}

}  // namespace

void bind_loop(py::module_& module) {
  bind_sensed(module);
  bind_runner(module);
}

}  // namespace zwang::python
