// Logs as numpy columns.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bind.hpp"
#include "log_table.hpp"

namespace zwang::python {

namespace py = pybind11;

namespace {

std::vector<std::string> column_names(const LogTable& table) {
  std::vector<std::string> names;
  for (const runtime::Column& column : table.columns()) names.push_back(column.name);
  return names;
}

/// A view into the table, which lives as long as the view.
py::array_t<double> column_of(const py::object& self, const std::string& name) {
  const auto& table = self.cast<const LogTable&>();
  std::size_t place = 0;
  try {
    place = table.column(name);
  } catch (const std::out_of_range& error) {
    throw py::key_error(error.what());
  }
  const auto stride = static_cast<py::ssize_t>(table.columns().size() * sizeof(double));
  py::array_t<double> view({static_cast<py::ssize_t>(table.size())}, {stride}, table.data() + place, self);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

}  // namespace

void bind_log(py::module_& module) {
  using py::arg;
  py::class_<LogTable, std::shared_ptr<LogTable>>(
      module, "Log", "A run, tick by tick: `log['time']` is a read-only numpy column, NaN where it is blank.")
      .def_property_readonly("columns", &column_names, "their names")
      .def("__getitem__", &column_of, arg("name"))
      .def("__contains__",
           [](const LogTable& table, const std::string& name) {
             try {
               table.column(name);
             } catch (const std::out_of_range&) {
               return false;
             }
             return true;
           })
      .def("__len__", &LogTable::size, "ticks")
      .def(
          "words",
          [](const LogTable& table, const std::string& name) {
            return table.columns()[table.column(name)].words;
          },
          arg("name"), "What the numbers of a column of words stand for, `log.words('task')`.")
      .def(
          "unit",
          [](const LogTable& table, const std::string& name) {
            return table.columns()[table.column(name)].unit;
          },
          arg("name"), "SI; empty for pure numbers.");
  module.def(
      "read_log", &read_table, arg("path"), py::call_guard<py::gil_scoped_release>(),
      "The log of a run, a file or its folder, as far as it can be read. Raises RuntimeError if it is none.");
}

}  // namespace zwang::python
