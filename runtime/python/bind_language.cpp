// Task files: load, validate, and what they say.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <sstream>
#include <variant>

#include "bind.hpp"
#include "read_program.hpp"
#include "zwang/lang/check_file.hpp"
#include "zwang/lang/mending.hpp"
#include "zwang/lang/open_texts.hpp"
#include "zwang/runtime/with_unit.hpp"

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

/// A text for a place of a file. Lines and columns count from 1, the end is exclusive.
struct Edit {
  std::string path;
  int line = 0, column = 0, end_line = 0, end_column = 0;
  std::string text;
};

/// As Python has it: the span in words of an editor.
struct Told {
  std::string code, severity, message, help, path;
  int line = 0, column = 0;
  std::optional<std::string> replacement;
  std::vector<std::string> choices;
  std::vector<Edit> edits;  ///< they belong together: all of them, or none
};

/// As `zwang validate --format json` tells them.
std::vector<Edit> edits_of(const lang::Diagnostics& diagnostics, const lang::Diagnostic& d) {
  std::vector<Edit> edits;
  const auto add = [&](const lang::Span& span, const std::optional<std::string>& text) {
    if (!text || !span.exists()) return;
    edits.push_back({diagnostics.source(span.source).path, span.begin.line, span.begin.column, span.end.line,
                     span.end.column, *text});
  };
  add(d.span, d.replacement);
  for (const lang::RelatedSpan& related : d.related) add(related.span, related.replacement);
  return edits;
}

std::vector<Told> told(const lang::Diagnostics& diagnostics, bool notes) {
  std::vector<Told> all;
  for (const lang::Diagnostic& d : diagnostics.sorted()) {
    if (d.severity == lang::Severity::note && !notes) continue;
    Told one{d.code,    name_of(d.severity),     d.message, d.help, "", 0, 0, d.replacement,
             d.choices, edits_of(diagnostics, d)};
    if (d.span.exists()) {
      one.path = diagnostics.source(d.span.source).path;
      one.line = d.span.begin.line;
      one.column = d.span.begin.column;
    }
    all.push_back(std::move(one));
  }
  return all;
}

/// With its unit, or a number in SI.
using Parameter = std::variant<std::string, double>;
using Parameters = std::map<std::string, Parameter>;
using Texts = std::map<fs::path, std::string>;

/// A number is written in the unit of the file, which only the file knows.
std::map<std::string, std::string> in_words(const Parameters& params, const fs::path& path,
                                            lang::LoadOptions options) {
  std::map<std::string, std::string> words;
  std::optional<lang::Program> program;
  for (const auto& [name, value] : params) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      words[name] = *text;
      continue;
    }
    lang::Diagnostics unheard;
    if (!program) program = lang::load(path, options, unheard);
    const double number = std::get<double>(value);
    words[name] = runtime::exactly(number);
    for (const lang::Parameter& p : program ? program->parameters : std::vector<lang::Parameter>()) {
      if (p.name == name) words[name] = runtime::exactly(number / p.unit_scale) + " " + p.unit;
    }
  }
  return words;
}

lang::LoadOptions options_of(const fs::path& path, const std::optional<fs::path>& robot,
                             const std::optional<fs::path>& scene, const Parameters& params) {
  lang::LoadOptions options;
  options.robot = robot;
  options.scene = scene;
  options.parameters = in_words(params, path, options);
  return options;
}

lang::OpenTexts open_texts(const fs::path& path, const std::optional<std::string>& text, const Texts& files) {
  lang::OpenTexts texts;
  for (const auto& [file, open] : files) texts.put(file, open);
  if (text) texts.put(path, *text);
  return texts;
}

ReadProgram load(const fs::path& path, const std::optional<std::string>& text, const Texts& open_files,
                 const std::optional<fs::path>& robot, const std::optional<fs::path>& scene,
                 const Parameters& params) {
  const lang::OpenTexts texts = open_texts(path, text, open_files);
  const lang::ReadsOpenTexts reading(texts);
  lang::Diagnostics diagnostics;
  std::optional<lang::Program> program =
      lang::load(path, options_of(path, robot, scene, params), diagnostics);
  if (!program) throw LoadError(std::move(diagnostics));
  ReadProgram read{*std::move(program), diagnostics.sources(), {}};
  if (robot) read.facts["robot"] = robot->string();
  if (scene) read.facts["scene"] = scene->string();
  return read;
}

void look_at(const fs::path& path, const lang::CheckOptions& options, lang::Diagnostics& diagnostics) {
  const lang::FileKind kind = lang::kind_of_file(path).value_or(lang::FileKind::task);
  lang::check_file(kind, path, options, diagnostics);
  diagnostics = lang::with_mending_edits(kind, path, options, diagnostics);
}

std::vector<Told> validate(const fs::path& path, const std::optional<std::string>& text,
                           const Texts& open_files, const std::optional<fs::path>& robot,
                           const std::optional<fs::path>& scene, const Parameters& params, bool notes,
                           const std::optional<fs::path>& task) {
  const lang::OpenTexts texts = open_texts(path, text, open_files);
  const lang::ReadsOpenTexts reading(texts);
  lang::Diagnostics diagnostics;
  const lang::LoadOptions options = options_of(task.value_or(path), robot, scene, params);
  look_at(path, {.load = options, .with_notes = notes, .task = task}, diagnostics);
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

namespace {

void bind_diagnostic(py::module_& module) {
  py::class_<Edit>(module, "Edit", "A text for a place of a file. The end is exclusive.")
      .def_readonly("path", &Edit::path, "of the file that it changes")
      .def_readonly("line", &Edit::line, "from 1")
      .def_readonly("column", &Edit::column, "from 1, in code points")
      .def_readonly("end_line", &Edit::end_line, "from 1")
      .def_readonly("end_column", &Edit::end_column, "from 1, behind the last character")
      .def_readonly("text", &Edit::text, "what stands there afterwards; empty: nothing")
      .def("__repr__", [](const Edit& e) {
        return e.path + ":" + std::to_string(e.line) + ":" + std::to_string(e.column) + ": `" + e.text + "`";
      });

  py::class_<Told>(module, "Diagnostic", "What zwang has to say about a line of a file.")
      .def_readonly("code", &Told::code, "stable, as `E201`; `zwang explain E201` says more")
      .def_readonly("severity", &Told::severity, "`error`, `warning` or `note`")
      .def_readonly("message", &Told::message, "what is wrong, with the values")
      .def_readonly("help", &Told::help, "what to write instead; may be empty")
      .def_readonly("path", &Told::path, "of the file; empty: no file's")
      .def_readonly("line", &Told::line, "from 1")
      .def_readonly("column", &Told::column, "from 1, in code points")
      .def_readonly("replacement", &Told::replacement, "what may stand in its place; None: nobody can tell")
      .def_readonly("choices", &Told::choices, "without a `replacement`: each of them may stand in its place")
      .def_readonly("edits", &Told::edits, "what mends it, also in other files: all of them together")
      .def("__repr__", [](const Told& d) {
        return d.path + ":" + std::to_string(d.line) + ":" + std::to_string(d.column) + ": " + d.severity +
               " " + d.code + ": " + d.message;
      });
}

void bind_program(py::module_& module) {
  py::class_<lang::Program>(module, "_Program")
      .def_readonly("path", &lang::Program::path, "of the task file")
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
  py::class_<ReadProgram, lang::Program>(module, "Program",
                                         "A task file, checked against its robot and scene. Immutable.");
}

}  // namespace

void bind_language(py::module_& module) {
  using py::arg;
  bind_diagnostic(module);
  bind_program(module);

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
      "load", &load, arg("path"), py::kw_only(), arg("text") = py::none(), arg("open_files") = Texts{},
      arg("robot") = py::none(), arg("scene") = py::none(), arg("params") = Parameters{},
      py::call_guard<py::gil_scoped_release>(),
      "Reads a task file with its robot and scene. `text` is read in the file's place, `open_files` in the "
      "place of those that it names. `params`: {'push': '30 N'}, or numbers in SI. Raises Error.");
  module.def(
      "validate", &validate, arg("path"), py::kw_only(), arg("text") = py::none(),
      arg("open_files") = Texts{}, arg("robot") = py::none(), arg("scene") = py::none(),
      arg("params") = Parameters{}, arg("notes") = false, arg("task") = py::none(),
      py::call_guard<py::gil_scoped_release>(),
      "What `zwang validate` says of a file of any kind, in the order of the text. A connection file is "
      "checked against `task`.");
}

}  // namespace zwang::python
