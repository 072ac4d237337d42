// Whole runs on the simulated plant.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>

#include "bind.hpp"
#include "log_file.hpp"
#include "log_table.hpp"
#include "named_sensed.hpp"
#include "zwang/runtime/simulated_run.hpp"

namespace zwang::python {

namespace py = pybind11;

namespace {

using runtime::PlantStatus;

/// The plant's true values, by the names of scenarios.
using Truths = std::map<std::string, std::optional<double>>;

Truths truths_of(const runtime::Truth& truth) {
  Truths all = {{"base.x", truth.x},
                {"base.y", truth.y},
                {"base.yaw", truth.yaw},
                {"base.vx", truth.velocity.x()},
                {"base.vy", truth.velocity.y()},
                {"base.wz", truth.velocity.z()},
                {"base.roll", truth.base.roll},
                {"base.pitch", truth.base.pitch},
                {"base.acceleration", truth.base.acceleration},
                {"base.push", truth.base.push},
                {"base.fallen", truth.base.fallen}};
  for (const runtime::ObjectTruth& o : truth.objects) {
    all[o.name + ".force"] = o.force;
    all[o.name + ".peak_force"] = o.peak_force;
    all[o.name + ".touched"] = o.touched;
    all[o.name + ".latched"] = o.latched;
    all[o.name + ".pull"] = o.pull;
    all[o.name + ".x"] = o.x;
    all[o.name + ".y"] = o.y;
    all[o.name + ".yaw"] = o.yaw;
  }
  return all;
}

struct Result {
  std::string outcome, because, why;
  double time = 0.0;  ///< [s]
  Truths truth;
  std::vector<runtime::LimitReport> limits;
  std::shared_ptr<LogTable> log;
};

runtime::ScenePlantOptions options_of(std::uint64_t seed,
                                      const std::optional<std::array<double, 2>>& start_at,
                                      std::optional<double> start_yaw, double period) {
  runtime::ScenePlantOptions options;
  options.seed = seed;
  options.simulation.start_at = start_at;
  options.simulation.start_yaw = start_yaw;
  options.simulation.period = runtime::SimulationSteps(period).period();
  return options;
}

/// Of the main thread; other threads hear nothing of them.
void heed_interruptions() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

constexpr int ticks_between_looks = 1000;

/// Keeps a log with the truth, and lets the main thread of Python interrupt.
class PythonRun final : public runtime::SimulatedRunHost {
 public:
  PythonRun(const lang::Program& program, const runtime::ScenePlant& plant, runtime::Runner& runner,
            runtime::Recorder* recorder)
      : scene_(*program.scene),
        plant_(plant),
        runner_(runner),
        recorder_(recorder),
        truth_(runtime::truth_columns(scene_).size()) {}
  bool tick(const runtime::Sensed& sensed) override {
    if (recorder_ != nullptr) recorder_->wait_for_room();
    if (++ticks_ % ticks_between_looks == 0) heed_interruptions();
    runtime::put_truth(plant_.truth(), scene_, truth_);
    runner_.step(sensed, truth_);
    return true;
  }

 private:
  const lang::Scene& scene_;
  const runtime::ScenePlant& plant_;
  runtime::Runner& runner_;
  runtime::Recorder* recorder_;
  std::vector<double> truth_;
  int ticks_ = 0;
};

/// As `zwang run` does it. `most`: [s] of simulated time.
Result simulate(const ReadProgram& program, double most, bool with_log, std::uint64_t seed,
                std::optional<std::array<double, 2>> start_at, std::optional<double> start_yaw,
                const std::optional<std::filesystem::path>& file) {
  if (!program.scene) throw std::invalid_argument("the task names no scene to run in: load(.., scene=..)");
  runtime::RunnerSettings settings;
  settings.extra_columns = runtime::truth_columns(*program.scene);
  runtime::Runner runner(program, settings);
  runtime::ScenePlant plant(program, options_of(seed, start_at, start_yaw, runner.period()));
  Result result;
  std::optional<runtime::Recorder> recorder;
  if (with_log || file) {
    std::vector<std::unique_ptr<runtime::LogSink>> sinks;
    if (with_log) result.log = std::make_shared<LogTable>(runner.columns());
    if (with_log) sinks.push_back(table_sink(result.log));
    if (file) sinks.push_back(log_file(*file, program, runner));
    recorder.emplace(std::move(sinks), runner.columns());
    runner.record_to(&*recorder);
  }
  runtime::Sensed sensed(program);
  PythonRun host(program, plant, runner, recorder ? &*recorder : nullptr);
  const PlantStatus status = runtime::run_simulated(plant, runner, sensed, most, host);
  if (recorder) {
    recorder->close();
    require_complete(*recorder);
  }
  result.time = plant.truth().time;
  result.truth = truths_of(plant.truth());
  result.limits = runner.limits();
  result.because = runner.because();
  if (const auto why = runner.why()) result.why = why->sentence;
  result.outcome = runner.finished() ? to_string(runner.state()) : "unfinished";
  if (plant.truth().base.fallen) {
    result.outcome = "fallen";
    result.because = runtime::describe_fall(plant.truth().base);
    result.why.clear();
  }
  if (status == PlantStatus::diverged) result.outcome = "diverged";
  return result;
}

void check(PlantStatus status, const char* what) {
  if (status == PlantStatus::diverged) throw std::runtime_error("the simulation diverged");
  if (status == PlantStatus::unreachable)
    throw std::runtime_error(std::string("the plant was not reached: ") + what);
}

/// A plant whose `apply` lasts a control period, however many steps of the simulation that is.
class TickedPlant {
 public:
  TickedPlant(const lang::Program& program, std::uint64_t seed,
              const std::optional<std::array<double, 2>>& start_at, std::optional<double> start_yaw)
      : steps_(program.robot.control_period),
        plant_(program, options_of(seed, start_at, start_yaw, program.robot.control_period)) {}

  void sense(NamedSensed& sensed) { check(plant_.sense(sensed.sensed), "no sample"); }
  void apply(const runtime::Command& command) {
    for (int i = 0; i < steps_.per_tick(); ++i) check(plant_.follow(command), "the command did not arrive");
  }
  Truths truth() const { return truths_of(plant_.truth()); }

 private:
  runtime::SimulationSteps steps_;
  runtime::ScenePlant plant_;
};

void bind_result(py::module_& module) {
  py::class_<runtime::LimitReport>(module, "Limit",
                                   "A limit that was in force, and how near the run came to it.")
      .def_readonly("row", &runtime::LimitReport::row, "its column of the log")
      .def_readonly("limit", &runtime::LimitReport::limit, "SI")
      .def_readonly("worst", &runtime::LimitReport::worst, "the value nearest to it, or farthest beyond; SI")
      .def_readonly("margin", &runtime::LimitReport::margin, "what was left; negative where it was broken")
      .def_readonly("unit", &runtime::LimitReport::unit,
                    "of `limit`, `worst` and `margin`; empty for pure numbers")
      .def("__repr__", [](const runtime::LimitReport& l) { return "<zwang.Limit " + l.row + ">"; });
  py::class_<Result>(module, "Result", "How a run ended.")
      .def_readonly("outcome", &Result::outcome,
                    "done, failed, stopped, fallen, diverged, or unfinished within `most`")
      .def_readonly("because", &Result::because, "of a stop or a fall; may be empty")
      .def_readonly("why", &Result::why, "a sentence: what its task waited for; empty of a run that is done")
      .def_readonly("time", &Result::time, "[s] of simulated time")
      .def_readonly(
          "truth", &Result::truth,
          "what the plant measured at the end, in SI: `truth['wall.peak_force']`; None: it never was")
      .def_readonly("limits", &Result::limits, "every limit that was in force")
      .def_readonly("log", &Result::log, "None without `log=True`")
      .def("__repr__", [](const Result& r) { return "<zwang.Result " + r.outcome + ">"; });
}

}  // namespace

void bind_run(py::module_& module) {
  using py::arg;
  bind_result(module);
  py::class_<TickedPlant>(module, "ScenePlant", "The simulated robot in the scene of its task.")
      .def(py::init<const lang::Program&, std::uint64_t, const std::optional<std::array<double, 2>>&,
                    std::optional<double>>(),
           arg("program"), py::kw_only(), arg("seed") = 0, arg("start_at") = py::none(),
           arg("start_yaw") = py::none())
      .def("sense", &TickedPlant::sense, arg("sensed"), "Raises RuntimeError where a sample is lost.")
      .def("apply", &TickedPlant::apply, arg("command"), "For one control period.")
      .def_property_readonly("truth", &TickedPlant::truth, "what the plant measured, as Result.truth");
  py::class_<FileRecorder>(module, "_FileRecorder", "Writes each step of a runner into a file.")
      .def(py::init<runtime::Runner&, const ReadProgram&, const std::filesystem::path&>(), arg("runner"),
           arg("program"), arg("file"), py::keep_alive<1, 2>(), py::keep_alive<1, 3>())
      .def("wait", &FileRecorder::wait, py::call_guard<py::gil_scoped_release>())
      .def("close", &FileRecorder::close, py::call_guard<py::gil_scoped_release>());
  module.def("simulate", &simulate, arg("program"), py::kw_only(), arg("most") = 600.0, arg("log") = false,
             arg("seed") = 0, arg("start_at") = py::none(), arg("start_yaw") = py::none(),
             arg("file") = py::none(), py::call_guard<py::gil_scoped_release>(),
             "Runs the task on the simulated robot. `most` [s]; `log`: keep every tick; `file`: write them; "
             "`start_at` (x, y) [m] and "
             "`start_yaw` [rad] in the place of the scene's.");
}

}  // namespace zwang::python
