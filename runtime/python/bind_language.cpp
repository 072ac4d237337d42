// Task files: load, validate, and what they say.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <sstream>

#include "bind.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

std::string rendered(const lang::Diagnostics& diagnostics) {
  std::ostringstream text;
  lang::render_human(diagnostics, text);
  return text.str();
}

const char* name_of(lang::Severity severity) {
  switch (severity) {
    case lang::Severity::note:
      return "note";
    case lang::Severity::warning:
      return "warning";
    case lang::Severity::error:
      break;
  }
  return "error";
}

/// As Python has it: the span in words of an editor.
struct Told {
  std::string code, severity, message, help, path;
  int line = 0, column = 0;
};

std::vector<Told> told(const lang::Diagnostics& diagnostics, bool notes) {
  std::vector<Told> all;
  for (const lang::Diagnostic& d : diagnostics.sorted()) {
    if (d.severity == lang::Severity::note && !notes) continue;
    Told one{d.code, name_of(d.severity), d.message, d.help, "", 0, 0};
    if (d.span.exists()) {
      one.path = diagnostics.source(d.span.source).path;
      one.line = d.span.begin.line;
      one.column = d.span.begin.column;
    }
    all.push_back(std::move(one));
  }
  return all;
}

lang::LoadOptions options_of(const std::optional<fs::path>& robot, const std::optional<fs::path>& scene,
                             const std::map<std::string, std::string>& params) {
  lang::LoadOptions options;
  options.robot = robot;
  options.scene = scene;
  options.parameters = params;
  return options;
}

lang::Program load(const fs::path& path, const std::optional<fs::path>& robot,
                   const std::optional<fs::path>& scene, const std::map<std::string, std::string>& params) {
  lang::Diagnostics diagnostics;
  std::optional<lang::Program> program = lang::load(path, options_of(robot, scene, params), diagnostics);
  if (!program) throw LoadError(std::move(diagnostics));
  return *std::move(program);
}

std::vector<Told> validate(const fs::path& path, const std::optional<fs::path>& robot,
                           const std::optional<fs::path>& scene,
                           const std::map<std::string, std::string>& params, bool notes) {
  lang::Diagnostics diagnostics;
  lang::load(path, options_of(robot, scene, params), diagnostics);
  return told(diagnostics, notes);
}

std::vector<std::string> joints_of(const lang::Program& program) {
  std::vector<std::string> names;
  for (int j = 0; j < program.robot.model.joint_count(); ++j)
    names.push_back(program.robot.model.joint(j).name);
  return names;
}

template <typename Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

std::map<std::string, double> values_of(const std::vector<lang::Parameter>& parameters) {
  std::map<std::string, double> values;
  for (const lang::Parameter& p : parameters) values[p.name] = p.value;
  return values;
}

/// pybind11 keeps one exception type for all modules: that of the last import.
void throw_as(const py::object& type, const LoadError& error) {
  py::object raised = type(error.what());
  raised.attr("diagnostics") = py::cast(told(error.diagnostics, false));
  PyErr_SetObject(type.ptr(), raised.ptr());
}

}  // namespace

LoadError::LoadError(lang::Diagnostics given)
    : std::runtime_error(rendered(given)), diagnostics(std::move(given)) {}

void bind_language(py::module_& module) {
  using py::arg;
  py::class_<Told>(module, "Diagnostic", "What zwang has to say about a line of a file.")
      .def_readonly("code", &Told::code, "stable, as `E201`; `zwang explain E201` says more")
      .def_readonly("severity", &Told::severity, "`error`, `warning` or `note`")
      .def_readonly("message", &Told::message)
      .def_readonly("help", &Told::help, "what to write instead; may be empty")
      .def_readonly("path", &Told::path)
      .def_readonly("line", &Told::line, "from 1")
      .def_readonly("column", &Told::column, "from 1, in code points")
      .def("__repr__", [](const Told& d) {
        return d.path + ":" + std::to_string(d.line) + ":" + std::to_string(d.column) + ": " + d.severity +
               " " + d.code + ": " + d.message;
      });

  py::class_<lang::Program>(module, "Program", "A task file, checked against its robot and scene. Immutable.")
      .def_readonly("path", &lang::Program::path)
      .def_property_readonly(
          "robot", [](const lang::Program& p) { return p.robot.name; }, "the robot's name, of its URDF")
      .def_property_readonly(
          "tasks", [](const lang::Program& p) { return names_of(p.tasks); },
          "their names, in the file's order")
      .def_property_readonly(
          "signals", [](const lang::Program& p) { return names_of(p.signals); }, "what the host measures")
      .def_property_readonly(
          "outputs", [](const lang::Program& p) { return names_of(p.outputs); },
          "what tasks set beside motion, in the file's order")
      .def_property_readonly("joints", &joints_of, "of the robot, in the order of `q`, `qd` and torques")
      .def_property_readonly(
          "params", [](const lang::Program& p) { return values_of(p.parameters); },
          "their values in SI, by name")
      .def("__repr__", [](const lang::Program& p) {
        return "<zwang.Program " + p.path + ", robot " + p.robot.name + ">";
      });

  static py::object error = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "zwang.Error", "A file that cannot be run; `diagnostics` says why.", PyExc_ValueError, nullptr));
  module.attr("Error") = error;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const LoadError& e) {
      throw_as(error, e);
    }
  });

  module.def(
      "load", &load, arg("path"), py::kw_only(), arg("robot") = py::none(), arg("scene") = py::none(),
      arg("params") = std::map<std::string, std::string>{}, py::call_guard<py::gil_scoped_release>(),
      "Reads a task file with its robot and scene. `params`: values with units, {'push': '30 N'}. Raises "
      "Error.");
  module.def("validate", &validate, arg("path"), py::kw_only(), arg("robot") = py::none(),
             arg("scene") = py::none(), arg("params") = std::map<std::string, std::string>{},
             arg("notes") = false, py::call_guard<py::gil_scoped_release>(),
             "What `zwang validate` says of a task file, in the order of the text.");
}

}  // namespace zwang::python
